#include "refinement/double_surfaces.h"

#include "blocks/directions.h"
#include "refinement/refine_blocks.h"

namespace dualblock {

template <int N>
Result<Doubling<N>> doubleSurfaces(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface,
                                   const BentShape<N> &shape, const std::vector<bool> &wanted) {
  RefineOptions options;
  Doubling<N> result;
  std::vector<Index> newId(wanted.size(), kNone);
  const std::vector<bool> isOneSided = directionsOf(blocks, skeletonOf(blocks, patchOfSurface)).isOneSided;
  for (std::size_t s = 0; s < wanted.size(); ++s) {
    if (!wanted[s]) continue;
    options.ofSurface.push_back({toIndex(s), 2});
    if (isOneSided[s]) continue; // its double is one with it
    newId[s] = toIndex(wanted.size() + result.inserted.size());
    result.inserted.push_back({newId[s], toIndex(s)});
  }
  auto refined = refineBlocks(blocks, patchOfSurface, shape, options);
  if (!refined.ok()) return refined.error();
  RefinedMesh<N> &mesh = refined.value();
  BlockMesh<N> &doubled = result.blocks;
  doubled.positions = std::move(mesh.positions);
  doubled.blocks = std::move(mesh.elements);
  std::array<Index, N> c{}; // of an element within its block
  for (std::size_t e = 0; e < doubled.blocks.size(); ++e) {
    const std::size_t b = at(mesh.block[e]);
    auto tags = blocks.tags[b];
    auto surfaces = blocks.surfaces[b];
    for (std::size_t a = 0; a < N; ++a) {
      const std::size_t s = at(surfaces[a]);
      const Index last = mesh.intervals[s] - 1;
      if (c[a] > 0) tags[2 * a] = kNone;
      if (c[a] < last) tags[2 * a + 1] = kNone;
      if (newId[s] != kNone && c[a] == (mesh.isReversed[b][a] ? 0 : 1)) surfaces[a] = newId[s];
    }
    doubled.tags.push_back(tags);
    doubled.surfaces.push_back(surfaces);
    doubled.part.push_back(blocks.part[b]);
    for (std::size_t a = 0; a < N; ++a) { // the next one: the first axis runs fastest
      if (++c[a] < mesh.intervals[at(blocks.surfaces[b][a])]) break;
      c[a] = 0;
    }
  }
  return result;
}

template Result<Doubling<2>> doubleSurfaces(const BlockMesh<2> &, const std::vector<Index> &,
                                            const BentShape<2> &, const std::vector<bool> &);
template Result<Doubling<3>> doubleSurfaces(const BlockMesh<3> &, const std::vector<Index> &,
                                            const BentShape<3> &, const std::vector<bool> &);

} // namespace dualblock
