// Nearest points.
#pragma once

#include <algorithm>

#include "base/types.h"

namespace dualblock {

/// The point of the segment from a to b next to x.
template <int N> Vec<N> nearestOnSegment(const Vec<N> &x, const Vec<N> &a, const Vec<N> &b) {
  const Vec<N> d = b - a;
  const double square = glm::dot(d, d);
  return a + (square > 0 ? std::clamp(glm::dot(x - a, d) / square, 0.0, 1.0) : 0.0) * d;
}

/// The point of a triangle next to x, by barycentric regions.
Vec<3> nearestOnTriangle(const Vec<3> &x, const Vec<3> &a, const Vec<3> &b, const Vec<3> &c);

} // namespace dualblock
