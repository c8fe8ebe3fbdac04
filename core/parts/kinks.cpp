#include "parts/kinks.h"

#include "base/sort.h"

namespace dualblock {

template <> std::vector<Kink> findKinks(const ReferenceMesh<2> &, const Parts<2> &) { return {}; }

template <> std::vector<Kink> findKinks(const ReferenceMesh<3> &mesh, const Parts<3> &parts) {
  std::vector<Kink> kinks;
  std::vector<std::pair<Index, Index>> ends; // of one curve: a ridge's node and its other one
  for (const Curve<3> &curve : parts.curves) {
    bool isGiven = true;
    bool isBent = false;
    for (const Index side : curve.sides) {
      const Surface<3> &surface = mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))];
      isGiven = isGiven && surface.kind == SurfaceKind::facet;
      isBent = isBent || surface.bent;
    }
    if (!isGiven || !isBent) continue;
    ends.clear();
    for (const auto &[a, b] : curve.ridges) {
      ends.emplace_back(a, b);
      ends.emplace_back(b, a);
    }
    sortItems(ends);
    for (std::size_t k = 0, next = 0; k < ends.size(); k = next) {
      const Index node = ends[k].first;
      while (next < ends.size() && ends[next].first == node) ++next;
      if (next - k != 2) continue;
      const auto away = [&](std::size_t e) {
        return glm::normalize(mesh.nodes[at(ends[e].second)] - mesh.nodes[at(node)]);
      };
      if (-glm::dot(away(k), away(k + 1)) <= mesh.smoothCosine) kinks.push_back({node, curve.part});
    }
  }
  sortItems(kinks);
  return kinks;
}

} // namespace dualblock
