#include "parts/fallback.h"

namespace dualblock {

template <int N> Components<N> findComponents(const ReferenceMesh<N> &mesh) {
  Components<N> result;
  std::vector<Index> raw = floodPieces(mesh, result.count, [](Index, int) { return false; });
  std::vector<std::pair<Index, Index>> lowestFacet; // (facet, raw component)
  for (Index c = 0; c < result.count; ++c) lowestFacet.emplace_back(toIndex(mesh.surfaces.size()), c);
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i) {
      if (mesh.neighbors[at(s)][i] != kNone) continue;
      Index &lowest = lowestFacet[at(raw[at(s)])].first;
      lowest = std::min(lowest, FaceTag::surface(mesh.tags[at(s)][i]));
    }
  std::sort(lowestFacet.begin(), lowestFacet.end());
  std::vector<Index> number(lowestFacet.size());
  for (std::size_t k = 0; k < lowestFacet.size(); ++k) number[at(lowestFacet[k].second)] = toIndex(k);
  for (Index &c : raw) c = number[at(c)];
  result.ofSimplex = std::move(raw);
  return result;
}

template <int N>
FallbackMesh<N> applyFallback(const ReferenceMesh<N> &cut, const ReferenceMesh<N> &coarse,
                              const std::vector<bool> &replace) {
  FallbackMesh<N> result;
  ReferenceMesh<N> &mesh = result.mesh;
  mesh.size = cut.size;
  mesh.surfaces = cut.surfaces; // both meshes number the domain's facets alike
  const Index inner = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back({SurfaceKind::simplexFace, kNone, {}});
  const auto append = [&](const ReferenceMesh<N> &from, bool wanted) {
    const Components<N> components = findComponents(from);
    std::vector<Index> node(from.nodes.size(), kNone);
    std::vector<Index> simplex(from.simplices.size(), kNone);
    Index next = mesh.simplexCount();
    for (Index s = 0; s < from.simplexCount(); ++s)
      if (replace[at(components.ofSimplex[at(s)])] == wanted) simplex[at(s)] = next++;
    for (Index s = 0; s < from.simplexCount(); ++s) {
      if (simplex[at(s)] == kNone) continue;
      auto v = from.simplices[at(s)];
      for (Index &n : v) {
        if (node[at(n)] == kNone) {
          node[at(n)] = mesh.nodeCount();
          mesh.nodes.push_back(from.nodes[at(n)]);
          mesh.nodeSimplex.push_back(simplex[at(s)]);
        }
        n = node[at(n)];
      }
      auto neighbors = from.neighbors[at(s)];
      auto tags = from.tags[at(s)];
      for (int i = 0; i < N + 1; ++i) {
        if (neighbors[i] == kNone) continue;
        neighbors[i] = simplex[at(neighbors[i])];
        if (wanted && tags[i] == kNone)
          tags[i] = simplex[at(s)] < neighbors[i] ? FaceTag::back(inner) : FaceTag::front(inner);
      }
      mesh.simplices.push_back(v);
      mesh.neighbors.push_back(neighbors);
      mesh.tags.push_back(tags);
      mesh.region.push_back(from.region[at(s)]);
      result.everyFace.push_back(wanted);
    }
  };
  append(cut, false);
  append(coarse, true);
  return result;
}

template Components<2> findComponents(const ReferenceMesh<2> &);
template Components<3> findComponents(const ReferenceMesh<3> &);
template FallbackMesh<2> applyFallback(const ReferenceMesh<2> &, const ReferenceMesh<2> &,
                                       const std::vector<bool> &);
template FallbackMesh<3> applyFallback(const ReferenceMesh<3> &, const ReferenceMesh<3> &,
                                       const std::vector<bool> &);

} // namespace dualblock
