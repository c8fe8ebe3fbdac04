#include "blocks/coarsen.h"

#include "base/deadline.h"
#include "base/sort.h"
#include "blocks/relax.h"
#include "geometry/jacobian.h"

namespace dualblock {
namespace {

/// The surfaces of a mesh, those of most blocks first.
template <int N> std::vector<Index> surfacesBySize(const BlockMesh<N> &blocks) {
  Index count = 0;
  for (const auto &crossing : blocks.surfaces)
    for (const Index s : crossing) count = std::max(count, s + 1);
  std::vector<Index> size(at(count), 0);
  for (const auto &crossing : blocks.surfaces)
    for (const Index s : crossing) ++size[at(s)];
  std::vector<Index> order;
  for (Index s = 0; s < count; ++s)
    if (size[at(s)] > 0) order.push_back(s);
  sortItems(order, [&](Index a, Index b) { return size[at(a)] > size[at(b)]; });
  return order;
}

template <int N> double worstNear(const BlockMesh<N> &blocks, const std::vector<bool> &isNear) {
  double worst = 1;
  for (const auto &block : blocks.blocks)
    if (std::any_of(block.begin(), block.end(), [&](Index v) { return isNear[at(v)]; }))
      worst = std::min(worst, scaledJacobian<N>(cornersOf<N>(block, blocks.positions)));
  return worst;
}

/// Whether a block near an extracted surface has two faces side by side on one bent side: valid while they
/// are plane, but flat along the edge between them once elements follow the side.
template <int N>
bool wrapsBentSide(const ReferenceMesh<N> &mesh, const BlockMesh<N> &blocks,
                   const std::vector<bool> &isNear) {
  const auto bentPatch = [&](Index tag) {
    if (tag == kNone || !mesh.surfaces[at(FaceTag::surface(tag))].bent) return kNone;
    return mesh.sideKey(tag) / 2;
  };
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
    const auto &block = blocks.blocks[b];
    if (std::none_of(block.begin(), block.end(), [&](Index v) { return isNear[at(v)]; })) continue;
    for (std::size_t f = 0; f < 2 * N; ++f)
      for (std::size_t g = f / 2 * 2 + 2; g < 2 * N; ++g) // across another axis
        if (const Index patch = bentPatch(blocks.tags[b][f]);
            patch != kNone && patch == bentPatch(blocks.tags[b][g]))
          return true;
  }
  return false;
}

} // namespace

template <int N>
std::vector<Index> coarsen(const ReferenceMesh<N> &mesh, const Parts<N> &features,
                           const std::vector<Vec<N>> &featureNodes, BlockMesh<N> &blocks,
                           const CoarsenOptions<N> &options) {
  std::vector<Index> extracted;
  Freedom<N> freedom(mesh, features, featureNodes, blocks);
  for (bool more = true; more;) {
    more = false;
    for (const Index surface : surfacesBySize(blocks)) {
      checkDeadline();
      Extraction<N> trial = extract(mesh, freedom, blocks, surface);
      if (!trial.why.empty() || wrapsBentSide(mesh, trial.blocks, trial.isNear)) continue;
      Freedom<N> after(mesh, features, featureNodes, trial.blocks);
      // Lightly first: that shows most of those that will do, and of those that are turned inside out.
      double worst = 0;
      for (const RelaxOptions &effort : {RelaxOptions{{}, 2, 4}, RelaxOptions{}}) {
        relax(after, trial.blocks, effort, trial.isNear);
        worst = worstNear(trial.blocks, trial.isNear);
        if (worst <= 0 || worst >= options.floor) break;
      }
      if (worst < options.floor || !options.isValid(trial.blocks)) continue;
      blocks = std::move(trial.blocks);
      freedom = std::move(after);
      extracted.push_back(surface);
      more = true;
    }
  }
  return extracted;
}

template std::vector<Index> coarsen(const ReferenceMesh<2> &, const Parts<2> &, const std::vector<Vec<2>> &,
                                    BlockMesh<2> &, const CoarsenOptions<2> &);
template std::vector<Index> coarsen(const ReferenceMesh<3> &, const Parts<3> &, const std::vector<Vec<3>> &,
                                    BlockMesh<3> &, const CoarsenOptions<3> &);

} // namespace dualblock
