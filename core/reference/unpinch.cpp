#include "reference/unpinch.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "reference/refine.h"

namespace dualblock {
namespace {

/// Edges of the mesh's boundary with more than two boundary faces.
std::vector<std::pair<Index, Index>> pinchedEdges(const ReferenceMesh<3> &mesh) {
  std::vector<std::pair<Index, Index>> edges;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      if (mesh.neighbors[at(s)][i] != kNone) continue;
      const std::array<Index, 3> f = mesh.sortedFace(s, i);
      edges.insert(edges.end(), {{f[0], f[1]}, {f[0], f[2]}, {f[1], f[2]}});
    }
  sortByIndex(edges, mesh.nodes.size(), [](const auto &e) { return e.first; });
  std::vector<std::pair<Index, Index>> pinched;
  for (std::size_t e = 2; e < edges.size(); ++e)
    if (edges[e] == edges[e - 2] && (pinched.empty() || pinched.back() != edges[e]))
      pinched.push_back(edges[e]);
  return pinched;
}

/// Gives each fan of simplices around a node, but the first, a copy of the node.
template <int N> Index doubleNodes(ReferenceMesh<N> &mesh) {
  DisjointSets fans(mesh.simplices.size() * (N + 1)); // of corners: (simplex, local vertex)
  const auto corner = [](Index s, int v) { return s * (N + 1) + v; };
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i) {
      const Index t = mesh.neighbors[at(s)][i];
      if (t < s) continue;
      for (int v = 0; v < N + 1; ++v)
        if (v != i) fans.unite(corner(s, v), corner(t, mesh.localVertex(t, mesh.simplices[at(s)][v])));
    }
  const Index before = mesh.nodeCount();
  std::vector<Index> firstFan(at(before), kNone);
  std::vector<Index> copyOf(mesh.simplices.size() * (N + 1), kNone); // per fan, at its representative
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int v = 0; v < N + 1; ++v) {
      Index &node = mesh.simplices[at(s)][v];
      const Index fan = fans.find(corner(s, v));
      Index &first = firstFan[at(node)];
      if (first == kNone) first = fan;
      if (first == fan) continue;
      Index &copy = copyOf[at(fan)];
      if (copy == kNone) {
        copy = mesh.nodeCount();
        mesh.nodes.push_back(Vec<N>(mesh.nodes[at(node)]));
        mesh.nodeSimplex.push_back(s);
      }
      node = copy;
    }
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (const Index v : mesh.simplices[at(s)]) mesh.nodeSimplex[at(v)] = s;
  return mesh.nodeCount() - before;
}

} // namespace

template <int N> Index unpinch(ReferenceMesh<N> &mesh) {
  const Index before = mesh.nodeCount();
  if constexpr (N == 3)
    if (auto edges = pinchedEdges(mesh); !edges.empty()) splitEdges(mesh, std::move(edges));
  doubleNodes(mesh);
  return mesh.nodeCount() - before;
}

template Index unpinch(ReferenceMesh<2> &);
template Index unpinch(ReferenceMesh<3> &);

} // namespace dualblock
