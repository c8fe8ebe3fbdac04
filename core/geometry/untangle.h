// Valid places for nodes (ARCHITECTURE.md 5): every Bezier coefficient of a block's Jacobian is affine in
// each of its nodes, so a small linear programme finds a valid place for one node, all others fixed, when
// there is one.
#pragma once

#include "primal/primal.h"

namespace dualblock {

/// Moves nodes of blocks that have a coefficient that is not positive, one at a time, to where the smallest
/// coefficient around them, relative to its gradient, is largest: the part's centre first, then nodes on
/// split surfaces, on facets and on curves, each within the facets that it lies on. Corners on facets, and
/// what lies on bent facets, stay. Several rounds, while blocks improve. Returns the number of moves.
/// bad: those blocks.
template <int N>
Index untangle(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualCells<N> &dual,
               std::vector<Index> bad, Primal<N> &primal);

extern template Index untangle(const ReferenceMesh<2> &, const Parts<2> &, const DualCells<2> &,
                               std::vector<Index>, Primal<2> &);
extern template Index untangle(const ReferenceMesh<3> &, const Parts<3> &, const DualCells<3> &,
                               std::vector<Index>, Primal<3> &);

} // namespace dualblock
