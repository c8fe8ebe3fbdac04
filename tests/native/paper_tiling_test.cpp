// The paper's triangulations of the contributions (4.1, figure 8) tile them exactly, with one correction, and
// no other contribution passes through the inside of a triangle. All in integers.
#include <bit>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

#include "support/display_triangulation.h"

namespace dualblock::test {
namespace {

using Point = std::array<std::int64_t, 2>; // in the contribution's plane, affine coordinates
using Triangle = std::array<Point, 3>;

std::int64_t area2(const Point &a, const Point &b, const Point &c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether the insides of two triangles are disjoint: for convex shapes an edge of one must separate them.
bool disjoint(const Triangle &a, const Triangle &b) {
  for (const auto &[first, second] : {std::pair(a, b), std::pair(b, a)})
    for (std::size_t k = 0; k < 3; ++k) {
      const Point &p = first[k];
      const Point &q = first[(k + 1) % 3];
      const std::int64_t own = area2(p, q, first[(k + 2) % 3]);
      bool separates = true;
      for (const Point &x : second) separates &= own > 0 ? area2(p, q, x) <= 0 : area2(p, q, x) >= 0;
      if (separates) return true;
    }
  return false;
}

/// The triangles in the plane, given the places of the contribution's corners there.
template <std::size_t C, std::size_t P, std::size_t T>
std::vector<Triangle> place(const DisplayTriangulation<C, P, T> &table, const std::array<Point, C> &corners) {
  std::vector<Triangle> triangles;
  for (const auto &t : table.triangles) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < C; ++c)
        for (std::size_t x = 0; x < 2; ++x)
          triangle[k][x] += table.points[static_cast<std::size_t>(t[k])][c] * corners[c][x];
    triangles.push_back(triangle);
  }
  return triangles;
}

/// Triangles inside a convex polygon, disjoint, and of its area: they cover it.
template <std::size_t C>
void expectTiling(const std::vector<Triangle> &triangles, const std::array<Point, C> &corners) {
  std::array<Point, C> polygon = corners;
  for (Point &p : polygon) p = {p[0] * kDisplayUnits, p[1] * kDisplayUnits};
  std::int64_t whole = 0;
  for (std::size_t k = 1; k + 1 < C; ++k) whole += area2(polygon[0], polygon[k], polygon[k + 1]);
  ASSERT_GT(whole, 0);
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < triangles.size(); ++a) {
    const std::int64_t area = std::abs(area2(triangles[a][0], triangles[a][1], triangles[a][2]));
    EXPECT_GT(area, 0) << "triangle " << a;
    sum += area;
    for (const Point &x : triangles[a])
      for (std::size_t k = 0; k < C; ++k)
        EXPECT_GE(area2(polygon[k], polygon[(k + 1) % C], x), 0) << "triangle " << a;
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_TRUE(disjoint(triangles[a], triangles[b])) << a << " and " << b;
  }
  EXPECT_EQ(sum, whole);
}

constexpr std::array<Point, 3> kTriangle = {{{0, 0}, {1, 0}, {0, 1}}};
constexpr std::array<Point, 4> kParallelogram = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}; // r1 - r2 = r4 - r3

TEST(PaperTiling, WeightsAddUp) {
  const auto check = [](const auto &table) {
    for (const auto &point : table.points) {
      int sum = 0;
      for (const int w : point) sum += w;
      EXPECT_EQ(sum, kDisplayUnits);
    }
  };
  check(kFaceDisplay);
  check(kEdgeDisplay);
  check(kNodeDisplay);
}

TEST(PaperTiling, Face) { expectTiling(place(kFaceDisplay, kTriangle), kTriangle); }
TEST(PaperTiling, Edge) { expectTiling(place(kEdgeDisplay, kParallelogram), kParallelogram); }
TEST(PaperTiling, Node) { expectTiling(place(kNodeDisplay, kTriangle), kTriangle); }

// r12 = (r1 + r2 + r231 + r412) / 4 and r34 likewise, as the paper defines them.
TEST(PaperTiling, CentresOfTheEdgeContribution) {
  for (std::size_t c = 0; c < 4; ++c) {
    const auto &p = kEdgeDisplay.points;
    EXPECT_EQ(4 * p[8][c], p[0][c] + p[1][c] + p[4][c] + p[7][c]);
    EXPECT_EQ(4 * p[9][c], p[2][c] + p[3][c] + p[6][c] + p[5][c]);
  }
}

TEST(PaperTiling, ThePrintedTriangleOverlapsItsNeighbour) {
  auto printed = kEdgeDisplay;
  printed.triangles[kEdgeDisplayCorrected] = kEdgeDisplayAsPrinted;
  const std::vector<Triangle> triangles = place(printed, kParallelogram);
  const std::size_t wrong = kEdgeDisplayCorrected;
  EXPECT_FALSE(disjoint(triangles[wrong], triangles[4])) << "with {r411, r231, r232}";
  // It leaves {r412, r231, r411} partly bare, although the areas add up.
  const Triangle right = place(kEdgeDisplay, kParallelogram)[wrong];
  EXPECT_NE(triangles[wrong], right);
  std::int64_t sum = 0;
  for (const Triangle &t : triangles) sum += std::abs(area2(t[0], t[1], t[2]));
  EXPECT_EQ(sum, 2 * kDisplayUnits * kDisplayUnits);
}

/// Barycentric coordinates in the tetrahedron, in units of 1 / (5 kDisplayUnits), of a triangulation whose
/// corner c lies at 4/5 vertex near[c] and 1/5 vertex far[c].
template <std::size_t C, std::size_t P, std::size_t T>
void expectCutByNone(const DisplayTriangulation<C, P, T> &table, const std::array<std::size_t, C> &near,
                     const std::array<std::size_t, C> &far, unsigned own) {
  const auto level = [](const std::array<int, 4> &point, unsigned mask) {
    int sum = -4 * kDisplayUnits;
    for (std::size_t v = 0; v < 4; ++v)
      if (mask >> v & 1) sum += point[v];
    return sum;
  };
  for (const auto &t : table.triangles) {
    std::array<std::array<int, 4>, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < C; ++c) {
        corners[k][near[c]] += 4 * table.points[static_cast<std::size_t>(t[k])][c];
        corners[k][far[c]] += table.points[static_cast<std::size_t>(t[k])][c];
      }
    for (unsigned mask = 1; mask < 15; ++mask) {
      bool above = false;
      bool below = false;
      for (const auto &corner : corners) {
        if (mask == own) { // it lies on its own contribution
          EXPECT_EQ(level(corner, mask), 0);
        }
        above |= level(corner, mask) > 0;
        below |= level(corner, mask) < 0;
      }
      EXPECT_FALSE(above && below) << "contribution " << mask << " cuts a triangle of contribution " << own;
    }
  }
}

// "To capture all the possible intersections with other local dual contributions" (4.1).
TEST(PaperTiling, NoContributionPassesThroughATriangle) {
  expectCutByNone<3, 12, 13>(kFaceDisplay, {0, 1, 2}, {3, 3, 3}, 0b0111);
  expectCutByNone<4, 10, 10>(kEdgeDisplay, {0, 0, 1, 1}, {3, 2, 2, 3}, 0b0011);
  expectCutByNone<3, 3, 1>(kNodeDisplay, {0, 0, 0}, {1, 2, 3}, 0b0001);
}

} // namespace
} // namespace dualblock::test
