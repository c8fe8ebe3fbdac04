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

/// Splits the inner edges between nodes that `belongs` accepts, in the given simplices; if there are none,
/// the inner faces likewise, one per simplex.
template <int N, typename Belongs>
Index splitBetween(ReferenceMesh<N> &mesh, const std::vector<Index> &simplices, Belongs belongs) {
  std::vector<std::pair<Index, Index>> edges;
  for (const Index s : simplices) {
    const auto &v = mesh.simplices[at(s)];
    for (int i = 0; i < N + 1; ++i)
      for (int k = i + 1; k < N + 1; ++k)
        if (belongs(s, v[i]) && belongs(s, v[k]) && isInnerEdge(mesh, s, i, k))
          edges.emplace_back(std::minmax(v[i], v[k]));
  }
  const Index before = mesh.nodeCount();
  if (!edges.empty()) {
    splitEdges(mesh, std::move(edges));
    return mesh.nodeCount() - before;
  }
  std::vector<Index> changed;
  for (const Index s : simplices)
    for (int i = 0; i < N + 1; ++i) {
      const Index t = mesh.neighbors[at(s)][i];
      if (t == kNone || mesh.tags[at(s)][i] != kNone) continue;
      bool all = true;
      for (int k = 0; k < N + 1; ++k) all &= k == i || belongs(s, mesh.simplices[at(s)][k]);
      const auto isChanged = [&](Index x) {
        return std::find(changed.begin(), changed.end(), x) != changed.end();
      };
      if (!all || isChanged(s) || isChanged(t)) continue;
      changed.push_back(s);
      changed.push_back(t);
      splitFace(mesh, FaceRef<N>{s, i});
    }
  return mesh.nodeCount() - before;
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
  // Of the pieces that share a label, all but the largest are extra.
  std::vector<Index> sizes(dual.pieces.size(), 0);
  for (const Index piece : dual.pieceOf) ++sizes[at(piece)];
  std::vector<bool> extra(dual.pieces.size(), false);
  for (std::size_t k = 0; k < dual.surplus.size();) {
    const Index first = dual.surplus[k] - 1;
    Index largest = first;
    Index last = first;
    for (; k < dual.surplus.size() && dual.surplus[k] == last + 1; ++k) {
      last = dual.surplus[k];
      if (sizes[at(last)] > sizes[at(largest)]) largest = last;
    }
    for (Index p = first; p <= last; ++p)
      if (p != largest && dual.pieces[at(p)].sides == dual.pieces[at(largest)].sides) extra[at(p)] = true;
  }
  // Around the extra cells first; where there is nothing to split, around all cells of their part.
  std::vector<Index> around;
  std::vector<Index> ofPart;
  std::vector<bool> partHasExtra(parts.parts.size(), false);
  for (std::size_t p = 0; p < extra.size(); ++p)
    if (extra[p]) partHasExtra[at(dual.pieces[p].part)] = true;
  for (Index s = 0; s < toIndex(dual.classOffset.size()) - 1; ++s) {
    if (!partHasExtra[at(parts.partOfSimplex[at(s)])]) continue;
    ofPart.push_back(s);
    bool here = false;
    for (Index c = dual.classOffset[at(s)]; c < dual.classOffset[at(s) + 1]; ++c)
      here |= extra[at(dual.pieceOf[at(c)])];
    if (here) around.push_back(s);
  }
  const Index nodes = parts.nodeSides.count();
  const auto onBoundary = [&](Index s, Index node) {
    return node < nodes && onPartBoundary(parts, node, parts.partOfSimplex[at(s)]);
  };
  const Index added = splitBetween(mesh, around, onBoundary);
  return added > 0 ? added : splitBetween(mesh, ofPart, onBoundary);
}

template Index repairFullness(ReferenceMesh<2> &, const Parts<2> &, const std::vector<NotFull> &);
template Index repairFullness(ReferenceMesh<3> &, const Parts<3> &, const std::vector<NotFull> &);
template Index repairBubbles(ReferenceMesh<2> &, const Parts<2> &, const DualCells<2> &);
template Index repairBubbles(ReferenceMesh<3> &, const Parts<3> &, const DualCells<3> &);

} // namespace dualblock
