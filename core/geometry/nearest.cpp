#include "geometry/nearest.h"

namespace dualblock {

Vec<3> nearestOnTriangle(const Vec<3> &x, const Vec<3> &a, const Vec<3> &b, const Vec<3> &c) {
  Vec<3> best = nearestOnSegment<3>(x, a, b);
  for (const Vec<3> &y : {nearestOnSegment<3>(x, b, c), nearestOnSegment<3>(x, c, a)})
    if (glm::length(y - x) < glm::length(best - x)) best = y;
  const Vec<3> u = b - a;
  const Vec<3> v = c - a;
  const double uu = glm::dot(u, u);
  const double uv = glm::dot(u, v);
  const double vv = glm::dot(v, v);
  const double det = uu * vv - uv * uv;
  if (det <= 0) return best;
  const double s = (vv * glm::dot(x - a, u) - uv * glm::dot(x - a, v)) / det;
  const double t = (uu * glm::dot(x - a, v) - uv * glm::dot(x - a, u)) / det;
  return s >= 0 && t >= 0 && s + t <= 1 ? a + s * u + t * v : best;
}

} // namespace dualblock
