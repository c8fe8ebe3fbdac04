// Cuts that make parts with bent sides simple (ARCHITECTURE.md 3, rule 3): sides without curves, closed
// curves, sides that meet twice, sides that turn too far. Internal to parts/.
#pragma once

#include "parts/chains.h"
#include "parts/cut_options.h"

namespace dualblock {

/// Looks for the first part that a bent side keeps from being simple, or one with a side that turns by more
/// than 140 degrees, and cuts it. `axes`: those of the domain's curves. Components that gave up are passed
/// over. `policies`: per component, or empty for the standard one. Returns whether a cut was made.
bool cutBentPart(ReferenceMesh<3> &mesh, const Parts<3> &parts, const std::vector<Axis> &axes,
                 const CutOptions &options, std::span<const CutPolicy> policies,
                 const std::vector<bool> &gaveUp);

} // namespace dualblock
