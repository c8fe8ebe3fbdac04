// Check 3: the blocks by themselves form a conformal mesh with the topology of the domain.
#include <tuple>

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

/// nodes - edges + triangles - tetrahedra, counted one by one.
Index eulerByCounting(const ReferenceMesh<3> &mesh) {
  std::vector<std::array<Index, 2>> edges;
  std::vector<bool> used(mesh.nodes.size(), false);
  Index faces = 0;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const auto &v = mesh.simplices[at(s)];
      used[at(v[i])] = true;
      if (mesh.neighbors[at(s)][i] < s) ++faces; // outer ones, and inner ones from the later simplex
      for (int k = i + 1; k < 4; ++k) edges.push_back(sortedPair(v[i], v[k]));
    }
  sortByIndex(edges, mesh.nodes.size(), [](const auto &e) { return e[0]; });
  const auto last = std::unique(edges.begin(), edges.end());
  return toIndex(static_cast<std::size_t>(std::count(used.begin(), used.end(), true))) -
         static_cast<Index>(last - edges.begin()) + faces - mesh.simplexCount();
}

template <int N> Shape shapeOfReference(const BlockInput<N> &in, const BlockComplex<N> &complex) {
  // chi = nodes - edges + triangles - tetrahedra. Edges are counted by sorting node pairs (3D).
  const ReferenceMesh<N> &mesh = in.mesh;
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
    // A 3-manifold with boundary has half the Euler characteristic of its boundary.
    if (!complex.pinches.empty()) shape.euler = eulerByCounting(mesh);
    else {
      std::vector<bool> used(mesh.nodes.size(), false);
      Index nodes = 0;
      std::vector<std::array<Index, 2>> edges;
      for (const auto &f : boundary)
        for (int k = 0; k < 3; ++k) {
          if (!used[at(f[k])]) ++nodes;
          used[at(f[k])] = true;
          edges.push_back({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
        }
      sortByIndex(edges, mesh.nodes.size(), [](const auto &e) { return e[0]; });
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      shape.euler = (nodes - toIndex(edges.size()) + toIndex(boundary.size())) / 2;
    }
  }
  shape.components = nodeComponents(mesh.simplices, mesh.nodes.size());
  shape.shells = nodeComponents(boundary, mesh.nodes.size());
  return shape;
}

template <int N> Shape shapeOfBlocks(const BlockInput<N> &in, const BlockComplex<N> &complex) {
  Shape shape;
  std::vector<bool> used(in.blocks.positions.size(), false);
  const auto &blocks = in.blocks.blocks;
  for (const auto &b : in.blocks.blocks)
    for (const Index v : b) used[at(v)] = true;
  Index faces = 0;
  for (std::size_t f = 0; f < complex.faces.size(); ++f)
    if (f == 0 || complex.faces[f].key != complex.faces[f - 1].key) ++faces;
  const Index nodes = toIndex(static_cast<std::size_t>(std::count(used.begin(), used.end(), true)));
  const Index count = toIndex(blocks.size());
  shape.euler = N == 2 ? nodes - faces + count : nodes - toIndex(complex.edges.size()) + faces - count;
  std::vector<std::array<Index, 1 << (N - 1)>> boundary;
  for (const Index f : complex.boundary) boundary.push_back(complex.faces[at(f)].cycle);
  shape.components = nodeComponents(blocks, in.blocks.positions.size());
  shape.shells = nodeComponents(boundary, in.blocks.positions.size());
  return shape;
}

/// In 2D there are none: unpinch has doubled them.
std::vector<Pinch> findPinches(const ReferenceMesh<3> &mesh) {
  // Corners of outer faces: two at one node go together where their faces share an edge there.
  struct Fan {
    std::array<Index, 2> edge; // node and neighbour
    Index corner;
  };
  std::vector<Fan> fans;
  std::vector<Pinch> corners;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      if (mesh.neighbors[at(s)][i] != kNone) continue;
      for (int v = 0; v < 4; ++v) {
        if (v == i) continue;
        const Index node = mesh.simplices[at(s)][v];
        for (int w = 0; w < 4; ++w)
          if (w != i && w != v) fans.push_back({{node, mesh.simplices[at(s)][w]}, toIndex(corners.size())});
        corners.push_back({node, s});
      }
    }
  sortByIndex(
      fans, mesh.nodes.size(), [](const Fan &f) { return f.edge[0]; },
      [](const Fan &a, const Fan &b) { return std::tie(a.edge, a.corner) < std::tie(b.edge, b.corner); });
  DisjointSets sets(corners.size());
  for (std::size_t f = 0; f + 1 < fans.size(); ++f)
    if (fans[f].edge == fans[f + 1].edge) sets.unite(fans[f].corner, fans[f + 1].corner);
  std::vector<bool> seen(mesh.nodes.size(), false);
  std::vector<Pinch> pinches;
  for (Index c = 0; c < toIndex(corners.size()); ++c) {
    if (sets.find(c) != c) continue;
    if (seen[at(corners[at(c)].node)]) pinches.push_back(corners[at(c)]);
    seen[at(corners[at(c)].node)] = true;
  }
  return pinches;
}

} // namespace

