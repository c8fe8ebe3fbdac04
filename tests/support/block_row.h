// A row of blocks under a roof that may be bent, made by hand: for what the certificate says of it.
#pragma once

#include <cmath>
#include <numbers>

#include "support/examples.h"

namespace dualblock::test {

/// An arc of so many degrees from (1, 0) to (0, 0), above, in n chords.
inline std::vector<Vec<2>> arcRoof(double degrees, int n) {
  const double whole = degrees * std::numbers::pi / 180;
  const double radius = 0.5 / std::sin(whole / 2);
  std::vector<Vec<2>> roof;
  for (int k = 0; k <= n; ++k) {
    const double angle = whole * (0.5 - static_cast<double>(k) / n);
    roof.emplace_back(0.5 + radius * std::sin(angle), radius * (std::cos(angle) - std::cos(whole / 2)));
  }
  roof.front() = {1, 0};
  roof.back() = {0, 0};
  return roof;
}

/// A room of height `wall` under the roof, 1 wide and `depth` long, and as many blocks side by side as there
/// are stations (of the roof's points, ascending, without its ends) and one.
struct BlockRow {
  PipelineResult<3> result;
  BlockMesh<3> blocks;

  BlockRow(const std::vector<Vec<2>> &roof, double wall, double depth,
           const std::vector<std::size_t> &stations = {}, double featureAngle = 20) {
    std::vector<Vec<2>> polygon{{0, -wall}, {1, -wall}};
    polygon.insert(polygon.end(), roof.begin(), roof.end());
    Domain<3> domain = prism(polygon, 0, depth);
    domain.name = "row";
    PipelineOptions options;
    options.featureAngle = featureAngle;
    result = run(domain, options);
    std::vector<Vec<2>> top{roof.front()};
    for (const std::size_t s : stations) top.push_back(roof[s]);
    top.push_back(roof.back());
    for (const Vec<2> &x : top)
      for (const double z : {0.0, depth}) {
        blocks.positions.emplace_back(x.x, -wall, z);
        blocks.positions.emplace_back(x.x, x.y, z);
      }
    for (Index k = 0; k + 1 < toIndex(top.size()); ++k) { // four nodes a station, from right to left
      const Index a = 4 * k;
      addBlock({a + 4, a, a + 1, a + 5, a + 6, a + 2, a + 3, a + 7});
    }
    for (int k = 0; k + 1 < blocks.blockCount(); ++k) {
      blocks.tags[at(k)][0] = kNone;
      blocks.tags[at(k + 1)][1] = kNone;
    }
  }

  /// Divides the only block into a lower and an upper one.
  void split() {
    std::array<Index, 8> lower = blocks.blocks[0];
    std::array<Index, 8> upper = lower;
    for (const auto &[low, high] : {std::pair{0U, 3U}, {1U, 2U}, {4U, 7U}, {5U, 6U}}) {
      blocks.positions.push_back((blocks.positions[at(lower[low])] + blocks.positions[at(lower[high])]) /
                                 2.0);
      lower[high] = upper[low] = toIndex(blocks.positions.size()) - 1;
    }
    blocks.blocks.clear();
    blocks.tags.clear();
    for (const auto &nodes : {lower, upper}) addBlock(nodes);
    blocks.tags[0][3] = blocks.tags[1][2] = kNone;
  }

  void addBlock(std::array<Index, 8> nodes) {
    blocks.blocks.push_back(nodes);
    blocks.surfaces.push_back({0, 1, 2});
    blocks.part.push_back(0);
    std::array<Index, 6> tags;
    for (int f = 0; f < 6; ++f) tags[at(f)] = tagOf(nodes, f);
    blocks.tags.push_back(tags);
  }

  BlockInput<3> input(double deviation = 0) const {
    return {result.domain.domain, result.features, result.featureNodes, result.mesh, blocks, deviation};
  }
  Certificate certificate(double deviation = 0) const { return certifyBlocks<3>(input(deviation)); }
  bool says(const std::string &words, double deviation = 0) const {
    return failuresOf(certificate(deviation)).find(words) != std::string::npos;
  }

private:
  /// The roof is what lies in no plane.
  Index tagOf(const std::array<Index, 8> &nodes, int f) const {
    Index bent = kNone;
    for (Index s = 0; s < toIndex(result.domain.domain.facets.size()); ++s) {
      const Surface<3> &surface = result.mesh.surfaces[at(s)];
      bool holdsAll = true;
      for (int k = 0; k < 4; ++k)
        holdsAll &=
            std::abs(surface.plane.distance(blocks.positions[at(nodes[at(faceCorner<3>(f, k))])])) < 1e-9;
      if (holdsAll) return FaceTag::back(s);
      if (surface.bent) bent = s;
    }
    return f == 3 && bent != kNone ? FaceTag::back(bent) : kNone;
  }
};

} // namespace dualblock::test
