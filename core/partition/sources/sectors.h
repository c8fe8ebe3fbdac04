// Sectors around a reflex curve: the directions of the planes that make them, and how far one may turn so
// that it serves another curve, too. Directions are angles from the curve's first side through the part.
#pragma once

#include <optional>
#include <span>

#include "partition/cut_options.h"
#include "parts/features.h"
#include "parts/ridge.h"

namespace dualblock {

/// Directions of the planes through a reflex curve of interior angle `angle`: 1 for 2 sectors, 2 for 3 or 4
/// (paper 2.4; ARCHITECTURE.md 3, rule 1).
std::vector<double> sectorPlanes(CurveKind kind, double angle);

/// Directions from `low` to `high`; none where low > high.
struct DirectionRange {
  double low, high;
  bool has(double direction) const {
    return low - kAngleSlack <= direction && direction <= high + kAngleSlack;
  }
};

/// How far plane `sector` may turn: by `snap` at most, and no sector beside it leaves 45 to 135 degrees.
DirectionRange rangeOfSector(CurveKind kind, double angle, std::size_t sector, double snap);

/// 0 to 2 pi.
template <int N> double directionOf(const RidgeFrame<N> &frame, const Vec<N> &away);

template <int N> Plane<N> planeAt(const Vec<N> &point, const RidgeFrame<N> &frame, double direction);

/// Of the planes through ridge `k` of the curve and another of its part, the one nearest to the middle of
/// the range.
template <int N>
std::optional<Plane<N>> sharedPlane(const ReferenceMesh<N> &mesh, const Curve<N> &curve, std::size_t k,
                                    const DirectionRange &range, std::span<const Curve<N> *const> others,
                                    double tolerance);

/// Whether a split surface leaves the ridge in a direction of the range.
template <int N>
bool isCutWithin(const ReferenceMesh<N> &mesh, const Ridge<N> &ridge, const RidgeFrame<N> &frame,
                 const DirectionRange &range, Index facetSurfaces);

} // namespace dualblock
