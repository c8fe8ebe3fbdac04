// Check 2: every label (part, set of sides) has one D-bar-cell piece, and every piece and every D-bar-cell is
// a ball as far as its Euler characteristic tells. A cell meets each simplex, face, edge and node of the
// reference mesh in convex pieces; over the inner ones, with alternating signs, these add up to its Euler
// characteristic (the reduced one of a simplex's link is its weight, 0 for simplices on the boundary).
#include <tuple>

#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

enum Depth : std::uint8_t { kInner = 0, kOnPart = 1, kOnDomain = 2 };

/// Nodes and edges on the boundary of parts and of the domain.
template <int N> struct BoundarySkeleton {
  std::vector<Depth> node;
  std::vector<std::pair<std::array<Index, 2>, Depth>> edges; // sorted

  explicit BoundarySkeleton(const ReferenceMesh<N> &mesh) : node(mesh.nodes.size(), kInner) {
    for (Index s = 0; s < mesh.simplexCount(); ++s)
      for (int i = 0; i < N + 1; ++i) {
        if (mesh.tags[at(s)][i] == kNone) continue;
        const Depth depth = mesh.neighbors[at(s)][i] == kNone ? kOnDomain : kOnPart;
        for (int a = 0; a < N + 1; ++a) {
          if (a == i) continue;
          Depth &d = node[at(mesh.simplices[at(s)][a])];
          d = std::max(d, depth);
          if constexpr (N == 3)
            for (int b = a + 1; b < N + 1; ++b)
              if (b != i)
                edges.push_back({sortedPair(mesh.simplices[at(s)][a], mesh.simplices[at(s)][b]), depth});
        }
      }
    // Of several entries for one edge the deepest comes first.
    sortByIndex(
        edges, mesh.nodes.size(), [](const auto &e) { return e.first[0]; },
        [](const auto &x, const auto &y) {
          return std::tie(x.first, y.second) < std::tie(y.first, x.second);
        });
    edges.erase(std::unique(edges.begin(), edges.end(),
                            [](const auto &x, const auto &y) { return x.first == y.first; }),
                edges.end());
  }

  Depth depthOfEdge(Index a, Index b) const {
    if (node[at(a)] == kInner || node[at(b)] == kInner) return kInner;
    const std::array<Index, 2> key{std::min(a, b), std::max(a, b)};
    const auto found = std::lower_bound(edges.begin(), edges.end(), key,
                                        [](const auto &e, const auto &k) { return e.first < k; });
    return found != edges.end() && found->first == key ? found->second : kInner;
  }
};

template <int N> class EulerCount {
public:
  EulerCount(const CertificateInput<N> &in)
      : in_(in), ofPiece(in.dual.pieces.size(), 0), ofCell(at(in.dual.cellCount), 0) {}

  /// Counts the class of s that lies inside of `inside` (within what is present).
  void add(Index s, ContributionSet inside, Depth depth, int weight) {
    const Index piece = pieceAt(s, inside);
    if (depth == kInner) ofPiece[at(piece)] += weight;
    if (depth != kOnDomain) ofCell[at(in_.dual.pieces[at(piece)].cell)] += weight;
  }

  Index pieceAt(Index s, ContributionSet inside) {
    const Index offset = in_.dual.classOffset[at(s)];
    const ContributionSet present = in_.contributions.present[at(s)];
    if (present == 0) return in_.dual.pieceOf[at(offset)];
    const auto &classes = cache_[present].inside;
    const auto found =
        std::find(classes.begin(), classes.end(), static_cast<ContributionSet>(inside & present));
    return in_.dual.pieceOf[at(offset) + static_cast<std::size_t>(found - classes.begin())];
  }

  const std::vector<ContributionSet> &classesOf(ContributionSet present) { return cache_[present].inside; }
  const auto &regionClasses(ContributionSet present) { return cache_[present].ofRegion; }

private:
  const CertificateInput<N> &in_;
  ClassCache<N> cache_;

public:
  std::vector<Index> ofPiece;
  std::vector<Index> ofCell;
};

/// The contributions that the place on an edge (a, b) or at a node (b < 0) lies inside of: those whose
/// subset holds all of the place's vertices.
template <int N> ContributionSet holding(unsigned vertices) {
  ContributionSet set = 0;
  for (unsigned mask = 1; mask < RegionTables<N>::kFullMask; ++mask)
    if ((mask & vertices) == vertices) set = set | contributionBit(mask);
  return set;
}

template <int N> void countSimplicesAndFaces(const CertificateInput<N> &in, EulerCount<N> &euler) {
  const auto &tables = RegionTables<N>::get();
  for (Index s = 0; s < in.mesh.simplexCount(); ++s) {
    const ContributionSet present = in.contributions.present[at(s)];
    if (present == 0) euler.add(s, 0, kInner, 1);
    else
      for (const ContributionSet inside : euler.classesOf(present)) euler.add(s, inside, kInner, 1);
    for (int i = 0; i < N + 1; ++i) {
      const Index t = in.mesh.neighbors[at(s)][i];
      if (t < s) continue; // outer faces have no weight; inner ones are counted once
      const Depth depth = in.mesh.tags[at(s)][i] == kNone ? kInner : kOnPart;
      if (present == 0) {
        euler.add(s, 0, depth, -1);
        continue;
      }
      std::uint64_t seen = 0;
      for (const std::uint8_t region : tables.onFace(i, 0)) {
        const std::uint8_t c = euler.regionClasses(present)[region];
        if (seen >> c & 1) continue;
        seen |= std::uint64_t{1} << c;
        euler.add(s, euler.classesOf(present)[c], depth, -1);
      }
    }
  }
}

