// Planar facets as polygons: their plane, their flatness, and a point inside a loop.
#pragma once

#include "base/plane.h"
#include "domain/domain.h"

namespace dualblock {

/// Twice the vector area of a facet (outer loop and holes together): its direction is the facet's normal.
/// In 2D the segment's normal, as long as the segment, with the domain's left side behind it.
Vec<3> areaVector(const std::vector<Vec<3>> &vertices, const Facet &facet);
Vec<2> areaVector(const std::vector<Vec<2>> &vertices, const Facet &facet);

/// The plane of a facet: normal from areaVector, offset the mean over the facet's corners.
template <int N> Plane<N> facetPlane(const std::vector<Vec<N>> &vertices, const Facet &facet) {
  Plane<N> plane{glm::normalize(areaVector(vertices, facet)), 0};
  double count = 0;
  for (const auto &loop : facet.loops)
    for (const Index v : loop) {
      plane.offset += glm::dot(plane.normal, vertices[at(v)]);
      count += 1;
    }
  plane.offset /= count;
  return plane;
}

/// The largest distance of a corner of the facet from the plane.
template <int N>
double deviation(const std::vector<Vec<N>> &vertices, const Facet &facet, const Plane<N> &plane) {
  double worst = 0;
  for (const auto &loop : facet.loops)
    for (const Index v : loop) {
      const double d = plane.distance(vertices[at(v)]);
      worst = d > worst ? d : -d > worst ? -d : worst;
    }
  return worst;
}

/// Coordinates in a plane with the given unit normal, seen from its tip, so that counter-clockwise stays so.
struct PlaneBasis {
  explicit PlaneBasis(const Vec<3> &normal);
  Vec<2> project(const Vec<3> &x) const { return {glm::dot(u, x), glm::dot(v, x)}; }
  Vec<3> u, v;
};

/// Twice the signed area of a closed polygon.
double polygonArea2(const std::vector<Vec<2>> &polygon);

/// Whether a point lies inside a simple polygon; boundary points may go either way.
bool insidePolygon(const std::vector<Vec<2>> &polygon, const Vec<2> &x);

/// A point strictly inside what simple polygons enclose, but not in the polygons inside of one of them.
Vec<2> pointInside(const std::vector<std::vector<Vec<2>>> &polygons);

/// The loops of a facet in a plane's coordinates.
std::vector<std::vector<Vec<2>>> projected(const std::vector<Vec<3>> &vertices, const Facet &facet,
                                           const PlaneBasis &basis);

/// Per simple polygon, those that it lies in; they may touch, but not cross.
std::vector<std::vector<std::size_t>> nestingOf(const std::vector<std::vector<Vec<2>>> &polygons);

} // namespace dualblock
