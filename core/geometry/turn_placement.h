// Where nodes of bent sides best stand for what turns. Middles by length follow a ball well; of a box with
// rounded edges they lie on its flats, and blocks cut off what is round.
#pragma once

#include "primal/primal.h"

namespace dualblock {

/// Moves the nodes of bent sides, and of curves beside them, to where those are farthest from their rim or
/// their chord: the middle of a fillet between two flats, of an arc, of an octant of a ball. The other nodes
/// stay.
void placeByTurning(const ReferenceMesh<3> &mesh, const Parts<3> &parts, const DualCells<3> &dual,
                    Primal<3> &primal);

} // namespace dualblock
