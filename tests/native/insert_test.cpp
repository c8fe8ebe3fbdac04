// Insertion of D-bar-surfaces along sides: counts, places, certificates, refusals.
#include "blocks/insert.h"

#include <gtest/gtest.h>

#include "support/dimensions.h"
#include "support/random_domains.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

PipelineOptions inserting(std::vector<ModeOptions::Insert> along, Mode mode = Mode::coarsest) {
  PipelineOptions options;
  options.mode.mode = mode;
  options.mode.insert = std::move(along);
  return options;
}

TEST(Insert, SplitsTheLayerAtItsShare) {
  const Domain<3> box = prism({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 0, 10);
  const auto r = run(box, inserting({{4, 0.2}})); // the bottom
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  const BlockMesh<3> &blocks = r.finalMesh->blocks;
  ASSERT_EQ(blocks.blocks.size(), 2U);
  EXPECT_EQ(blocks.positions.size(), 12U);
  for (const Vec<3> &x : blocks.positions) EXPECT_TRUE(x.z == 0 || x.z == 2 || x.z == 10) << x.z;
  // The new surface is the one next to the side.
  ASSERT_EQ(r.finalMesh->inserted.size(), 1U);
  const auto [id, from] = r.finalMesh->inserted[0];
  for (std::size_t b = 0; b < 2; ++b) {
    double low = 10;
    for (const Index v : blocks.blocks[b]) low = std::min(low, blocks.positions[at(v)].z);
    const auto &s = blocks.surfaces[b];
    EXPECT_EQ(std::count(s.begin(), s.end(), low == 0 ? id : from), 1);
  }
}

TEST(Insert, GoesOnAndOn) {
  const auto r = run(loadExample<3>("tapered_brick"), inserting({{0, 0.5}, {0, 0.5}, {1, 0.25}, {2, 0.1}}));
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.finalMesh->inserted.size(), 4U);
  const std::size_t blocks = r.finalMesh->blocks.blocks.size();
  EXPECT_TRUE(blocks == 8 || blocks == 9 || blocks == 12 || blocks == 10) << blocks; // by which are opposite
}

template <typename T> struct InsertIn : ::testing::Test {};
TYPED_TEST_SUITE(InsertIn, Dimensions);

// A layer is split wherever it goes, and nothing else is: every example, along every facet.
TYPED_TEST(InsertIn, EveryFacetOfTheExamples) {
  constexpr int N = TypeParam::value;
  int done = 0;
  for (const std::string &name : computedExampleNames()) {
    if (!std::holds_alternative<Domain<N>>(loadExample(name))) continue;
    SCOPED_TRACE(name);
    const Domain<N> domain = loadExample<N>(name);
    const auto plain = run(domain);
    const BlockMesh<N> before = layeredBlocks(plain.mesh, plain.parts, plain.surfaces, plain.primal);
    const Index facets = toIndex(plain.domain.domain.facets.size());
    for (Index facet = 0; facet < facets; facet += std::max(1, facets / 6)) {
      const auto tried = runPipeline<N>(domain, inserting({{facet, 0.3}}, Mode::layered));
      if (!tried.ok()) {
        EXPECT_EQ(tried.error().code, ErrorCode::badOption);
        continue;
      }
      const auto &r = tried.value();
      EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
      ++done;
      std::size_t split = 0;
      for (const auto &crossing : before.surfaces)
        for (const Index s : crossing)
          for (const auto &[id, from] : r.finalMesh->inserted) split += s == from ? 1 : 0;
      EXPECT_EQ(r.finalMesh->blocks.blocks.size(), before.blocks.size() + split);
      EXPECT_EQ(r.finalMesh->extracted.size(), 0U);
    }
  }
  std::cout << done << " insertions\n";
  EXPECT_GT(done, N == 2 ? 20 : 60);
}

TEST(Insert, StaysOnBentSides) {
  for (const Domain<3> &domain : {shaft(24), plateWithHole(24)}) {
    SCOPED_TRACE(domain.name);
    const auto plain = run(domain);
    const auto r = run(domain, inserting({{0, 0.3}}, Mode::layered));
    EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
    EXPECT_GT(r.finalMesh->blocks.blocks.size(), plain.primal.blocks.size());
  }
}

// Facets of one name: walls of 24 facets, each one side, and flat ones.
TEST(Insert, OncePerSideOfFacetsThatGoTogether) {
  const Domain<3> domain = shaft(24);
  std::vector<ModeOptions::Insert> all;
  for (Index f = 0; f < toIndex(domain.facets.size()); ++f) all.push_back({f, 0.3, f > 0});
  const auto r = run(domain, inserting(all, Mode::layered));
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  std::size_t one = 0; // by one facet of each side
  std::vector<Index> sides;
  const auto plain = run(domain);
  for (Index f = 0; f < toIndex(domain.facets.size()); ++f) {
    const Index side = patchOf(patchOfSurface(plain.mesh), plain.domain.facetOfGiven[at(f)]);
    if (std::find(sides.begin(), sides.end(), side) != sides.end()) continue;
    sides.push_back(side);
    one += run(domain, inserting({{f, 0.3}}, Mode::layered)).finalMesh->inserted.size();
  }
  EXPECT_EQ(sides.size(), 5U); // two walls, two ends, the step
  EXPECT_EQ(r.finalMesh->inserted.size(), one);
}

TEST(Insert, RefusesWithReasons) {
  const Domain<3> brick = loadExample<3>("tapered_brick");
  for (const Index facet : {-1, 6, 1000}) {
    const auto refused = runPipeline<3>(brick, inserting({{facet, 0.3}}));
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::badOption);
    EXPECT_NE(refused.error().message.find("does not exist"), std::string::npos);
  }
  for (const double share : {0.0, 1.0, -0.5, 2.0})
    EXPECT_FALSE(runPipeline<3>(brick, inserting({{0, share}})).ok()) << share;
}

} // namespace
} // namespace dualblock::test
