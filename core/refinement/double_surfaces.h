// The dual with some of its D-bar-surfaces doubled: the layers of blocks along them are split in two, so that
// blocks come nearer to bent sides (ARCHITECTURE.md 8).
#pragma once

#include "base/error.h"
#include "blocks/bent_shape.h"
#include "blocks/block_mesh.h"

namespace dualblock {

template <int N> struct Doubling {
  BlockMesh<N> blocks;
  std::vector<std::array<Index, 2>> inserted; // D-bar-surface, and the one that it doubles
};

/// Doubles the D-bar-surfaces that are wanted: every edge that one crosses gets a node in its middle, which
/// lies on the bent side or curve that the edge stands for. Errors (badOption): as refineBlocks.
template <int N>
Result<Doubling<N>> doubleSurfaces(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface,
                                   const BentShape<N> &shape, const std::vector<bool> &wanted);

extern template Result<Doubling<2>> doubleSurfaces(const BlockMesh<2> &, const std::vector<Index> &,
                                                   const BentShape<2> &, const std::vector<bool> &);
extern template Result<Doubling<3>> doubleSurfaces(const BlockMesh<3> &, const std::vector<Index> &,
                                                   const BentShape<3> &, const std::vector<bool> &);

} // namespace dualblock
