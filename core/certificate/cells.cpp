// Check 2: every label (part, set of sides) has one D-bar-cell piece, and every piece and every D-bar-cell is
// a ball as far as its Euler characteristic tells. A cell meets each simplex, face, edge and node of the
// reference mesh in convex pieces; over the inner ones, with alternating signs, these add up to its Euler
// characteristic (the reduced one of a simplex's link is its weight, 0 for simplices on the boundary).
#include <memory>
#include <numeric>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

enum Depth : std::uint8_t { kInner = 0, kOnPart = 1, kOnDomain = 2 };

template <int N> Depth depthOfFace(const ReferenceMesh<N> &mesh, Index s, int i) {
  if (mesh.tags[at(s)][i] == kNone) return kInner;
  return mesh.neighbors[at(s)][i] == kNone ? kOnDomain : kOnPart;
}

/// The classes of a simplex's regions that its faces, edges and nodes pass through.
template <int N> struct Places {
  std::array<std::vector<std::uint8_t>, N + 1> onFace;
  /// By mask of vertices: the class around their middle, inside of all contributions whose subset holds them.
  std::array<std::uint8_t, RegionTables<N>::kFullMask> around{};
  std::size_t classes;

  explicit Places(ContributionSet present) {
    const auto &tables = RegionTables<N>::get();
    const auto all = tables.classes(present);
    classes = all.inside.size();
    for (std::size_t i = 0; i < onFace.size(); ++i)
      for (const std::uint8_t region : tables.onFace(static_cast<int>(i), 0))
        if (const std::uint8_t c = all.ofRegion[region];
            std::find(onFace[i].begin(), onFace[i].end(), c) == onFace[i].end())
          onFace[i].push_back(c);
    for (unsigned vertices = 1; vertices < RegionTables<N>::kFullMask; ++vertices) {
      unsigned inside = 0;
      for (unsigned mask = 1; mask < RegionTables<N>::kFullMask; ++mask)
        if ((mask & vertices) == vertices) inside |= contributionBit(mask) & present;
      around[vertices] = static_cast<std::uint8_t>(std::find(all.inside.begin(), all.inside.end(), inside) -
                                                   all.inside.begin());
    }
  }
};

template <int N> class EulerCount {
public:
  explicit EulerCount(const CertificateInput<N> &in)
      : ofPiece(in.dual.pieces.size(), 0), in_(in), slots_(std::size_t{1} << 15),
        onPart_(in.dual.pieces.size(), 0) {}

  const Places<N> &places(Index s) {
    const ContributionSet present = in_.contributions.present[at(s)];
    auto &slot = slots_[present >> 1]; // no contribution has mask 0
    if (!slot) slot = std::make_unique<Places<N>>(present);
    return *slot;
  }

  Index pieceAt(Index s, std::size_t c) const {
    return in_.dual.pieceOf[at(in_.dual.classOffset[at(s)]) + c];
  }

  void add(Index s, std::size_t c, Depth depth, int weight) {
    if (depth != kOnDomain) (depth == kInner ? ofPiece : onPart_)[at(pieceAt(s, c))] += weight;
  }

  std::vector<Index> ofCells() const {
    std::vector<Index> sum(at(in_.dual.cellCount), 0);
    for (std::size_t p = 0; p < ofPiece.size(); ++p)
      sum[at(in_.dual.pieces[p].cell)] += ofPiece[p] + onPart_[p];
    return sum;
  }

  std::vector<Index> ofPiece;

private:
  const CertificateInput<N> &in_;
  std::vector<std::unique_ptr<Places<N>>> slots_;
  std::vector<Index> onPart_; // per piece: what it adds to its cell only
};

