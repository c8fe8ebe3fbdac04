// Findings about parts, what sources of cuts answer them with, and what the search makes of it.
#include <gtest/gtest.h>

#include "partition/bent_search.h"
#include "support/bent_domains.h"
#include "support/examples.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

/// Two parts, each with a side on one split surface; the first has a corner there.
Parts<3> twoParts(bool hasBoth) {
  Parts<3> parts;
  parts.parts.resize(2);
  parts.sides = {{0, 7, 3}, {0, 8, kNone}, {0, 9, kNone}, {1, 6, 0}, {1, 4, kNone}, {1, 5, kNone}};
  auto store = std::make_shared<FeatureStore<3>>();
  store->cornerSides = {0, 1, 2, 3, 4, 5};
  parts.corners.push_back({0, 11, std::span(store->cornerSides).first(3)});
  parts.corners.push_back({1, hasBoth ? 11 : 12, std::span(store->cornerSides).last(3)});
  parts.store = store;
  return parts;
}

TEST(UnlikeCorners, AreFoundFromBothSides) {
  const std::vector<UnlikeCorner> unlike = unlikeCorners(twoParts(false));
  ASSERT_EQ(unlike.size(), 2U);
  EXPECT_EQ(unlike[0].part, 1); // which lacks the corner of the first
  EXPECT_EQ(unlike[0].node, 11);
  EXPECT_EQ(unlike[1].part, 0);
  EXPECT_EQ(unlike[1].node, 12);
  EXPECT_EQ(costOf(twoParts(false)).joints, 4);
  EXPECT_TRUE(unlikeCorners(twoParts(true)).empty());
  EXPECT_EQ(costOf(twoParts(true)).sum(), 0);
}

TEST(Sources, JointsOfferTheCutsThatMendThem) {
  const Domain<3> domain = loadExample<3>("double_pyramid"); // two corners of four sides
  const ReferenceMesh<3> mesh = fill(domain);
  const Parts<3> parts = buildParts(mesh, PartOptions{});
  const Cost before = costOf(parts);
  EXPECT_GT(before.joints, 0);
  Index least = before.joints;
  visitParts(mesh, parts, {}, [&](const PartView &view) {
    for (const Cut &cut : throughJoints(view)) {
      EXPECT_EQ(cut.from.size(), 1U);
      ReferenceMesh<3> copy = mesh;
      if (makeCut(copy, view, cut, {1e-6 * mesh.size, toIndex(domain.facets.size())}))
        least = std::min(least, costOf(buildParts(copy, PartOptions{})).joints);
    }
    return false;
  });
  EXPECT_LT(least, before.joints);
}

/// What each source says about the only part of an uncut solid.
std::size_t offered(Source source, const Domain<3> &domain) {
  const ReferenceMesh<3> mesh = fill(domain);
  const Parts<3> parts = buildParts(mesh, PartOptions{});
  const std::vector<Axis> axes = axesOf(parts, mesh.nodes);
  std::size_t count = 0;
  visitParts(mesh, parts, axes, [&](const PartView &view) {
    const std::vector<Cut> cuts = source(view);
    count += cuts.size();
    for (const Cut &cut : cuts) { // each cuts something
      ReferenceMesh<3> copy = mesh;
      EXPECT_TRUE(makeCut(copy, view, cut, {1e-6 * mesh.size, toIndex(domain.facets.size())}));
    }
    return false;
  });
  return count;
}

TEST(Sources, EachAnswersItsFindingOnly) {
  const Domain<3> cube = prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0, 1);
  for (const Source source : std::array<Source, 11>{throughCreases, acrossMiddle, throughVoids, betweenCurves,
                                                    alongAxes, throughKinks, betweenCorners, throughJoints,
                                                    acrossCurves, acrossTurns, halving})
    EXPECT_EQ(offered(source, cube), 0U);
  EXPECT_EQ(offered(acrossMiddle, ball(16)), 1U); // no curve
  EXPECT_EQ(offered(alongAxes, ball(16)), 0U);
  EXPECT_GT(offered(alongAxes, shaft(16)), 0U); // closed curves
  EXPECT_EQ(offered(acrossMiddle, shaft(16)), 0U);
  EXPECT_GT(offered(alongAxes, plateWithHole(16)), 0U);
  EXPECT_EQ(offered(throughVoids, torus(16, 8)), 0U);
}

