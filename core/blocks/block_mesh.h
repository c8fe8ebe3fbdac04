// A block mesh by itself, without the dual that it was read off: what extraction, relaxation, refinement and
// the certificate of their results work on.
#pragma once

#include "parts/parts.h"
#include "primal/primal.h"

namespace dualblock {

template <int N> struct BlockMesh {
  std::vector<Vec<N>> positions;
  std::vector<std::array<Index, 1 << N>> blocks; // nodes in VTK's order; axis a as in Block
  /// Per block and face 2a, 2a + 1, the low and the high end of axis a: the FaceTag of the domain's facet
  /// that the face lies on, as seen from the block, or kNone.
  std::vector<std::array<Index, 2 * N>> tags;
  std::vector<std::array<Index, N>>
      surfaces;            // per block and axis: the D-bar-surface that crosses it along that axis
  std::vector<Index> part; // per block: of the cuts' parts, the one that it fills a corner of

  Index nodeCount() const { return toIndex(positions.size()); }
  Index blockCount() const { return toIndex(blocks.size()); }
};

/// Corner k of face f of a block, in VTK's order of corners; faces as in BlockMesh::tags.
template <int N> constexpr int faceCorner(int f, int k) {
  constexpr int kFaces[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  constexpr int kQuadSides[4][2] = {{3, 0}, {1, 2}, {0, 1}, {2, 3}};
  return N == 3 ? kFaces[f][k] : kQuadSides[f % 4][k % 2];
}

/// The primal as it is: one layer of blocks along every side.
template <int N>
BlockMesh<N> layeredBlocks(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualSurfaces &surfaces,
                           const Primal<N> &primal);

/// Per node: the patches of facets that it lies on (half of ReferenceMesh::sideKey), ascending.
template <int N> Lists<Index> patchesOfNodes(const ReferenceMesh<N> &mesh, const BlockMesh<N> &blocks);

/// Per node: its blocks, ascending.
template <int N> Lists<Index> blocksOfNodes(const BlockMesh<N> &blocks);

#define DUALBLOCK_DECLARE(N)                                                                                 \
  extern template BlockMesh<N> layeredBlocks(const ReferenceMesh<N> &, const Parts<N> &,                     \
                                             const DualSurfaces &, const Primal<N> &);                       \
  extern template Lists<Index> patchesOfNodes(const ReferenceMesh<N> &, const BlockMesh<N> &);               \
  extern template Lists<Index> blocksOfNodes(const BlockMesh<N> &);
DUALBLOCK_DECLARE(2)
DUALBLOCK_DECLARE(3)
#undef DUALBLOCK_DECLARE

} // namespace dualblock