/// Each node once, and (3D) each edge once, from one simplex that has it.
template <int N>
void countNodesAndEdges(const CertificateInput<N> &in, const BoundarySkeleton<N> &boundary,
                        EulerCount<N> &euler) {
  constexpr int kNodeWeight = N == 2 ? 1 : -1;
  const Index nodes = in.mesh.nodeCount();
  Lists<Index> around; // simplices around each node
  around.offsets.assign(at(nodes) + 1, 0);
  for (const auto &s : in.mesh.simplices)
    for (const Index v : s) ++around.offsets[at(v) + 1];
  for (std::size_t v = 0; v < at(nodes); ++v) around.offsets[v + 1] += around.offsets[v];
  around.items.resize(at(around.offsets.back()));
  std::vector<Index> cursor(around.offsets.begin(), around.offsets.end() - 1);
  for (Index s = 0; s < in.mesh.simplexCount(); ++s)
    for (const Index v : in.mesh.simplices[at(s)]) around.items[at(cursor[at(v)]++)] = s;

  std::vector<Index> seenFrom(at(nodes), kNone);
  for (Index a = 0; a < nodes; ++a) {
    if (around.size(a) == 0) continue;
    const Index first = *around.begin(a);
    euler.add(first, holding<N>(1U << in.mesh.localVertex(first, a)), boundary.node[at(a)], kNodeWeight);
    if constexpr (N == 3) {
      for (const Index *s = around.begin(a); s != around.end(a); ++s) {
        const ContributionSet present = in.contributions.present[at(*s)];
        for (int k = 0; k < N + 1; ++k) {
          const Index b = in.mesh.simplices[at(*s)][k];
          if (b <= a || seenFrom[at(b)] == a) continue;
          seenFrom[at(b)] = a;
          const Depth depth = boundary.depthOfEdge(a, b);
          if (depth == kOnDomain) continue;
          if (present == 0) {
            euler.add(*s, 0, depth, 1);
            continue;
          }
          // Up to three pieces along the edge: near a, in the middle, near b.
          const unsigned bitA = 1U << in.mesh.localVertex(*s, a);
          const unsigned bitB = 1U << k;
          const ContributionSet middle = holding<N>(bitA | bitB) & present;
          const ContributionSet nearA = holding<N>(bitA) & present;
          const ContributionSet nearB = holding<N>(bitB) & present;
          euler.add(*s, middle, depth, 1);
          if (nearA != middle) euler.add(*s, nearA, depth, 1);
          if (nearB != middle) euler.add(*s, nearB, depth, 1);
        }
      }
    }
  }
}

/// What each cell's Euler characteristic should be: 1, less 1 for each time that the domain's boundary comes
/// back to a node that the cell holds. There the domain itself is no manifold, and its neighbourhood no ball.
template <int N>
std::vector<Index> eulerOfCells(const CertificateInput<N> &in, const BlockComplex<N> &complex,
                                EulerCount<N> &euler) {
  std::vector<Index> wanted(euler.ofCell.size(), 1);
  for (const auto &[node, s] : complex.pinches) {
    const Index piece = euler.pieceAt(s, holding<N>(1U << in.mesh.localVertex(s, node)));
    --wanted[at(in.dual.pieces[at(piece)].cell)];
  }
  return wanted;
}

} // namespace

template <int N>
void checkCells(const CertificateInput<N> &in, const BlockComplex<N> &complex, Certificate &certificate) {
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
  const BoundarySkeleton<N> boundary(in.mesh);
  countSimplicesAndFaces(in, euler);
  countNodesAndEdges(in, boundary, euler);
  for (std::size_t p = 0; p < euler.ofPiece.size(); ++p)
    if (euler.ofPiece[p] != 1)
      certificate.fail(Check::cells,
                       "the D-bar-cell of " + describe(in.dual.pieces[p]) +
                           " is not a ball: Euler characteristic " + std::to_string(euler.ofPiece[p]),
                       {{"cell", in.dual.pieces[p].cell}});
  const std::vector<Index> wanted = eulerOfCells(in, complex, euler);
  for (std::size_t c = 0; c < euler.ofCell.size(); ++c)
    if (euler.ofCell[c] != wanted[c])
      certificate.fail(Check::cells,
                       "D-bar-cell " + std::to_string(c) + " is not a ball: Euler characteristic " +
                           std::to_string(euler.ofCell[c]) + " instead of " + std::to_string(wanted[c]),
                       {{"cell", static_cast<std::int64_t>(c)}});
}

template void checkCells(const CertificateInput<2> &, const BlockComplex<2> &, Certificate &);
template void checkCells(const CertificateInput<3> &, const BlockComplex<3> &, Certificate &);

} // namespace dualblock
