// Cuts through what has no curves: parts and sides that are closed in themselves.
#include <cmath>
#include <limits>

#include "partition/sources.h"

namespace dualblock {
namespace {

/// No curve at all: through the middle, across the direction in which the part extends least; of directions
/// that are as good the coordinate axes, z first, go before.
Cut halve(const PartView &v) {
  Vec<3> mean{0.0};
  double weight = 0;
  std::vector<std::pair<std::array<Vec<3>, 4>, double>> cells; // corners, volume
  for (Index s = 0; s < v.mesh.simplexCount(); ++s) {
    if (v.parts.partOfSimplex[at(s)] != v.part) continue;
    const auto &n = v.mesh.simplices[at(s)];
    const double volume = orientation<3>(v.mesh.nodes, n);
    cells.push_back({{v.node(n[0]), v.node(n[1]), v.node(n[2]), v.node(n[3])}, volume});
    for (const Vec<3> &x : cells.back().first) mean += volume / 4 * x;
    weight += volume;
  }
  mean /= weight;
  // Second moments by rows, exactly: the reference mesh is coarse, and nothing may depend on it.
  std::array<Vec<3>, 3> second{Vec<3>(0.0), Vec<3>(0.0), Vec<3>(0.0)};
  for (const auto &[corners, volume] : cells) {
    Vec<3> sum{0.0};
    for (const Vec<3> &x : corners) sum += x - mean;
    for (int k = 0; k < 3; ++k) {
      second[at(k)] += volume / 20 * sum[k] * sum;
      for (const Vec<3> &x : corners) second[at(k)] += volume / 20 * (x - mean)[k] * (x - mean);
    }
  }
  const auto extent = [&](const Vec<3> &d) {
    return d.x * glm::dot(second[0], d) + d.y * glm::dot(second[1], d) + d.z * glm::dot(second[2], d);
  };
  std::vector<Vec<3>> directions{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  for (int k = 0; k < 64; ++k) { // a spiral over the half sphere
    const double z = (k + 0.5) / 64;
    const double turn = 2.399963229728653 * k; // the golden angle
    directions.emplace_back(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vec<3> &d : directions) least = std::min(least, extent(d));
  for (const Vec<3> &d : directions)
    if (extent(d) <= 1.1 * least) return {planeSurface(mean, d), {}};
  return {}; // the least is one of them
}

/// A bent side that is closed in itself, a void in the part: across the part, through its middle.
std::optional<Cut> throughVoid(const PartView &v, Index side) {
  if (std::any_of(v.curves.begin(), v.curves.end(),
                  [&](const Curve<3> *curve) { return curve->sides[0] == side || curve->sides[1] == side; }))
    return std::nullopt;
  Vec<3> middle{0.0};
  double area = 0;
  std::vector<Index> from;
  for (const FaceRef<3> *f = v.parts.sideFaces.begin(side); f != v.parts.sideFaces.end(side); ++f) {
    const auto face = v.mesh.sortedFace(f->simplex, f->face);
    const double a =
        glm::length(glm::cross(v.node(face[1]) - v.node(face[0]), v.node(face[2]) - v.node(face[0])));
    middle += a / 3 * (v.node(face[0]) + v.node(face[1]) + v.node(face[2]));
    area += a;
    from.insert(from.end(), face.begin(), face.end());
  }
  if (!(area > 0)) return std::nullopt;
  return Cut{planeSurface(middle / area, {0, 0, 1}), std::move(from)};
}

} // namespace

std::vector<Cut> acrossMiddle(const PartView &v) {
  if (!v.curves.empty() || !v.hasBentSide()) return {};
  return {halve(v)};
}

std::vector<Cut> throughVoids(const PartView &v) {
  std::vector<Cut> list;
  if (v.curves.empty()) return list;
  for (const Index *side = v.firstSide(); side != v.lastSide(); ++side)
    if (v.isBent(*side))
      if (std::optional<Cut> cut = throughVoid(v, *side)) list.push_back(std::move(*cut));
  return list;
}

} // namespace dualblock
