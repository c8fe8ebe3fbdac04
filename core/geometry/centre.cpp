#include "geometry/centre.h"

#include "geometry/jacobian.h"
#include "geometry/linear_programme.h"

namespace dualblock {
namespace {

template <int N> bool hasNonPositive(const Block<N> &block, const std::vector<Vec<N>> &positions) {
  const auto coefficients = jacobianCoefficients<N>(cornersOf<N>(block.nodes, positions));
  return *std::min_element(coefficients.begin(), coefficients.end()) <= 0;
}

/// The centre's depth inside every coefficient's half-space, maximised.
template <int N>
bool moveCentre(const Block<N> *begin, const Block<N> *end, Index centre, std::vector<Vec<N>> &positions) {
  const Vec<N> start = positions[at(centre)];
  double scale = 0;
  for (const Block<N> *b = begin; b != end; ++b)
    for (const Index v : b->nodes) scale = std::max(scale, glm::length(positions[at(v)] - start));
  // Unknowns: the shift of the centre in units of scale, and the depth. An affine function is known from its
  // values at the start and one step along each axis.
  std::vector<LinearConstraint<N + 1>> constraints;
  for (const Block<N> *b = begin; b != end; ++b) {
    std::array<std::array<double, kJacobianCoefficients<N>>, N + 1> values;
    for (int k = 0; k <= N; ++k) {
      positions[at(centre)] = start;
      if (k < N) positions[at(centre)][k] += scale;
      values[at(k)] = jacobianCoefficients<N>(cornersOf<N>(b->nodes, positions));
    }
    positions[at(centre)] = start;
    for (std::size_t c = 0; c < values[0].size(); ++c) {
      LinearConstraint<N + 1> row{};
      double length = 0;
      for (int k = 0; k < N; ++k) {
        row.normal[at(k)] = -(values[at(k)][c] - values[N][c]);
        length += row.normal[at(k)] * row.normal[at(k)];
      }
      length = std::sqrt(length);
      if (length < 1e-12 * std::abs(values[N][c]) || length == 0) continue; // the centre has no say in it
      for (int k = 0; k < N; ++k) row.normal[at(k)] /= length;
      row.normal[N] = 1;
      row.bound = values[N][c] / length;
      constraints.push_back(row);
    }
  }
  std::array<double, N + 1> objective{};
  objective[N] = 1;
  const auto best = solveLinearProgramme<N + 1>(std::move(constraints), objective, 1.0);
  if (!best || (*best)[N] <= 0) return false;
  for (int k = 0; k < N; ++k) positions[at(centre)][k] = start[k] + scale * (*best)[at(k)];
  return true;
}

} // namespace

template <int N> Index validateCentres(Primal<N> &primal) {
  Index moved = 0;
  const Block<N> *const last = primal.blocks.data() + primal.blocks.size();
  for (const Block<N> *begin = primal.blocks.data(), *end = begin; begin != last; begin = end) {
    while (end != last && end->part == begin->part) ++end;
    if (std::none_of(begin, end, [&](const Block<N> &b) { return hasNonPositive(b, primal.positions); }))
      continue;
    // Node 0 of a block is inside of no D-bar-surface: the part's centre.
    if (moveCentre<N>(begin, end, begin->nodes[0], primal.positions)) ++moved;
  }
  return moved;
}

template Index validateCentres(Primal<2> &);
template Index validateCentres(Primal<3> &);

} // namespace dualblock
