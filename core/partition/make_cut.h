// Making a cut that a source has proposed. Internal to partition/.
#pragma once

#include "partition/cut_options.h"
#include "partition/part_view.h"

namespace dualblock {

struct BentCutOptions : CutOptions {
  std::vector<Axis> axes;              // of the domain's curves
  std::span<const CutPolicy> policies; // per component, or empty for the standard one
};

/// Cuts the part, refining the mesh first where the cut is bent. False where there was nothing to cut, or the
/// plane is one of those that are `refused`.
bool makeCut(ReferenceMesh<3> &mesh, const PartView &part, const Cut &cut, const CutOptions &options,
             const std::vector<Plane<3>> &refused = {});

} // namespace dualblock
