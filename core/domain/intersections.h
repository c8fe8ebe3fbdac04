// Where a boundary crosses or touches itself: found by brute force over pairs that may meet, to name the
// culprits. In 2D it runs before the reference mesh is made, in 3D after TetGen has refused the domain.
#pragma once

#include <optional>

#include "domain/domain.h"

namespace dualblock {

/// Two facets that meet where they share no vertex or edge, or nothing.
template <int N> struct Intersection {
  Index facetA, facetB;
  Vec<N> where;
};

/// tolerance: absolute; features nearer than this touch.
std::optional<Intersection<2>> findIntersection(const Domain<2> &domain, double tolerance);
std::optional<Intersection<3>> findIntersection(const Domain<3> &domain, double tolerance);

} // namespace dualblock
