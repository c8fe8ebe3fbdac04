// The choice among policies of cutting: fewest blocks, then the least distorted.
#include <gtest/gtest.h>

#include "partition/sources/sectors.h"
#include "support/examples.h"
#include "support/random_domains.h"

namespace dualblock::test {
namespace {

/// A rectangle with a notch from above and one from below, `offset` apart.
Domain<2> waist(double offset) {
  Domain<2> domain;
  domain.vertices = {{0, 0}, {2, 0.4}, {4, 0}, {4, 2}, {2 + offset, 1.6}, {0, 2}};
  for (Index k = 0; k < 6; ++k) domain.facets.push_back({{{k, (k + 1) % 6}}});
  return domain;
}

// Bisecting each of the two reflex vertices gives three parts; one cut through both gives two.
TEST(ChooseParts, OneCutServesTwoVertices) {
  const auto r = run(waist(0.3));
  EXPECT_EQ(r.parts.parts.size(), 2U);
  EXPECT_EQ(r.primal.blocks.size(), 8U);
  ASSERT_EQ(r.cutTrials.size(), 2U);
  EXPECT_GT(r.cutTrials[0].blocks, 8);
  EXPECT_EQ(r.cutTrials[0].components, 0);
  EXPECT_EQ(r.cutTrials[1].components, 1);
  EXPECT_TRUE(r.certificate.valid);
}

// Notches too far apart keep a cut each: the sectors would not stay between 45 and 135 degrees.
TEST(ChooseParts, NoCutTurnsTooFar) {
  const auto r = run(waist(1));
  EXPECT_EQ(r.parts.parts.size(), 3U);
  EXPECT_EQ(r.cutTrials[0].components, 1);
}

// What is the same either way keeps the standard policy.
TEST(ChooseParts, StandardWhereNothingIsGained) {
  for (const char *name : {"u_shape_extruded", "square_ring", "protrusion"}) {
    const auto r = run(loadExample<3>(name));
    ASSERT_EQ(r.cutTrials.size(), 2U) << name;
    EXPECT_EQ(r.cutTrials[0].components, 1) << name;
    EXPECT_EQ(r.cutTrials[0].blocks, r.cutTrials[1].blocks) << name;
  }
}

TEST(ChooseParts, DirectionsStayInTheirSectors) {
  using std::numbers::pi;
  for (int degrees = 171; degrees <= 315; ++degrees) {
    const double angle = degrees * pi / 180;
    const CurveKind kind = curveKind(angle);
    const std::vector<double> planes = sectorPlanes(kind, angle);
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const DirectionRange range = rangeOfSector(kind, angle, k, pi / 8);
      for (const double direction : {range.low, (range.low + range.high) / 2, range.high}) {
        if (!range.has(direction)) continue;
        EXPECT_LE(std::abs(direction - planes[k]), pi / 8 + 1e-9);
        std::vector<double> rays = planes;
        rays[k] = direction;
        rays.insert(rays.end(), {0, angle});
        std::sort(rays.begin(), rays.end());
        for (std::size_t i = 0; i + 1 < rays.size(); ++i)
          if (rays[i] == direction || rays[i + 1] == direction) {
            EXPECT_GE(rays[i + 1] - rays[i], pi / 4 - 1e-9) << degrees;
            EXPECT_LE(rays[i + 1] - rays[i], 3 * pi / 4 + 1e-9) << degrees;
          }
      }
    }
  }
}

// Over many solids: what is taken never has more blocks than the standard policy alone, on most of those
// where it differs the shape is better as well, and the trials' counts are those of the meshes.
TEST(ChooseParts, SavesBlocks) {
  double standard = 0;
  double taken = 0;
  int differ = 0;
  for (const int kind : {0, 1, 6})
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
      const auto r = run(randomSolid(kind, seed));
      ASSERT_TRUE(r.certificate.valid);
      const double blocks = r.candidates[0].blocks; // whatever good simplices may have made better since
      EXPECT_LE(blocks, r.cutTrials[0].blocks) << kind << " " << seed;
      if (r.cutTrials[0].components == 0) ++differ;
      standard += r.cutTrials[0].blocks;
      taken += blocks;
    }
  std::cout << "180 solids: " << taken << " blocks instead of " << standard << "; the choice differs in "
            << differ << "\n";
  EXPECT_LT(taken, 0.95 * standard);
}

} // namespace
} // namespace dualblock::test
