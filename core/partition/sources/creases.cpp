// Cuts along creases of bent sides.
#include "base/sort.h"
#include "partition/heuristics.h"
#include "partition/sources.h"

namespace dualblock {
namespace {

/// The ridges of a side that are reflex by the feature angle or more.
std::vector<std::array<Index, 2>> reflexRidges(const PartView &v, Index side) {
  std::vector<std::array<Index, 2>> ridges;
  for (const FaceRef<3> *f = v.parts.sideFaces.begin(side); f != v.parts.sideFaces.end(side); ++f) {
    const auto &nodes = v.mesh.simplices[at(f->simplex)];
    const Index key = v.mesh.sideKey(v.mesh.tags[at(f->simplex)][f->face]);
    const Vec<3> normal = v.mesh.outwardNormal(f->simplex, f->face);
    for (int k = 0; k < 4; ++k) {
      if (k == f->face) continue;
      const FaceRef<3> mate = turnAroundRidge(v.mesh, f->simplex, f->face, k, kCrossNone, [](Index) {});
      if (v.mesh.sideKey(v.mesh.tags[at(mate.simplex)][mate.face]) != key) continue;
      const Vec<3> other = v.mesh.outwardNormal(mate.simplex, mate.face);
      if (glm::dot(normal, other) > v.mesh.smoothCosine) continue;
      std::array<Index, 2> ridge{};
      int count = 0;
      for (int n = 0; n < 4; ++n)
        if (n != f->face && n != k) ridge[at(count++)] = nodes[n];
      // Across a reflex ridge the mate's face rises above this one's plane.
      const Vec<3> along = v.node(ridge[1]) - v.node(ridge[0]);
      const Vec<3> within = glm::cross(normal, along); // in this face, across the ridge
      const double sign = glm::dot(within, v.node(nodes[k]) - v.node(ridge[0])) > 0 ? 1 : -1;
      if (sign * glm::dot(other, within) > 0) ridges.push_back(sortedPair(ridge[0], ridge[1]));
    }
  }
  sortItems(ridges);
  ridges.erase(std::unique(ridges.begin(), ridges.end()), ridges.end());
  return ridges;
}

std::optional<Cut> throughCrease(const PartView &v, Index side) {
  const auto ridges = reflexRidges(v, side);
  Curve<3> curve{};
  curve.ridges = ridges;
  Chain longest;
  for (Chain &chain : chainsOf(curve))
    if (chain.nodes.size() > longest.nodes.size()) longest = std::move(chain);
  Axis axis;
  if (longest.nodes.size() < kLeastCrease || !axisOf(longest, v.mesh.nodes, axis)) return std::nullopt;
  for (const Index node : longest.nodes)
    if (std::abs(glm::dot(v.node(node) - v.node(longest.nodes[0]), axis.direction)) >
        kFlatCrease * v.mesh.size)
      return std::nullopt;
  return Cut{planeSurface(v.node(longest.nodes[0]), axis.direction), std::move(longest.nodes)};
}

} // namespace

std::vector<Cut> throughCreases(const PartView &v) {
  std::vector<Cut> list;
  for (const Index *side = v.firstSide(); side != v.lastSide(); ++side)
    if (v.isGiven(*side) && v.isBent(*side))
      if (std::optional<Cut> cut = throughCrease(v, *side)) list.push_back(std::move(*cut));
  return list;
}

} // namespace dualblock
