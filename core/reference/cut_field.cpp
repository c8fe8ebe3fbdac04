#include "reference/cut_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dualblock {
namespace {

template <int N> double distanceTo(const std::vector<Segment<N>> &chain, const Vec<N> &x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment<N> &s : chain) least = std::min(least, dualblock::distanceTo<N>(s, x));
  return least;
}

} // namespace

template <int N> double nearestOn(const Segment<N> &segment, const Vec<N> &x) {
  const Vec<N> along = segment[1] - segment[0];
  const double square = glm::dot(along, along);
  return square > 0 ? std::clamp(glm::dot(x - segment[0], along) / square, 0.0, 1.0) : 0.0;
}

template <int N> double distanceTo(const Segment<N> &segment, const Vec<N> &x) {
  return glm::length(x - glm::mix(segment[0], segment[1], nearestOn<N>(segment, x)));
}

template <int N>
double rootBetween(const CutField<N> &field, const Vec<N> &a, const Vec<N> &b, double va, double vb) {
  // Fields bend: false position with the Illinois rule.
  constexpr int kSteps = 12;
  double low = 0;
  double high = 1;
  double t = va / (va - vb);
  int last = 0;
  for (int step = 0; step < kSteps; ++step) {
    const double v = field.value(a + t * (b - a));
    if (std::abs(v) <= 1e-9 * std::abs(va - vb)) break;
    const bool isLow = (v < 0) == (va < 0);
    if (isLow) {
      low = t;
      va = v;
      if (last == 1) vb /= 2;
    } else {
      high = t;
      vb = v;
      if (last == 2) va /= 2;
    }
    last = isLow ? 1 : 2;
    t = low + va / (va - vb) * (high - low);
  }
  return t;
}

template <int N> double SweptField<N>::value(const Vec<N> &x) const {
  // Each segment has a sheet. Near sheets count most, so that the whole has no steps where they part or
  // cross; ahead of the chain distance from it hardly counts, or the sheet of an uneven chain would follow
  // its bends.
  constexpr double kAhead = 0.01;
  double sum = 0;
  double weights = 0;
  for (std::size_t k = 0; k < sweep_.segments.size(); ++k) {
    const auto &[from, to] = sweep_.segments[k];
    const auto &[first, last] = sweep_.headings[k];
    const double t = nearestOn<N>(sweep_.segments[k], x);
    const Vec<N> away = x - glm::mix(from, to, t);
    const double u = glm::dot(away, glm::mix(first.ahead, last.ahead, t));
    double v = glm::dot(away, glm::mix(first.normal, last.normal, t));
    const double within = std::clamp(u, 0.0, sweep_.reach);
    const double square = glm::dot(away, away) - (1 - kAhead) * within * within;
    if (u < 0) { // behind the chain each side goes on as far as the middle of what is outside
      const double angle = std::atan2(v, u);
      const double gap = sweep_.gaps[k];
      const bool isFront = angle > 0 ? angle < gap : angle < gap - 2 * std::numbers::pi;
      v = (isFront ? 1 : -1) * std::sqrt(u * u + v * v);
    } else {
      v += sweep_.slope * u / (1 + u / sweep_.depth);
    }
    if (!(square > 0)) return v;
    const double weight = 1 / (square * square * square * square);
    sum += weight * v;
    weights += weight;
  }
  return sum / weights;
}

template <int N> bool SweptField<N>::isAnchor(const Vec<N> &x, double tolerance) const {
  return distanceTo<N>(sweep_.segments, x) <= tolerance;
}

template <int N> double MiddleField<N>::value(const Vec<N> &x) const {
  return distanceTo<N>(first_, x) - distanceTo<N>(second_, x);
}

template class SweptField<3>;
template class MiddleField<3>;
template double rootBetween<3>(const CutField<3> &, const Vec<3> &, const Vec<3> &, double, double);
template double nearestOn<3>(const Segment<3> &, const Vec<3> &);
template double distanceTo<3>(const Segment<3> &, const Vec<3> &);

} // namespace dualblock
