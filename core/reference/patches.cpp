#include "reference/patches.h"

#include <cmath>
#include <numbers>

#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace dualblock {

namespace {

/// Calls visit(facet, face, other facet, face) where two facets meet that have the domain on the same sides,
/// from each of them.
template <typename Visit> void visitRidges(const ReferenceMesh<3> &mesh, Visit visit) {
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone) continue;
      for (int k = 0; k < 4; ++k) {
        if (k == i) continue;
        const FaceRef<3> mate = turnAroundRidge(mesh, s, i, k, kCrossNone, [](Index) {});
        const Index other = mesh.tags[at(mate.simplex)][mate.face];
        if (FaceTag::surface(tag) == FaceTag::surface(other) || (tag & 1) != (other & 1)) continue;
        visit(FaceTag::surface(tag), FaceRef<3>{s, i}, FaceTag::surface(other), mate);
      }
    }
}

std::vector<Index> sizesOf(DisjointSets &sets, std::size_t count) {
  std::vector<Index> sizes(count, 0);
  for (Index f = 0; f < toIndex(count); ++f) ++sizes[at(sets.find(f))];
  return sizes;
}

/// Whether a face is so narrow that its normal says nothing of the surface it was put on.
bool isSliver(const ReferenceMesh<3> &mesh, const FaceRef<3> &face) {
  constexpr double kNarrow = 0.05; // height over the longest edge
  const std::array<Index, 3> v = mesh.sortedFace(face.simplex, face.face);
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, glm::length(mesh.nodes[at(v[(k + 1) % 3])] - mesh.nodes[at(v[k])]));
  const double area2 = glm::length(
      glm::cross(mesh.nodes[at(v[1])] - mesh.nodes[at(v[0])], mesh.nodes[at(v[2])] - mesh.nodes[at(v[0])]));
  return area2 < kNarrow * longest * longest;
}

/// Slivers of a coarse tessellation stand askew: a triangle that is smooth with none of its three neighbours,
/// which are with one another, belongs to the bent side that they are of. Of narrow ones two will do.
void joinMisfits(const ReferenceMesh<3> &mesh, DisjointSets &sets, const std::vector<Index> &sizes,
                 double leastCosine) {
  struct Beside {
    Index facet, other;
    Vec<3> normal; // of the other
    bool isNarrow;
  };
  std::vector<Beside> besides;
  const auto size = [&](Index facet) { return sizes[at(sets.find(facet))]; };
  visitRidges(mesh, [&](Index facet, FaceRef<3> face, Index other, FaceRef<3> mate) {
    if (size(facet) == 1)
      besides.push_back({facet, other, mesh.outwardNormal(mate.simplex, mate.face), isSliver(mesh, face)});
  });
  sortItems(besides, [](const Beside &a, const Beside &b) {
    return a.facet != b.facet ? a.facet < b.facet : a.other < b.other;
  });
  const auto isSame = [](const Beside &a, const Beside &b) {
    return a.facet == b.facet && a.other == b.other;
  };
  besides.erase(std::unique(besides.begin(), besides.end(), isSame), besides.end());
  const auto isAlike = [&](const Beside &a, const Beside &b) {
    return size(a.other) >= kSmoothFacets && glm::dot(a.normal, b.normal) > leastCosine;
  };
  for (std::size_t k = 0, next = 0; k < besides.size(); k = next) {
    while (next < besides.size() && besides[next].facet == besides[k].facet) ++next;
    if (next != k + 3) continue;
    int alike = 0;
    std::size_t member = k; // of an alike pair
    for (std::size_t m = 0; m < 3; ++m)
      if (isAlike(besides[k + m], besides[k + (m + 1) % 3])) {
        ++alike;
        member = k + m;
      }
    if (alike == 3 || (alike == 1 && besides[k].isNarrow))
      sets.unite(besides[k].facet, besides[member].other);
  }
}

} // namespace

void joinSmoothFacets(ReferenceMesh<3> &mesh, double featureAngle) {
  const double angle = featureAngle < 0 ? kSmoothAngle : featureAngle;
  const double leastCosine = std::cos(angle * std::numbers::pi / 180);
  mesh.smoothCosine = leastCosine;
  DisjointSets sets(mesh.surfaces.size());
  visitRidges(mesh, [&](Index facet, FaceRef<3> face, Index other, FaceRef<3> mate) {
    if (facet < other && glm::dot(mesh.outwardNormal(face.simplex, face.face),
                                  mesh.outwardNormal(mate.simplex, mate.face)) > leastCosine)
      sets.unite(facet, other);
  });
  std::vector<Index> sizes = sizesOf(sets, mesh.surfaces.size());
  if (featureAngle < 0 && *std::max_element(sizes.begin(), sizes.end()) >= kSmoothFacets) {
    joinMisfits(mesh, sets, sizes, leastCosine);
    sizes = sizesOf(sets, mesh.surfaces.size());
  }
  for (Index f = 0; f < toIndex(sizes.size()); ++f) {
    const Index size = sizes[at(sets.find(f))];
    if (size < 2 || (featureAngle < 0 && size < kSmoothFacets)) continue;
    mesh.surfaces[at(f)].patch = sets.find(f);
    mesh.surfaces[at(f)].bent = true;
  }
}

} // namespace dualblock
