// The Jacobian determinant of blocks: the certificate's sign against exact values and samples, and its
// Bernstein form, built by polynomial multiplication, against the construction's formula.
#include "geometry/jacobian.h"

#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "certificate/checks.h"
#include "support/signed_measure.h"

namespace dualblock::test {
namespace {

template <int N> using Corners = std::array<Vec<N>, 1 << N>;

/// Parameters of corner k in VTK's order.
constexpr int kParameters[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// `grid`^N times the determinant at the point with parameters `p` / `grid`, from the definition of the
/// multilinear map; exact for T = std::int64_t and small integer corners.
template <int N, typename T>
T determinantAt(const std::array<std::array<T, N>, 1 << N> &corners, const std::array<T, N> &p, T grid) {
  std::array<std::array<T, N>, N> d{}; // d[axis]: grid^(N - 1) times the derivative
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (std::size_t axis = 0; axis < N; ++axis) {
      T weight = kParameters[k][axis] ? 1 : -1;
      for (std::size_t other = 0; other < N; ++other)
        if (other != axis) weight *= kParameters[k][other] ? p[other] : grid - p[other];
      for (std::size_t x = 0; x < N; ++x) d[axis][x] += weight * corners[k][x];
    }
  if constexpr (N == 2) return d[0][0] * d[1][1] - d[0][1] * d[1][0];
  else
    return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
           d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
           d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

template <int N, typename Visit> void forGrid(int grid, Visit visit) {
  for (int k = 0; k <= (N == 3 ? grid : 0); ++k)
    for (int j = 0; j <= grid; ++j)
      for (int i = 0; i <= grid; ++i) {
        if constexpr (N == 2) visit(std::array<int, 2>{i, j});
        else visit(std::array<int, 3>{i, j, k});
      }
}

/// A unit block with every coordinate moved by up to `noise`.
template <int N> Corners<N> randomBlock(std::mt19937 &random, double noise) {
  Corners<N> corners;
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (int x = 0; x < N; ++x)
      corners[k][x] = kParameters[k][x] + noise * (static_cast<double>(random()) / 2147483647.5 - 1);
  return corners;
}

template <int N> double sampledMinimum(const Corners<N> &corners, int grid) {
  std::array<std::array<double, N>, 1 << N> plain;
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (int x = 0; x < N; ++x) plain[k][static_cast<std::size_t>(x)] = corners[k][x];
  double least = std::numeric_limits<double>::infinity();
  forGrid<N>(grid, [&](const std::array<int, N> &p) {
    std::array<double, N> at;
    for (std::size_t x = 0; x < N; ++x) at[x] = static_cast<double>(p[x]) / grid;
    least = std::min(least, determinantAt<N, double>(plain, at, 1.0));
  });
  return least;
}

template <typename Dimension> class Jacobian : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Jacobian, Dimensions);

TYPED_TEST(Jacobian, SignAgainstSampling) {
  constexpr int N = TypeParam::value;
  std::array<int, 3> count{};
  for (std::uint32_t seed = 0; seed < 1500; ++seed) {
    std::mt19937 random(seed);
    const Corners<N> corners = randomBlock<N>(random, 0.05 + (N == 2 ? 0.008 : 0.005) * (seed % 100));
    double ratio = 0;
    const int sign = jacobianSign<N>(corners, ratio);
    ++count[static_cast<std::size_t>(sign + 1)];
    const double least = sampledMinimum<N>(corners, 8);
    if (sign > 0) {
      ASSERT_GT(least, 0) << "seed " << seed;
    }
    if (least <= -1e-9) {
      ASSERT_LE(sign, 0) << "seed " << seed;
    }
    if (ratio > 0) {
      ASSERT_EQ(sign, 1) << "all coefficients are positive, seed " << seed;
    }
    // It does not give up on blocks that are good by a margin.
    if (least > 0.1) {
      EXPECT_EQ(sign, 1) << "seed " << seed << ", minimum " << least;
    }
  }
  EXPECT_GT(count[0], 100);
  EXPECT_GT(count[2], 300);
}

// Integer corners: exact determinants on a grid, and exact coefficients from the values at 0, 1/2 and 1.
TYPED_TEST(Jacobian, SignAndCoefficientsAgainstExactArithmetic) {
  constexpr int N = TypeParam::value;
  using Integer = std::int64_t;
  int certified = 0;
  int refuted = 0;
  int onlyInside = 0; // positive at all corners, and yet not everywhere
  for (std::uint32_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::array<std::array<Integer, N>, 1 << N> exact;
    Corners<N> corners;
    const unsigned spread = 1 + seed % 4;
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (std::size_t x = 0; x < N; ++x) {
        exact[k][x] = 4 * kParameters[k][x] + static_cast<Integer>(random() % (2 * spread + 1)) -
                      static_cast<Integer>(spread);
        corners[k][static_cast<int>(x)] = static_cast<double>(exact[k][x]);
      }
    const auto valueAt = [&](const std::array<int, N> &p, Integer grid) {
      std::array<Integer, N> q;
      for (std::size_t x = 0; x < N; ++x) q[x] = p[x];
      return determinantAt<N, Integer>(exact, q, grid);
    };
    Integer least = std::numeric_limits<Integer>::max();
    Integer leastCorner = least;
    forGrid<N>(6, [&](const std::array<int, N> &p) { least = std::min(least, valueAt(p, 6)); });
    forGrid<N>(1, [&](const std::array<int, N> &p) { leastCorner = std::min(leastCorner, valueAt(p, 1)); });
    double ratio = 0;
    const int sign = jacobianSign<N>(corners, ratio);
    if (least <= 0) {
      ASSERT_LE(sign, 0) << "the determinant is " << least << " / 6^k at a point";
    }
    if (leastCorner <= 0) {
      ASSERT_EQ(sign, -1);
    }
    onlyInside += least <= 0 && leastCorner > 0 ? 1 : 0;
    (sign > 0 ? certified : refuted) += 1;

    const auto coefficients = jacobianCoefficients<N>(corners);
    if constexpr (N == 2) {
      for (unsigned bits = 0; bits < 4; ++bits) // degree 1: values at the corners
        EXPECT_EQ(coefficients[bits],
                  static_cast<double>(valueAt({static_cast<int>(bits & 1), static_cast<int>(bits >> 1)}, 1)));
    } else {
      // Degree 2 on each axis: c0 = f(0), c1 = 2 f(1/2) - (f(0) + f(1)) / 2, c2 = f(1), axis after axis, in
      // units of 1 / 512. Values carry 2^6 as derivatives are of degree 2 in the grid; 2^3 are for the
      // halves.
      std::array<Integer, 27> c;
      for (std::size_t n = 0; n < 27; ++n)
        c[n] =
            8 * valueAt({static_cast<int>(n % 3), static_cast<int>(n / 3 % 3), static_cast<int>(n / 9)}, 2);
      for (const std::size_t step : {1U, 3U, 9U})
        for (std::size_t n = 0; n < 27; ++n)
          if (n / step % 3 == 1) c[n] = (4 * c[n] - c[n - step] - c[n + step]) / 2;
      for (std::size_t n = 0; n < 27; ++n)
        EXPECT_NEAR(coefficients[n], static_cast<double>(c[n]) / 512, 1e-10) << n;
    }
  }
  EXPECT_GT(certified, 300);
  EXPECT_GT(refuted, 300);
  if (N == 3) {
    EXPECT_GT(onlyInside, 0) << "no trial showed that corner values do not suffice";
  }
}

TYPED_TEST(Jacobian, CoefficientsAgreeWithTheCertificates) {
  constexpr int N = TypeParam::value;
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    const Corners<N> corners = randomBlock<N>(random, 0.4);
    double ratio = 0;
    jacobianSign<N>(corners, ratio);
    const auto c = jacobianCoefficients<N>(corners);
    const auto [low, high] = std::minmax_element(c.begin(), c.end());
    EXPECT_NEAR(ratio, *low / *high, 1e-12) << "seed " << seed;
  }
}

TYPED_TEST(Jacobian, KnownBlocks) {
  constexpr int N = TypeParam::value;
  std::mt19937 random(1);
  const Corners<N> unit = randomBlock<N>(random, 0);
  double ratio = 0;
  EXPECT_EQ(jacobianSign<N>(unit, ratio), 1);
  EXPECT_DOUBLE_EQ(ratio, 1);
  EXPECT_DOUBLE_EQ(scaledJacobian<N>(unit), 1);
  EXPECT_DOUBLE_EQ(signedMeasure<N>(unit), 1);
  Corners<N> mirrored = unit;
  for (Vec<N> &x : mirrored) x[0] = -x[0];
  EXPECT_EQ(jacobianSign<N>(mirrored, ratio), -1);
  EXPECT_DOUBLE_EQ(scaledJacobian<N>(mirrored), -1);
  EXPECT_DOUBLE_EQ(signedMeasure<N>(mirrored), -1);
  Corners<N> flat = unit;
  for (Vec<N> &x : flat) x[N - 1] = 0;
  EXPECT_EQ(jacobianSign<N>(flat, ratio), -1);
  // Far from the origin, where coordinates have lost their last digits, it must not claim what it cannot
  // know.
  Corners<N> far = unit;
  for (Vec<N> &x : far) {
    x *= 1e-9;
    x += Vec<N>(1e6);
  }
  EXPECT_LE(jacobianSign<N>(far, ratio), 0);
}

// Within what rounding may make of the determinant nothing is claimed, and beyond it is.
TYPED_TEST(Jacobian, RoundingFarFromTheOrigin) {
  constexpr int N = TypeParam::value;
  std::mt19937 random(1);
  const Corners<N> unit = randomBlock<N>(random, 0);
  for (const auto &[size, sign] : {std::pair{0x1p-30, -1}, {0x1p-23, 1}}) { // the limit: 2^-26 at 2^20
    Corners<N> far = unit;
    for (Vec<N> &x : far) {
      x *= size;
      x += Vec<N>(0x1p20);
    }
    double ratio = 0;
    EXPECT_EQ(jacobianSign<N>(far, ratio), sign) << size;
    EXPECT_EQ(ratio, 1);
  }
}

// The measure is the integral: against Simpson's rule, which is exact for degree 2 per axis.
TYPED_TEST(Jacobian, MeasureIsTheIntegral) {
  constexpr int N = TypeParam::value;
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const Corners<N> corners = randomBlock<N>(random, 0.5);
    std::array<std::array<double, N>, 1 << N> plain;
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (int x = 0; x < N; ++x) plain[k][static_cast<std::size_t>(x)] = corners[k][x];
    double integral = 0;
    forGrid<N>(2, [&](const std::array<int, N> &p) {
      std::array<double, N> at;
      double weight = 1;
      for (std::size_t x = 0; x < N; ++x) {
        at[x] = p[x] / 2.0;
        weight *= p[x] == 1 ? 4.0 / 6 : 1.0 / 6;
      }
      integral += weight * determinantAt<N, double>(plain, at, 1.0);
    });
    EXPECT_NEAR(signedMeasure<N>(corners), integral, 1e-12);
  }
}

} // namespace
} // namespace dualblock::test
