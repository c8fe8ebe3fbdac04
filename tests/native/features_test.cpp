// Classification of curves and vertices (paper 2.4, figures 2 and 3).
#include "parts/features.h"

#include <numbers>

#include <gtest/gtest.h>

#include "partition/heuristics.h"
#include "support/examples.h"

namespace dualblock::test {
namespace {

TEST(CurveKinds, FollowTheInteriorAngle) {
  EXPECT_EQ(curveKind(20 * kDegree), CurveKind::end);
  EXPECT_EQ(curveKind(90 * kDegree), CurveKind::end);
  EXPECT_EQ(curveKind(136 * kDegree), CurveKind::side);
  EXPECT_EQ(curveKind(224 * kDegree), CurveKind::side);
  EXPECT_EQ(curveKind(270 * kDegree), CurveKind::corner);
  EXPECT_EQ(curveKind(316 * kDegree), CurveKind::reversal);
}

template <int N> Features featuresOf(const std::string &name) {
  return run(loadExample<N>(name)).featureKinds;
}

TEST(CurveKinds, OfTheVertexExamples) {
  const auto has = [](const char *name, CurveKind kind) {
    const auto features = featuresOf<2>(name);
    return std::count(features.curves.begin(), features.curves.end(), kind);
  };
  EXPECT_GE(has("vertex_end", CurveKind::end), 1);
  EXPECT_EQ(has("vertex_side", CurveKind::side), 1);
  EXPECT_EQ(has("vertex_corner", CurveKind::corner), 1);
  EXPECT_EQ(has("vertex_reversal", CurveKind::reversal), 1);
}

TEST(VertexKinds, CountFeatureCurves) {
  const Features brick = featuresOf<3>("tapered_brick");
  EXPECT_EQ(brick.vertices, std::vector<VertexKind>(8, VertexKind::vertex));
  // All curves of an icosahedron have 138 degrees: of type side, so no vertex is a feature.
  const Features icosahedron = featuresOf<3>("icosahedron");
  EXPECT_EQ(icosahedron.vertices, std::vector<VertexKind>(12, VertexKind::face));
  const Features ring = featuresOf<3>("square_ring");
  EXPECT_EQ(std::count(ring.curves.begin(), ring.curves.end(), CurveKind::corner), 4);
  EXPECT_EQ(ring.vertices, std::vector<VertexKind>(16, VertexKind::vertex));
}

// The corners of a 12-gon have 150 degrees, so its prism's upright curves are of type side: each vertex sees
// two feature curves, both of its rim.
TEST(VertexKinds, EdgeOnTheRimOfADrum) {
  std::vector<Vec<2>> polygon;
  for (int k = 0; k < 12; ++k) polygon.emplace_back(std::cos(30 * k * kDegree), std::sin(30 * k * kDegree));
  const Features drum = classifyFeatures(buildParts(fill(prism(polygon, 0, 1), 0, 0, 0), {}));
  EXPECT_EQ(drum.vertices, std::vector<VertexKind>(24, VertexKind::edge));
}

} // namespace
} // namespace dualblock::test
