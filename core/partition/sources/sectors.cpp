#include "partition/sources/sectors.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "partition/heuristics.h"

namespace dualblock {
namespace {

using std::numbers::pi;

/// Vertices of simplex s on the ridge, as a mask of local numbers.
template <int N> unsigned maskOfRidge(const ReferenceMesh<N> &mesh, const Ridge<N> &ridge, Index s) {
  unsigned mask = 0;
  for (int v = 0; v < N + 1; ++v) {
    if (v == ridge.from || v == ridge.to) continue;
    mask |= 1U << mesh.localVertex(s, mesh.simplices[at(ridge.simplex)][v]);
  }
  return mask;
}

} // namespace

std::vector<double> sectorPlanes(CurveKind kind, double angle) {
  switch (kind) {
  case CurveKind::end: return {};
  case CurveKind::side: return {angle / 2};
  case CurveKind::corner: // the planes of both facets: sectors of angle - 180, 360 - angle and angle - 180
                          // degrees
    return {pi, angle - pi};
  case CurveKind::reversal: // two whole planes: the bisector, and one across it that runs on beyond the curve
    return {angle / 2, (angle - pi) / 2};
  }
  return {};
}

DirectionRange rangeOfSector(CurveKind kind, double angle, std::size_t sector, double snap) {
  if (kind == CurveKind::end || kind == CurveKind::reversal)
    return {1, 0}; // both sectors of a whole plane count
  const std::vector<double> planes = sectorPlanes(kind, angle);
  const double nominal = planes[sector];
  double before = 0; // the directions that bound the two sectors beside the plane
  double after = angle;
  for (const double other : planes) {
    if (other < nominal) before = std::max(before, other);
    if (other > nominal) after = std::min(after, other);
  }
  return {std::max({nominal - snap, before + kLeastSector, after - kMostSector}),
          std::min({nominal + snap, after - kLeastSector, before + kMostSector})};
}

template <int N> double directionOf(const RidgeFrame<N> &frame, const Vec<N> &away) {
  const double direction = std::atan2(-glm::dot(away, frame.outward), glm::dot(away, frame.into));
  return direction < 0 ? direction + 2 * pi : direction;
}

template <int N> Plane<N> planeAt(const Vec<N> &point, const RidgeFrame<N> &frame, double direction) {
  return planeThrough(point, std::sin(direction) * frame.into + std::cos(direction) * frame.outward);
}

template <int N>
std::optional<Plane<N>> sharedPlane(const ReferenceMesh<N> &mesh, const Curve<N> &curve, std::size_t k,
                                    const DirectionRange &range, std::span<const Curve<N> *const> others,
                                    double tolerance) {
  const Vec<N> point = mesh.nodes[at(curve.ridges[k].front())];
  const double middle = (range.low + range.high) / 2;
  std::optional<Plane<N>> best;
  double least = pi;
  for (const Curve<N> *other : others) {
    if (other == &curve || other->part != curve.part) continue;
    const double direction =
        directionOf<N>(curve.frames[k], mesh.nodes[at(other->ridges[0].front())] - point);
    // Of two as near the first, for rounding is not the same on every reference mesh.
    if (!range.has(direction) || std::abs(direction - middle) >= least - kAngleSlack) continue;
    const Plane<N> plane = planeAt(point, curve.frames[k], direction);
    bool holds = true;
    for (const auto &ridge : other->ridges)
      for (const Index v : ridge) holds &= std::abs(plane.distance(mesh.nodes[at(v)])) <= tolerance;
    if (!holds) continue;
    least = std::abs(direction - middle);
    best = plane;
  }
  return best;
}

template <int N>
bool isCutWithin(const ReferenceMesh<N> &mesh, const Ridge<N> &ridge, const RidgeFrame<N> &frame,
                 const DirectionRange &range, Index facetSurfaces) {
  bool found = false;
  const auto inspect = [&](Index s) {
    const unsigned onRidge = maskOfRidge(mesh, ridge, s);
    for (int i = 0; i < N + 1; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone || FaceTag::surface(tag) < facetSurfaces || (onRidge >> i & 1)) continue;
      const Surface<N> &surface = mesh.surfaces[at(FaceTag::surface(tag))];
      // A plane knows the direction but for its sign, which even a sliver's face tells.
      const Vec<N> along = glm::dot(surface.plane.normal, frame.outward) * frame.into -
                           glm::dot(surface.plane.normal, frame.into) * frame.outward;
      for (int v = 0; v < N + 1; ++v) {
        if (v == i || (onRidge >> v & 1)) continue;
        const Vec<N> away = mesh.nodes[at(mesh.simplices[at(s)][v])] -
                            mesh.nodes[at(mesh.simplices[at(s)][std::countr_zero(onRidge)])];
        const Vec<N> inPlane = glm::dot(away, along) < 0 ? -along : along;
        found |= range.has(directionOf<N>(frame, surface.field ? away : inPlane));
      }
    }
  };
  turnAroundRidge(mesh, ridge.simplex, ridge.from, ridge.to, facetSurfaces, inspect);
  return found;
}

template double directionOf(const RidgeFrame<2> &, const Vec<2> &);
template double directionOf(const RidgeFrame<3> &, const Vec<3> &);
template Plane<2> planeAt(const Vec<2> &, const RidgeFrame<2> &, double);
template Plane<3> planeAt(const Vec<3> &, const RidgeFrame<3> &, double);
template std::optional<Plane<2>> sharedPlane(const ReferenceMesh<2> &, const Curve<2> &, std::size_t,
                                             const DirectionRange &, std::span<const Curve<2> *const>,
                                             double);
template std::optional<Plane<3>> sharedPlane(const ReferenceMesh<3> &, const Curve<3> &, std::size_t,
                                             const DirectionRange &, std::span<const Curve<3> *const>,
                                             double);
template bool isCutWithin(const ReferenceMesh<2> &, const Ridge<2> &, const RidgeFrame<2> &,
                          const DirectionRange &, Index);
template bool isCutWithin(const ReferenceMesh<3> &, const Ridge<3> &, const RidgeFrame<3> &,
                          const DirectionRange &, Index);

} // namespace dualblock
