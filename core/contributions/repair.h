// Repairs of the reference mesh where a condition of ARCHITECTURE.md 2 fails: (a) sides are full, (b) the
// boundary is full near a corner.
#pragma once

#include "dual/dual_cells.h"

namespace dualblock {

/// Splits the edges, else the faces, of the offending simplices whose nodes lie on a side that they are not
/// part of. Returns the number of nodes added; 0 means that there is nothing left to split.
template <int N>
Index repairFullness(ReferenceMesh<N> &mesh, const Parts<N> &parts, const std::vector<NotFull> &notFull);

/// Splits, in the simplices around surplus cell pieces, the inner edges whose nodes all lie on the part's
/// boundary, else the inner faces likewise. Returns the number of nodes added.
template <int N> Index repairBubbles(ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualCells<N> &dual);

extern template Index repairFullness(ReferenceMesh<2> &, const Parts<2> &, const std::vector<NotFull> &);
extern template Index repairFullness(ReferenceMesh<3> &, const Parts<3> &, const std::vector<NotFull> &);
extern template Index repairBubbles(ReferenceMesh<2> &, const Parts<2> &, const DualCells<2> &);
extern template Index repairBubbles(ReferenceMesh<3> &, const Parts<3> &, const DualCells<3> &);

} // namespace dualblock