template <int N> void countSimplicesAndFaces(const CertificateInput<N> &in, EulerCount<N> &euler) {
  for (Index s = 0; s < in.mesh.simplexCount(); ++s) {
    const Places<N> &places = euler.places(s);
    for (std::size_t c = 0; c < places.classes; ++c) euler.add(s, c, kInner, 1);
    for (int i = 0; i < N + 1; ++i) {
      if (in.mesh.neighbors[at(s)][i] < s)
        continue; // outer faces have no weight; inner ones are counted once
      const Depth depth = depthOfFace(in.mesh, s, i);
      for (const std::uint8_t c : places.onFace[at(i)]) euler.add(s, c, depth, -1);
    }
  }
}

/// Each node once, and (3D) each edge once, from one simplex that has it.
template <int N> void countNodesAndEdges(const CertificateInput<N> &in, EulerCount<N> &euler) {
  constexpr int kNodeWeight = N == 2 ? 1 : -1;
  const Index nodes = in.mesh.nodeCount();
  const Lists<Index> around = collectLists<Index>(at(nodes), [&](auto put) { // simplices around each node
    for (Index s = 0; s < in.mesh.simplexCount(); ++s)
      for (const Index v : in.mesh.simplices[at(s)]) put(v, s);
  });

  struct Edge { // from the node at hand to a higher one
    Index to, simplex;
    unsigned near, far; // bits of its ends in the simplex
    Depth depth;
  };
  std::vector<Edge> edges;
  std::vector<std::size_t> place(at(nodes), 0); // of the edge to each node
  for (Index a = 0; a < nodes; ++a) {
    if (around.size(a) == 0) continue;
    edges.clear();
    Depth depth = kInner;
    for (const Index *s = around.begin(a); s != around.end(a); ++s) {
      const int v = in.mesh.localVertex(*s, a);
      std::array<Depth, N + 1> ofFace;
      for (int i = 0; i < N + 1; ++i) {
        ofFace[at(i)] = i == v ? kInner : depthOfFace(in.mesh, *s, i);
        depth = std::max(depth, ofFace[at(i)]);
      }
      for (int k = 0; N == 3 && k < N + 1; ++k) {
        const Index b = in.mesh.simplices[at(*s)][k];
        if (b <= a) continue;
        std::size_t &e = place[at(b)];
        if (e >= edges.size() || edges[e].to != b) {
          e = edges.size();
          edges.push_back({b, *s, 1U << v, 1U << k, kInner});
        }
        for (int i = 0; i < N + 1; ++i)
          if (i != k) edges[e].depth = std::max(edges[e].depth, ofFace[at(i)]);
      }
    }
    const Index first = *around.begin(a);
    euler.add(first, euler.places(first).around[1U << in.mesh.localVertex(first, a)], depth, kNodeWeight);
    for (const Edge &e : edges) {
      // Up to three pieces along the edge: near a, in the middle, near b.
      const auto &classAround = euler.places(e.simplex).around;
      const std::uint8_t middle = classAround[e.near | e.far];
      euler.add(e.simplex, middle, e.depth, 1);
      for (const unsigned end : {e.near, e.far})
        if (classAround[end] != middle) euler.add(e.simplex, classAround[end], e.depth, 1);
    }
  }
}

/// A node that the domain's boundary comes back to, once per further time, with a simplex that has it.
struct Pinch {
  Index node, simplex;
};

