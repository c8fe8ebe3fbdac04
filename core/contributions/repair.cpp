#include "contributions/repair.h"

#include "reference/refine.h"

namespace dualblock {
namespace {

/// Whether the edge of s between local vertices i and k is inside its part: on none of its boundary faces.
template <int N> bool isInnerEdge(const ReferenceMesh<N> &mesh, Index s, int i, int k) {
  if constexpr (N == 2) {
    return mesh.tags[at(s)][3 - i - k] == kNone;
  } else {
    int from = 0;
    while (from == i || from == k) ++from;
    const int to = 6 - i - k - from;
    const FaceRef<N> end = turnAroundRidge(mesh, s, from, to, kCrossNone, [](Index) {});
    return mesh.tags[at(end.simplex)][end.face] == kNone;
  }
}

template <int N> bool onPartBoundary(const Parts<N> &parts, Index node, Index part) {
  const Index *const begin = parts.nodeSides.begin(node);
  const Index *const end = parts.nodeSides.end(node);
  const Index *const found = std::lower_bound(begin, end, parts.partSides.offsets[at(part)]);
  return found != end && *found < parts.partSides.offsets[at(part) + 1];
}

/// Whether node k of simplex s is one of those that are to be torn apart: on the boundary of its part.
template <int N> class PartBoundary {
public:
  PartBoundary(const ReferenceMesh<N> &mesh, const Parts<N> &parts)
      : mesh_(mesh), parts_(parts), partOf_(parts.partOfSimplex) {}

  bool has(Index s, Index node) const {
    return node < parts_.nodeSides.count() && onPartBoundary(parts_, node, partOf_[at(s)]);
  }

  /// The simplices that are new are pieces of the part of s.
  void addPiecesOf(Index s) { partOf_.resize(mesh_.simplices.size(), Index{partOf_[at(s)]}); }

  /// Adds the pieces that have been split off the given simplices, which are those of whole parts.
  void addPieces(std::vector<Index> &simplices) {
    partOf_.resize(mesh_.simplices.size(), kNone);
    for (std::size_t n = 0; n < simplices.size(); ++n)
      for (int i = 0; i < N + 1; ++i) {
        const Index s = simplices[n];
        const Index t = mesh_.neighbors[at(s)][i];
        if (t == kNone || mesh_.tags[at(s)][i] != kNone || partOf_[at(t)] != kNone) continue;
        partOf_[at(t)] = partOf_[at(s)];
        simplices.push_back(t);
      }
  }

private:
  const ReferenceMesh<N> &mesh_;
  const Parts<N> &parts_;
  std::vector<Index> partOf_;
};

/// Splits, in the simplices of whole parts, the inner edges between nodes of the boundary, then the inner
/// faces of such nodes, of each simplex at most one.
template <int N>
Index fillBoundary(ReferenceMesh<N> &mesh, std::vector<Index> simplices, PartBoundary<N> boundary) {
  std::vector<std::pair<Index, Index>> edges;
  for (const Index s : simplices) {
    const auto &v = mesh.simplices[at(s)];
    for (int i = 0; i < N + 1; ++i)
      for (int k = i + 1; k < N + 1; ++k)
        if (boundary.has(s, v[i]) && boundary.has(s, v[k]) && isInnerEdge(mesh, s, i, k))
          edges.emplace_back(std::minmax(v[i], v[k]));
  }
  const Index nodes = mesh.nodeCount();
  if (!edges.empty()) {
    splitEdges(mesh, std::move(edges));
    boundary.addPieces(simplices);
  }
  // A new node is on no boundary, so the list, which grows by the pieces, comes to an end.
  for (std::size_t n = 0; n < simplices.size(); ++n)
    for (int i = 0; i < N + 1; ++i) {
      const Index s = simplices[n];
      if (mesh.neighbors[at(s)][i] == kNone || mesh.tags[at(s)][i] != kNone) continue;
      bool all = true;
      for (int k = 0; k < N + 1; ++k) all &= k == i || boundary.has(s, mesh.simplices[at(s)][k]);
      if (!all) continue;
      simplices.insert(simplices.end(), {s, mesh.neighbors[at(s)][i]}); // what is left of them
      const Index before = mesh.simplexCount();
      splitFace(mesh, FaceRef<N>{s, i});
      for (Index piece = before; piece < mesh.simplexCount(); ++piece) simplices.push_back(piece);
      boundary.addPiecesOf(s);
      break;
    }
  return mesh.nodeCount() - nodes;
}

} // namespace

template <int N>
Index repairFullness(ReferenceMesh<N> &mesh, const Parts<N> &parts, const std::vector<NotFull> &notFull) {
  std::vector<bool> wanted(parts.sides.size(), false);
  for (const NotFull &n : notFull) wanted[at(n.contribution.side)] = true;
  const SideEdges onSide(mesh, parts, wanted);
  std::vector<std::pair<Index, Index>> edges;
  for (const auto &[s, c] : notFull)
    for (int i = 0; i < N + 1; ++i)
      for (int k = i + 1; k < N + 1; ++k) {
        if (!(c.mask >> i & 1) || !(c.mask >> k & 1)) continue;
        const auto [a, b] = sortedPair(mesh.simplices[at(s)][i], mesh.simplices[at(s)][k]);
        if (!onSide.has(c.side, a, b)) edges.emplace_back(a, b);
      }
  const Index before = mesh.nodeCount();
  if (!edges.empty()) {
    splitEdges(mesh, std::move(edges));
    return mesh.nodeCount() - before;
  }
  // All edges are the side's own: a face is not.
  std::vector<Index> changed;
  for (const auto &[s, c] : notFull)
    for (int i = 0; i < N + 1; ++i) {
      const unsigned face = RegionTables<N>::kFullMask & ~(1U << i);
      if ((c.mask & face) != face) continue;
      const Index tag = mesh.tags[at(s)][i];
      if (tag != kNone && mesh.sideKey(tag) == mesh.sideKey(parts.sides[at(c.side)].tag)) continue;
      const Index t = mesh.neighbors[at(s)][i];
      const auto isChanged = [&](Index x) {
        return std::find(changed.begin(), changed.end(), x) != changed.end();
      };
      if (isChanged(s) || (t != kNone && isChanged(t))) continue;
      changed.push_back(s);
      if (t != kNone) changed.push_back(t);
      splitFace(mesh, FaceRef<N>{s, i});
    }
  return mesh.nodeCount() - before;
}

template <int N>
Index repairBubbles(ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualCells<N> &dual) {
  std::vector<bool> hasBubble(parts.parts.size(), false);
  for (const Index piece : dual.surplus) hasBubble[at(dual.pieces[at(piece)].part)] = true;
  std::vector<Index> simplices;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    if (hasBubble[at(parts.partOfSimplex[at(s)])]) simplices.push_back(s);
  return fillBoundary(mesh, std::move(simplices), PartBoundary<N>(mesh, parts));
}

template Index repairFullness(ReferenceMesh<2> &, const Parts<2> &, const std::vector<NotFull> &);
template Index repairFullness(ReferenceMesh<3> &, const Parts<3> &, const std::vector<NotFull> &);
template Index repairBubbles(ReferenceMesh<2> &, const Parts<2> &, const DualCells<2> &);
template Index repairBubbles(ReferenceMesh<3> &, const Parts<3> &, const DualCells<3> &);

} // namespace dualblock
