// A valid place for a part's centre (ARCHITECTURE.md 5): every Bezier coefficient of a block's Jacobian is
// affine in the centre, so a small linear programme finds a valid place when there is one.
#pragma once

#include "primal/primal.h"

namespace dualblock {

/// Moves the centre of each part that has a block with a coefficient that is not positive to where the
/// smallest coefficient, relative to its gradient, is largest. Returns the number of centres moved.
template <int N> Index validateCentres(Primal<N> &primal);

extern template Index validateCentres(Primal<2> &);
extern template Index validateCentres(Primal<3> &);

} // namespace dualblock
