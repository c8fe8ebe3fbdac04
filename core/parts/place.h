// An order of places that is the same on every reference mesh: nodes are numbered otherwise on each, and
// those that cuts have made differ by rounding. Internal to parts/.
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/reference_mesh.h"

namespace dualblock {

/// Coordinates in steps so small that no two places share all of them, and so large that rounding makes no
/// other; the shift keeps round numbers away from where steps meet.
template <int N> using Place = std::array<double, N>;

template <int N> Place<N> placeOf(const ReferenceMesh<N> &mesh, Index node) {
  constexpr double kSteps = 1e8; // of the domain's size
  constexpr double kShift = 0.3819660112501051;
  Place<N> place;
  for (int k = 0; k < N; ++k)
    place[at(k)] = std::floor(mesh.nodes[at(node)][k] / mesh.size * kSteps + kShift);
  return place;
}

/// The first and the last place of a piece of a curve.
template <int N> using Extent = std::array<Place<N>, 2>;

template <int N, typename Ridges> Extent<N> extentOf(const ReferenceMesh<N> &mesh, const Ridges &ridges) {
  Extent<N> extent{placeOf(mesh, ridges[0][0]), placeOf(mesh, ridges[0][0])};
  for (const auto &ridge : ridges)
    for (const Index node : ridge) {
      const Place<N> place = placeOf(mesh, node);
      extent = {std::min(extent[0], place), std::max(extent[1], place)};
    }
  return extent;
}

} // namespace dualblock
