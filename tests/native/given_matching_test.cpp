// The paper's 2D matching rules (4.3) on contributions given one by one, beside figure 12's own examples,
// which tests/node checks through the module.
#include "contributions/given_matching.h"

#include <gtest/gtest.h>

#include "support/random_domains.h"

namespace dualblock {
namespace {

using Triangles = std::vector<std::array<Index, 3>>;

std::size_t faults(const Triangles &triangles, const std::vector<GivenContribution> &contributions) {
  return checkGivenContributions(triangles, contributions).size();
}

/// The one fault's message; empty if there is none or more than one.
std::string fault(const Triangles &triangles, const std::vector<GivenContribution> &contributions) {
  const auto found = checkGivenContributions(triangles, contributions);
  return found.size() == 1 ? found[0].message : "";
}

/// On both sides of the edge from 0 to 2.
const Triangles kTwo{{0, 1, 2}, {0, 2, 3}};
/// Around node 0, which lies on the boundary.
const Triangles kFan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
const Triangles kLongFan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
/// Around node 0, which lies inside.
const Triangles kDisc{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};

TEST(GivenMatching, AcceptsEqualNumbersFromBothSides) {
  EXPECT_EQ(faults(kTwo, {}), 0U);
  EXPECT_EQ(faults(kTwo, {{0, {0}, true}, {0, {0, 1}, true}, {1, {0}, true}, {1, {0, 3}, true}}), 0U);
}

TEST(GivenMatching, NamesThePointWhereOneSideIsMissing) {
  const auto found = checkGivenContributions(kTwo, {{0, {2}, true}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].near, 2);
  EXPECT_EQ(found[0].far, 0);
  EXPECT_NE(found[0].message.find("near 2"), std::string::npos);
}

TEST(GivenMatching, RefusesTwoFromOneSideAndNoneFromTheOther) {
  EXPECT_NE(fault(kTwo, {{0, {0}, true}, {0, {0, 1}, true}}).find("0 from the other"), std::string::npos);
}

TEST(GivenMatching, AllowsOneHardContributionAtABoundaryPoint) {
  // {0} and {0, 2} of triangle 0 both meet the boundary edge (0, 1) near 0.
  EXPECT_NE(fault(kTwo, {{0, {0}, true}, {0, {0, 2}, true}, {1, {0}, true}}).find("boundary at one point"),
            std::string::npos);
}

TEST(GivenMatching, RefusesSoftContributionsAtTheBoundary) {
  EXPECT_EQ(faults(kTwo, {{0, {0}, false}}), 2U); // and nothing arrives at its other end
}

/// In the fan the triangles between the first and the last are soft around node 0: all their points are one.
std::vector<GivenContribution> withSoft(std::vector<GivenContribution> hard) {
  hard.push_back({1, {0}, false});
  return hard;
}

TEST(GivenMatching, AcceptsTwoOrFourAtAVirtualPoint) {
  // One curve that goes on through the virtual point crosses none; with four there are two curves.
  EXPECT_NE(fault(kFan, withSoft({{0, {0}, true}, {2, {0}, true}})).find("crosses none"), std::string::npos);
  EXPECT_EQ(faults(kFan, withSoft({{0, {0}, true}, {0, {0, 1}, true}, {2, {0}, true}, {2, {0, 4}, true}})),
            0U);
}

TEST(GivenMatching, RefusesOtherNumbersAtAVirtualPoint) {
  EXPECT_NE(fault(kFan, withSoft({})).find("where 0 hard"), std::string::npos);
  EXPECT_NE(fault(kFan, withSoft({{0, {0}, true}, {0, {0, 1}, true}, {2, {0}, true}})).find("where 3 hard"),
            std::string::npos);
}

TEST(GivenMatching, RefusesAVirtualPointWithAllFromOneSide) {
  EXPECT_NE(fault(kFan, withSoft({{0, {0}, true}, {0, {0, 1}, true}})).find("2 from one side and 0"),
            std::string::npos);
  // From the left and the right of its first edge, and its other end leads nowhere.
  EXPECT_NE(fault(kFan, withSoft({{0, {0}, true}, {1, {0, 3}, true}})).find("2 from one side and 0"),
            std::string::npos);
}

TEST(GivenMatching, CountsBothEndsOfALongChain) {
  const auto check = [&](std::vector<GivenContribution> hard) {
    hard.push_back({1, {0}, false});
    hard.push_back({2, {0}, false});
    return fault(kLongFan, hard);
  };
  EXPECT_EQ(faults(kLongFan, {{0, {0}, true},
                              {0, {0, 1}, true},
                              {1, {0}, false},
                              {2, {0}, false},
                              {3, {0}, true},
                              {3, {0, 5}, true}}),
            0U);
  // Four in all: two at the first end, one at the last, and one between the soft ones.
  EXPECT_NE(check({{0, {0}, true}, {0, {0, 1}, true}, {1, {0, 2}, true}, {3, {0}, true}})
                .find("3 from one side and 1"),
            std::string::npos);
}

TEST(GivenMatching, RefusesThreeCurvesAtAVirtualPoint) {
  // A soft contribution of two nodes, two curves through it, and a third one across.
  const Triangles four{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {1, 0, 5}};
  const std::vector<GivenContribution> crossing{{1, {0}, true}, {1, {0, 3}, true}, {0, {0, 1}, false},
                                                {2, {1}, true}, {2, {1, 4}, true}, {0, {1, 2}, true},
                                                {1, {2}, true}, {3, {1}, true}};
  EXPECT_NE(fault(four, crossing).find("where 6 hard"), std::string::npos);
}

TEST(GivenMatching, RefusesARingOfSoftContributions) {
  EXPECT_NE(fault(kDisc, {{0, {0}, false}, {1, {0}, false}, {2, {0}, false}}).find("ring"),
            std::string::npos);
}

TEST(GivenMatching, RefusesCurvesThatCrossNone) {
  const std::string closed = fault(kDisc, {{0, {0}, true}, {1, {0}, true}, {2, {0}, true}});
  EXPECT_NE(closed.find("crosses none"), std::string::npos);
  EXPECT_NE(fault(kTwo, {{0, {0}, true}, {1, {0}, true}}).find("crosses none"), std::string::npos);
  // Two that do not cross are two faults; two that cross are none, inside of a triangle as well.
  EXPECT_EQ(faults(kTwo, {{0, {0}, true}, {1, {0}, true}, {0, {2}, true}, {1, {2}, true}}), 2U);
  EXPECT_EQ(faults({{0, 1, 2}}, {{0, {0, 1}, true}, {0, {1, 2}, true}}), 0U);
  EXPECT_EQ(faults({{0, 1, 2}}, {{0, {0, 1}, true}, {0, {2}, true}}), 2U);
}

TEST(GivenMatching, AcceptsWhatTheMethodMakes) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto result = test::run(test::randomPolygon(seed));
    std::vector<GivenContribution> given;
    for (Index s = 0; s < result.mesh.simplexCount(); ++s)
      for (unsigned mask = 1; mask < 7; ++mask) {
        const ContributionSet bit = contributionBit(mask);
        if (!(result.contributions.present[at(s)] & bit)) continue;
        GivenContribution &c = given.emplace_back();
        c.simplex = s;
        c.hard = !(result.contributions.soft[at(s)] & bit);
        for (std::size_t v = 0; v < 3; ++v)
          if (mask >> v & 1) c.nodes.push_back(result.mesh.simplices[at(s)][v]);
      }
    EXPECT_EQ(faults(result.mesh.simplices, given), 0U);
  }
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
