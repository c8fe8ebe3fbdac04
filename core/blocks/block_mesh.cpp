#include "blocks/block_mesh.h"

#include "base/sort.h"

namespace dualblock {

template <int N>
BlockMesh<N> layeredBlocks(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualSurfaces &surfaces,
                           const Primal<N> &primal) {
  BlockMesh<N> result;
  result.positions = primal.positions;
  result.blocks.reserve(primal.blocks.size());
  result.part.reserve(primal.blocks.size());
  result.tags.reserve(primal.blocks.size());
  result.surfaces.reserve(primal.blocks.size());
  for (const Block<N> &block : primal.blocks) {
    result.blocks.push_back(block.nodes);
    result.part.push_back(block.part);
    auto &tags = result.tags.emplace_back();
    auto &crossing = result.surfaces.emplace_back();
    tags.fill(kNone); // low faces are towards the part's centre
    for (std::size_t a = 0; a < N; ++a) {
      const Index tag = parts.sides[at(block.sides[a])].tag;
      crossing[a] = surfaces.ofSide[at(block.sides[a])];
      if (mesh.surfaces[at(FaceTag::surface(tag))].kind == SurfaceKind::facet) tags[2 * a + 1] = tag;
    }
  }
  return result;
}

template <int N> Lists<Index> patchesOfNodes(const ReferenceMesh<N> &mesh, const BlockMesh<N> &blocks) {
  std::vector<std::array<Index, 2>> found; // node, patch
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) {
      const Index tag = blocks.tags[b][at(f)];
      if (tag == kNone) continue;
      for (int k = 0; k < 1 << (N - 1); ++k)
        found.push_back({blocks.blocks[b][at(faceCorner<N>(f, k))], mesh.sideKey(tag) / 2});
    }
  sortByIndex(found, blocks.positions.size(), [](const auto &f) { return f[0]; });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  Lists<Index> patches;
  std::size_t next = 0;
  for (Index node = 0; node < blocks.nodeCount(); ++node) {
    for (; next < found.size() && found[next][0] == node; ++next) patches.items.push_back(found[next][1]);
    patches.closeList();
  }
  return patches;
}

template <int N> Lists<Index> blocksOfNodes(const BlockMesh<N> &blocks) {
  return collectLists<Index>(blocks.positions.size(), [&](auto put) {
    for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
      for (const Index v : blocks.blocks[b]) put(v, toIndex(b));
  });
}

#define DUALBLOCK_DEFINE(N)                                                                                  \
  template BlockMesh<N> layeredBlocks(const ReferenceMesh<N> &, const Parts<N> &, const DualSurfaces &,      \
                                      const Primal<N> &);                                                    \
  template Lists<Index> patchesOfNodes(const ReferenceMesh<N> &, const BlockMesh<N> &);                      \
  template Lists<Index> blocksOfNodes(const BlockMesh<N> &);
DUALBLOCK_DEFINE(2)
DUALBLOCK_DEFINE(3)
#undef DUALBLOCK_DEFINE

} // namespace dualblock
