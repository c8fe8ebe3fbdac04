// Exact feasibility of strict linear inequalities in a few variables, by Fourier-Motzkin elimination in
// integers: an oracle that shares nothing with the lattice of the core's region tables.
#pragma once

#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

namespace dualblock::test {

/// coefficients[0] x_0 + ... + coefficients[n - 1] x_{n-1} + coefficients[n] > 0
using Strict = std::vector<std::int64_t>;

/// Divides by the greatest common divisor, so that numbers stay small and equal rows are equal.
inline Strict reduced(Strict row) {
  std::int64_t divisor = 0;
  for (const std::int64_t c : row) divisor = std::gcd(divisor, c);
  if (divisor > 1)
    for (std::int64_t &c : row) c /= divisor;
  return row;
}

/// Whether some real point satisfies all rows, which have equal length.
inline bool feasible(const std::vector<Strict> &system) {
  std::set<Strict> rows;
  for (const Strict &row : system) rows.insert(reduced(row));
  std::size_t variables = system.empty() ? 0 : system[0].size() - 1;
  while (variables > 0) {
    const std::size_t x = --variables;
    std::set<Strict> next;
    for (const Strict &row : rows)
      if (row[x] == 0) next.insert(row);
    for (const Strict &low : rows) {
      if (low[x] <= 0) continue;
      for (const Strict &high : rows) {
        if (high[x] >= 0) continue;
        Strict sum(low.size());
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = -high[x] * low[k] + low[x] * high[k];
        next.insert(reduced(sum));
      }
    }
    rows = std::move(next);
  }
  for (const Strict &row : rows)
    if (row.back() <= 0) return false;
  return true;
}

} // namespace dualblock::test
