#include "parts/fallback.h"

namespace dualblock {

template <int N>
FallbackMesh<N> applyFallback(const ReferenceMesh<N> &cut, const ReferenceMesh<N> &coarse,
                              const std::vector<bool> &replace) {
  FallbackMesh<N> result;
  ReferenceMesh<N> &mesh = result.mesh;
  mesh.size = cut.size;
  mesh.componentCount = cut.componentCount;
  mesh.surfaces = cut.surfaces; // both meshes number the domain's facets alike
  const Index inner = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back({SurfaceKind::simplexFace, kNone, {}});
  const auto append = [&](const ReferenceMesh<N> &from, bool wanted) {
    std::vector<Index> node(from.nodes.size(), kNone);
    std::vector<Index> simplex(from.simplices.size(), kNone);
    Index next = mesh.simplexCount();
    for (Index s = 0; s < from.simplexCount(); ++s)
      if (replace[at(from.component[at(s)])] == wanted) simplex[at(s)] = next++;
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
      mesh.component.push_back(from.component[at(s)]);
      result.everyFace.push_back(wanted);
    }
  };
  append(cut, false);
  append(coarse, true);
  return result;
}

template FallbackMesh<2> applyFallback(const ReferenceMesh<2> &, const ReferenceMesh<2> &,
                                       const std::vector<bool> &);
template FallbackMesh<3> applyFallback(const ReferenceMesh<3> &, const ReferenceMesh<3> &,
                                       const std::vector<bool> &);

} // namespace dualblock
