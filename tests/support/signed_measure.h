// A block's area or volume, with its orientation.
#pragma once

#include <numeric>

#include "geometry/jacobian.h"

namespace dualblock::test {

/// The exact integral of the determinant: a polynomial in Bernstein form integrates to the mean of its
/// coefficients.
template <int N> double signedMeasure(const std::array<Vec<N>, 1 << N> &corners) {
  const auto coefficients = jacobianCoefficients<N>(corners);
  return std::accumulate(coefficients.begin(), coefficients.end(), 0.0) / kJacobianCoefficients<N>;
}

} // namespace dualblock::test
