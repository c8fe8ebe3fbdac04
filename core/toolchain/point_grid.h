// Where plain double arithmetic is exact: points on a coarse grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dualblock {

/// Knows whether a point's coordinates are multiples of a step, a power of two, of which the domain is at
/// most 512 long. Differences of such points are D <= 512 steps, all that the predicates compute of them is a
/// multiple of a power of the step, and the largest such multiple, 72 D^5 in insphere(), is below 2^53: no
/// operation rounds. Points that TetGen adds lie in the domain, but off the grid most often.
class PointGrid {
public:
  /// points: 3 coordinates each. has() is false ever after if they are on no such grid.
  void lay(const double *points, int count) {
    const int size = 3 * count;
    double step = std::numeric_limits<double>::infinity();
    double extent = 0;
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (int k = axis; k < size; k += 3) {
        low = std::min(low, points[k]);
        high = std::max(high, points[k]);
        step = std::min(step, lowestBit(points[k]));
      }
      extent = std::max(extent, high - low);
      largest = std::max({largest, -low, high});
    }
    constexpr double kFarthest = 1LL << 40;                    // steps from the origin
    const bool isOrdinary = step > 0x1p-150 && step < 0x1p150; // nor does its fifth power under- or overflow
    isLaid = isOrdinary && extent <= kLongest * step && largest <= kFarthest * step;
    rounder = 1.5 * 0x1p52 * step;
  }

  /// Whether all the points, of the domain, are on the grid.
  template <class... Points> bool has(const Points *...points) const {
    return isLaid && (isOn(points) && ...);
  }

private:
  static constexpr double kLongest = 512;

  static double lowestBit(double x) {
    if (x == 0) return std::numeric_limits<double>::infinity();
    int exponent = 0;
    const auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    return std::ldexp(static_cast<double>(digits & -digits), exponent - 53);
  }

  // Adding so large a number rounds to a multiple of the step.
  bool isOn(const double *p) const {
    return (p[0] + rounder) - rounder == p[0] && (p[1] + rounder) - rounder == p[1] &&
           (p[2] + rounder) - rounder == p[2];
  }

  double rounder = 0;
  bool isLaid = false;
};

} // namespace dualblock
