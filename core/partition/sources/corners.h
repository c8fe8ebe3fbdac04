// Cuts through vertices of more than three sides (ARCHITECTURE.md 3, rule 2). Internal to parts/.
#pragma once

#include "partition/cut_options.h"
#include "parts/parts.h"

namespace dualblock {

/// At most one cut in each part that has a corner of too many sides. Components that gave up are passed over.
/// Returns the cuts.
Index cutCorners(ReferenceMesh<3> &mesh, const Parts<3> &parts, const CutOptions &options,
                 const std::vector<bool> &gaveUp);

} // namespace dualblock
