#include "partition/sources/reflex.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "partition/heuristics.h"
#include "partition/sources/sectors.h"
#include "partition/sources/sheets.h"
#include "parts/place.h"
#include "parts/ridge.h"
#include "reference/cut.h"
#include "reference/patches.h"
#include "reference/refine.h"

namespace dualblock {
namespace {

using std::numbers::pi;

/// Whether the plane already is a split surface at this ridge, on either side of it.
template <int N>
bool isCutAlready(const ReferenceMesh<N> &mesh, const Ridge<N> &ridge, const RidgeFrame<N> &frame,
                  const Plane<N> &plane, Index facetSurfaces) {
  const Vec<N> along =
      glm::dot(plane.normal, frame.outward) * frame.into - glm::dot(plane.normal, frame.into) * frame.outward;
  for (const double sign : {1.0, -1.0}) {
    const double direction = directionOf<N>(frame, sign * along);
    if (isCutWithin(mesh, ridge, frame, {direction - kCutAlready, direction + kCutAlready}, facetSurfaces))
      return true;
  }
  return false;
}

/// The ridges of a curve by smooth runs, in the order of their places: a curve between two plane sides may
/// turn sharply, and each run then has a cut of its own.
template <int N>
std::vector<std::vector<std::size_t>> smoothRuns(const ReferenceMesh<N> &mesh, const Curve<N> &curve) {
  if (curve.ridges.size() == 1) return {{0}};
  DisjointSets sets(curve.ridges.size());
  if constexpr (N == 3) {
    std::vector<std::pair<Index, std::size_t>> ends; // node, ridge
    for (std::size_t k = 0; k < curve.ridges.size(); ++k)
      for (const Index node : curve.ridges[k]) ends.emplace_back(node, k);
    sortItems(ends);
    const double leastCosine = std::cos(kSmoothAngle * pi / 180);
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
      if (ends[e].first != ends[e + 1].first) continue;
      const auto away = [&](std::size_t k) {
        const auto &r = curve.ridges[k];
        const Index other = r[0] == ends[e].first ? r[1] : r[0];
        return glm::normalize(mesh.nodes[at(other)] - mesh.nodes[at(ends[e].first)]);
      };
      if (-glm::dot(away(ends[e].second), away(ends[e + 1].second)) > leastCosine)
        sets.unite(toIndex(ends[e].second), toIndex(ends[e + 1].second));
    }
  }
  Index count = 0;
  const std::vector<Index> number = sets.numbering(count);
  std::vector<std::vector<std::size_t>> runs(at(count));
  for (std::size_t k = 0; k < number.size(); ++k) runs[at(number[k])].push_back(k);
  std::vector<std::pair<Extent<N>, std::size_t>> order;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::vector<std::array<Index, N - 1>> ridges;
    for (const std::size_t k : runs[r]) ridges.push_back(curve.ridges[k]);
    order.push_back({extentOf(mesh, ridges), r});
  }
  sortItems(order);
  std::vector<std::vector<std::size_t>> sorted;
  for (const auto &[extent, r] : order) sorted.push_back(std::move(runs[r]));
  return sorted;
}

template <int N>
const Surface<N> &surfaceOf(const ReferenceMesh<N> &mesh, const Curve<N> &curve, std::size_t ridge,
                            std::size_t side) {
  return mesh.surfaces[at(FaceTag::surface(curve.frames[ridge].tags[side]))];
}

/// The angle between a bent side and a plane one along a run: its facets tilt, so one angle for all, square
/// where it is nearly that. None where the angle really changes, or both sides are of one kind.
template <int N>
std::optional<double> steadyAngle(const ReferenceMesh<N> &mesh, const Curve<N> &curve,
                                  const std::vector<std::size_t> &run) {
  if (surfaceOf(mesh, curve, run[0], 0).bent == surfaceOf(mesh, curve, run[0], 1).bent) return std::nullopt;
  const double mean = meanAngle<N>(curve, run);
  for (const std::size_t k : run)
    if (std::abs(curve.frames[k].angle - mean) > kSameAlongRun) return std::nullopt;
  return std::abs(mean - 1.5 * pi) < kSameAlongRun ? 1.5 * pi : mean;
}

/// The direction of a sector's plane at a ridge of a run.
template <int N>
double directionAt(const ReferenceMesh<N> &mesh, const Curve<N> &curve, std::size_t ridge, std::size_t sector,
                   const std::optional<double> &steady) {
  const double angle = curve.frames[ridge].angle;
  const double direction = sectorPlanes(curveKind(curve.angle), steady.value_or(angle))[sector];
  // As seen from the plane side.
  return steady && surfaceOf(mesh, curve, ridge, 0).bent ? direction + angle - *steady : direction;
}