TEST(BentSearch, EndsWithSimplePartsOfRoundSolids) {
  for (const Domain<3> &domain : {ball(16), torus(16, 8)}) {
    ReferenceMesh<3> mesh = fill(domain);
    Parts<3> parts = buildParts(mesh, PartOptions{});
    BentSearch search(mesh, parts,
                      {{1e-6 * mesh.size, toIndex(domain.facets.size())}, axesOf(parts, mesh.nodes), {}},
                      true, [](ReferenceMesh<3> &, const Parts<3> &) { return 0; });
    int cuts = 0;
    while (search.step({false}) != CutReason::none && cuts < 40) ++cuts;
    EXPECT_GT(cuts, 0);
    EXPECT_LT(cuts, 40);
    EXPECT_EQ(costOf(parts).sum(), 0);
    EXPECT_EQ(search.isSimple, std::vector<bool>{true});
    const Parts<3> again = buildParts(mesh, PartOptions{});
    EXPECT_EQ(again.parts.size(), parts.parts.size());
  }
}

TEST(BentSearch, LeavesComponentsThatGaveUp) {
  const Domain<3> domain = ball(16);
  ReferenceMesh<3> mesh = fill(domain);
  Parts<3> parts = buildParts(mesh, PartOptions{});
  BentSearch search(mesh, parts, {{1e-6 * mesh.size, toIndex(domain.facets.size())}, {}, {}}, false,
                    [](ReferenceMesh<3> &, const Parts<3> &) { return 0; });
  EXPECT_EQ(search.step({true}), CutReason::none);
  EXPECT_EQ(parts.parts.size(), 1U);
}

TEST(BentSearch, MendsJointsByRowsOfCuts) {
  const Domain<3> domain = loadExample<3>("double_pyramid");
  ReferenceMesh<3> mesh = fill(domain);
  Parts<3> parts = buildParts(mesh, PartOptions{});
  BentSearch search(mesh, parts, {{1e-6 * mesh.size, toIndex(domain.facets.size())}, {}, {}}, false,
                    [](ReferenceMesh<3> &, const Parts<3> &) { return 0; });
  EXPECT_EQ(search.step({false}), CutReason::needed);
  EXPECT_EQ(costOf(parts).sum(), 0);
  EXPECT_GT(parts.parts.size(), 1U);
  EXPECT_EQ(search.partsBefore.parts.size(), 1U);
  for (const PartInfo &part : parts.parts) EXPECT_TRUE(part.isSimple()) << describe(part.defect, 3);
}

// One part has all the holes at first: as many cuts as they need are no extravagance, however many there are,
// and however fine they are.
TEST(BentSearch, CutsAPlateOfManyHoles) {
  for (const auto &[across, n] : {std::pair(4, 16), std::pair(8, 16), std::pair(8, 32)}) {
    SCOPED_TRACE(across * 100 + n);
    const double width = across;
    Domain<3> domain = prism({{0, 0}, {width, 0}, {width, width}, {0, width}}, 0, 0.5);
    for (int x = 0; x < across; ++x)
      for (int y = 0; y < across; ++y) addHole(domain, circle(n, 0.25, {x + 0.5, y + 0.5}), 0, 0.5);
    const PipelineResult<3> r = run(domain);
    EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
    EXPECT_EQ(r.fallbackComponents, 0);
    EXPECT_GT(minimumQuality(r), 0.6);
    EXPECT_LT(r.primal.blocks.size(), 22 * static_cast<std::size_t>(across * across));
  }
}

} // namespace
} // namespace dualblock::test
