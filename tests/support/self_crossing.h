// Whether a surface given as facets is the boundary of a solid, by plain means: what the generators of random
// solids are held to.
#pragma once

#include <algorithm>
#include <set>

#include "domain/domain.h"

namespace dualblock::test {

/// The distance of two segments of the plane, 0 where they cross.
inline double segmentDistance(const Vec<2> &a, const Vec<2> &b, const Vec<2> &c, const Vec<2> &d) {
  const auto turn = [](const Vec<2> &p, const Vec<2> &q, const Vec<2> &r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  if ((turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0)) return 0;
  const auto toSegment = [](const Vec<2> &p, const Vec<2> &q, const Vec<2> &r) {
    const double t = std::clamp(glm::dot(p - q, r - q) / glm::dot(r - q, r - q), 0.0, 1.0);
    return glm::length(p - (q + t * (r - q)));
  };
  return std::min({toSegment(a, c, d), toSegment(b, c, d), toSegment(c, a, b), toSegment(d, a, b)});
}

/// A closed polygon whose sides are `clearance` apart wherever they do not share a corner or a side.
inline bool isSimplePolygon(const std::vector<Vec<2>> &polygon, double clearance) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const double distance = segmentDistance(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % n]);
      const double side =
          std::min(glm::length(polygon[i + 1] - polygon[i]), glm::length(polygon[(j + 1) % n] - polygon[j]));
      // Sides with one side between them are as near as that one is long.
      const bool isNext = j == i + 2 || (i + n) - j == 2;
      if (distance < (isNext ? std::min(clearance, 0.3 * side) : clearance)) return false;
    }
  double area = 0;
  for (std::size_t i = 0; i < n; ++i)
    area += polygon[i].x * polygon[(i + 1) % n].y - polygon[i].y * polygon[(i + 1) % n].x;
  return area > 0;
}

/// Every edge is in two loops that run against each other.
inline bool isClosed(const Domain<3> &domain) {
  std::set<std::array<Index, 2>> edges;
  for (const Facet &facet : domain.facets)
    for (const auto &loop : facet.loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (!edges.insert({loop[k], loop[(k + 1) % loop.size()]}).second) return false;
  return std::all_of(edges.begin(), edges.end(), [&](const auto &edge) {
    return edges.count({edge[1], edge[0]}) > 0;
  });
}

/// Whether an edge of one triangle goes through another one that shares no corner with it. Facets of more
/// than `corners` corners, plane caps, are left out.
inline bool crossesItself(const Domain<3> &domain, std::size_t corners = 4) {
  struct Triangle {
    std::array<Index, 3> v;
    Vec<3> low, high;
  };
  std::vector<Triangle> triangles;
  for (const Facet &facet : domain.facets) {
    const auto &loop = facet.loops[0];
    if (loop.size() > corners || facet.loops.size() > 1) continue;
    for (std::size_t k = 2; k < loop.size(); ++k) {
      Triangle t{{loop[0], loop[k - 1], loop[k]}, {}, {}};
      t.low = t.high = domain.vertices[at(t.v[0])];
      for (const Index v : t.v) {
        t.low = glm::min(t.low, domain.vertices[at(v)]);
        t.high = glm::max(t.high, domain.vertices[at(v)]);
      }
      triangles.push_back(t);
    }
  }
  const double size = domainSize(domain.vertices);
  const double planar = 1e-12 * size * size * size; // triangles of one facet do not cross
  const auto side = [&](Index a, Index b, Index c, Index d) {
    const Vec<3> &o = domain.vertices[at(a)];
    const double volume = glm::dot(domain.vertices[at(d)] - o,
                                   glm::cross(domain.vertices[at(b)] - o, domain.vertices[at(c)] - o));
    return volume > planar ? 1 : volume < -planar ? -1 : 0;
  };
  const auto pierces = [&](Index p, Index q, const std::array<Index, 3> &t) {
    if (std::find(t.begin(), t.end(), p) != t.end() || std::find(t.begin(), t.end(), q) != t.end())
      return false;
    if (side(t[0], t[1], t[2], p) * side(t[0], t[1], t[2], q) >= 0) return false;
    const int first = side(p, q, t[0], t[1]);
    return first != 0 && first == side(p, q, t[1], t[2]) && first == side(p, q, t[2], t[0]);
  };
  for (const Triangle &s : triangles)
    for (const Triangle &t : triangles) {
      bool apart = &s == &t;
      for (int k = 0; k < 3; ++k) apart = apart || s.low[k] > t.high[k] || t.low[k] > s.high[k];
      if (apart) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (pierces(s.v[k], s.v[(k + 1) % 3], t.v)) return true;
    }
  return false;
}

} // namespace dualblock::test
