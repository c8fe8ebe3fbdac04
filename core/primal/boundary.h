// The faces of the block mesh on the domain's boundary.
#pragma once

#include "primal/primal.h"

namespace dualblock {

template <int N> struct BoundaryFaces {
  std::vector<std::array<Index, 1 << (N - 1)>>
      faces;                // node cycles, outward (3D), the domain on the left (2D)
  std::vector<Index> facet; // surface of each: a facet of the prepared domain
};

/// By block, then axis.
template <int N>
BoundaryFaces<N> boundaryFaces(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const Primal<N> &primal);

extern template BoundaryFaces<2> boundaryFaces(const ReferenceMesh<2> &, const Parts<2> &, const Primal<2> &);
extern template BoundaryFaces<3> boundaryFaces(const ReferenceMesh<3> &, const Parts<3> &, const Primal<3> &);

} // namespace dualblock
