// Where blocks are right but too far from bent sides: the D-bar-surfaces that cross them are doubled.
// Internal to the pipeline.
#pragma once

#include "certified_mesh.h"

namespace dualblock {

/// Doubles the D-bar-surfaces that cross the faces and edges which the certificate of r refuses as straying,
/// and again those of what strays still, until the mesh is valid: it is r's final mesh then. False, and r as
/// it was, where something else is wrong with the blocks, or they would become more than `most`.
template <int N> bool doubleStraying(PipelineResult<N> &r, const PipelineOptions &options, double most);

extern template bool doubleStraying(PipelineResult<2> &, const PipelineOptions &, double);
extern template bool doubleStraying(PipelineResult<3> &, const PipelineOptions &, double);

} // namespace dualblock
