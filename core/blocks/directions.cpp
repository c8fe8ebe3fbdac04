#include "blocks/directions.h"

#include "base/disjoint_sets.h"

namespace dualblock {

template <int N> Directions directionsOf(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton) {
  std::size_t surfaces = 0;
  for (const Index s : skeleton.surfaceOfEdge) surfaces = std::max(surfaces, at(s) + 1);
  DisjointSets runs(2 * skeleton.edges.size()); // 2 * edge: it runs up, 2 * edge + 1: down
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (int axis = 0; axis < N; ++axis) {
      Index first = kNone; // an edge of the block, as it runs along the axis
      for (unsigned bits = 0; bits < 1U << N; ++bits) {
        if (bits >> axis & 1U) continue;
        const Index edge = skeleton.edgesOf[b][edgeAt<N>(axis, bits)];
        const Index low = blocks.blocks[b][cornerAt<N>(bits)];
        const Index run = 2 * edge + (skeleton.edges[at(edge)][0] == low ? 0 : 1);
        if (first == kNone) first = run;
        runs.unite(first, run);
        runs.unite(first ^ 1, run ^ 1);
      }
    }
  Directions result{std::vector<bool>(skeleton.edges.size()), std::vector<bool>(surfaces, false)};
  for (Index e = 0; e < toIndex(skeleton.edges.size()); ++e) {
    const Index up = runs.find(2 * e);
    const Index down = runs.find(2 * e + 1);
    result.isReversed[at(e)] = down < up;
    if (up == down) result.isOneSided[at(skeleton.surfaceOfEdge[at(e)])] = true;
  }
  return result;
}

template <int N>
std::vector<unsigned> endsOnSide(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton,
                                 const Directions &directions, const std::vector<Index> &patchOfSurface,
                                 Index patch) {
  std::vector<unsigned> ends(directions.isOneSided.size(), 0);
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) {
      const Index tag = blocks.tags[b][at(f)];
      if (tag == kNone || patchOf(patchOfSurface, FaceTag::surface(tag)) != patch) continue;
      const bool isLow = (f % 2 == 0) == runsAlong(blocks, skeleton, directions, b, f / 2);
      ends[at(blocks.surfaces[b][at(f / 2)])] |= isLow ? 1U : 2U;
    }
  return ends;
}

template Directions directionsOf(const BlockMesh<2> &, const Skeleton<2> &);
template Directions directionsOf(const BlockMesh<3> &, const Skeleton<3> &);
template std::vector<unsigned> endsOnSide(const BlockMesh<2> &, const Skeleton<2> &, const Directions &,
                                          const std::vector<Index> &, Index);
template std::vector<unsigned> endsOnSide(const BlockMesh<3> &, const Skeleton<3> &, const Directions &,
                                          const std::vector<Index> &, Index);

} // namespace dualblock
