// The random bent solids are what they say: closed, oriented outward, with plane facets, and without
// crossings. Those that are extruded are so by construction; there, the distance of what is in a hole from
// the hole is looked at.
#include <gtest/gtest.h>

#include "support/bent_domains.h"
#include "support/solid_membership.h"

namespace dualblock::test {
namespace {

constexpr std::uint32_t kSeeds = 30;

double unevenness(const Domain<3> &domain) {
  double worst = 0;
  for (const Facet &facet : domain.facets) {
    const auto &loop = facet.loops[0];
    Vec<3> normal{0.0};
    for (std::size_t k = 2; k < loop.size(); ++k)
      normal += glm::cross(domain.vertices[at(loop[k - 1])] - domain.vertices[at(loop[0])],
                           domain.vertices[at(loop[k])] - domain.vertices[at(loop[0])]);
    for (const auto &other : facet.loops)
      for (const Index v : other)
        worst = std::max(worst, std::abs(glm::dot(glm::normalize(normal),
                                                  domain.vertices[at(v)] - domain.vertices[at(loop[0])])));
  }
  return worst;
}

TEST(BentDomains, AreClosedAndOrientedOutward) {
  for (int kind = 0; kind < kBentKindCount; ++kind)
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
      const Domain<3> domain = bentSolid(kind, seed);
      SCOPED_TRACE(domain.name + ", kind " + std::to_string(kind) + ", seed " + std::to_string(seed));
      EXPECT_TRUE(isClosed(domain));
      EXPECT_LT(unevenness(domain), 1e-9 * domainSize(domain.vertices));
      EXPECT_LE(domain.facets.size(), 390U);
      EXPECT_FALSE(crossesItself(domain));
      const SolidMembership solid(domain);
      EXPECT_GT(solid.volume(), 0);
      // Winds around points once or not at all: nothing overlaps, and nothing is inside out.
      RandomSource random(seed);
      for (int k = 0; k < 100; ++k) {
        Vec<3> p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = random.real(solid.low()[axis], solid.high()[axis]);
        const double winding = solid.windingNumber(p);
        EXPECT_NEAR(winding, winding > 0.5 ? 1 : 0, 1e-6);
      }
    }
}

TEST(BentDomains, HolesLeaveTheRoomTheySay) {
  for (const int n : {12, 17, 32})
    for (const double room : {0.002, 0.1})
      for (int k = 0; k < 12; ++k) { // a corner against a side at one of them
        const auto hole = turnedCircle(n, holeRadius(room, n), 0);
        const auto shaft = turnedCircle(n, 1, 0.04 * k);
        double least = 1;
        for (std::size_t i = 0; i < hole.size(); ++i)
          for (std::size_t j = 0; j < shaft.size(); ++j)
            least = std::min(least, segmentDistance(hole[i], hole[(i + 1) % hole.size()], shaft[j],
                                                    shaft[(j + 1) % shaft.size()]));
        EXPECT_GT(least, room * (1 - 1e-9));
      }
}

TEST(BentDomains, TheCheckSeesCrossings) {
  Domain<3> twoCubes = prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0, 1);
  addComponent(twoCubes, prism({{0.5, 0.4}, {1.5, 0.4}, {1.5, 1.4}, {0.5, 1.4}}, 0.3, 0.6));
  EXPECT_TRUE(isClosed(twoCubes));
  EXPECT_TRUE(crossesItself(twoCubes));
  twoCubes.facets.pop_back();
  EXPECT_FALSE(isClosed(twoCubes));
  EXPECT_FALSE(isSimplePolygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 0));
  EXPECT_FALSE(isSimplePolygon({{0, 0}, {4, 0}, {4, 1}, {0.5, 0.3}, {0, 1}}, 0.5));
  EXPECT_TRUE(isSimplePolygon({{0, 0}, {4, 0}, {4, 1}, {0, 1}}, 0.5));
  Section near = placed(rectangle(1, 1), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Section far = placed(rectangle(1, 1), {0, 0, 0.3}, {0.6, 0, 0.8}, {0, 1, 0});
  EXPECT_FALSE(runsForwards({near, far}, false));
}

} // namespace
} // namespace dualblock::test
