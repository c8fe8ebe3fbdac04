// What every rule of cutting has to know. Internal to parts/.
#pragma once

#include "base/types.h"

namespace dualblock {

struct CutOptions {
  double tolerance;    // nodes nearer to a cut than this count as on it
  Index facetSurfaces; // surfaces below this number are the domain's own facets
};

} // namespace dualblock
