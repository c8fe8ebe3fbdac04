// Plain arithmetic in TetGen's predicates where it is exact: against integers, and against TetGen as it is.
#include "toolchain/point_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "domain/prepare.h"
#include "reference/tetgen_adaptor.h"
#include "support/voxels.h"

double orient3dfast(double *, double *, double *, double *); // predicates.cxx
double inspherefast(double *, double *, double *, double *, double *);

namespace dualblock {
namespace {

using Whole = std::array<std::int64_t, 3>;

Whole operator-(const Whole &a, const Whole &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

std::int64_t dot(const Whole &a, const Whole &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::int64_t determinant(const Whole &a, const Whole &b, const Whole &c) {
  return dot(a, {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]});
}

/// Expanded along the lifts: TetGen's formula groups the columns otherwise.
std::int64_t insphere(const std::array<Whole, 5> &p) {
  const Whole a = p[0] - p[4];
  const Whole b = p[1] - p[4];
  const Whole c = p[2] - p[4];
  const Whole d = p[3] - p[4];
  return dot(d, d) * determinant(a, b, c) - dot(c, c) * determinant(a, b, d) +
         dot(b, b) * determinant(a, c, d) - dot(a, a) * determinant(b, c, d);
}

TEST(PointGrid, PlainArithmeticIsExactUpToTheLongestExtent) {
  std::mt19937 random(5);
  constexpr double kStep = 0x1p-3;
  constexpr std::array<double, 3> kOrigin{1000, -70000.125, 0.25}; // multiples of the step
  for (int round = 0; round < 20000; ++round) {
    std::array<Whole, 5> whole;
    std::array<std::array<double, 3>, 5> point;
    for (std::size_t p = 0; p < 5; ++p)
      for (std::size_t k = 0; k < 3; ++k) {
        // The box's own corners too, where the determinants are largest.
        whole[p][k] = round % 3 == 0 ? 512 * static_cast<std::int64_t>(random() % 2)
                                     : static_cast<std::int64_t>(random() % 513);
        point[p][k] = kOrigin[k] + kStep * static_cast<double>(whole[p][k]);
      }
    PointGrid grid;
    grid.lay(point[0].data(), 5);
    ASSERT_TRUE(grid.has(point[0].data(), point[4].data()));
    const double orient = orient3dfast(point[0].data(), point[1].data(), point[2].data(), point[3].data());
    ASSERT_EQ(
        orient / std::pow(kStep, 3),
        static_cast<double>(determinant(whole[0] - whole[3], whole[1] - whole[3], whole[2] - whole[3])));
    const double sphere =
        inspherefast(point[0].data(), point[1].data(), point[2].data(), point[3].data(), point[4].data());
    ASSERT_EQ(sphere / std::pow(kStep, 5), static_cast<double>(insphere(whole)));
  }
}

bool isLaid(std::vector<double> points) {
  PointGrid grid;
  grid.lay(points.data(), static_cast<int>(points.size() / 3));
  return grid.has(points.data());
}

TEST(PointGrid, IsLaidOnlyWhereArithmeticIsExact) {
  EXPECT_TRUE(isLaid({0, 0, 0, 512, 1, 1}));
  EXPECT_FALSE(isLaid({0, 0, 0, 513, 1, 1}));
  EXPECT_TRUE(isLaid({-3, 5, 2.5, 7, 8, 9}));
  EXPECT_FALSE(isLaid({0, 0, 0, 1, 0.1, 0.2}));           // tenths have many digits
  EXPECT_FALSE(isLaid({0x1p45, 0, 0, 0x1p45 + 1, 1, 1})); // too far to tell half steps
  EXPECT_FALSE(isLaid({0, 0, 0, 0x1p-300, 0x1p-300, 0})); // the fifth power underflows
  EXPECT_FALSE(isLaid({0, 0, 0, 0, 0, 0}));
}

TEST(PointGrid, KnowsPointsOffTheGrid) {
  const std::array<double, 6> points{0, 0, 0, 100, 100, 100.25};
  PointGrid grid;
  grid.lay(points.data(), 2);
  const std::array<double, 3> on{99.75, 0.5, 3};
  EXPECT_TRUE(grid.has(on.data(), points.data()));
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> off = on;
    off[k] += 0x1p-40;
    EXPECT_FALSE(grid.has(on.data(), off.data()));
  }
}

TEST(PointGrid, TetgenFillsAsWithoutIt) {
  std::mt19937 random(11);
  for (int round = 0; round < 12; ++round) {
    std::array<int, 216> isFull{};
    for (int &cell : isFull) cell = random() % 3 == 0 ? 1 : 0;
    Domain<3> given =
        test::voxelDomain(6, [&](int i, int j, int k) { return isFull[at((i * 6 + j) * 6 + k)]; });
    for (Vec<3> &v : given.vertices) v = v * 0.375 + Vec<3>{10, -3, 0.125};
    const auto prepared = prepareDomain(given, 1e-6);
    ASSERT_TRUE(prepared.ok());
    TetgenOptions options{domainSize(given.vertices)};
    if (round % 2 == 1) options.maxVolume = 0.01; // with points off the grid
    const auto fill = [&] {
      return runTetgen(prepared.value().domain.vertices, prepared.value().domain.facets, options);
    };
    const auto with = fill();
    options.onGrid = false;
    const auto without = fill();
    ASSERT_TRUE(with.ok() && without.ok()) << "round " << round;
    EXPECT_EQ(with.value().nodes, without.value().nodes);
    EXPECT_EQ(with.value().simplices, without.value().simplices);
    EXPECT_EQ(with.value().faces, without.value().faces);
  }
}

} // namespace
} // namespace dualblock
