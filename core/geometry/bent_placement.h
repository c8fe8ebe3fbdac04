// Where parts have bent sides: side nodes onto their surface, and centres where the bent curves and sides
// carry them. Internal to geometry/.
#pragma once

#include "primal/primal.h"

namespace dualblock {

/// The point of a side's faces next to x.
Vec<3> nearestOnSide(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index side, const Vec<3> &x);

/// Moves the nodes of sides and centres of parts with bent sides, placed at means of corners so far. Bent
/// curves move a side's centre by twice their mean shift from the middles of their chords, sides and curves a
/// part's by the inclusion and exclusion of transfinite interpolation; in a box of bent faces that is its
/// centre exactly.
void followBentSides(const ReferenceMesh<3> &mesh, const Parts<3> &parts, const DualCells<3> &dual,
                     Primal<3> &primal);

} // namespace dualblock
