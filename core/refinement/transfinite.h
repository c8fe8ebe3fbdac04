// Transfinite interpolation: the inside of an edge, a face or a block from what bounds it.
#pragma once

#include <bit>

#include "base/types.h"

namespace dualblock {

/// The point of a D-dimensional cell at the parameters t, by the boolean sum of the interpolations along its
/// axes (Gordon and Hall 1973). `ends(axes, bits)` is the boundary's point where each axis in the mask `axes`
/// is at the end that its bit in `bits` gives, and the others are at their own parameter.
template <int N, std::size_t D, typename Ends>
Vec<N> transfinite(const std::array<double, D> &t, const Ends &ends) {
  Vec<N> sum{0.0};
  for (unsigned axes = 1; axes < 1U << D; ++axes)
    for (unsigned bits = axes;; bits = (bits - 1) & axes) { // all subsets of the mask
      double weight = std::popcount(axes) % 2 == 1 ? 1 : -1;
      for (std::size_t a = 0; a < D; ++a)
        if (axes >> a & 1U) weight *= bits >> a & 1U ? t[a] : 1 - t[a];
      sum += weight * ends(axes, bits);
      if (bits == 0) break;
    }
  return sum;
}

} // namespace dualblock
