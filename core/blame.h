// Which components and parts the certificate's failures concern, and those parts cut further. Internal to the
// pipeline.
#pragma once

#include "partition/fills/mixed_mesh.h"
#include "pipeline.h"

namespace dualblock {

/// The components of what the certificate's failures name, of those that can still change; all of them where
/// a failure names nothing that belongs to one.
template <int N> std::vector<bool> blamed(const PipelineResult<N> &r, const std::vector<PartSource> &source);

/// Whose parts are cut on.
enum class Blame : std::uint8_t {
  wide,  // all that the certificate names, what is around nodes that it names, and blocks that are further
         // from a side than is aimed at: mostly one round of cuts is enough then
  narrow // of blocks that are inverted; of others only where there are none: each cut may spoil its
         // neighbours
};

/// Halves the parts whose blocks strayed from their bent sides, or cross others, or are inverted. Returns
/// whether that was possible, and is still cheap.
template <int N>
bool cutFiner(PipelineResult<N> &r, const std::vector<PartSource> &source, Blame blame, double tolerance,
              int &triesLeft);

#define DUALBLOCK_DECLARE(N)                                                                                 \
  extern template std::vector<bool> blamed(const PipelineResult<N> &, const std::vector<PartSource> &);      \
  extern template bool cutFiner(PipelineResult<N> &, const std::vector<PartSource> &, Blame, double, int &);
DUALBLOCK_DECLARE(2)
DUALBLOCK_DECLARE(3)
#undef DUALBLOCK_DECLARE

} // namespace dualblock
