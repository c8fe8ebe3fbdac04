// The fallback confined (ARCHITECTURE.md 3, rule 4): convex parts that are not simple become simplices
// without a new vertex, and so do those that a quadrilateral or larger polygon joins to them; the others stay
// as they are.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// A mesh of the parts by their corners alone, and which of its simplices are parts of their own.
struct PulledMesh {
  ReferenceMesh<3> mesh;
  std::vector<bool> everyFace;   // per simplex
  std::vector<double> blocks;    // per component: what it would give; infinity where it cannot be pulled
  std::vector<Index> simplified; // per component: parts that became simplices
};

/// `mesh` and `parts` after the cuts through reflex curves, which leave convex parts. A component cannot be
/// pulled where it has bent sides, or a part with a side that is no disc or a split side without one part
/// behind it.
PulledMesh pullParts(const ReferenceMesh<3> &mesh, const Parts<3> &parts);

} // namespace dualblock
