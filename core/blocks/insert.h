// Insertion of a D-bar-surface along a side: the layer of blocks there is split in two, so that a thinner one
// lies next to the side (ARCHITECTURE.md 8).
#pragma once

#include "blocks/bent_shape.h"
#include "blocks/block_mesh.h"

namespace dualblock {

/// What came of it: a mesh with the layer, or why there is none.
template <int N> struct Insertion {
  BlockMesh<N> blocks;
  std::vector<std::array<Index, 2>> inserted; // D-bar-surface, and the one that it was split from
  std::string why;                            // empty where it worked
};

/// Splits the layers of all D-bar-surfaces that cross edges from the side of `facet` inwards. `share`,
/// between 0 and 1: of each edge, what the new layer next to the side gets. Each half of a block is a piece
/// of its own map, so that it is valid where the block is; on bent sides new nodes lie on the side. Refused
/// where a layer crosses itself, or has the side at both ends.
template <int N>
Insertion<N> insertAlong(const ReferenceMesh<N> &mesh, const BentShape<N> &shape, const BlockMesh<N> &blocks,
                         Index facet, double share);

extern template Insertion<2> insertAlong(const ReferenceMesh<2> &, const BentShape<2> &, const BlockMesh<2> &,
                                         Index, double);
extern template Insertion<3> insertAlong(const ReferenceMesh<3> &, const BentShape<3> &, const BlockMesh<3> &,
                                         Index, double);

} // namespace dualblock
