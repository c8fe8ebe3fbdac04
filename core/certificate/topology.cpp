// Check 3: the blocks by themselves form a conformal mesh with the topology of the domain.
#include <numeric>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

/// Euler characteristic, components and boundary components of a mesh.
struct Shape {
  Index euler = 0;
  Index components = 0;
  Index shells = 0;
  bool operator==(const Shape &) const = default;
};

std::string describe(const Shape &s) {
  return "Euler characteristic " + std::to_string(s.euler) + ", " + std::to_string(s.components) +
         " component(s), " + std::to_string(s.shells) + " boundary component(s)";
}

Index countSets(DisjointSets &sets, const std::vector<bool> &member) {
  Index count = 0;
  for (Index i = 0; i < toIndex(member.size()); ++i)
    if (member[at(i)] && sets.find(i) == i) ++count;
  return count;
}

/// Components of the nodes that the given cells (or boundary faces) hold together.
template <typename Cells> Index nodeComponents(const Cells &cells, std::size_t nodes) {
  DisjointSets sets(nodes);
  std::vector<bool> used(nodes, false);
  for (const auto &cell : cells)
    for (const Index v : cell) {
      used[at(v)] = true;
      sets.unite(v, cell[0]);
    }
  return countSets(sets, used);
}

/// How many different pairs of nodes there are. `forEdges(visit)` calls visit(a, b) for each, however often.
template <typename ForEdges> Index countEdges(std::size_t nodes, ForEdges forEdges) {
  std::vector<Index> place(nodes + 1, 0); // of the next higher node beside each lower one
  forEdges([&](Index a, Index b) { ++place[at(std::min(a, b)) + 1]; });
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<Index> ends(at(place.back()));
  forEdges([&](Index a, Index b) { ends[at(place[at(std::min(a, b))]++)] = std::max(a, b); });
  std::vector<Index> seenFrom(nodes, kNone);
  Index count = 0;
  for (Index a = 0, e = 0; a < toIndex(nodes); ++a)
    for (; e < place[at(a)]; ++e) {
      if (seenFrom[at(ends[at(e)])] != a) ++count;
      seenFrom[at(ends[at(e)])] = a;
    }
  return count;
}

/// How two faces of the same nodes run around them.
enum class Sense : std::uint8_t { opposite, alike, twisted };

/// Faces run counter-clockwise as seen from outside of their blocks: two blocks on opposite sides of one run
/// around it in opposite directions, and the order of nodes alone tells (2D: along it).
template <std::size_t Size>
Sense senseOf(const std::array<Index, Size> &a, const std::array<Index, Size> &b) {
  const auto first = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  if constexpr (Size == 2) return first == 1 ? Sense::opposite : Sense::alike;
  const Index next = b[(first + 1) % Size];
  const Index last = b[(first + Size - 1) % Size];
  if (next == a[Size - 1] && last == a[1]) return Sense::opposite;
  return next == a[1] && last == a[Size - 1] ? Sense::alike : Sense::twisted;
}

/// nodes - edges + triangles - tetrahedra, counted one by one.
Index eulerOf(const ReferenceMesh<3> &mesh) {
  std::vector<bool> used(mesh.nodes.size(), false);
  Index faces = 0;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      used[at(mesh.simplices[at(s)][i])] = true;
      if (mesh.neighbors[at(s)][i] < s) ++faces; // outer ones, and inner ones from the later simplex
    }
  const Index edges = countEdges(mesh.nodes.size(), [&](auto visit) {
    for (const auto &v : mesh.simplices)
      for (int i = 0; i < 4; ++i)
        for (int k = i + 1; k < 4; ++k) visit(v[i], v[k]);
  });
  return toIndex(static_cast<std::size_t>(std::count(used.begin(), used.end(), true))) - edges + faces -
         mesh.simplexCount();
}

