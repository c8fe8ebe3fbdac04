#include "geometry/jacobian.h"

#include <algorithm>
#include <limits>

namespace dualblock {
namespace {

double det(const Vec<2> &a, const Vec<2> &b) { return a.x * b.y - a.y * b.x; }
double det(const Vec<3> &a, const Vec<3> &b, const Vec<3> &c) { return glm::dot(a, glm::cross(b, c)); }

/// The number of the corner that has the bits of its parameters.
template <int N> constexpr auto cornerTable() {
  std::array<std::size_t, 1 << N> table{};
  for (std::size_t k = 0; k < table.size(); ++k) table[kBlockBits<N>[k]] = k;
  return table;
}
template <int N> inline constexpr auto kCornerOfBits = cornerTable<N>();

/// The edge along `axis` that starts at the corner given by `bits` (the axis' own bit is ignored).
template <int N> Vec<N> edgeAlong(const std::array<Vec<N>, 1 << N> &corners, int axis, unsigned bits) {
  const unsigned low = bits & ~(1U << axis);
  return corners[kCornerOfBits<N>[low | 1U << axis]] - corners[kCornerOfBits<N>[low]];
}

} // namespace

template <int N>
std::array<double, kJacobianCoefficients<N>> jacobianCoefficients(const std::array<Vec<N>, 1 << N> &corners) {
  std::array<double, kJacobianCoefficients<N>> result{};
  if constexpr (N == 2) {
    for (unsigned bits = 0; bits < 4; ++bits)
      result[bits] = det(edgeAlong<2>(corners, 0, bits), edgeAlong<2>(corners, 1, bits));
  } else {
    // d/du has degree (0,1,1), d/dv (1,0,1), d/dw (1,1,0). Along each axis two of the three vary linearly;
    // the product of two linear Bernstein forms has the quadratic coefficients x0 y0, (x0 y1 + x1 y0) / 2, x1
    // y1.
    std::array<Vec<3>, 8> du;
    std::array<Vec<3>, 8> dv;
    std::array<Vec<3>, 8> dw;
    for (unsigned bits = 0; bits < 8; ++bits) {
      du[bits] = edgeAlong<3>(corners, 0, bits);
      dv[bits] = edgeAlong<3>(corners, 1, bits);
      dw[bits] = edgeAlong<3>(corners, 2, bits);
    }
    // Per pair of end values along one axis: which quadratic coefficient, and with what weight.
    for (unsigned u = 0; u < 4; ++u)       // ends of v's and w's derivative along u
      for (unsigned v = 0; v < 4; ++v)     // ends of u's and w's derivative along v
        for (unsigned w = 0; w < 4; ++w) { // ends of u's and v's derivative along w
          const auto place = [](unsigned pair) { return (pair & 1) + (pair >> 1); };
          const auto weight = [](unsigned pair) { return pair == 1 || pair == 2 ? 0.5 : 1.0; };
          const unsigned uBits = (v & 1) << 1 | (w & 1) << 2;
          const unsigned vBits = (u & 1) | (w >> 1) << 2;
          const unsigned wBits = u >> 1 | (v >> 1) << 1;
          result[place(u) + 3 * place(v) + 9 * place(w)] +=
              weight(u) * weight(v) * weight(w) * det(du[uBits], dv[vBits], dw[wBits]);
        }
  }
  return result;
}

template <int N> double scaledJacobian(const std::array<Vec<N>, 1 << N> &corners) {
  double worst = std::numeric_limits<double>::infinity();
  for (unsigned bits = 0; bits < 1U << N; ++bits) {
    std::array<Vec<N>, N> edges;
    double lengths = 1;
    for (int axis = 0; axis < N; ++axis) {
      edges[at(axis)] = edgeAlong<N>(corners, axis, bits);
      lengths *= glm::length(edges[at(axis)]);
    }
    double d = 0;
    if constexpr (N == 2) d = det(edges[0], edges[1]);
    else d = det(edges[0], edges[1], edges[2]);
    worst = std::min(worst, lengths > 0 ? d / lengths : 0.0);
  }
  return worst;
}

template std::array<double, 4> jacobianCoefficients<2>(const std::array<Vec<2>, 4> &);
template std::array<double, 27> jacobianCoefficients<3>(const std::array<Vec<3>, 8> &);
template double scaledJacobian<2>(const std::array<Vec<2>, 4> &);
template double scaledJacobian<3>(const std::array<Vec<3>, 8> &);

} // namespace dualblock
