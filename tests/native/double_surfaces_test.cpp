// D-bar-surfaces doubled: counts and places where every one is, conformity where some are, and blocks that
// stray from bent sides brought nearer to them.
#include "refinement/double_surfaces.h"

#include <gtest/gtest.h>

#include "doubled_mesh.h"
#include "support/random_domains.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

template <int N> BlockMesh<N> layered(const PipelineResult<N> &r) {
  return layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
}

template <int N> Doubling<N> doubled(const PipelineResult<N> &r, const std::vector<bool> &wanted) {
  const BentShape<N> shape(bentFacetsOf(r.sideMesh(), r.features, r.featureNodes));
  auto result = doubleSurfaces(layered(r), patchOfSurface(r.mesh), shape, wanted);
  EXPECT_TRUE(result.ok());
  return std::move(result.value());
}

template <int N> Certificate certified(const PipelineResult<N> &r, const BlockMesh<N> &blocks) {
  return certifyBlocks<N>(
      {r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, r.domain.deviation, r.given.get()});
}

TEST(DoubleSurfaces, AllOfABoxMakeAFinerGrid) {
  const auto r = run(prism({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, 4)); // 2 x 2 x 2 blocks, six surfaces
  const Doubling<3> d = doubled(r, std::vector<bool>(6, true));
  EXPECT_EQ(d.blocks.blockCount(), 64);
  EXPECT_EQ(d.blocks.nodeCount(), 125);
  EXPECT_EQ(d.inserted.size(), 6U);
  for (const Vec<3> &x : d.blocks.positions)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(x[k], std::round(x[k]));
  const Certificate certificate = certified(r, d.blocks);
  EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
  std::vector<int> blocksOf(12, 0);
  for (const auto &surfaces : d.blocks.surfaces)
    for (const Index s : surfaces) ++blocksOf[at(s)];
  for (const int count : blocksOf) EXPECT_EQ(count, 16);
}

TEST(DoubleSurfaces, OneOfThemSplitsItsLayerOnly) {
  const auto r = run(prism({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, 4));
  for (std::size_t s = 0; s < 6; ++s) {
    std::vector<bool> wanted(6, false);
    wanted[s] = true;
    const Doubling<3> d = doubled(r, wanted);
    EXPECT_EQ(d.blocks.blockCount(), 12);
    ASSERT_EQ(d.inserted.size(), 1U);
    EXPECT_EQ(d.inserted[0], (std::array<Index, 2>{6, toIndex(s)}));
    const Certificate certificate = certified(r, d.blocks);
    EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
  }
}

TEST(DoubleSurfaces, QuadrilateralsToo) {
  const auto r = run(loadExample<2>("square_2d"));
  std::vector<bool> wanted(4, false);
  wanted[0] = true;
  const Doubling<2> d = doubled(r, wanted);
  EXPECT_EQ(d.blocks.blockCount(), 6);
  EXPECT_TRUE(certified(r, d.blocks).valid);
}

/// As if block 0 strayed.
PipelineResult<3> straying(PipelineResult<3> r) {
  r.certificate.fail(Check::features, "block 0 strays", {{"block", 0}});
  return r;
}

TEST(DoubleStraying, BringsBlocksNearerToTheirSide) {
  const auto plain = run(shaft(16));
  ASSERT_TRUE(plain.certificate.valid);
  auto r = straying(plain);
  ASSERT_TRUE(doubleStraying(r, PipelineOptions{}, 1e4));
  ASSERT_TRUE(r.finalMesh);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_GT(r.finalMesh->blocks.blocks.size(), plain.primal.blocks.size());
  EXPECT_LT(r.certificate.fidelity.strayed, plain.certificate.fidelity.strayed);
  EXPECT_FALSE(r.finalMesh->inserted.empty());
  const Certificate again = certified(r, r.finalMesh->blocks);
  EXPECT_TRUE(again.valid) << failuresOf(again);
}

TEST(DoubleStraying, LeavesWhatItCannotMend) {
  const auto plain = run(shaft(16));
  auto tooFew = straying(plain);
  EXPECT_FALSE(doubleStraying(tooFew, PipelineOptions{}, static_cast<double>(plain.primal.blocks.size())));
  EXPECT_FALSE(tooFew.finalMesh);
  EXPECT_FALSE(tooFew.certificate.valid);
  auto inverted = straying(plain);
  inverted.certificate.fail(Check::geometry, "block 0 is inverted", {{"block", 0}});
  EXPECT_FALSE(doubleStraying(inverted, PipelineOptions{}, 1e4));
  EXPECT_FALSE(inverted.finalMesh);
}

} // namespace
} // namespace dualblock::test
