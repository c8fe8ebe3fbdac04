#include "domain/polygon.h"

#include "base/sort.h"
#include <algorithm>
#include <cmath>

namespace dualblock {

Vec<3> areaVector(const std::vector<Vec<3>> &vertices, const Facet &facet) {
  Vec<3> sum{0.0};
  const Vec<3> origin = vertices[at(facet.loops[0][0])]; // far from the origin, differences stay exact
  for (const auto &loop : facet.loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      sum += glm::cross(vertices[at(loop[k])] - origin, vertices[at(loop[(k + 1) % loop.size()])] - origin);
  return sum;
}

Vec<2> areaVector(const std::vector<Vec<2>> &vertices, const Facet &facet) {
  const Vec<2> d = vertices[at(facet.loops[0][1])] - vertices[at(facet.loops[0][0])];
  return {d.y, -d.x};
}

PlaneBasis::PlaneBasis(const Vec<3> &normal) {
  const Vec<3> a = glm::abs(normal);
  const Vec<3> axis = a.x <= a.y && a.x <= a.z ? Vec<3>{1, 0, 0}
                      : a.y <= a.z             ? Vec<3>{0, 1, 0}
                                               : Vec<3>{0, 0, 1};
  u = glm::normalize(glm::cross(axis, normal));
  v = glm::cross(normal, u);
}

double polygonArea2(const std::vector<Vec<2>> &polygon) {
  double sum = 0;
  const Vec<2> o = polygon[0];
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec<2> a = polygon[k] - o;
    const Vec<2> b = polygon[(k + 1) % polygon.size()] - o;
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

bool insidePolygon(const std::vector<Vec<2>> &polygon, const Vec<2> &x) {
  bool inside = false;
  for (std::size_t k = 0, j = polygon.size() - 1; k < polygon.size(); j = k++) {
    const Vec<2> &a = polygon[k];
    const Vec<2> &b = polygon[j];
    if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (b.x - a.x) * (x.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

Vec<2> pointInside(const std::vector<std::vector<Vec<2>>> &polygons) {
  // Along a horizontal line between two corner heights, the widest gap between crossings 2k and 2k+1.
  std::vector<double> heights;
  for (const auto &polygon : polygons)
    for (const Vec<2> &p : polygon) heights.push_back(p.y);
  sortItems(heights);
  Vec<2> best = polygons[0][0];
  double bestRoom = 0;
  for (std::size_t h = 0; h + 1 < heights.size(); ++h) {
    const double room = heights[h + 1] - heights[h];
    if (room <= 0) continue;
    const double y = heights[h] + room / 2;
    std::vector<double> crossings;
    for (const auto &polygon : polygons)
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec<2> &a = polygon[k];
        const Vec<2> &b = polygon[(k + 1) % polygon.size()];
        if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
      }
    sortItems(crossings);
    for (std::size_t c = 0; c + 1 < crossings.size(); c += 2) {
      const double width = std::min(crossings[c + 1] - crossings[c], room);
      if (width <= bestRoom) continue;
      bestRoom = width;
      best = {(crossings[c] + crossings[c + 1]) / 2, y};
    }
  }
  return best;
}

std::vector<std::vector<Vec<2>>> projected(const std::vector<Vec<3>> &vertices, const Facet &facet,
                                           const PlaneBasis &basis) {
  std::vector<std::vector<Vec<2>>> polygons;
  for (const auto &loop : facet.loops) {
    polygons.emplace_back();
    for (const Index v : loop) polygons.back().push_back(basis.project(vertices[at(v)]));
  }
  return polygons;
}

std::vector<std::vector<std::size_t>> nestingOf(const std::vector<std::vector<Vec<2>>> &polygons) {
  std::vector<std::vector<std::size_t>> around(polygons.size());
  if (polygons.size() < 2) return around;
  std::vector<double> area;
  for (const auto &polygon : polygons) area.push_back(std::abs(polygonArea2(polygon)));
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const Vec<2> x = pointInside({polygons[k]});
    for (std::size_t m = 0; m < polygons.size(); ++m)
      if (area[m] > area[k] && insidePolygon(polygons[m], x)) around[k].push_back(m);
  }
  return around;
}

} // namespace dualblock
