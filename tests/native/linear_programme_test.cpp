// The small linear programmes of centre placement (ARCHITECTURE.md 5) against brute force: the optimum of a
// bounded feasible programme is at a vertex, where as many constraints as there are variables meet. The
// programmes have small integer coefficients, so feasibility of a vertex is decided exactly.
#include "geometry/linear_programme.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace dualblock::test {
namespace {

using Integer = std::int64_t;

template <std::size_t D> struct Row {
  std::array<Integer, D> normal;
  Integer bound;
};

template <std::size_t D> Integer determinant(const std::array<std::array<Integer, D>, D> &m) {
  if constexpr (D == 1) {
    return m[0][0];
  } else {
    Integer sum = 0;
    for (std::size_t k = 0; k < D; ++k) {
      std::array<std::array<Integer, D - 1>, D - 1> minor;
      for (std::size_t r = 1; r < D; ++r)
        for (std::size_t c = 0, n = 0; c < D; ++c)
          if (c != k) minor[r - 1][n++] = m[r][c];
      sum += (k % 2 == 0 ? 1 : -1) * m[0][k] * determinant<D - 1>(minor);
    }
    return sum;
  }
}

/// The largest objective over all feasible vertices, by Cramer's rule; empty if there is none.
template <std::size_t D>
std::optional<double> bruteForce(std::vector<Row<D>> rows, const std::array<Integer, D> &objective,
                                 Integer box) {
  for (std::size_t k = 0; k < D; ++k)
    for (const Integer sign : {1, -1}) {
      Row<D> row{{}, box};
      row.normal[k] = sign;
      rows.push_back(row);
    }
  std::optional<double> best;
  std::array<std::size_t, D> chosen;
  for (std::size_t k = 0; k < D; ++k) chosen[k] = k;
  while (true) {
    std::array<std::array<Integer, D>, D> matrix;
    for (std::size_t k = 0; k < D; ++k) matrix[k] = rows[chosen[k]].normal;
    Integer divisor = determinant<D>(matrix);
    if (divisor != 0) {
      std::array<Integer, D> x;
      for (std::size_t v = 0; v < D; ++v) {
        auto replaced = matrix;
        for (std::size_t k = 0; k < D; ++k) replaced[k][v] = rows[chosen[k]].bound;
        x[v] = determinant<D>(replaced) * (divisor < 0 ? -1 : 1);
      }
      divisor = std::abs(divisor);
      bool feasible = true;
      for (const Row<D> &row : rows) {
        Integer value = 0;
        for (std::size_t v = 0; v < D; ++v) value += row.normal[v] * x[v];
        feasible &= value <= row.bound * divisor;
      }
      if (feasible) {
        Integer value = 0;
        for (std::size_t v = 0; v < D; ++v) value += objective[v] * x[v];
        const double here = static_cast<double>(value) / static_cast<double>(divisor);
        if (!best || here > *best) best = here;
      }
    }
    // The next combination.
    std::size_t k = D;
    while (k > 0 && chosen[k - 1] == rows.size() - D + k - 1) --k;
    if (k == 0) return best;
    ++chosen[k - 1];
    for (; k < D; ++k) chosen[k] = chosen[k - 1] + 1;
  }
}

template <std::size_t D> class Trial {
public:
  explicit Trial(std::uint32_t seed) : random_(seed) {
    const std::size_t count = 1 + random_() % (D == 4 ? 8 : 12);
    for (std::size_t k = 0; k < count; ++k) {
      Row<D> row{};
      for (Integer &c : row.normal) c = pick(5);
      row.bound = pick(8) + 3; // more often feasible than not
      rows.push_back(row);
    }
    for (Integer &c : objective) c = pick(5);
  }

  std::optional<std::array<double, D>> solve(double box) const {
    std::vector<LinearConstraint<D>> constraints;
    for (const Row<D> &row : rows) {
      LinearConstraint<D> c{{}, static_cast<double>(row.bound)};
      for (std::size_t k = 0; k < D; ++k) c.normal[k] = static_cast<double>(row.normal[k]);
      constraints.push_back(c);
    }
    std::array<double, D> goal{};
    for (std::size_t k = 0; k < D; ++k) goal[k] = static_cast<double>(objective[k]);
    return solveLinearProgramme<D>(constraints, goal, box);
  }

  std::vector<Row<D>> rows;
  std::array<Integer, D> objective{};

private:
  Integer pick(Integer limit) {
    return static_cast<Integer>(random_() % static_cast<unsigned>(2 * limit + 1)) - limit;
  }
  std::mt19937 random_;
};

template <std::size_t D> void compare(int trials) {
  constexpr Integer kBox = 10;
  int feasible = 0;
  int infeasible = 0;
  for (int t = 0; t < trials; ++t) {
    const auto seed = static_cast<std::uint32_t>(1000 * D + static_cast<std::size_t>(t));
    SCOPED_TRACE("dimension " + std::to_string(D) + ", seed " + std::to_string(seed));
    const Trial<D> trial(seed);
    const auto found = trial.solve(kBox);
    const auto expected = bruteForce<D>(trial.rows, trial.objective, kBox);
    ASSERT_EQ(found.has_value(), expected.has_value());
    ++(found ? feasible : infeasible);
    if (!found) continue;
    double value = 0;
    for (std::size_t k = 0; k < D; ++k) {
      value += static_cast<double>(trial.objective[k]) * (*found)[k];
      EXPECT_LE(std::abs((*found)[k]), kBox + 1e-9);
    }
    EXPECT_NEAR(value, *expected, 1e-9);
    for (const Row<D> &row : trial.rows) {
      double left = 0;
      for (std::size_t k = 0; k < D; ++k) left += static_cast<double>(row.normal[k]) * (*found)[k];
      EXPECT_LE(left, static_cast<double>(row.bound) + 1e-9);
    }
  }
  EXPECT_GT(feasible, trials / 20);
  EXPECT_GT(infeasible, trials / 50);
}

TEST(LinearProgramme, OneVariable) { compare<1>(2000); }
TEST(LinearProgramme, TwoVariables) { compare<2>(2000); }
TEST(LinearProgramme, ThreeVariables) { compare<3>(800); }
TEST(LinearProgramme, FourVariables) { compare<4>(250); }

TEST(LinearProgramme, EdgeCases) {
  EXPECT_EQ((solveLinearProgramme<2>({}, {1, -1}, 3)), (std::array<double, 2>{3, -3}));
  EXPECT_FALSE((solveLinearProgramme<2>({{{0, 0}, -1}}, {1, 1}, 3))) << "0 <= -1";
  EXPECT_TRUE((solveLinearProgramme<2>({{{0, 0}, 0}}, {1, 1}, 3))) << "0 <= 0";
  EXPECT_FALSE((solveLinearProgramme<2>({{{1, 0}, -4}}, {1, 1}, 3))) << "outside the box";
  const auto point =
      solveLinearProgramme<2>({{{1, 0}, 1}, {{-1, 0}, -1}, {{0, 1}, 2}, {{0, -1}, -2}}, {1, 1}, 5);
  ASSERT_TRUE(point) << "a single point is feasible";
  EXPECT_EQ(*point, (std::array<double, 2>{1, 2}));
}

} // namespace
} // namespace dualblock::test