template <int N> Shape shapeOfReference(const ReferenceMesh<N> &mesh) {
  Shape shape;
  Index outer = 0;
  std::vector<std::array<Index, N>> boundary;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i)
      if (mesh.neighbors[at(s)][i] == kNone) {
        ++outer;
        std::array<Index, N> face;
        for (int v = 0, m = 0; v < N + 1; ++v)
          if (v != i) face[m++] = mesh.simplices[at(s)][v];
        boundary.push_back(face);
      }
  if constexpr (N == 2) {
    std::vector<bool> used(mesh.nodes.size(), false);
    for (const auto &t : mesh.simplices)
      for (const Index v : t) used[at(v)] = true;
    const Index nodes = toIndex(static_cast<std::size_t>(std::count(used.begin(), used.end(), true)));
    const Index edges = (3 * mesh.simplexCount() + outer) / 2;
    shape.euler = nodes - edges + mesh.simplexCount();
  } else {
    shape.euler = eulerOf(mesh);
  }
  shape.components = nodeComponents(mesh.simplices, mesh.nodes.size());
  shape.shells = nodeComponents(boundary, mesh.nodes.size());
  return shape;
}

constexpr std::array<std::array<Index, 2>, 12> kHexahedronEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

template <int N> Shape shapeOfBlocks(const BlockInput<N> &in, const BlockComplex<N> &complex) {
  Shape shape;
  std::vector<bool> used(in.blocks.positions.size(), false);
  const auto &blocks = in.blocks.blocks;
  for (const auto &b : in.blocks.blocks)
    for (const Index v : b) used[at(v)] = true;
  Index faces = 0;
  for (std::size_t f = 0; f < complex.faces.size(); ++f)
    if (f == 0 || !complex.areTwins(f - 1, f)) ++faces;
  const Index nodes = toIndex(static_cast<std::size_t>(std::count(used.begin(), used.end(), true)));
  const Index count = toIndex(blocks.size());
  shape.euler = nodes - faces + count;
  if constexpr (N == 3) {
    const Index edges = countEdges(in.blocks.positions.size(), [&](auto visit) {
      for (const auto &b : blocks)
        for (const auto &[u, v] : kHexahedronEdges) visit(b[at(u)], b[at(v)]);
    });
    shape.euler = nodes - edges + faces - count;
  }
  std::vector<std::array<Index, 1 << (N - 1)>> boundary;
  for (const Index f : complex.boundary) boundary.push_back(complex.faces[at(f)].cycle);
  shape.components = nodeComponents(blocks, in.blocks.positions.size());
  shape.shells = nodeComponents(boundary, in.blocks.positions.size());
  return shape;
}

} // namespace

template <int N> BlockComplex<N> buildBlockComplex(const BlockInput<N> &in) {
  BlockComplex<N> complex;
  // Each face goes straight to its place among those with the same lowest node.
  const auto &blocks = in.blocks.blocks;
  const auto cycleOf = [&](std::size_t b, int f) {
    std::array<Index, 1 << (N - 1)> cycle;
    for (std::size_t k = 0; k < cycle.size(); ++k)
      cycle[k] = blocks[b][at(faceCorner<N>(f, static_cast<int>(k)))];
    return cycle;
  };
  std::vector<std::size_t> place(in.blocks.positions.size() + 1, 0);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) {
      const auto cycle = cycleOf(b, f);
      ++place[at(*std::min_element(cycle.begin(), cycle.end())) + 1];
    }
  std::partial_sum(place.begin(), place.end(), place.begin());
  complex.faces.resize(place.back());
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) {
      BlockFace<N> face;
      face.key = face.cycle = cycleOf(b, f);
      sortItems(face.key);
      face.block = toIndex(b);
      face.local = f;
      face.tag = in.blocks.tags[b][at(f)];
      complex.faces[place[at(face.key[0])]++] = face;
    }
  for (std::size_t node = 0, begin = 0; node + 1 < place.size(); begin = place[node++])
    sortRange(complex.faces.data() + begin, complex.faces.data() + place[node],
              [](const BlockFace<N> &a, const BlockFace<N> &b) {
                for (std::size_t k = 1; k < a.key.size(); ++k)
                  if (a.key[k] != b.key[k]) return a.key[k] < b.key[k];
                return a.block < b.block;
              });
  const auto number = [&](std::size_t f) { return 2 * N * complex.faces[f].block + complex.faces[f].local; };
  complex.behind.resize(complex.faces.size());
  for (std::size_t f = 0; f < complex.faces.size(); ++f) {
    const Index twin = complex.twinOf(f);
    complex.behind[at(number(f))] = twin == kNone ? kNone : number(at(twin));
    if (twin == kNone) complex.boundary.push_back(toIndex(f));
  }
  return complex;
}

