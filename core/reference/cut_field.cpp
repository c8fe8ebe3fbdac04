#include "reference/cut_field.h"

#include <algorithm>
#include <limits>

namespace dualblock {
namespace {

template <int N> double distanceTo(const std::vector<Segment<N>> &chain, const Vec<N> &x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment<N> &s : chain) least = std::min(least, dualblock::distanceTo<N>(s, x));
  return least;
}

} // namespace

template <int N> double distanceTo(const Segment<N> &segment, const Vec<N> &x) {
  const Vec<N> along = segment[1] - segment[0];
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(x - segment[0], along) / square, 0.0, 1.0) : 0.0;
  return glm::length(x - (segment[0] + t * along));
}

template <int N> double SweptField<N>::value(const Vec<N> &x) const {
  double least = std::numeric_limits<double>::infinity();
  double value = 0;
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const double d = dualblock::distanceTo<N>(segments_[k], x);
    if (d >= least) continue;
    least = d;
    value = planes_[k].distance(x);
  }
  return value;
}

template <int N> double MiddleField<N>::value(const Vec<N> &x) const {
  return distanceTo<N>(first_, x) - distanceTo<N>(second_, x);
}

template class SweptField<2>;
template class SweptField<3>;
template class MiddleField<2>;
template class MiddleField<3>;
template double distanceTo<2>(const Segment<2> &, const Vec<2> &);
template double distanceTo<3>(const Segment<3> &, const Vec<3> &);

} // namespace dualblock
