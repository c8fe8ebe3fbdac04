// Cuts at kinks of curves, and between corners where the same sides meet.
#include "partition/sources.h"

namespace dualblock {
namespace {

/// Square to a curve where it turns sharply between two sides, so that a third one meets them there.
std::optional<Cut> throughKink(const PartView &v, const Corner &kink) {
  Vec<3> tangent{0.0};
  for (const Curve<3> *curve : v.curves) {
    if (curve->sides[0] != kink.sides[0] || curve->sides[1] != kink.sides[1]) continue;
    for (const auto &[a, b] : curve->ridges) {
      if (a != kink.node && b != kink.node) continue;
      const Vec<3> away = glm::normalize(v.node(a == kink.node ? b : a) - v.node(kink.node));
      tangent = away - tangent; // of two ridges: from the one to the other
    }
  }
  if (glm::length(tangent) == 0) return std::nullopt;
  return Cut{planeSurface(v.node(kink.node), tangent), {kink.node}};
}

/// Half way between two corners where the same sides meet.
std::optional<Cut> halfWay(const PartView &v) {
  for (std::size_t k = 0; k < v.corners.size(); ++k)
    for (std::size_t m = 0; m < k; ++m) { // a part has few corners
      const std::span<const Index> sides = v.corners[k]->sides;
      if (sides.size() < 3 ||
          !std::equal(sides.begin(), sides.end(), v.corners[m]->sides.begin(), v.corners[m]->sides.end()))
        continue;
      const Vec<3> a = v.node(v.corners[m]->node);
      const Vec<3> b = v.node(v.corners[k]->node);
      return Cut{planeSurface((a + b) / 2.0, b - a), {}};
    }
  return std::nullopt;
}

} // namespace

std::vector<Cut> throughKinks(const PartView &v) {
  std::vector<Cut> list;
  if (!v.hasBentSide()) return list;
  for (const Corner *corner : v.corners)
    if (corner->sides.size() < 3)
      if (std::optional<Cut> cut = throughKink(v, *corner)) list.push_back(std::move(*cut));
  return list;
}

std::vector<Cut> betweenCorners(const PartView &v) {
  if (!v.hasBentSide()) return {};
  const std::optional<Cut> cut = halfWay(v);
  return cut ? std::vector{*cut} : std::vector<Cut>{};
}

} // namespace dualblock