/// The surface through a run of a curve that leaves it in the direction of a sector's plane: a plane where
/// one holds the whole run, else a sheet. Where it extends a plane facet it is the facet's own plane, so that
/// neighbouring curves share it to the last bit.
template <int N>
Surface<N> surfaceThrough(const ReferenceMesh<N> &mesh, const Curve<N> &curve,
                          const std::vector<std::size_t> &run, std::size_t sector,
                          std::span<const Curve<N>> curves, double tolerance) {
  const std::optional<double> steady = steadyAngle(mesh, curve, run);
  const auto direction = [&](std::size_t k) { return directionAt(mesh, curve, k, sector, steady); };
  const auto planeOf = [&](std::size_t k) {
    const RidgeFrame<N> &frame = curve.frames[k];
    for (std::size_t side = 0; side < 2; ++side)
      if (std::abs(direction(k) - (side == 0 ? pi : frame.angle - pi)) < kSameDirection)
        return surfaceOf(mesh, curve, k, side).plane;
    return planeAt(mesh.nodes[at(curve.ridges[k].front())], frame, direction(k));
  };
  Surface<N> surface{SurfaceKind::reflexCut, FaceTag::surface(curve.frames[run[0]].tags[0]), planeOf(run[0])};
  if constexpr (N == 3) {
    for (const std::size_t k : run)
      for (const Index node : curve.ridges[k])
        surface.bent |= std::abs(surface.plane.distance(mesh.nodes[at(node)])) > tolerance;
    // Facets of a bent side tilt: a plane would shave off what is between it and them.
    for (const std::size_t k : run)
      for (std::size_t side = 0; side < 2; ++side) {
        const Surface<N> &facet = surfaceOf(mesh, curve, k, side);
        const double turn = glm::length(glm::cross(facet.plane.normal, surface.plane.normal));
        surface.bent |= facet.bent && turn > kSameDirection && turn < kNearDirection;
      }
    if (!surface.bent) return surface;
    SheetStart start{curve, run, {}, rangeOfSheet(curve, run, sector)};
    for (const std::size_t k : run) start.directions.push_back(direction(k));
    surface.field = sheetThrough(mesh, start, curves);
  }
  return surface;
}

/// One cut in the place of all sectors' planes, where a side is bent.
std::optional<Surface<3>> dishThrough(const ReferenceMesh<3> &mesh, const Curve<3> &curve,
                                      const std::vector<std::size_t> &run) {
  if (!surfaceOf(mesh, curve, run[0], 0).bent && !surfaceOf(mesh, curve, run[0], 1).bent) return std::nullopt;
  const std::optional<SheetStart> start = dishFrom(mesh, curve, run);
  if (!start) return std::nullopt;
  const RidgeFrame<3> &frame = curve.frames[run[0]];
  Surface<3> surface{SurfaceKind::reflexCut, FaceTag::surface(frame.tags[0]),
                     planeAt(mesh.nodes[at(curve.ridges[run[0]].front())], frame, start->directions[0])};
  surface.bent = true;
  surface.field = sheetThrough(mesh, *start, {});
  return surface;
}

/// The plane of a facet that arrives at the ridge from behind the other two, where an assembly's regions
/// meet, if it leaves both sectors at least 45 degrees: a cut that goes on in it needs no new direction.
template <int N>
std::optional<Plane<N>> facetBeyond(const ReferenceMesh<N> &mesh, const Ridge<N> &ridge,
                                    const RidgeFrame<N> &frame, Index facetSurfaces) {
  Index found = kNone; // the lowest surface, whichever way round they are met
  const auto inspect = [&](Index s) {
    for (int i = 0; i < N + 1; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone) continue;
      const Index surface = FaceTag::surface(tag);
      if (surface >= facetSurfaces || (found != kNone && surface >= found) ||
          surface == FaceTag::surface(frame.tags[0]) || surface == FaceTag::surface(frame.tags[1]))
        continue;
      bool holdsRidge = true;
      for (int v = 0; v < N + 1; ++v) {
        if (v == ridge.from || v == ridge.to) continue;
        const int here = mesh.localVertex(s, mesh.simplices[at(ridge.simplex)][v]);
        holdsRidge &= here >= 0 && here != i;
      }
      if (!holdsRidge) continue;
      const Plane<N> &plane = mesh.surfaces[at(surface)].plane;
      double direction =
          std::atan2(glm::dot(plane.normal, frame.into), glm::dot(plane.normal, frame.outward));
      if (direction < 0) direction += pi;
      if (direction >= pi / 4 - kAngleSlack && direction <= frame.angle - pi / 4 + kAngleSlack)
        found = surface;
    }
  };
  const FaceRef<N> stop = turnAroundRidge(mesh, ridge.simplex, ridge.from, ridge.to, kCrossAll, inspect);
  if (mesh.neighbors[at(stop.simplex)][stop.face] == kNone)
    turnAroundRidge(mesh, ridge.simplex, ridge.to, ridge.from, kCrossAll, inspect);
  return found == kNone ? std::nullopt : std::optional(mesh.surfaces[at(found)].plane);
}

