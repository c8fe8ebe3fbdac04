// The Jacobian determinant of a block as a polynomial in Bernstein-Bezier form: its coefficients bound it
// from both sides, so that a sign can be certified and not only sampled.
#pragma once

#include <span>

#include "primal/primal.h"

namespace dualblock {

/// Quads: bilinear map, determinant of degree 1 per axis, 4 coefficients, at the corners. Hexahedra:
/// trilinear map, degree 2 per axis, 27 coefficients.
template <int N> inline constexpr int kJacobianCoefficients = N == 2 ? 4 : 27;

/// The coefficients of the map from [0, 1]^N onto the block, first axis fastest.
template <int N>
std::array<double, kJacobianCoefficients<N>> jacobianCoefficients(const std::array<Vec<N>, 1 << N> &corners);

/// Smallest of the corners' determinants divided by the lengths of the edges that meet there: 1 for a right
/// parallelepiped, 0 or less for a block inverted at a corner.
template <int N> double scaledJacobian(const std::array<Vec<N>, 1 << N> &corners);

/// The corners of a block in the order of its nodes.
template <int N>
std::array<Vec<N>, 1 << N> cornersOf(const std::array<Index, 1 << N> &nodes,
                                     const std::vector<Vec<N>> &positions) {
  std::array<Vec<N>, 1 << N> corners;
  for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = positions[at(nodes[k])];
  return corners;
}

} // namespace dualblock
