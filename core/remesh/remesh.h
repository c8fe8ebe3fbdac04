// A reference mesh of good tetrahedra for what becomes simplices (ARCHITECTURE.md 3, rule 4): the coarsest
// one is as poor as can be, and every block inherits that.
#pragma once

#include <optional>

#include "parts/parts.h"

namespace dualblock {

struct RemeshOptions {
  double scale = 1;   // of all sizes: less is finer, and nearer to bent sides
  Index mostTets = 0; // > 0: nothing is made that has more
};

/// Tetrahedra of good shape for the domain that `coarse` fills, by edits of those that are there: edges are
/// divided and contracted to the lengths that the domain's curvature and thickness ask for, swapped, and
/// nodes moved, all within what they lie on. Nodes of bent sides lie on them, faces may not. Surfaces,
/// regions and components are numbered as in `coarse`. `features`: its parts.
std::optional<ReferenceMesh<3>> remesh(const ReferenceMesh<3> &coarse, const Parts<3> &features,
                                       const RemeshOptions &options = {});

} // namespace dualblock
