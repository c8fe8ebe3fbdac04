// Parts as they come from workshops: holes, steps, teeth. The counts follow from how one would cut them by
// hand.
#include <gtest/gtest.h>

#include "support/round_solids.h"

namespace dualblock::test {
namespace {

void expectParts(const Domain<3> &domain, std::size_t parts, std::size_t blocks,
                 const PipelineOptions &options = {}) {
  SCOPED_TRACE(domain.name + ", seed " + std::to_string(options.seed));
  const PipelineResult<3> r = run(domain, options);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
  EXPECT_EQ(r.parts.parts.size(), parts);
  EXPECT_EQ(r.primal.blocks.size(), blocks);
}

Domain<3> plateWithHoles(const std::vector<Vec<2>> &centres) {
  Domain<3> domain = prism({{0, 0}, {10, 0}, {10, 8}, {0, 8}}, 0, 1);
  for (const Vec<2> &centre : centres) addHole(domain, circle(16, 0.7, centre), 0, 1);
  domain.name = "plate with " + std::to_string(centres.size()) + " holes";
  return domain;
}

Domain<3> gear(int teeth) {
  std::vector<Vec<2>> outline;
  for (int k = 0; k < teeth; ++k) {
    const double angle = 2 * std::numbers::pi * k / teeth;
    const double half = std::asin(0.3 / 2);
    const auto put = [&](double turn, double radius) {
      outline.emplace_back(radius * std::cos(angle + turn), radius * std::sin(angle + turn));
    };
    put(-half, 2);
    put(-half * 2 / 2.6, 2.6);
    put(half * 2 / 2.6, 2.6);
    put(half, 2);
    for (int m = 1; m < 8; ++m) put(half + m * (2 * std::numbers::pi / teeth - 2 * half) / 8, 2);
  }
  Domain<3> domain = prism(outline, 0, 1);
  addHole(domain, circle(32, 0.8), 0, 1);
  domain.name = "gear";
  return domain;
}

// Planes through the axes of two holes each, as far as they go, leave corners (a pentagon), edges (a hexagon)
// and a middle of eight sides, each a prism: two blocks per corner of their polygon.
TEST(MachinedParts, PlateWithFourHoles) {
  expectParts(plateWithHoles({{2, 2}, {8, 2}, {2, 6}, {8, 6}}), 9, 2 * (4 * 5 + 4 * 6 + 8));
}

TEST(MachinedParts, PlateWithTwoHoles) {
  const PipelineResult<3> r = run(plateWithHoles({{3, 4}, {7, 4}}));
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
  EXPECT_LE(r.primal.blocks.size(), 80U);
}

// A circle's nodes are seldom evenly spaced: their mean is beside the axis, and a plane through it would miss
// the corners of the plate by little, which leaves slivers.
TEST(MachinedParts, UnevenCircle) {
  Domain<3> domain = prism({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, 0, 1);
  std::vector<Vec<2>> hole;
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * std::numbers::pi * k / 24;
    hole.emplace_back(0.8 * std::cos(angle + 0.05 * std::sin(angle)),
                      0.8 * std::sin(angle + 0.05 * std::sin(angle)));
  }
  addHole(domain, hole, 0, 1);
  domain.name = "uneven hole";
  expectParts(domain, 4, 32);
}

// Quarters around the axis: three lengths of core (prisms of three sides, six blocks), and a ring around the
// middle one, whose inner side runs from the one shaft to the other instead of missing both.
TEST(MachinedParts, ShaftOfThreeSteps) {
  Domain<3> shaft = revolved({{0, 0}, {1, 0}, {1, 4}, {2, 4}, {2, 7}, {1.2, 7}, {1.2, 10}, {0, 10}}, 24);
  shaft.name = "shaft of three steps";
  expectParts(shaft, 16, 4 * (3 * 6 + 8));
}

// A shaft whose wall has nodes in between: its facets tilt, and the side that extends them must not.
TEST(MachinedParts, WallsOfManyFacets) {
  std::vector<Vec<2>> profile{{0, 0}, {2, 0}, {2, 2}, {1.2, 2}};
  for (int k = 1; k < 4; ++k) profile.emplace_back(1.2, 2 + k);
  profile.emplace_back(0, 5);
  Domain<3> domain = revolved(profile, 16);
  // Every second ring of the upper wall is turned by half a step: no two facets of it are in a plane.
  for (int k = 0; k < 16; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / 16;
    Vec<3> &x = domain.vertices[at(1 + 3 * 16 + k)];
    x = {1.2 * std::cos(angle), 1.2 * std::sin(angle), x.z};
  }
  domain.name = "stepped shaft, turned rings";
  expectParts(domain, 12, 4 * (2 * 6 + 8));
}

// Its rims' extensions would meet the axis and each other by little. A dish through each rim leaves slabs of
// a shaft instead, in quarters around the axis: eight blocks for five sides around, six for four.
TEST(MachinedParts, LatheOfSlantedRims) {
  Domain<3> lathe = revolved({{0, 0},
                              {1.295, 0},
                              {1.507, 1.437},
                              {0.959, 1.437},
                              {1.481, 2.874},
                              {0.963, 2.874},
                              {1.089, 3.546},
                              {0.66, 3.546},
                              {1.319, 4.253},
                              {0, 4.253}},
                             16);
  lathe.name = "lathe of slanted rims";
  expectParts(lathe, 16, 4 * (3 * 8 + 6));
}

TEST(MachinedParts, Dumbbell) {
  std::vector<Vec<2>> profile;
  const auto add = [&](double centre, double from, double to) {
    for (int k = 0; k <= 8; ++k) {
      const double angle = from + (to - from) * k / 8;
      profile.emplace_back(std::cos(angle), centre + std::sin(angle));
    }
  };
  const double rim = std::acos(0.4);
  add(0, -std::numbers::pi / 2, rim);
  add(4, -rim, std::numbers::pi / 2);
  Domain<3> dumbbell = revolved(profile, 16);
  dumbbell.name = "dumbbell";
  const PipelineResult<3> r = run(dumbbell);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
  EXPECT_LE(r.primal.blocks.size(), 216U);
}

/// Two pipes of radius 1 that meet at right angles: their walls make a crease that fades out at two vertices,
/// where both are level; these may be off by `shift`.
Domain<3> equalTee(int n, double shift) {
  Domain<3> domain;
  domain.name = "tee, off by " + std::to_string(shift);
  const auto add = [&](double x, double y, double z) {
    domain.vertices.emplace_back(x, y, z);
    return toIndex(domain.vertices.size()) - 1;
  };
  struct Row {
    Index left, right, creaseLeft, creaseRight, topLeft, topRight, lowLeft, lowRight;
  };
  std::vector<Row> rows; // over the width
  for (int k = 0; k <= n / 2; ++k) {
    const double angle = std::numbers::pi * (2.0 * k / n - 0.5);
    const double y = std::sin(angle);
    const bool isEnd = k == 0 || 2 * k == n;
    const double h = isEnd ? 0 : std::cos(angle);
    Row row{};
    row.left = add(-3, y, h);
    row.right = add(3, y, h);
    row.creaseLeft = add(isEnd ? shift * y : -h, y, h);
    row.topLeft = add(-h, y, 3);
    row.creaseRight = isEnd ? row.creaseLeft : add(h, y, h);
    row.topRight = isEnd ? row.topLeft : add(h, y, 3);
    row.lowLeft = isEnd ? row.left : add(-3, y, -h);
    row.lowRight = isEnd ? row.right : add(3, y, -h);
    rows.push_back(row);
  }
  const auto facet = [&](std::vector<Index> loop) {
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    if (loop.front() == loop.back()) loop.pop_back();
    domain.facets.push_back({{std::move(loop)}});
  };
  std::vector<Index> leftEnd;
  std::vector<Index> rightEnd;
  std::vector<Index> topEnd;
  for (const Row &row : rows) {
    leftEnd.push_back(row.left);
    rightEnd.push_back(row.right);
    topEnd.push_back(row.topLeft);
  }
  for (std::size_t k = rows.size() - 1; k-- > 1;) {
    leftEnd.push_back(rows[k].lowLeft);
    rightEnd.push_back(rows[k].lowRight);
    topEnd.push_back(rows[k].topRight);
  }
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const Row &a = rows[k];
    const Row &b = rows[k + 1];
    facet({a.left, a.creaseLeft, b.creaseLeft, b.left});
    facet({a.creaseLeft, a.topLeft, b.topLeft, b.creaseLeft});
    facet({a.creaseRight, b.creaseRight, b.topRight, a.topRight});
    facet({a.creaseRight, a.right, b.right, b.creaseRight});
    // The lowest strips run along the whole pipe, the outer ones past the vertex where the crease fades out.
    std::vector<Index> low{b.lowLeft, b.lowRight, a.lowRight, a.lowLeft};
    if (k == 0) low.insert(low.begin() + 3, a.creaseLeft);
    if (k + 2 == rows.size()) low.insert(low.begin() + 1, b.creaseLeft);
    facet(low);
  }
  facet({leftEnd.begin(), leftEnd.end()});
  facet({rightEnd.rbegin(), rightEnd.rend()});
  facet({topEnd.begin(), topEnd.end()});
  return domain;
}

// Planes through both creases, which leave two wedges and two wedge-ended lengths to each side, cut by the
// plane of the pipes and by one square to it: quarters of three pipes, prisms of three sides, and two wedges
// below of four blocks each.
TEST(MachinedParts, TeeOfEqualPipes) { expectParts(equalTee(24, 0), 14, 3 * 4 * 6 + 2 * 4); }

// Nodes that earlier cuts leave beside such a vertex are nearer to each other than the tolerance: of those on
// one edge across a later cut only one is on it.
TEST(MachinedParts, TeeOfInexactVertices) {
  for (const double shift : {5e-6, 2e-5, 5e-5, 1e-4, 2e-4, 1e-3})
    expectParts(equalTee(24, shift), 14, 3 * 4 * 6 + 2 * 4);
}

// By hand it takes a tooth, what is under it and what is between it and the next: 24 blocks for each.
TEST(MachinedParts, Gear) {
  const PipelineResult<3> r = run(gear(8));
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
  EXPECT_LE(r.primal.blocks.size(), 8 * 40U);
}

// Coarse tessellations have slivers that stand askew: they are no sides of their own.
TEST(MachinedParts, BallWithASliver) {
  Domain<3> domain = ball(16);
  Facet &facet = domain.facets[at(toIndex(domain.facets.size()) / 2)];
  const auto [a, b, c] = std::array{facet.loops[0][0], facet.loops[0][1], facet.loops[0][2]};
  const Vec<3> middle = (domain.vertices[at(a)] + domain.vertices[at(b)]) / 2.0;
  const Vec<3> across = glm::normalize(domain.vertices[at(c)] - middle);
  const Index m = toIndex(domain.vertices.size());
  domain.vertices.push_back(middle + 0.005 * (0.5 * across + 0.9 * glm::normalize(middle)));
  facet.loops = {{a, b, m}};
  domain.facets.push_back({{{b, c, m}}});
  domain.facets.push_back({{{c, a, m}}});
  domain.name = "ball with a sliver";
  expectParts(domain, 8, 32);
}

// A void without curves is cut through its middle.
TEST(MachinedParts, BallInABox) {
  Domain<3> domain = prism({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, -2, 2);
  const Domain<3> inner = ball(12);
  const Index shift = toIndex(domain.vertices.size());
  domain.vertices.insert(domain.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (Facet facet : inner.facets) {
    for (auto &loop : facet.loops)
      for (Index &v : loop) v += shift;
    domain.facets.push_back(facet);
  }
  domain.name = "ball in a box";
  const PipelineResult<3> r = run(domain);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
  EXPECT_LE(r.parts.parts.size(), 8U);
}

} // namespace
} // namespace dualblock::test