/// Whether a plane cut has made the curve, and not the domain. Where it meets a plane side at a small angle,
/// or another cut, nothing is reflex, and relaxation makes the best of what is flat.
template <int N> bool isBySplit(const ReferenceMesh<N> &mesh, const Curve<N> &curve, Index facetSurfaces) {
  bool isSplit = false;
  for (std::size_t side = 0; side < 2; ++side) {
    if (surfaceOf(mesh, curve, 0, side).bent) return false;
    isSplit = isSplit || FaceTag::surface(curve.frames[0].tags[side]) >= facetSurfaces;
  }
  return isSplit;
}

/// Cuts along one sector plane of one run, or the surface in the place of all of them. Returns whether there
/// was something to cut.
template <int N>
bool cutRun(ReferenceMesh<N> &mesh, const Curve<N> &curve, const std::vector<std::size_t> &run,
            std::size_t sector, std::span<const Curve<N> *const> others, double snap, Surface<N> surface,
            double sagitta, const CutOptions &options) {
  if (mesh.simplexCount() > options.mostSimplices) return false;
  const auto find = [&](std::size_t k) {
    const auto [f, g] = curve.frames[k].tags;
    return findRidge(mesh, curve.ridges[k].front(), curve.ridges[k].back(), f, g, options.facetSurfaces);
  };
  const auto seedsNow = [&] {
    std::vector<CutSeed<N>> seeds;
    for (const std::size_t k : run)
      if (const auto ridge = find(k))
        seeds.push_back({ridge->simplex, ridge->from, ridge->to, options.facetSurfaces});
    return seeds;
  };
  if constexpr (N == 3)
    if (surface.field) {
      const auto known = find(run[0]); // there may be a sheet that runs from another curve to this one
      if (known && isCutWithin(mesh, *known, curve.frames[run[0]], rangeOfSheet(curve, run, sector),
                               options.facetSurfaces))
        return false;
      resolve<N>(mesh, surface, seedsNow, options.tolerance, sagitta);
    }
  const auto ridge = find(run[0]);
  if (!ridge) return false;
  if (!surface.field && curveKind(curve.angle) == CurveKind::side)
    if (const auto beyond = facetBeyond(mesh, *ridge, curve.frames[run[0]], options.facetSurfaces))
      surface.plane = *beyond;
  if (!surface.field &&
      isCutAlready(mesh, *ridge, curve.frames[run[0]], surface.plane, options.facetSurfaces))
    return false;
  if (!surface.field && snap > 0) {
    const RidgeFrame<N> &frame = curve.frames[run[0]];
    const DirectionRange range = rangeOfSector(curveKind(curve.angle), frame.angle, sector, snap);
    if (isCutWithin(mesh, *ridge, frame, range, options.facetSurfaces)) return false;
    if (const auto shared = sharedPlane(mesh, curve, run[0], range, others, options.tolerance))
      surface.plane = *shared;
  }
  const Index number = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back(std::move(surface));
  if (cutAlong<N>(mesh, number, seedsNow(), options.tolerance) > 0) return true;
  mesh.surfaces.pop_back();
  return false;
}

} // namespace

template <int N>
Index cutReflexCurve(ReferenceMesh<N> &mesh, const Curve<N> &curve, std::span<const Curve<N> *const> others,
                     std::span<const Curve<N>> curves, const CutPolicy &policy, const CutOptions &options) {
  if (isBySplit(mesh, curve, options.facetSurfaces)) return 0;
  Index cuts = 0;
  const auto cut = [&](const auto &run, std::size_t sector, Surface<N> surface, double sagitta) {
    if (cutRun(mesh, curve, run, sector, others, policy.snap, std::move(surface), sagitta, options)) ++cuts;
  };
  for (const auto &run : smoothRuns(mesh, curve)) {
    if constexpr (N == 3)
      if (policy.isLast)
        if (std::optional<Surface<3>> dish = dishThrough(mesh, curve, run)) {
          cut(run, 0, std::move(*dish), kDishSagitta);
          continue;
        }
    const CurveKind kind = curveKind(curve.angle);
    const std::size_t sectors = sectorPlanes(kind, curve.angle).size();
    // Which side of a curve is the first depends on the reference mesh; the numbers of their surfaces do not.
    const auto &[first, second] = curve.frames[run[0]].tags;
    const bool isTurned = kind == CurveKind::corner && first > second;
    for (std::size_t k = 0; k < sectors; ++k) {
      const std::size_t sector = isTurned ? sectors - 1 - k : k;
      cut(run, sector, surfaceThrough(mesh, curve, run, sector, curves, options.tolerance), kSheetSagitta);
    }
  }
  return cuts;
}

template Index cutReflexCurve(ReferenceMesh<2> &, const Curve<2> &, std::span<const Curve<2> *const>,
                              std::span<const Curve<2>>, const CutPolicy &, const CutOptions &);
template Index cutReflexCurve(ReferenceMesh<3> &, const Curve<3> &, std::span<const Curve<3> *const>,
                              std::span<const Curve<3>>, const CutPolicy &, const CutOptions &);

} // namespace dualblock
