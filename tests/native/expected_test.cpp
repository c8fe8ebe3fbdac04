// Counts of the examples of the paper's section 5 and their plane relatives, on coarse and refined reference
// meshes; bounds on the blocks of the others.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/examples.h"

namespace dualblock::test {
namespace {

const std::vector<PipelineOptions> &variants() {
  static const std::vector<PipelineOptions> list = [] {
    std::vector<PipelineOptions> all(7);
    all[1].edgeLength = 0.8;
    all[2].edgeLength = 0.55;
    all[3].edgeLength = 0.4;
    all[4].seed = 1;
    all[5].seed = 2;
    all[6].seed = 3;
    return all;
  }();
  return list;
}

std::string describe(const PipelineOptions &options) {
  return "edge length " + std::to_string(options.edgeLength) + ", seed " + std::to_string(options.seed);
}

/// Calls check(result) for every variant, after what holds for every result.
template <typename Check> void forVariants(const std::string &name, Check check) {
  for (const PipelineOptions &options : variants()) {
    SCOPED_TRACE(describe(options));
    std::visit(
        [&](const auto &domain) {
          const auto result = run(domain, options);
          EXPECT_TRUE(result.certificate.valid) << failuresOf(result.certificate);
          EXPECT_GT(minimumQuality(result), 0);
          EXPECT_GT(result.certificate.worstCoefficient, 0);
          if (options.edgeLength > 0 && options.edgeLength < 0.5 && !domain.reference &&
              result.fallbackComponents == 0) {
            EXPECT_GT(result.fillSimplices, 4); // that the mesh was indeed refined
          }
          check(result);
        },
        loadExample(name));
  }
}

nlohmann::json expectedCounts() { return nlohmann::json::parse(readText("tests/fixtures/expected.json")); }

std::vector<std::string> expectedNames() {
  std::vector<std::string> names;
  const nlohmann::json counts = expectedCounts();
  for (const auto &entry : counts.items()) names.push_back(entry.key());
  return names;
}

class Expected : public ::testing::TestWithParam<std::string> {};

TEST_P(Expected, Counts) {
  const auto counts = expectedCounts().at(GetParam());
  forVariants(GetParam(), [&](const auto &result) {
    EXPECT_EQ(result.primal.nodeCount, counts.at("nodes").get<Index>());
    EXPECT_EQ(result.primal.edges.size(), counts.at("edges").get<std::size_t>());
    EXPECT_EQ(result.primal.blocks.size(), counts.at("blocks").get<std::size_t>());
    EXPECT_EQ(result.fallbackComponents, 0);
  });
}

INSTANTIATE_TEST_SUITE_P(Examples, Expected, ::testing::ValuesIn(expectedNames()),
                         [](const auto &info) { return info.param; });

struct Bound {
  const char *name;
  std::size_t blocks;
};

class Bounded : public ::testing::TestWithParam<Bound> {};

TEST_P(Bounded, NoMoreBlocksThan) {
  forVariants(GetParam().name,
              [&](const auto &result) { EXPECT_LE(result.primal.blocks.size(), GetParam().blocks); });
}

INSTANTIATE_TEST_SUITE_P(Examples, Bounded,
                         ::testing::Values(Bound{"tetrahedron", 4}, Bound{"house", 10},
                                           Bound{"notched_cube", 56}, Bound{"hexagonal_pyramid", 16},
                                           Bound{"icosahedron", 60}, Bound{"vertex_end", 4},
                                           Bound{"vertex_side", 8}, Bound{"vertex_corner", 12},
                                           Bound{"vertex_reversal", 16}, Bound{"two_holes_2d", 52}),
                         [](const auto &info) { return std::string(info.param.name); });

// The paper's figures 9 to 11: one dual and one primal, whatever the reference mesh.
class Rectangles : public ::testing::TestWithParam<std::string> {};

TEST_P(Rectangles, FourBlocks) {
  forVariants(GetParam(), [](const auto &result) {
    EXPECT_EQ(result.primal.nodeCount, 9);
    EXPECT_EQ(result.primal.edges.size(), 12U);
    EXPECT_EQ(result.primal.blocks.size(), 4U);
  });
}

INSTANTIATE_TEST_SUITE_P(Figures, Rectangles,
                         ::testing::Values("square_2d_first", "square_2d_second", "end_vertex_1",
                                           "end_vertex_2", "end_vertex_3", "end_vertex_4"),
                         [](const auto &info) { return info.param; });

// Figures 10 and 11: n triangles at the end vertex have n - 2 soft node contributions between hard ones.
TEST(EndVertex, SoftContributionsBetweenHardOnes) {
  for (const int triangles : {1, 2, 3, 4}) {
    SCOPED_TRACE(triangles);
    const auto result = run(loadExample<2>("end_vertex_" + std::to_string(triangles)));
    int around = 0;
    int softNodes = 0;
    for (Index s = 0; s < result.mesh.simplexCount(); ++s) {
      const int v = result.mesh.localVertex(s, 0);
      if (v < 0) continue;
      ++around;
      const ContributionSet node = contributionBit(1U << v);
      if (result.contributions.soft[at(s)] & node) ++softNodes;
    }
    EXPECT_EQ(around, triangles);
    EXPECT_EQ(softNodes, std::max(0, triangles - 2));
  }
}

} // namespace
} // namespace dualblock::test
