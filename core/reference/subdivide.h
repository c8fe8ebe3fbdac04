// Subdivision of simplices at new nodes on their edges. Every edge split in one call is split in one global
// order, so that simplices that share a face divide it alike: the result is conformal by construction.
#pragma once

#include <span>

#include "reference/reference_mesh.h"

namespace dualblock {

struct EdgeSplit {
  Index a, b; // a < b
  Index node; // the new node on the edge; also its place in the global order: lower ones split first
};

/// Splits every edge of `edges` (sorted by a, then b) in all simplices of `affected`, which must hold every
/// simplex around each of the edges. Tags, regions, adjacency and nodeSimplex are kept up. Returns the
/// simplices that stand in the place of the affected ones: `affected` keeps one piece each, the others are
/// appended to the mesh and to `affected`.
template <int N>
void subdivide(ReferenceMesh<N> &mesh, std::span<const EdgeSplit> edges, std::vector<Index> &affected);

/// Puts a new node at the centroid of a face and divides the simplices on both sides of it.
template <int N> void splitFace(ReferenceMesh<N> &mesh, FaceRef<N> face);

/// The node that splits edge {a, b}, or kNone.
Index splitNode(std::span<const EdgeSplit> edges, Index a, Index b);

extern template void splitFace(ReferenceMesh<2> &, FaceRef<2>);
extern template void splitFace(ReferenceMesh<3> &, FaceRef<3>);
extern template void subdivide(ReferenceMesh<2> &, std::span<const EdgeSplit>, std::vector<Index> &);
extern template void subdivide(ReferenceMesh<3> &, std::span<const EdgeSplit>, std::vector<Index> &);

} // namespace dualblock
