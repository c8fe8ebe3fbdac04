// Cutting the reference mesh along a plane (ARCHITECTURE.md 3): a sign per node, a node on each crossing
// edge. The new split surface is the connected component of plane and domain that holds the seed.
#pragma once

#include "reference/subdivide.h"

namespace dualblock {

struct CutResult {
  Index faces = 0; // newly tagged inner faces; 0 when the component was a split surface already
  bool touched = false;
};

/// Cuts along surfaces[surface].plane, starting from the ridge of simplex `seed` that its faces `from` and
/// `to` share, which must lie in the plane. Nodes nearer than `tolerance` count as in the plane. Earlier
/// split surfaces do not stop the cut.
template <int N>
CutResult cutByPlane(ReferenceMesh<N> &mesh, Index surface, Index seed, int from, int to, double tolerance);

extern template CutResult cutByPlane(ReferenceMesh<2> &, Index, Index, int, int, double);
extern template CutResult cutByPlane(ReferenceMesh<3> &, Index, Index, int, int, double);

} // namespace dualblock
