// From the parts that were chosen to a certified mesh, by way of cutting on and of the fallback. Internal to
// the pipeline.
#pragma once

#include "certified_mesh.h"
#include "parts/choose.h"

namespace dualblock {

/// Meshes the parts of `choice`. Parts that the certificate blames are halved; where that does not serve,
/// their components go down the ladder of the fallback, if they may. False if they may not, or there is no
/// coarsest mesh for them.
template <int N>
bool meshParts(PipelineResult<N> &r, PartChoice<N> choice, bool mayFallBack, const PipelineOptions &options,
               const CoarseMesh<N> &coarse, StageClock &clock);

#define DUALBLOCK_DECLARE(N)                                                                                 \
  extern template bool meshParts(PipelineResult<N> &, PartChoice<N>, bool, const PipelineOptions &,          \
                                 const CoarseMesh<N> &, StageClock &);
DUALBLOCK_DECLARE(2)
DUALBLOCK_DECLARE(3)
#undef DUALBLOCK_DECLARE

} // namespace dualblock
