// The paper's 2D matching rules (4.3) on contributions given one by one, beside figure 12's own examples,
// which tests/node checks through the module.
#include "contributions/given_matching.h"

#include <gtest/gtest.h>

namespace dualblock {
namespace {

/// Two triangles, (0, 1, 2) and (0, 2, 3), on both sides of the edge from 0 to 2.
class TwoTriangles : public ::testing::Test {
protected:
  std::size_t faults(const std::vector<GivenContribution> &contributions) const {
    ReferenceMesh<2> mesh;
    mesh.simplices = triangles;
    return checkGivenContributions(mesh, triangles, contributions).size();
  }
  const std::vector<std::array<Index, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
};

TEST_F(TwoTriangles, AcceptsEqualNumbersFromBothSides) {
  EXPECT_EQ(faults({}), 0U);
  EXPECT_EQ(faults({{0, {0}, true}, {1, {0}, true}}), 0U);
  EXPECT_EQ(faults({{0, {0}, true}, {0, {0, 1}, true}, {1, {0}, true}, {1, {0, 3}, true}}), 0U);
}

TEST_F(TwoTriangles, NamesThePointWhereOneSideIsMissing) {
  ReferenceMesh<2> mesh;
  mesh.simplices = triangles;
  const auto found = checkGivenContributions(mesh, triangles, {{0, {2}, true}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].near, 2);
  EXPECT_EQ(found[0].far, 0);
  EXPECT_NE(found[0].message.find("near 2"), std::string::npos);
}

TEST_F(TwoTriangles, AllowsOneHardContributionAtABoundaryPoint) {
  // {0} and {0, 2} of triangle 0 both meet the boundary edge (0, 1) near 0.
  EXPECT_EQ(faults({{0, {0}, true}, {0, {0, 2}, true}, {1, {0}, true}}), 1U);
}

TEST_F(TwoTriangles, RefusesSoftContributionsAtTheBoundary) { EXPECT_EQ(faults({{0, {0}, false}}), 2U); }

TEST_F(TwoTriangles, CountsHardOnesAtAVirtualPoint) {
  // A fan of three triangles around node 0; the middle one is soft: its two points are one.
  const std::vector<std::array<Index, 3>> fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  ReferenceMesh<2> mesh;
  mesh.simplices = fan;
  const GivenContribution soft{1, {0}, false};
  const auto check = [&](std::vector<GivenContribution> hard) {
    hard.push_back(soft);
    return checkGivenContributions(mesh, fan, hard).size();
  };
  EXPECT_EQ(check({{0, {0}, true}, {2, {0}, true}}), 0U);                                       // two
  EXPECT_EQ(check({{0, {0}, true}, {0, {0, 1}, true}, {2, {0}, true}}), 1U);                    // three
  EXPECT_EQ(check({{0, {0}, true}, {0, {0, 1}, true}, {2, {0}, true}, {2, {0, 4}, true}}), 0U); // four
  EXPECT_EQ(check({}), 1U);                                                                     // none
}

TEST(GivenContributions, AreThoseOfTheMeshWhateverTheirOrder) {
  ReferenceMesh<2> mesh;
  mesh.simplices = {{0, 1, 2}, {3, 2, 0}, {0, 3, 4}};
  const auto c =
      givenContributions(mesh, {{2, {4}, true}, {0, {1, 0}, true}, {1, {0}, false}, {0, {2}, true}});
  EXPECT_EQ(c.ofSimplex.offsets, (std::vector<Index>{0, 2, 3, 4}));
  std::vector<int> masks;
  for (const Contribution &one : c.ofSimplex.items) {
    EXPECT_EQ(one.side, kNone);
    masks.push_back(one.mask);
  }
  EXPECT_EQ(masks, (std::vector<int>{0b011, 0b100, 0b100, 0b100}));
  EXPECT_EQ(c.soft, (std::vector<ContributionSet>{0, contributionBit(0b100), 0}));
  EXPECT_EQ(c.hardCount, 3);
  EXPECT_EQ(c.softCount, 1);
}

} // namespace
} // namespace dualblock
