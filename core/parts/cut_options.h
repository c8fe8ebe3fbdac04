// What every rule of cutting has to know. Internal to parts/.
#pragma once

#include <numbers>

#include "base/types.h"

namespace dualblock {

/// What may be chosen about a component's cuts through reflex and flat curves.
struct CutPolicy {
  /// A block cannot fill a flat corner, and badly what is nearly flat.
  double largestAngle = 170 * std::numbers::pi / 180; // radians: curves of more want a cut
  double snap = 0; // radians: a plane may turn by as much to serve another curve, too

  bool wantsCut(double angle) const { return angle > largestAngle; }
};

struct CutOptions {
  double tolerance;    // nodes nearer to a cut than this count as on it
  Index facetSurfaces; // surfaces below this number are the domain's own facets
};

} // namespace dualblock