template <int N> BlockComplex<N> buildBlockComplex(const BlockInput<N> &in) {
  static constexpr int kEdges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                        {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  BlockComplex<N> complex;
  if constexpr (N == 3) complex.pinches = findPinches(in.mesh);
  std::vector<std::array<Index, 2>> edges;
  complex.faces.reserve(2 * N * in.blocks.blocks.size());
  edges.reserve((N == 3 ? 12 : 4) * in.blocks.blocks.size());
  for (Index b = 0; b < toIndex(in.blocks.blocks.size()); ++b) {
    const auto &block = in.blocks.blocks[at(b)];
    for (int f = 0; f < 2 * N; ++f) {
      BlockFace<N> face;
      for (std::size_t k = 0; k < face.cycle.size(); ++k)
        face.cycle[k] = block[at(faceCorner<N>(f, static_cast<int>(k)))];
      face.key = face.cycle;
      sortItems(face.key);
      face.block = b;
      face.local = f;
      face.tag = in.blocks.tags[at(b)][at(f)];
      complex.faces.push_back(face);
    }
    for (const auto &[u, v] : kEdges) {
      if (N == 2 && std::max(u, v) > 3) continue;
      edges.push_back(sortedPair(block[at(u)], block[at(v)]));
    }
  }
  sortByIndex(
      complex.faces, in.blocks.positions.size(), [](const BlockFace<N> &f) { return f.key[0]; },
      [](const BlockFace<N> &a, const BlockFace<N> &b) {
        return std::tie(a.key, a.block) < std::tie(b.key, b.block);
      });
  complex.faceOf.resize(complex.faces.size());
  for (std::size_t f = 0; f < complex.faces.size(); ++f)
    complex.faceOf[at(2 * N * complex.faces[f].block + complex.faces[f].local)] = toIndex(f);
  for (std::size_t f = 0; f < complex.faces.size(); ++f) {
    const bool before = f > 0 && complex.faces[f - 1].key == complex.faces[f].key;
    const bool after = f + 1 < complex.faces.size() && complex.faces[f + 1].key == complex.faces[f].key;
    if (!before && !after) complex.boundary.push_back(toIndex(f));
  }
  sortByIndex(edges, in.blocks.positions.size(), [](const auto &e) { return e[0]; });
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (e == 0 || edges[e] != edges[e - 1]) {
      complex.edges.push_back(edges[e]);
      complex.blocksAtEdge.push_back(0);
    }
    ++complex.blocksAtEdge.back();
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
    if (complex.faces[f].key != complex.faces[f + 1].key) continue;
    pairs.push_back({complex.faces[f].block, complex.faces[f + 1].block});
    if (f + 2 < complex.faces.size() && complex.faces[f].key == complex.faces[f + 2].key)
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
  const Shape reference = shapeOfReference(in, complex);
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
