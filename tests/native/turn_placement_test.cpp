// Nodes of bent sides where these turn: middles by length lie on the flats of what is rounded, and blocks
// between them cut its edges off.
#include <gtest/gtest.h>

#include <map>

#include "geometry/turn_placement.h"
#include "support/examples.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

/// A box with all edges rounded: eight octants of a ball of radius r around the corners of a box of half
/// sizes `half`, and what is between them.
Domain<3> roundedBox(const Vec<3> &half, double r, int n) {
  std::vector<std::pair<double, double>>
      turns; // angle, and the side that it belongs to: quarters' ends twice
  for (int quarter = 0; quarter < 4; ++quarter)
    for (int k = 0; k <= n; ++k) turns.emplace_back(quarter + static_cast<double>(k) / n, quarter);
  std::map<std::array<double, 3>, Index> known;
  Domain<3> domain;
  domain.name = "rounded_box";
  const auto vertexAt = [&](int rise, std::size_t turn) {
    const bool isUp = rise > n; // heights from below: a quarter turn to the middle, and another one
    const double height = std::numbers::pi / 2 * (static_cast<double>(rise - (isUp ? 1 : 0)) / n - 1);
    const auto &[angle, quarter] = turns[turn % turns.size()];
    const double a = std::numbers::pi / 2 * angle;
    const Vec<3> centre(half.x * (quarter == 0 || quarter == 3 ? 1 : -1), half.y * (quarter < 2 ? 1 : -1),
                        half.z * (isUp ? 1 : -1));
    const bool isPole = rise == 0 || rise == 2 * n + 1;
    const double flat = isPole ? 0 : r * std::cos(height);
    const Vec<3> x = centre + Vec<3>(flat * std::cos(a), flat * std::sin(a), r * std::sin(height));
    const auto [place, isNew] = known.emplace(std::array{x.x, x.y, x.z}, toIndex(domain.vertices.size()));
    if (isNew) domain.vertices.push_back(x);
    return place->second;
  };
  const auto addFacet = [&](std::vector<Index> loop) {
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() > 2) domain.facets.push_back({{loop}});
  };
  for (int rise = 0; rise <= 2 * n; ++rise)
    for (std::size_t t = 0; t < turns.size(); ++t)
      addFacet({vertexAt(rise, t), vertexAt(rise, t + 1), vertexAt(rise + 1, t + 1), vertexAt(rise + 1, t)});
  std::vector<Index> bottom;
  std::vector<Index> top;
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    bottom.push_back(vertexAt(0, (3 - quarter) * at(n + 1)));
    top.push_back(vertexAt(2 * n + 1, quarter * at(n + 1)));
  }
  addFacet(bottom);
  addFacet(top);
  return domain;
}

TEST(TurnPlacement, ARoundedBoxKeepsItsCorners) {
  for (const Vec<3> &half : {Vec<3>{1.5, 1, 0.5}, {2, 0.6, 0.6}, {1, 1, 1}, {0.3, 0.4, 2}}) {
    constexpr double kRadius = 0.5;
    const auto r = run(roundedBox(half, kRadius, 4));
    EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
    EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
    EXPECT_LE(r.primal.blocks.size(),
              half.x < 1 ? 240U : 64U); // the slender one is cut on; simplices give thousands
    EXPECT_GT(*std::min_element(r.quality.begin(), r.quality.end()), 0.5);
    EXPECT_LT(r.certificate.fidelity.strayed, 0.25);
  }
}

// Each node of a curve or side is where that is turned half way, or as it was.
TEST(TurnPlacement, MiddlesOfFillets) {
  const auto r = run(roundedBox({1.5, 1, 0.5}, 0.5, 4));
  Primal<3> primal = r.primal;
  placeByTurning(r.mesh, r.parts, r.dual, primal);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) {
        const Vec<3> corner = Vec<3>(1.5 * x, y, 0.5 * z) + 0.5 / std::sqrt(3) * Vec<3>(x, y, z);
        double least = std::numeric_limits<double>::infinity();
        for (const Vec<3> &node : primal.positions) least = std::min(least, glm::length(node - corner));
        EXPECT_LT(least, 0.2) << x << y << z;
      }
}

// Where nothing bends, nothing moves.
TEST(TurnPlacement, FlatSidesKeepTheirNodes) {
  const auto r = run(loadExample<3>("house"));
  Primal<3> primal = r.primal;
  placeByTurning(r.mesh, r.parts, r.dual, primal);
  EXPECT_EQ(primal.positions, r.primal.positions);
}

} // namespace
} // namespace dualblock::test
