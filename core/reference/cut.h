// Cutting the reference mesh along a surface (ARCHITECTURE.md 3): a sign per node, a node on each crossing
// edge. The new split surface is the connected piece of the zero set that holds the seeds.
#pragma once

#include "reference/subdivide.h"

namespace dualblock {

/// Where a cut begins: at the ridge that two faces of a simplex share and that lies in the zero set, or (from
/// < 0) in a simplex that the zero set crosses or touches in a face.
template <int N> struct CutSeed {
  Index simplex;
  int from = -1;
  int to = -1;
  Index crossFrom = kCrossAll; // which surfaces are passed when turning around the seed ridge
};

/// The simplices that a cut would cross, those that a part of it lies beside, and those around seed ridges,
/// which it may cross unseen.
template <int N>
std::vector<Index> sectionOf(const ReferenceMesh<N> &mesh, const Surface<N> &surface,
                             const std::vector<CutSeed<N>> &seeds, double tolerance);

/// Cuts along surfaces[surface]. Nodes nearer to it than `tolerance` count as on it. The cut crosses earlier
/// split surfaces where it meets their inside, and ends where it arrives at a curve of a part: there both
/// parts go on as they are, and nothing new has to match. Returns the number of inner faces newly tagged; 0
/// where the piece was a split surface already.
template <int N>
Index cutAlong(ReferenceMesh<N> &mesh, Index surface, const std::vector<CutSeed<N>> &seeds, double tolerance);

extern template std::vector<Index> sectionOf(const ReferenceMesh<3> &, const Surface<3> &,
                                             const std::vector<CutSeed<3>> &, double);
extern template Index cutAlong(ReferenceMesh<2> &, Index, const std::vector<CutSeed<2>> &, double);
extern template Index cutAlong(ReferenceMesh<3> &, Index, const std::vector<CutSeed<3>> &, double);

} // namespace dualblock
