// Measures of fidelity of shapes for which they are known.
#include "certificate/fidelity.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace dualblock::test {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

/// An arc of so many degrees about the middle of its chord of length 1, in n chords.
std::vector<Vec<3>> arc(double degrees, int n) {
  const double radius = 0.5 / std::sin(degrees * kRadian / 2);
  std::vector<Vec<3>> points;
  for (int k = 0; k <= n; ++k) {
    const double angle = degrees * kRadian * (static_cast<double>(k) / n - 0.5);
    points.emplace_back(radius * std::sin(angle), 0,
                        radius * (std::cos(angle) - std::cos(degrees * kRadian / 2)));
  }
  return points;
}

/// The greatest distance of an arc from its chord, as a share of that.
double sagitta(double degrees) { return std::tan(degrees * kRadian / 4) / 2; }

TEST(Fidelity, SagOfAnArc) {
  for (const double degrees : {10.0, 90.0, 120.0, 180.0, 270.0})
    EXPECT_NEAR(sagOf(arc(degrees, 64)), sagitta(degrees), 1e-12);
  EXPECT_EQ(sagOf(arc(1e-3, 1)), 0);
  // The distance from the chord itself, not from the line through it.
  EXPECT_DOUBLE_EQ(sagOf(std::vector<Vec<3>>{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}), 1);
  EXPECT_EQ(sagOf(std::vector<Vec<3>>{{0, 0, 0}, {2, 0, 0}, {0, 0, 0}}),
            std::numeric_limits<double>::infinity());
}

TEST(Fidelity, TurningOfAnArc) {
  for (const int n : {2, 4, 8}) // every chord counts
    EXPECT_NEAR(turningOf(arc(120, n)), 120 * (1 - 1.0 / n), 1e-9) << n;
  for (const int n : {16, 24, 64}) // every other point
    EXPECT_NEAR(turningOf(arc(120, n)), 120 * (1 - 2.0 / n), 1.5) << n;
  EXPECT_NEAR(turningOf(std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}), 180, 1e-9);
  EXPECT_NEAR(turningOf(std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}), 180, 1e-5);
}

// Points twice, or nearly: they have no direction. Steps a little longer have.
TEST(Fidelity, TurningTakesNoNoticeOfTheShortestSteps) {
  EXPECT_NEAR(turningOf(std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {1, 1e-10, 0}, {2, 0, 0}}), 0, 1e-6);
  EXPECT_NEAR(turningOf(std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {1, 1e-8, 0}, {2, 1e-8, 0}}), 180, 1e-5);
  EXPECT_NEAR(turningOf(std::vector<Vec<3>>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}}), 90, 1e-9);
}

// Where there are many segments, jags of single ones even out; where there are few they count.
TEST(Fidelity, TurningOfJags) {
  const auto jagged = [](int n) {
    std::vector<Vec<3>> chain;
    for (int k = 0; k <= n; ++k) chain.emplace_back(k, 0.3 * (k % 2), 0);
    return turningOf(chain);
  };
  EXPECT_LT(jagged(64), 1);
  EXPECT_GT(jagged(8), 200);
  EXPECT_LT(jagged(24), 60);
}

