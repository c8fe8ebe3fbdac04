#include "reference/patches.h"

#include <cmath>
#include <numbers>

#include "base/disjoint_sets.h"

namespace dualblock {

void joinSmoothFacets(ReferenceMesh<3> &mesh, double featureAngle) {
  const double angle = featureAngle < 0 ? kSmoothAngle : featureAngle;
  const double leastCosine = std::cos(angle * std::numbers::pi / 180);
  mesh.smoothCosine = leastCosine;
  DisjointSets sets(mesh.surfaces.size());
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone) continue;
      for (int k = 0; k < 4; ++k) {
        if (k == i) continue;
        const FaceRef<3> mate = turnAroundRidge(mesh, s, i, k, kCrossNone, [](Index) {});
        const Index other = mesh.tags[at(mate.simplex)][mate.face];
        if (FaceTag::surface(tag) >= FaceTag::surface(other) || (tag & 1) != (other & 1)) continue;
        if (glm::dot(mesh.outwardNormal(s, i), mesh.outwardNormal(mate.simplex, mate.face)) > leastCosine)
          sets.unite(FaceTag::surface(tag), FaceTag::surface(other));
      }
    }
  std::vector<Index> sizes(mesh.surfaces.size(), 0);
  for (Index f = 0; f < toIndex(sizes.size()); ++f) ++sizes[at(sets.find(f))];
  for (Index f = 0; f < toIndex(sizes.size()); ++f) {
    const Index size = sizes[at(sets.find(f))];
    if (size < 2 || (featureAngle < 0 && size < kSmoothFacets)) continue;
    mesh.surfaces[at(f)].patch = sets.find(f);
    mesh.surfaces[at(f)].bent = true;
  }
}

} // namespace dualblock
