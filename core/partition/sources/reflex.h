// Cuts through reflex and flat curves (ARCHITECTURE.md 3, rule 1).
#pragma once

#include <span>

#include "partition/cut_options.h"
#include "parts/features.h"

namespace dualblock {

/// Cuts along every sector plane of the curve that is not cut already. As the policy allows a plane may turn
/// where it then serves one of the `others`, too; a sheet may where it then ends in one of the `curves`,
/// which are those of all parts. Returns the number of cuts.
template <int N>
Index cutReflexCurve(ReferenceMesh<N> &mesh, const Curve<N> &curve, std::span<const Curve<N> *const> others,
                     std::span<const Curve<N>> curves, const CutPolicy &policy, const CutOptions &options);

extern template Index cutReflexCurve(ReferenceMesh<2> &, const Curve<2> &, std::span<const Curve<2> *const>,
                                     std::span<const Curve<2>>, const CutPolicy &, const CutOptions &);
extern template Index cutReflexCurve(ReferenceMesh<3> &, const Curve<3> &, std::span<const Curve<3> *const>,
                                     std::span<const Curve<3>>, const CutPolicy &, const CutOptions &);

} // namespace dualblock
