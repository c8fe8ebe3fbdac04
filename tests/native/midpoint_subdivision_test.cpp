// The primal against midpoint subdivision of the parts (ARCHITECTURE.md 4): the same numbers of nodes, edges,
// faces and blocks, and isomorphic complexes.
#include "support/midpoint_subdivision.h"

#include <gtest/gtest.h>

#include "support/examples.h"

namespace dualblock::test {
namespace {

template <int N> void expectMidpointSubdivision(const PipelineResult<N> &result) {
  ASSERT_TRUE(result.certificate.valid) << failuresOf(result.certificate);
  const MidpointSubdivision<N> oracle = midpointSubdivision(result.mesh, result.parts);
  EXPECT_EQ(toIndex(oracle.nodes.size()), result.primal.nodeCount);
  EXPECT_EQ(oracle.edges.size(), result.primal.edges.size());
  EXPECT_EQ(oracle.faces.size(), result.primal.faces.size());
  EXPECT_EQ(oracle.blocks.size(), result.primal.blocks.size());
  EXPECT_EQ(canonicalForm<N>(oracle.blocks), canonicalForm<N>(blocksOf(result.primal)));

  // Every corner of a part, and every midpoint of a straight curve, is where the oracle's face says.
  std::set<std::array<double, N>> positions;
  for (const Vec<N> &x : result.primal.positions) {
    std::array<double, N> key{};
    for (int k = 0; k < N; ++k) key[at(k)] = x[k];
    positions.insert(key);
  }
  for (const auto &[face, node] : oracle.nodes)
    if (face.dimension == 0) {
      EXPECT_TRUE(positions.count(face.corners[0])) << "oracle node " << node;
    }
}

class MidpointOracle : public ::testing::TestWithParam<std::string> {};

TEST_P(MidpointOracle, IsomorphicToThePrimal) {
  for (const double edgeLength : {0.0, 0.7})
    for (const std::uint32_t seed : {0U, 5U}) {
      SCOPED_TRACE("edge length " + std::to_string(edgeLength) + ", seed " + std::to_string(seed));
      PipelineOptions options;
      options.edgeLength = edgeLength;
      options.seed = seed;
      options.mode.relax = false; // the oracle knows the first places only
      std::visit([&](const auto &domain) { expectMidpointSubdivision(run(domain, options)); },
                 loadExample(GetParam()));
    }
}

INSTANTIATE_TEST_SUITE_P(Examples, MidpointOracle, ::testing::ValuesIn(computedExampleNames()),
                         [](const auto &info) { return info.param; });

TEST(MidpointOracle, KnownSubdivisions) {
  // The oracle against counts by hand: a polytope with c corners, e edges and f sides has c + e + f + 1
  // nodes, an edge per incidence between faces of neighbouring dimensions, and a block per corner.
  const auto tetrahedron = run(loadExample<3>("tetrahedron"));
  const auto oracle = midpointSubdivision(tetrahedron.mesh, tetrahedron.parts);
  EXPECT_EQ(oracle.nodes.size(), 4U + 6 + 4 + 1);
  EXPECT_EQ(oracle.edges.size(), 2U * 6 + 3 * 4 + 4);
  EXPECT_EQ(oracle.blocks.size(), 4U);
  const auto pentagon = run(loadExample<2>("pentagon_2d"));
  const auto flat = midpointSubdivision(pentagon.mesh, pentagon.parts);
  EXPECT_EQ(flat.nodes.size(), 11U);
  EXPECT_EQ(flat.edges.size(), 15U);
  EXPECT_EQ(flat.blocks.size(), 5U);
}

TEST(MidpointOracle, RefusesPartsThatAreNotSimple) {
  const auto mesh = fill(loadExample<3>("double_pyramid"));
  EXPECT_THROW(midpointSubdivision(mesh, buildParts(mesh, {})), std::invalid_argument);
}

TEST(MidpointOracle, NoticesAMissingBlock) {
  auto result = run(loadExample<3>("l_shape_extruded"));
  const auto oracle = midpointSubdivision(result.mesh, result.parts);
  result.primal.blocks.pop_back();
  EXPECT_NE(canonicalForm<3>(oracle.blocks), canonicalForm<3>(blocksOf(result.primal)));
}

} // namespace
} // namespace dualblock::test
