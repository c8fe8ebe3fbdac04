// Random solids of every kind: whatever they look like, the certificate holds. 420 a run; DUALBLOCK_TRIALS
// sets another number per kind, DUALBLOCK_FIRST_SEED where to begin. A failure names kind and seed.
#include <iostream>

#include <gtest/gtest.h>

#include "support/random_domains.h"
#include "support/signed_measure.h"

namespace dualblock::test {
namespace {

class Property : public ::testing::TestWithParam<int> {};

TEST_P(Property, EverySolidGetsACertifiedMesh) {
  const std::uint32_t first = fromEnvironment("DUALBLOCK_FIRST_SEED", 1);
  const std::uint32_t trials = fromEnvironment("DUALBLOCK_TRIALS", 60);
  std::size_t blocks = 0;
  Index fallbacks = 0;
  for (std::uint32_t seed = first; seed < first + trials; ++seed) {
    const Domain<3> domain = randomSolid(GetParam(), seed);
    SCOPED_TRACE(domain.name + ", kind " + std::to_string(GetParam()) + ", seed " + std::to_string(seed));
    const auto result = runPipeline<3>(domain, {});
    ASSERT_TRUE(result.ok()) << result.error().message;
    const auto &r = result.value();
    EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
    blocks += r.primal.blocks.size();
    fallbacks += r.fallbackComponents > 0 ? 1 : 0;
    // Regions come back whole: the blocks of each have its volume.
    std::map<Index, double> volume;
    for (const Block<3> &b : r.primal.blocks)
      volume[r.parts.parts[at(b.part)].region] += signedMeasure<3>(cornersOf<3>(b.nodes, r.primal.positions));
    if (domain.name != "assembly") continue;
    std::map<Index, double> wanted;
    const double cell = r.certificate.domainMeasure / static_cast<double>(domain.regions.size());
    for (const Region<3> &region : domain.regions) wanted[region.id] += cell;
    EXPECT_EQ(volume.size(), wanted.size());
    for (const auto &[region, v] : wanted) EXPECT_NEAR(volume[region], v, 1e-6 * r.certificate.domainMeasure);
  }
  std::cout << randomSolid(GetParam(), first).name << ": seeds " << first << " to " << first + trials - 1
            << ", " << blocks << " blocks, fallback in " << fallbacks << "\n";
}

// What confining the fallback saves: prisms on the facets of a hull stay prisms, of six blocks and not of
// twelve.
TEST(ConfinedFallback, SavesBlocks) {
  std::size_t confined = 0;
  std::size_t whole = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const Domain<3> domain = randomSolid(6, seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto r = run(domain);
    EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
    const std::size_t simplices = 4 * fill(domain).simplices.size();
    const auto blocks = static_cast<std::size_t>(r.candidates[0].blocks); // before good simplices
    EXPECT_LE(blocks, simplices);
    if (r.pulledComponents == 0 || !r.candidates[0].chosen) continue;
    confined += blocks;
    whole += simplices;
  }
  std::cout << "gems: " << confined << " blocks instead of " << whole << "\n";
  EXPECT_LT(confined, whole * 2 / 3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Property, ::testing::Range(0, kRandomKinds));

} // namespace
} // namespace dualblock::test