template <int N>
void checkTopology(const BlockInput<N> &in, const BlockComplex<N> &complex, Certificate &certificate) {
  if (in.blocks.blocks.empty()) certificate.fail(Check::topology, "there are no blocks");
  for (Index b = 0; b < toIndex(in.blocks.blocks.size()); ++b) {
    auto nodes = in.blocks.blocks[at(b)];
    sortItems(nodes);
    if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end())
      certificate.fail(Check::topology, "a block has the same node twice", {{"block", b}});
  }
  std::vector<std::array<Index, 2>> pairs; // blocks that share a face
  pairs.reserve(complex.faces.size() / 2);
  for (std::size_t f = 0; f + 1 < complex.faces.size(); ++f) {
    if (!complex.areTwins(f, f + 1)) continue;
    pairs.push_back({complex.faces[f].block, complex.faces[f + 1].block});
    if (const Sense sense = senseOf(complex.faces[f].cycle, complex.faces[f + 1].cycle);
        sense != Sense::opposite)
      certificate.fail(Check::topology,
                       sense == Sense::alike
                           ? "two blocks lie on the same side of the face that they share"
                           : "faces of two blocks have the same nodes, but not in the same order",
                       {{"block", complex.faces[f].block}, {"block", complex.faces[f + 1].block}});
    if (f + 2 < complex.faces.size() && complex.areTwins(f, f + 2))
      certificate.fail(Check::topology, "three blocks share a face",
                       {{"block", complex.faces[f].block}, {"block", complex.faces[f + 1].block}});
  }
  sortByIndex(pairs, in.blocks.blocks.size(), [](const auto &p) { return p[0]; });
  const auto twice = std::adjacent_find(pairs.begin(), pairs.end());
  if (twice != pairs.end())
    certificate.fail(Check::topology, "two blocks share more than one face",
                     {{"block", (*twice)[0]}, {"block", (*twice)[1]}});
  // The boundary is closed: every ridge of it belongs to an even number of boundary faces, to two of them
  // where the domain is a manifold, which the reference mesh's parts require.
  std::vector<std::array<Index, N == 2 ? 1 : 2>> ridges;
  for (const Index f : complex.boundary) {
    const auto &cycle = complex.faces[at(f)].cycle;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      if constexpr (N == 2) ridges.push_back({cycle[k]});
      else ridges.push_back(sortedPair(cycle[k], cycle[(k + 1) % 4]));
    }
  }
  sortByIndex(ridges, in.blocks.positions.size(), [](const auto &r) { return r[0]; });
  for (std::size_t begin = 0, end = 0; begin < ridges.size(); begin = end) {
    while (end < ridges.size() && ridges[end] == ridges[begin]) ++end;
    if (end - begin != 2)
      certificate.fail(Check::topology, "the blocks' boundary is not a closed manifold",
                       {{"node", ridges[begin][0]}});
  }
  const Shape reference = shapeOfReference(in.sideMesh());
  const Shape blocks = shapeOfBlocks(in, complex);
  if (!(reference == blocks))
    certificate.fail(Check::topology,
                     "the blocks have " + describe(blocks) + "; the domain has " + describe(reference));
}

template BlockComplex<2> buildBlockComplex(const BlockInput<2> &);
template BlockComplex<3> buildBlockComplex(const BlockInput<3> &);
template void checkTopology(const BlockInput<2> &, const BlockComplex<2> &, Certificate &);
template void checkTopology(const BlockInput<3> &, const BlockComplex<3> &, Certificate &);

} // namespace dualblock
