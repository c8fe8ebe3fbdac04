// The refined mesh: each block filled with elements by transfinite interpolation, on the true facets
// (ARCHITECTURE.md 9).
#pragma once

#include <functional>

#include "blocks/bent_shape.h"
#include "primal/boundary.h"
#include "refinement/spacing.h"

namespace dualblock {

template <int N> struct RefinedMesh {
  std::vector<Vec<N>> positions;                   // the blocks' own nodes first
  std::vector<std::array<Index, 1 << N>> elements; // by block, then the third, second and first axis
  std::vector<Index> block;                        // per element
  std::vector<double> quality;                     // per element: scaled Jacobian
  BoundaryFaces<N> boundary;
  std::vector<Index> boundaryElement; // per face of the boundary: whose it is
  BoundaryFaces<N> interfaces;        // faces on facets inside the domain, as one of the two blocks sees them
  std::vector<std::array<Index, 3>>
      outline;                  // along the blocks' edges: two nodes and an element that has them
  std::vector<Index> intervals; // per D-bar-surface; 0 for one that is not in the mesh
  Lists<double> places;         // per D-bar-surface, as in Spacing
  std::vector<std::array<std::uint8_t, N>> isReversed; // per block and axis: its surface runs against it
  std::vector<Index>
      straightened; // blocks that bent sides would have made invalid: their elements are straight
};

/// Divides valid blocks. Nodes on bent sides and curves lie on them; where an element would be inverted
/// whatever is tried (NodePlacer), the block's edges and faces stay straight. `progress`: the share of the
/// work done. Errors (badOption): see spacingOf, and more elements than the limit.
template <int N>
Result<RefinedMesh<N>> refineBlocks(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface,
                                    const BentShape<N> &shape, const RefineOptions &options,
                                    const std::function<void(double)> &progress = {});

extern template Result<RefinedMesh<2>> refineBlocks(const BlockMesh<2> &, const std::vector<Index> &,
                                                    const BentShape<2> &, const RefineOptions &,
                                                    const std::function<void(double)> &);
extern template Result<RefinedMesh<3>> refineBlocks(const BlockMesh<3> &, const std::vector<Index> &,
                                                    const BentShape<3> &, const RefineOptions &,
                                                    const std::function<void(double)> &);

} // namespace dualblock
