// An oriented hyperplane: a line in 2D, a plane in 3D.
#pragma once

#include "base/types.h"

namespace dualblock {

template <int N> struct Plane {
  Vec<N> normal{0.0}; // unit length
  double offset = 0;  // normal . x == offset on the plane

  double distance(const Vec<N> &x) const { return glm::dot(normal, x) - offset; }
};

/// The plane through `point` with the given normal, which need not have unit length.
template <int N> Plane<N> planeThrough(const Vec<N> &point, const Vec<N> &normal) {
  const Vec<N> unit = glm::normalize(normal);
  return {unit, glm::dot(unit, point)};
}

} // namespace dualblock
