// The coarsest mesh: D-bar-surfaces are extracted, one after the other, while the blocks stay valid and well
// enough shaped.
#pragma once

#include <functional>

#include "blocks/extract.h"

namespace dualblock {

template <int N> struct CoarsenOptions {
  double floor = 0;                                  // of the scaled Jacobian around what has been extracted
  std::function<bool(const BlockMesh<N> &)> isValid; // topology, geometry and features
};

/// Tries every surface, those of most blocks first, again and again until none can go. Nodes near an
/// extracted one are relaxed before its blocks are judged. Returns the surfaces extracted, in that order.
template <int N>
std::vector<Index> coarsen(const ReferenceMesh<N> &mesh, const Parts<N> &features,
                           const std::vector<Vec<N>> &featureNodes, BlockMesh<N> &blocks,
                           const CoarsenOptions<N> &options);

extern template std::vector<Index> coarsen(const ReferenceMesh<2> &, const Parts<2> &,
                                           const std::vector<Vec<2>> &, BlockMesh<2> &,
                                           const CoarsenOptions<2> &);
extern template std::vector<Index> coarsen(const ReferenceMesh<3> &, const Parts<3> &,
                                           const std::vector<Vec<3>> &, BlockMesh<3> &,
                                           const CoarsenOptions<3> &);

} // namespace dualblock
