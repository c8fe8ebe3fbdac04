// From the parts that were chosen to a certified mesh, by way of cutting on and of the fallback. Internal to
// the pipeline.
#pragma once

#include "certified_mesh.h"
#include "partition/choose.h"

namespace dualblock {

/// Meshes whose simplices may become parts: the coarsest there is, and one of good simplices, made from that
/// (remesh/remesh.h).
template <int N> struct FillMeshes {
  CoarseMesh<N> coarsest;
  /// Each attempt finer than the one before; null where it would take more simplices than `most` (0: no
  /// bound).
  std::function<const ReferenceMesh<N> *(int attempt, Index most)> good;
};

/// Meshes the parts of `choice`. Parts that the certificate blames are halved; where that does not serve,
/// their components go down the ladder of the fallback, if they may: simplices confined to parts that are not
/// simple, good simplices, the coarsest. False if they may not, or there is no coarsest mesh for them.
template <int N>
bool meshParts(PipelineResult<N> &r, PartChoice<N> choice, bool mayFallBack, const PipelineOptions &options,
               const FillMeshes<N> &fills, StageClock &clock);

/// Good simplices in place of components of r whose blocks have a poor shape, whatever they are made of.
/// False if there are none, or they are more than `most` in all, or no valid mesh comes of it.
template <int N>
bool meshGoodSimplices(PipelineResult<N> &r, Index most, const PipelineOptions &options,
                       const FillMeshes<N> &fills, StageClock &clock);

#define DUALBLOCK_DECLARE(N)                                                                                 \
  extern template bool meshParts(PipelineResult<N> &, PartChoice<N>, bool, const PipelineOptions &,          \
                                 const FillMeshes<N> &, StageClock &);                                       \
  extern template bool meshGoodSimplices(PipelineResult<N> &, Index, const PipelineOptions &,                \
                                         const FillMeshes<N> &, StageClock &);
DUALBLOCK_DECLARE(2)
DUALBLOCK_DECLARE(3)
#undef DUALBLOCK_DECLARE

} // namespace dualblock
