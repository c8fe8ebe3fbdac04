// The fallback confined (ARCHITECTURE.md 3, rule 4): convex parts that are not simple become simplices, and
// so do those that a quadrilateral or larger polygon joins to them; the others stay as they are.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// Where the simplices of a part meet. More nodes give more simplices, of a better shape perhaps.
enum class Apex : std::uint8_t {
  corner, // where most sides do: no new node
  side,   // there, and those over an outer side of more than three corners in its middle, if they miss it
  centre  // inside, as far as can be from every side, and in the middles of outer sides
};
inline constexpr std::array kApexes{Apex::corner, Apex::side, Apex::centre};

/// A mesh of the parts by their corners, and perhaps their centres, alone, and which of its simplices are
/// parts of their own.
struct PulledMesh {
  ReferenceMesh<3> mesh;
  std::vector<bool> everyFace;   // per simplex
  std::vector<double> blocks;    // per component: what it would give; infinity where it cannot be pulled
  std::vector<Index> simplified; // per component: parts that became simplices
};

/// `mesh` and `parts` after the cuts through reflex curves, which leave convex parts. A component cannot be
/// pulled where it has bent sides, or a part with a side that is no disc or a split side without one part
/// behind it, or a centre that does not see the whole of its part. What is one simplex already gets no
/// centre.
PulledMesh pullParts(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Apex wanted = Apex::corner);

} // namespace dualblock
