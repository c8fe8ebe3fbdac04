#include "blocks/insert.h"

#include "blocks/directions.h"

namespace dualblock {
template <int N>
Insertion<N> insertAlong(const ReferenceMesh<N> &mesh, const BentShape<N> &shape, const BlockMesh<N> &blocks,
                         Index facet, double share) {
  Insertion<N> result;
  const std::vector<Index> patches = patchOfSurface(mesh);
  const Skeleton<N> skeleton = skeletonOf(blocks, patches);
  const Directions directions = directionsOf(blocks, skeleton);
  const std::vector<unsigned> ends =
      endsOnSide(blocks, skeleton, directions, patches, patchOf(patches, facet));
  std::vector<Index> newId(ends.size(), kNone);
  for (std::size_t s = 0; s < ends.size(); ++s) {
    if (ends[s] == 0) continue;
    if (ends[s] == 3 || directions.isOneSided[s]) {
      result.why = "D\u0304-surface " + std::to_string(s) + " has the side at both ends of its edges";
      return result;
    }
    newId[s] = toIndex(ends.size() + result.inserted.size());
    result.inserted.push_back({newId[s], toIndex(s)});
  }
  if (result.inserted.empty()) {
    result.why = "no edge of the blocks leads away from it";
    return result;
  }

  BlockMesh<N> &split = result.blocks;
  split.positions = blocks.positions;
  std::vector<Index> newNode(skeleton.edges.size(), kNone);
  for (Index e = 0; e < toIndex(skeleton.edges.size()); ++e) {
    const std::size_t s = at(skeleton.surfaceOfEdge[at(e)]);
    if (newId[s] == kNone) continue;
    auto [from, to] = skeleton.edges[at(e)];
    if ((ends[s] == 2) != directions.isReversed[at(e)]) std::swap(from, to);
    const Vec<N> a = blocks.positions[at(from)];
    const Vec<N> x = a + share * (blocks.positions[at(to)] - a);
    newNode[at(e)] = split.nodeCount();
    split.positions.push_back(
        shape.project(skeleton.patchesOfEdge.begin(e), skeleton.patchesOfEdge.end(e), x));
  }
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
    int axis = -1;
    for (int a = 0; a < N; ++a) {
      if (newId[at(blocks.surfaces[b][at(a)])] == kNone) continue;
      if (axis >= 0) {
        result.why = "the layer along it crosses itself";
        return result;
      }
      axis = a;
    }
    const auto add = [&](const std::array<Index, 1 << N> &nodes) {
      split.blocks.push_back(nodes);
      split.part.push_back(blocks.part[b]);
      split.tags.push_back(blocks.tags[b]);
      split.surfaces.push_back(blocks.surfaces[b]);
    };
    if (axis < 0) {
      add(blocks.blocks[b]);
      continue;
    }
    const std::size_t s = at(blocks.surfaces[b][at(axis)]);
    const bool isLow = (ends[s] == 1) == runsAlong(blocks, skeleton, directions, b, axis);
    const unsigned sideEnd = isLow ? 0 : 1;     // of the block's axis
    for (unsigned half = 0; half < 2; ++half) { // the low one, the high one
      std::array<Index, 1 << N> nodes = blocks.blocks[b];
      for (unsigned bits = 0; bits < 1U << N; ++bits)
        if ((bits >> axis & 1U) != half)
          nodes[cornerAt<N>(bits)] = newNode[at(skeleton.edgesOf[b][edgeAt<N>(axis, bits & ~(1U << axis))])];
      add(nodes);
      split.tags.back()[2 * at(axis) + 1 - half] = kNone;
      if (half == sideEnd) split.surfaces.back()[at(axis)] = newId[s];
    }
  }
  return result;
}

template Insertion<2> insertAlong(const ReferenceMesh<2> &, const BentShape<2> &, const BlockMesh<2> &, Index,
                                  double);
template Insertion<3> insertAlong(const ReferenceMesh<3> &, const BentShape<3> &, const BlockMesh<3> &, Index,
                                  double);

} // namespace dualblock
