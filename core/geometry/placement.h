// Where the primal nodes sit (ARCHITECTURE.md 4 and 5): at the corner, the curve's midpoint by arc length,
// the centre of the side or of the part that their D-bar-cell stands for.
#pragma once

#include "primal/primal.h"

namespace dualblock {

/// Fills primal.positions and turns every block's axes so that its volume is positive. Where averages leave a
/// nodes in places that invert a block, they are moved to valid ones if there are any (untangle.h).
template <int N>
void placeNodes(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualCells<N> &dual,
                Primal<N> &primal);

/// The midpoint by arc length of a chain of segments given in any order. Starts from the lower end node.
template <int N>
Vec<N> chainMidpoint(const std::vector<Vec<N>> &nodes, std::span<const std::array<Index, 2>> segments);

extern template void placeNodes(const ReferenceMesh<2> &, const Parts<2> &, const DualCells<2> &,
                                Primal<2> &);
extern template void placeNodes(const ReferenceMesh<3> &, const Parts<3> &, const DualCells<3> &,
                                Primal<3> &);

} // namespace dualblock
