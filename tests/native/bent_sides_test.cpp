// Curved solids given as polygons (ARCHITECTURE.md 3, rule 3): the blocks follow from the cuts alone,
// whatever the reference mesh and the number of polygons.
#include <gtest/gtest.h>

#include "support/round_solids.h"

namespace dualblock::test {
namespace {

struct Wanted {
  std::size_t nodes, edges, blocks;
};

void expectCounts(const Domain<3> &domain, const Wanted &wanted, const PipelineOptions &options = {}) {
  SCOPED_TRACE(domain.name + ", edge length " + std::to_string(options.edgeLength) + ", seed " +
               std::to_string(options.seed));
  const auto r = run(domain, options);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
  EXPECT_EQ(at(r.primal.nodeCount), wanted.nodes);
  EXPECT_EQ(r.primal.edges.size(), wanted.edges);
  EXPECT_EQ(r.primal.blocks.size(), wanted.blocks);
  EXPECT_GT(minimumQuality(r), 0);
}

// The first three are the counts of the method's description, ARCHITECTURE.md 3.
TEST(BentSides, CountsOnEveryReferenceMesh) {
  for (const double edgeLength : {0.0, 0.6})
    for (const std::uint32_t seed : {0U, 1U}) {
      const PipelineOptions options{edgeLength, seed};
      expectCounts(cylinder(24), {51, 118, 24}, options);
      expectCounts(plateWithHole(24), {72, 168, 32}, options);
      expectCounts(ball(24), {53, 128, 32}, options);
    }
}

TEST(BentSides, CountsForAnyNumberOfPolygons) {
  for (const int n : {12, 13, 17, 32, 60}) {
    expectCounts(cylinder(n), {51, 118, 24});
    expectCounts(plateWithHole(n), {72, 168, 32});
  }
  expectCounts(ball(16), {53, 128, 32});
}

// Four tetrahedra, four quarters of a pipe, three times four prisms, a bent tube of four prisms.
TEST(BentSides, OtherSolids) {
  expectCounts(cone(24), {35, 78, 16});
  expectCounts(shaft(24), {133, 336, 80});
  expectCounts(torus(8, 16, std::numbers::pi / 2), {51, 118, 24});
  Domain<3> pipe = prism(circle(24, 1), 0, 2);
  addHole(pipe, circle(24, 0.6), 0, 2);
  pipe.name = "pipe";
  expectCounts(pipe, {72, 168, 32});
  expectCounts(torus(24, 12), {136, 360, 96}); // four sectors of four prisms
}

// A cut that extends a bent side over long, thin simplices must not go straight where that side is bent.
TEST(BentSides, ShaftOnShuffledMeshes) {
  for (std::uint32_t seed = 1; seed <= 24; ++seed) expectCounts(shaft(24), {133, 336, 80}, {0, seed});
}

TEST(BentSides, ATurnedSolidIsCutAlike) {
  expectCounts(rotated(cylinder(24)), {51, 118, 24});
  expectCounts(rotated(plateWithHole(24)), {72, 168, 32});
  expectCounts(rotated(shaft(24)), {133, 336, 80});
}

// What the feature angle says: 24 facets of 15 degrees are one bent side, or 24 sides.
TEST(BentSides, FeatureAngle) {
  PipelineOptions options;
  options.featureAngle = 0;
  const auto sharp = run(cylinder(24), options);
  EXPECT_TRUE(sharp.certificate.valid);
  EXPECT_TRUE(sharp.certificate.isExact);
  EXPECT_EQ(sharp.primal.blocks.size(), 48U);
  options.featureAngle = 14;
  EXPECT_EQ(run(cylinder(24), options).primal.blocks.size(), 48U);
  options.featureAngle = 16;
  EXPECT_EQ(run(cylinder(24), options).primal.blocks.size(), 24U);
  EXPECT_EQ(run(prism(circle(5, 1), 0, 1)).primal.blocks.size(), 10U); // a pentagon is no circle
}

// Straight blocks hold less than the round solid, their nodes lie on it.
TEST(BentSides, NodesLieOnTheSurface) {
  const auto r = run(ball(24));
  EXPECT_FALSE(r.certificate.isExact);
  EXPECT_LT(r.certificate.meshMeasure, r.certificate.domainMeasure);
  std::size_t outer = 0;
  for (std::size_t p = 0; p < r.primal.positions.size(); ++p) {
    const double radius = glm::length(r.primal.positions[p]);
    EXPECT_LE(radius, 1 + 1e-12);
    if (radius > 0.95) ++outer; // facets of a 24-gon cut the sphere off at 0.97
  }
  EXPECT_EQ(outer, 26U); // 6 corners, 12 curves, 8 sides
}

TEST(BentSides, TheCertificateSeesANodeOffTheSurface) {
  auto r = run(cylinder(24));
  ASSERT_TRUE(r.certificate.valid);
  for (Vec<3> &x : r.primal.positions)
    if (std::abs(x.z - 1) < 0.1 && std::hypot(x.x, x.y) > 0.9) {
      x *= 0.95;
      break;
    }
  const Certificate c = certify<3>({r.domain.domain, r.features, r.featureNodes, r.mesh, r.parts,
                                    r.contributions, r.dual, r.surfaces, r.primal, r.domain.deviation});
  EXPECT_FALSE(c.passed[static_cast<std::size_t>(Check::features)]);
}

} // namespace
} // namespace dualblock::test