/// In 2D there are none: unpinch has doubled them.
std::vector<Pinch> findPinches(const ReferenceMesh<3> &mesh) {
  // Corners of outer faces: two at one node go together where their faces share an edge there.
  struct Corner {
    Pinch pinch;
    std::array<Index, 2> others; // nodes of the face
  };
  std::vector<Corner> corners;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      if (mesh.neighbors[at(s)][i] != kNone) continue;
      for (int v = 0; v < 4; ++v) {
        if (v == i) continue;
        Corner corner{{mesh.simplices[at(s)][v], s}, {}};
        for (int w = 0, m = 0; w < 4; ++w)
          if (w != i && w != v) corner.others[at(m++)] = mesh.simplices[at(s)][w];
        corners.push_back(corner);
      }
    }
  std::vector<Index> byNode(corners.size());
  std::iota(byNode.begin(), byNode.end(), 0);
  sortByIndex(
      byNode, mesh.nodes.size(), [&](Index c) { return corners[at(c)].pinch.node; },
      [](Index, Index) { return false; });
  DisjointSets sets(corners.size());
  std::vector<Index> last(mesh.nodes.size(), kNone); // corner, at the same node, whose face has this one, too
  for (const Index c : byNode)
    for (const Index other : corners[at(c)].others) {
      Index &before = last[at(other)];
      if (before != kNone && corners[at(before)].pinch.node == corners[at(c)].pinch.node)
        sets.unite(before, c);
      before = c;
    }
  std::vector<bool> seen(mesh.nodes.size(), false);
  std::vector<Pinch> pinches;
  for (Index c = 0; c < toIndex(corners.size()); ++c) {
    if (sets.find(c) != c) continue;
    const Pinch &pinch = corners[at(c)].pinch;
    if (seen[at(pinch.node)]) pinches.push_back(pinch);
    seen[at(pinch.node)] = true;
  }
  return pinches;
}

/// What each cell's Euler characteristic should be: 1, less 1 for each time that the domain's boundary comes
/// back to a node that the cell holds. There the domain itself is no manifold, and its neighbourhood no ball.
template <int N> std::vector<Index> eulerOfCells(const CertificateInput<N> &in, EulerCount<N> &euler) {
  std::vector<Index> wanted(at(in.dual.cellCount), 1);
  if constexpr (N == 3)
    for (const auto &[node, s] : findPinches(in.mesh)) {
      const Index piece = euler.pieceAt(s, euler.places(s).around[1U << in.mesh.localVertex(s, node)]);
      --wanted[at(in.dual.pieces[at(piece)].cell)];
    }
  return wanted;
}

} // namespace

template <int N> void checkCells(const CertificateInput<N> &in, Certificate &certificate) {
  const auto describe = [&](const CellPiece<N> &piece) {
    std::string text = "part " + std::to_string(piece.part) + ", sides {";
    for (int k = 0; k < piece.sideCount(); ++k) text += (k ? ", " : "") + std::to_string(piece.sides[at(k)]);
    return text + "}";
  };
  if (in.dual.overfull)
    certificate.fail(Check::cells,
                     "a region lies inside more D-bar-surfaces of one part than there are dimensions");
  for (std::size_t p = 0; p + 1 < in.dual.pieces.size(); ++p)
    if (in.dual.pieces[p].part == in.dual.pieces[p + 1].part &&
        in.dual.pieces[p].sides == in.dual.pieces[p + 1].sides)
      certificate.fail(Check::cells, "two D-bar-cells share the label " + describe(in.dual.pieces[p]),
                       {{"cell", in.dual.pieces[p].cell}, {"cell", in.dual.pieces[p + 1].cell}});
  EulerCount<N> euler(in);
  countSimplicesAndFaces(in, euler);
  countNodesAndEdges(in, euler);
  for (std::size_t p = 0; p < euler.ofPiece.size(); ++p)
    if (euler.ofPiece[p] != 1)
      certificate.fail(Check::cells,
                       "the D-bar-cell of " + describe(in.dual.pieces[p]) +
                           " is not a ball: Euler characteristic " + std::to_string(euler.ofPiece[p]),
                       {{"cell", in.dual.pieces[p].cell}});
  const std::vector<Index> wanted = eulerOfCells(in, euler);
  const std::vector<Index> found = euler.ofCells();
  for (std::size_t c = 0; c < found.size(); ++c)
    if (found[c] != wanted[c])
      certificate.fail(Check::cells,
                       "D-bar-cell " + std::to_string(c) + " is not a ball: Euler characteristic " +
                           std::to_string(found[c]) + " instead of " + std::to_string(wanted[c]),
                       {{"cell", static_cast<std::int64_t>(c)}});
}

template void checkCells(const CertificateInput<2> &, Certificate &);
template void checkCells(const CertificateInput<3> &, Certificate &);

} // namespace dualblock
