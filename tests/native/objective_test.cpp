// Parts that are chosen for the shape of their blocks: never worse than those that are chosen for few blocks.
#include <gtest/gtest.h>

#include "support/examples.h"
#include "support/mesh_invariants.h"
#include "support/random_domains.h"

namespace dualblock::test {
namespace {

PipelineOptions shape() {
  PipelineOptions options;
  options.objective = Objective::shape;
  return options;
}

/// What was chosen is among the candidates, is not worse than the first, and no candidate is clearly better.
template <int N> void expectBest(const PipelineResult<N> &r, const std::string &name) {
  EXPECT_TRUE(r.certificate.valid) << name << failuresOf(r.certificate);
  const auto chosen =
      std::find_if(r.candidates.begin(), r.candidates.end(), [](const PartCandidate &c) { return c.chosen; });
  ASSERT_NE(chosen, r.candidates.end()) << name;
  EXPECT_EQ(chosen->blocks, toIndex(r.primal.blocks.size())) << name;
  EXPECT_EQ(chosen->parts, toIndex(r.parts.parts.size())) << name;
  EXPECT_EQ(chosen->minScaledJacobian, minimumQuality(r)) << name;
  EXPECT_GE(chosen->minScaledJacobian, r.candidates[0].minScaledJacobian) << name;
  int count = 0;
  for (const PartCandidate &c : r.candidates) {
    EXPECT_GE(chosen->minScaledJacobian, c.minScaledJacobian - 1e-3) << name;
    count += c.chosen ? 1 : 0;
  }
  EXPECT_EQ(count, 1) << name;
}

// TetGen's 15 tetrahedra share corners of the icosahedron; around its centre there is room for 20.
TEST(Objective, IcosahedronAroundItsCentre) {
  const Domain<3> domain = loadExample<3>("icosahedron");
  const auto few = run(domain);
  const auto round = run(domain, shape());
  EXPECT_EQ(few.primal.blocks.size(), 60U);
  EXPECT_LT(minimumQuality(few), 0.3);
  EXPECT_EQ(round.primal.blocks.size(), 80U);
  EXPECT_GE(minimumQuality(round), 0.65);
  EXPECT_EQ(round.pulledComponents, 1);
  EXPECT_EQ(round.candidates[0].minScaledJacobian, minimumQuality(few));
  expectBest(round, "icosahedron");
}

// Six tetrahedra stand around the axis, over the middle of the base.
TEST(Objective, PyramidOverTheMiddleOfItsBase) {
  const auto r = run(loadExample<3>("hexagonal_pyramid"), shape());
  EXPECT_LT(r.candidates[0].minScaledJacobian, 0.31);
  EXPECT_EQ(r.primal.blocks.size(), 24U);
  EXPECT_GE(minimumQuality(r), 0.43);
  expectBest(r, "hexagonal_pyramid");
}

TEST(Objective, BlocksIsTheOnlyCandidateOfItself) {
  const auto r = run(loadExample<3>("icosahedron"));
  ASSERT_EQ(r.candidates.size(), 1U);
  expectBest(r, "icosahedron");
}

TEST(Objective, NoExampleIsWorse) {
  for (const std::string &name : computedExampleNames())
    std::visit(
        [&](const auto &domain) {
          const auto few = run(domain);
          const auto best = run(domain, shape());
          expectBest(best, name);
          EXPECT_GE(minimumQuality(best), minimumQuality(few)) << name;
          EXPECT_EQ(best.candidates[0].blocks, toIndex(few.primal.blocks.size())) << name;
        },
        loadExample(name));
}

TEST(Objective, NoRandomSolidIsWorse) {
  int better = 0;
  for (int kind = 0; kind < kRandomKinds; ++kind)
    for (std::uint32_t seed = 0; seed < 7; ++seed) {
      const std::string name = std::to_string(kind) + " " + std::to_string(seed);
      const Domain<3> domain = randomSolid(kind, seed);
      const auto few = run(domain);
      const auto best = run(domain, shape());
      expectBest(best, name);
      EXPECT_EQ(brokenInvariants(best.mesh, true), std::vector<std::string>{}) << name;
      EXPECT_GE(minimumQuality(best), minimumQuality(few)) << name;
      better += minimumQuality(best) > minimumQuality(few) + 1e-3 ? 1 : 0;
    }
  EXPECT_GE(better, 6);
}

} // namespace
} // namespace dualblock::test
