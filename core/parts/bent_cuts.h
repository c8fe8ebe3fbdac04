// Cuts that make parts with bent sides simple (ARCHITECTURE.md 3, rule 3): sides without curves, closed
// curves, sides that meet twice, sides that turn too far. Internal to parts/.
#pragma once

#include "parts/chains.h"
#include "parts/cut_options.h"

namespace dualblock {

struct BentCutOptions : CutOptions {
  std::vector<Axis> axes;              // of the domain's curves
  std::span<const CutPolicy> policies; // per component, or empty for the standard one
  std::vector<Plane<3>> refused;       // planes not to cut along
};

/// What a cut is made for.
enum class CutReason : std::uint8_t { none, needed, shape };

/// Looks for the first part that a bent side keeps from being simple, or whose blocks could not follow it, or
/// one with a side that turns too far, and cuts it. Components that gave up are passed over. Returns why a
/// cut was made, if one was.
CutReason cutBentPart(ReferenceMesh<3> &mesh, const Parts<3> &parts, const BentCutOptions &options,
                      const std::vector<bool> &gaveUp);

/// Cuts each of some parts once more, where it turns most, as far as that leaves as many parts simple as
/// were. `parts` are those of the mesh, before and afterwards. `triesLeft`: cuts of single parts that may
/// still be tried, each of which is judged by all parts anew. Returns the number of cuts.
Index halveParts(ReferenceMesh<3> &mesh, Parts<3> &parts, const std::vector<Index> &which,
                 const BentCutOptions &options, int &triesLeft);

} // namespace dualblock
