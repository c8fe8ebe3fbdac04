// Cuts through reflex and flat curves (ARCHITECTURE.md 3, rule 1).
#pragma once

#include "parts/cut_options.h"
#include "parts/features.h"

namespace dualblock {

/// A block cannot fill a flat corner, and badly what is nearly flat: curves of more than 170 degrees want a
/// cut.
bool wantsCut(double angle);

/// Cuts along every sector plane of the curve that is not cut already. Returns the number of cuts.
template <int N>
Index cutReflexCurve(ReferenceMesh<N> &mesh, const Curve<N> &curve, const CutOptions &options);

/// Directions of the planes through a reflex curve of interior angle `angle`, as angles from its first
/// side: 1 for 2 sectors, 2 for 3 or 4 (paper 2.4; ARCHITECTURE.md 3, rule 1).
std::vector<double> sectorPlanes(CurveKind kind, double angle);

extern template Index cutReflexCurve(ReferenceMesh<2> &, const Curve<2> &, const CutOptions &);
extern template Index cutReflexCurve(ReferenceMesh<3> &, const Curve<3> &, const CutOptions &);

} // namespace dualblock
