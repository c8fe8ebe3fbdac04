// Edges of blocks on bent sides and their curves.
#pragma once

#include "blocks/bent_shape.h"
#include "blocks/skeleton.h"

namespace dualblock {

/// Whether an edge lies on a bent side.
template <int N> bool isCurved(const BentShape<N> &shape, const Skeleton<N> &skeleton, Index edge) {
  return std::any_of(skeleton.patchesOfEdge.begin(edge), skeleton.patchesOfEdge.end(edge),
                     [&](Index patch) { return shape.isBent(patch); });
}

/// Moves the points of a curved edge, its ends excepted, onto what it lies on: the curve between two sides,
/// or a bent side. `places`: how far along the edge each of them is to be, from 0 to 1.
template <int N>
void bendEdge(const BentShape<N> &shape, const Skeleton<N> &skeleton, Index edge,
              const std::vector<double> &places, std::vector<Vec<N>> &points) {
  const Index *const first = skeleton.patchesOfEdge.begin(edge);
  const Index *const last = skeleton.patchesOfEdge.end(edge);
  const auto project = [&] {
    for (std::size_t k = 1; k + 1 < points.size(); ++k) points[k] = shape.project(first, last, points[k]);
  };
  project();
  // The nearest points of a chord crowd where it is farthest from an arc: spread them again by length.
  for (int round = 0; round < 2 && points.size() > 2; ++round) {
    std::vector<double> along{0};
    for (std::size_t k = 1; k < points.size(); ++k)
      along.push_back(along.back() + glm::length(points[k] - points[k - 1]));
    const std::vector<Vec<N>> before = points;
    std::size_t to = 1;
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      const double wanted = places[k] * along.back();
      while (to + 1 < points.size() && along[to] < wanted) ++to;
      const double length = along[to] - along[to - 1];
      const double share = length > 0 ? (wanted - along[to - 1]) / length : 0;
      points[k] = before[to - 1] + share * (before[to] - before[to - 1]);
    }
    project();
  }
}

} // namespace dualblock
