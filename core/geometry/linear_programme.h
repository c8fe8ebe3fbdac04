// Seidel's incremental linear programme for a few variables and any number of constraints (R. Seidel,
// "Small-dimensional linear programming and convex hulls made easy", 1991). Expected time is linear in the
// constraints; the order they are visited in is shuffled by a fixed seed, so the result is deterministic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace dualblock {

/// dot(normal, x) <= bound
template <std::size_t D> struct LinearConstraint {
  std::array<double, D> normal;
  double bound;
};

/// Maximises dot(objective, x) over the constraints and the box |x_k| <= box. Empty if infeasible.
template <std::size_t D>
std::optional<std::array<double, D>> solveLinearProgramme(std::vector<LinearConstraint<D>> constraints,
                                                          const std::array<double, D> &objective,
                                                          double box) {
  constexpr double kTiny = 1e-12;
  std::array<double, D> x{};
  if constexpr (D == 1) {
    double low = -box;
    double high = box;
    for (const auto &c : constraints) {
      if (std::abs(c.normal[0]) < kTiny) {
        if (c.bound < -kTiny) return std::nullopt;
        continue;
      }
      const double at = c.bound / c.normal[0];
      if (c.normal[0] > 0) high = std::min(high, at);
      else low = std::max(low, at);
    }
    if (low > high + kTiny) return std::nullopt;
    x[0] = objective[0] >= 0 ? high : low;
    return x;
  } else {
    for (std::size_t k = 0; k < D; ++k) x[k] = objective[k] >= 0 ? box : -box;
    std::mt19937 random(7);
    for (std::size_t i = constraints.size(); i > 1; --i)
      std::swap(constraints[i - 1], constraints[random() % i]);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const auto &c = constraints[i];
      double value = -c.bound;
      for (std::size_t k = 0; k < D; ++k) value += c.normal[k] * x[k];
      if (value <= kTiny) continue;
      // The optimum lies on this constraint: eliminate its largest variable.
      std::size_t pivot = 0;
      for (std::size_t k = 1; k < D; ++k)
        if (std::abs(c.normal[k]) > std::abs(c.normal[pivot])) pivot = k;
      if (std::abs(c.normal[pivot]) < kTiny) return std::nullopt;
      const auto substitute = [&](const std::array<double, D> &row, double bound) {
        LinearConstraint<D - 1> reduced{};
        const double factor = row[pivot] / c.normal[pivot];
        for (std::size_t k = 0, m = 0; k < D; ++k)
          if (k != pivot) reduced.normal[m++] = row[k] - factor * c.normal[k];
        reduced.bound = bound - factor * c.bound;
        return reduced;
      };
      std::vector<LinearConstraint<D - 1>> reduced;
      for (std::size_t j = 0; j < i; ++j)
        reduced.push_back(substitute(constraints[j].normal, constraints[j].bound));
      for (const double sign : {1.0, -1.0}) { // the box of the eliminated variable
        std::array<double, D> row{};
        row[pivot] = sign;
        reduced.push_back(substitute(row, box));
      }
      const auto lower =
          solveLinearProgramme<D - 1>(std::move(reduced), substitute(objective, 0).normal, box);
      if (!lower) return std::nullopt;
      double rest = c.bound;
      for (std::size_t k = 0, m = 0; k < D; ++k)
        if (k != pivot) {
          x[k] = (*lower)[m++];
          rest -= c.normal[k] * x[k];
        }
      x[pivot] = rest / c.normal[pivot];
    }
    return x;
  }
}

} // namespace dualblock
