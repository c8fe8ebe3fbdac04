// What every rule of cutting has to know. Internal to parts/.
#pragma once

#include <limits>

#include "parts/features.h"

namespace dualblock {

/// What may be chosen about a component's cuts through reflex and flat curves.
struct CutPolicy {
  double largestAngle = kFlatAngle; // radians: curves of more want a cut; no less, or they have no frames
  double snap = 0;                  // radians: a plane may turn by as much to serve another curve, too
  bool isLast = false; // where no other serves: a round rim gets one sheet, in the place of its sectors' two,
                       // and hollow sides that turn are cut along

  bool wantsCut(double angle) const { return angle > largestAngle + kAngleSlack; }
};

struct CutOptions {
  double tolerance;    // nodes nearer to a cut than this count as on it
  Index facetSurfaces; // surfaces below this number are the domain's own facets
  Index mostSimplices = std::numeric_limits<Index>::max(); // of a mesh that is still to be cut
};

} // namespace dualblock
