// Where a domain touches itself, or two of its pieces touch, along an edge or at a node only, no block can
// reach across. Each side of such a contact gets nodes of its own, so that the reference mesh is a manifold.
#pragma once

#include "reference/reference_mesh.h"

namespace dualblock {

/// Doubles the nodes whose simplices do not hang together over faces, and (3D) splits the edges whose
/// simplices do not, so that their midpoints can be doubled. Returns the nodes added. Linear in the
/// simplices.
template <int N> Index unpinch(ReferenceMesh<N> &mesh);

extern template Index unpinch(ReferenceMesh<2> &);
extern template Index unpinch(ReferenceMesh<3> &);

} // namespace dualblock
