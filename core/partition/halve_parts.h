// Parts whose blocks do not serve, cut on: by themselves, where they turn most. Internal to the pipeline.
#pragma once

#include "partition/make_cut.h"

namespace dualblock {

/// Cuts each of some parts once more, where it turns most, as far as that leaves as many parts simple as
/// were. `parts` are those of the mesh, before and afterwards. `triesLeft`: cuts of single parts that may
/// still be tried, each of which is judged by all parts anew. Returns the number of cuts.
Index halveParts(ReferenceMesh<3> &mesh, Parts<3> &parts, const std::vector<Index> &which,
                 const BentCutOptions &options, int &triesLeft);

} // namespace dualblock