TEST(Fidelity, FaceSize) {
  const std::vector<Vec<3>> x{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
  EXPECT_DOUBLE_EQ(faceSize(x, {0, 1, 2, 3}), 3);
  EXPECT_DOUBLE_EQ(faceSize(x, {1, 2, 3, 0}), 3);
}

/// A face over a strip that bends along x as `course` says, and is as long as wanted along y.
struct Strip {
  std::vector<Vec<3>> positions;
  std::vector<SideFace> faces;
  std::vector<SideTriangle> triangles;

  Strip(const std::vector<Vec<3>> &course, double length, double column = 1) {
    for (const double y : {0.0, length})
      for (const Vec<3> &x : {course.front(), course.back()}) positions.emplace_back(x.x, y, x.z);
    faces.push_back({{0, 1, 3, 2}, 0, 0, column});
    addSide(course, 0, length);
  }
  void addSide(const std::vector<Vec<3>> &course, double from, double to, Index patch = 0) {
    for (std::size_t k = 0; k + 1 < course.size(); ++k) {
      const Vec<3> along(0, to - from, 0);
      const Vec<3> a = course[k] + Vec<3>(0, from, 0);
      const Vec<3> b = course[k + 1] + Vec<3>(0, from, 0);
      triangles.push_back({{a, b, b + along}, patch});
      triangles.push_back({{a, b + along, a + along}, patch});
    }
  }
  SideMeasures measured(int samples = 3) const { return measureSides(positions, faces, triangles, samples); }
};

TEST(Fidelity, DistanceOfASideFromItsFace) {
  for (const double degrees : {30.0, 90.0, 130.0}) {
    const SideMeasures m = Strip(arc(degrees, 8), 1).measured();
    ASSERT_EQ(m.sides.size(), 1U);
    EXPECT_NEAR(m.sides[0].distance, sagitta(degrees), 1e-9) << degrees;
    EXPECT_NEAR(m.sides[0].turning, degrees * 7 / 8, 1e-6) << degrees; // between the outermost chords
    EXPECT_TRUE(m.faults.empty());
  }
  // By the face's size, and by what is behind it.
  EXPECT_NEAR(Strip(arc(90, 8), 2, 0.8).measured().sides[0].distance, sagitta(90) / 2, 1e-9);
  EXPECT_NEAR(Strip(arc(90, 8), 2, 0.8).measured().sides[0].depth, sagitta(90) / 0.8, 1e-9);
}

// Slightly less than the bound, and slightly more.
TEST(Fidelity, DistanceBeyondTheBound) {
  EXPECT_TRUE(Strip(arc(134, 8), 1, 10).measured().faults.empty());
  const SideMeasures m = Strip(arc(135.5, 8), 1, 10).measured();
  ASSERT_EQ(m.faults.size(), 1U);
  EXPECT_EQ(m.faults[0].kind, Fault::distance);
  EXPECT_NEAR(m.faults[0].value, sagitta(135.5), 1e-9);
}

// Of the thickness: what is aimed at, and what is allowed.
TEST(Fidelity, DepthBeyondTheBounds) {
  const double off = sagitta(60);
  const auto measured = [&](double share) { return Strip(arc(60, 8), 1, off / share).measured(); };
  EXPECT_TRUE(measured(0.33).coarse.empty());
  EXPECT_EQ(measured(0.34).coarse, std::vector<Index>{0});
  EXPECT_TRUE(measured(0.66).faults.empty());
  const SideMeasures m = measured(0.67);
  ASSERT_EQ(m.faults.size(), 1U);
  EXPECT_EQ(m.faults[0].kind, Fault::depth);
  EXPECT_NEAR(m.faults[0].value, 0.67, 1e-9);
}

TEST(Fidelity, TurningBeyondTheBound) {
  EXPECT_TRUE(Strip(arc(119.0 * 8 / 7, 8), 3, 10).measured().faults.empty());
  const SideMeasures m = Strip(arc(121.0 * 8 / 7, 8), 3, 10).measured();
  ASSERT_EQ(m.faults.size(), 1U);
  EXPECT_EQ(m.faults[0].kind, Fault::turning);
  EXPECT_NEAR(m.faults[0].value, 121, 1e-6);
}

// Normals that differ by little more than rounding explains are two, others one.
TEST(Fidelity, TurningByVeryLittle) {
  const auto turning = [](double degrees) {
    const double height = std::tan(degrees / 2 * kRadian) / 2;
    return Strip({{0, 0, 0}, {0.5, 0, height}, {1, 0, 0}}, 1).measured().sides[0].turning;
  };
  EXPECT_NEAR(turning(0.05), 0.05, 1e-5);
  EXPECT_EQ(turning(0.002), 0);
}

// What is askew by little of a face's area is a sliver, or another face's by right.
TEST(Fidelity, TurningOfSlivers) {
  const auto turning = [](double share) { // of the side stands upright
    Strip strip({{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}, 1, 1);
    strip.addSide({{0.5, 0, 0}, {0.5, 0, share / (1 - share)}}, 0, 1);
    return strip.measured().sides[0].turning;
  };
  EXPECT_NEAR(turning(0.04), 0, 1e-6);
  EXPECT_NEAR(turning(0.08), 90, 1e-6);
}

// A face that reaches beyond its side is off it where its own points are, not where the side's are.
TEST(Fidelity, DistanceOfAFaceFromItsSide) {
  Strip strip({{0, 0, 0}, {1, 0, 0}}, 1);
  strip.triangles.clear();
  strip.addSide({{0, 0, 0}, {0.5, 0, 0}}, 0, 1);
  EXPECT_NEAR(strip.measured(3).sides[0].distance, 0.5, 1e-12); // at the middle of an edge
  EXPECT_NEAR(strip.measured(1).sides[0].distance, 0.5, 1e-12);
  ASSERT_EQ(strip.measured().faults.size(), 1U);
  // Nodes are another check's business.
  Strip bulged({{0, 0, 0}, {1, 0, 0}}, 1);
  bulged.positions[0].z = 0.4;
  EXPECT_LT(bulged.measured(3).sides[0].distance, 0.38);
}

// Four faces that rise in their middle, over two triangles whose corners lie on them.
TEST(Fidelity, PlacesWithinLargeTriangles) {
  Strip strip({{0, 0, 0}, {1, 0, 0}}, 1);
  strip.positions.clear();
  strip.faces.clear();
  for (int k = 0; k < 9; ++k) strip.positions.emplace_back(k % 3 / 2.0, k / 3 / 2.0, k == 4 ? 0.2 : 0.0);
  for (const Index k : {0, 1, 3, 4}) strip.faces.push_back({{k, k + 1, k + 4, k + 3}, 0, k, 1});
  EXPECT_GT(strip.measured(0).sides[0].depth, 0.15); // by the side's own places
  EXPECT_LE(strip.measured(3).sides[0].depth, 0.2);
}

TEST(Fidelity, SidesByTheirPatches) {
  Strip strip(arc(90, 8), 1);
  strip.faces[0].patch = 7;
  for (SideTriangle &t : strip.triangles) t.patch = 7;
  // Another patch's triangles do not count, however near, and its face is in another place.
  strip.addSide({{0, 0, 9}, {1, 0, 9}}, 0, 1, 3);
  const Index first = toIndex(strip.positions.size());
  for (const Vec<3> &x : {Vec<3>{0, 0, 9}, {1, 0, 9}, {1, 1, 9}, {0, 1, 9}}) strip.positions.push_back(x);
  strip.faces.push_back({{first, first + 1, first + 2, first + 3}, 3, 1, 1});
  strip.addSide(arc(30, 8), 0, 1, 5);
  const SideMeasures m = strip.measured();
  ASSERT_EQ(m.sides.size(), 2U);
  EXPECT_EQ(m.sides[0].patch, 3);
  EXPECT_NEAR(m.sides[0].distance, 0, 1e-12);
  EXPECT_EQ(m.sides[1].patch, 7);
  EXPECT_NEAR(m.sides[1].distance, sagitta(90), 1e-9);
  // A face of a side that is nowhere cannot be near it.
  strip.faces[1].patch = 4;
  ASSERT_FALSE(strip.measured().faults.empty());
  EXPECT_EQ(strip.measured().faults[0].face, 1);
}

/// Faces apart from one another, each so far above its own part of a flat side, which is in small triangles.
Strip hovering(const std::vector<double> &heights) {
  Strip strip({{0, 0, 0}, {1, 0, 0}}, 1);
  strip.positions.clear();
  strip.faces.clear();
  strip.triangles.clear();
  for (Index k = 0; k < toIndex(heights.size()); ++k) {
    for (const Vec<2> &x : {Vec<2>(0, 0), {1, 0}, {1, 1}, {0, 1}})
      strip.positions.emplace_back(3 * k + x.x, x.y, heights[at(k)]);
    strip.faces.push_back({{4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3}, 0, k, 1});
    std::vector<Vec<3>> course;
    for (int i = 0; i <= 8; ++i) course.emplace_back(3 * k + i / 8.0, 0, 0);
    for (int i = 0; i < 8; ++i) strip.addSide(course, i / 8.0, (i + 1) / 8.0);
  }
  return strip;
}

// Half of it is seen from the faces, half of it from the side.
TEST(Fidelity, VolumeBetweenFacesAndASide) {
  for (const int samples : {1, 3}) {
    EXPECT_NEAR(hovering({0.1}).measured(samples).sides[0].strayed, 0.1, 1e-12);
    EXPECT_NEAR(hovering({0.1, 0.1, 0.2}).measured(samples).sides[0].strayed, 0.4, 1e-12);
  }
}

// Those with over half as much beside them as the one with the most, in the faces' order.
TEST(Fidelity, FacesFurthestFromTheirSides) {
  Strip strip = hovering({0.11, 0.2, 0.09, 0.15});
  EXPECT_EQ(strip.measured().furthest, (std::vector<Index>{0, 1, 3}));
  strip.faces[0].patch = 1; // a side of its own, behind the others'
  for (std::size_t t = 0; t < strip.triangles.size() / 4; ++t) strip.triangles[t].patch = 1;
  EXPECT_EQ(strip.measured().furthest, (std::vector<Index>{0, 1, 3}));
  strip.faces.clear();
  EXPECT_TRUE(strip.measured().furthest.empty());
}

// Faces around a cylinder each stand for their own part of it.
TEST(Fidelity, AnOctagonInACircle) {
  Strip around({{0, 0, 0}, {1, 0, 0}}, 2);
  around.positions.clear();
  around.faces.clear();
  around.triangles.clear();
  std::vector<Vec<3>> circle;
  for (int k = 0; k <= 64; ++k)
    circle.emplace_back(std::cos(2 * std::numbers::pi * k / 64), 0, std::sin(2 * std::numbers::pi * k / 64));
  around.addSide(circle, 0, 1);
  for (Index k = 0; k < 8; ++k) {
    const Index n = toIndex(around.positions.size());
    const Vec<3> &a = circle[at(8 * k)];
    const Vec<3> &b = circle[at(8 * k + 8)];
    for (const Vec<3> &x : {a, b, b + Vec<3>(0, 1, 0), a + Vec<3>(0, 1, 0)}) around.positions.push_back(x);
    around.faces.push_back({{n, n + 1, n + 2, n + 3}, 0, k, 1});
  }
  const SideMeasures m = around.measured();
  ASSERT_EQ(m.sides.size(), 1U);
  EXPECT_NEAR(m.sides[0].distance, 1 - std::cos(std::numbers::pi / 8), 1e-9);
  EXPECT_NEAR(m.sides[0].turning, 45.0 * 7 / 8, 1e-6);
}

} // namespace
} // namespace dualblock::test
