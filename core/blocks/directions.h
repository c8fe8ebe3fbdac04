// Which way the edges of a block mesh run along the D-bar-surfaces that cross them.
#pragma once

#include "blocks/skeleton.h"

namespace dualblock {

/// Opposite edges of a face run alike.
struct Directions {
  std::vector<bool> isReversed; // per edge: the surface runs from its higher node to its lower one
  std::vector<bool> isOneSided; // per surface: it cannot say which way is up, like a Moebius strip
};

template <int N> Directions directionsOf(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton);

/// Whether a block's axis runs as the D-bar-surface that crosses it along that axis.
template <int N>
bool runsAlong(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton, const Directions &directions,
               std::size_t block, int axis) {
  const Index edge = skeleton.edgesOf[block][edgeAt<N>(axis, 0)];
  return (skeleton.edges[at(edge)][0] == blocks.blocks[block][0]) != directions.isReversed[at(edge)];
}

/// Per surface, at which ends of its edges blocks have a face on the patch: 1 at the low end, as the surface
/// runs, plus 2 at the high end.
template <int N>
std::vector<unsigned> endsOnSide(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton,
                                 const Directions &directions, const std::vector<Index> &patchOfSurface,
                                 Index patch);

extern template Directions directionsOf(const BlockMesh<2> &, const Skeleton<2> &);
extern template Directions directionsOf(const BlockMesh<3> &, const Skeleton<3> &);
extern template std::vector<unsigned> endsOnSide(const BlockMesh<2> &, const Skeleton<2> &,
                                                 const Directions &, const std::vector<Index> &, Index);
extern template std::vector<unsigned> endsOnSide(const BlockMesh<3> &, const Skeleton<3> &,
                                                 const Directions &, const std::vector<Index> &, Index);

} // namespace dualblock
