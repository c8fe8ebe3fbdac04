// From parts to a mesh with its certificate: contributions, dual, primal, places of its nodes. Internal to
// the pipeline.
#pragma once

#include "pipeline.h"
#include "stage_clock.h"

namespace dualblock {

/// Contributions and D-bar-cells of r.parts, with repairs of the mesh until conditions (a) and (b) hold; new
/// simplices are added to `everyFace`. False if they cannot be made to hold.
template <int N>
bool buildDual(PipelineResult<N> &r, const PartOptions &partOptions, std::vector<bool> &everyFace,
               StageClock &clock);

/// The primal of r's dual, its certificate and its quality. False where another mesh might serve better,
/// though this one is valid: blocks are further from a side than is aimed at, or the shape has suffered.
template <int N> bool buildResult(PipelineResult<N> &r, const PipelineOptions &options, StageClock &clock);

/// The scaled Jacobians of the blocks that r hands out.
template <int N> const std::vector<double> &shapesOf(const PipelineResult<N> &r) {
  return r.finalMesh ? r.finalMesh->quality : r.quality;
}

/// The worst of them.
template <int N> double worstShape(const PipelineResult<N> &r) {
  return *std::min_element(shapesOf(r).begin(), shapesOf(r).end());
}

#define DUALBLOCK_DECLARE(N)                                                                                 \
  extern template bool buildDual(PipelineResult<N> &, const PartOptions &, std::vector<bool> &,              \
                                 StageClock &);                                                              \
  extern template bool buildResult(PipelineResult<N> &, const PipelineOptions &, StageClock &);
DUALBLOCK_DECLARE(2)
DUALBLOCK_DECLARE(3)
#undef DUALBLOCK_DECLARE

} // namespace dualblock
