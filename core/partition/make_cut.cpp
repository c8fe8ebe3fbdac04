#include "partition/make_cut.h"

#include "base/sort.h"
#include "partition/sources.h"
#include "reference/cut.h"
#include "reference/refine.h"

namespace dualblock {
namespace {

/// The part's simplices, with those that have been split off them since the part was found.
std::vector<Index> simplicesOf(const ReferenceMesh<3> &mesh, const PartView &v) {
  const auto &partOf = v.parts.partOfSimplex;
  std::vector<Index> list{
      toIndex(static_cast<std::size_t>(std::find(partOf.begin(), partOf.end(), v.part) - partOf.begin()))};
  std::vector<bool> seen(mesh.simplices.size(), false);
  seen[at(list[0])] = true;
  for (std::size_t n = 0; n < list.size(); ++n)
    for (int i = 0; i < 4; ++i) {
      const Index s = list[n];
      const Index t = mesh.neighbors[at(s)][i];
      if (t == kNone || mesh.tags[at(s)][i] != kNone || seen[at(t)]) continue;
      seen[at(t)] = true;
      list.push_back(t);
    }
  sortItems(list);
  return list;
}

} // namespace

bool makeCut(ReferenceMesh<3> &mesh, const PartView &v, const Cut &cut, const CutOptions &options,
             const std::vector<Plane<3>> &refused) {
  Surface<3> surface = cut.surface;
  if (!surface.field) surface.plane = plainPlane(v, surface.plane);
  for (const Plane<3> &plane : refused)
    if (!surface.field && std::abs(glm::dot(plane.normal, surface.plane.normal)) > 1 - 1e-12 &&
        std::abs(plane.distance(surface.plane.offset * surface.plane.normal)) <= options.tolerance)
      return false;
  std::vector<Index> from = cut.from;
  sortItems(from);
  const auto seedsNow = [&] {
    std::vector<CutSeed<3>> seeds;
    for (const Index s : simplicesOf(mesh, v)) {
      const auto &nodes = mesh.simplices[at(s)];
      const bool touches = from.empty() || std::any_of(nodes.begin(), nodes.end(), [&](Index n) {
                             return std::binary_search(from.begin(), from.end(), n);
                           });
      if (touches) seeds.push_back({s});
    }
    return seeds;
  };
  if (surface.field) resolve<3>(mesh, surface, seedsNow, options.tolerance, 0);
  const std::vector<CutSeed<3>> seeds = seedsNow();
  const Index number = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back(std::move(surface));
  if (cutAlong<3>(mesh, number, seeds, options.tolerance) > 0) return true;
  mesh.surfaces.pop_back();
  return false;
}

} // namespace dualblock
