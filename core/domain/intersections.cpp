#include "domain/intersections.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "domain/polygon.h"

namespace dualblock {
namespace {

template <int N> struct Box {
  Vec<N> low, high;
  Index facet;
};

template <int N> std::vector<Box<N>> facetBoxes(const Domain<N> &domain, double margin) {
  std::vector<Box<N>> boxes;
  for (std::size_t f = 0; f < domain.facets.size(); ++f) {
    const auto &loops = domain.facets[f].loops;
    Box<N> box{domain.vertices[at(loops[0][0])], domain.vertices[at(loops[0][0])], toIndex(f)};
    for (const auto &loop : loops)
      for (const Index v : loop) {
        box.low = glm::min(box.low, domain.vertices[at(v)]);
        box.high = glm::max(box.high, domain.vertices[at(v)]);
      }
    box.low -= Vec<N>(margin);
    box.high += Vec<N>(margin);
    boxes.push_back(box);
  }
  return boxes;
}

/// Calls visit(a, b) for pairs of facets, a < b, whose boxes overlap: a sweep along x. Stops when it
/// returns true.
template <int N, typename Visit> void sweep(const Domain<N> &domain, double margin, Visit visit) {
  std::vector<Box<N>> boxes = facetBoxes(domain, margin);
  sortItems(boxes, [](const Box<N> &a, const Box<N> &b) {
    return a.low.x != b.low.x ? a.low.x < b.low.x : a.facet < b.facet;
  });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = i + 1; k < boxes.size() && boxes[k].low.x <= boxes[i].high.x; ++k) {
      bool apart = false;
      for (int c = 1; c < N; ++c)
        apart |= boxes[k].low[c] > boxes[i].high[c] || boxes[i].low[c] > boxes[k].high[c];
      if (apart) continue;
      if (visit(std::min(boxes[i].facet, boxes[k].facet), std::max(boxes[i].facet, boxes[k].facet))) return;
    }
}

double distanceToSegment(const Vec<2> &x, const Vec<2> &a, const Vec<2> &b) {
  const Vec<2> d = b - a;
  const double t = std::clamp(glm::dot(x - a, d) / glm::dot(d, d), 0.0, 1.0);
  return glm::length(x - (a + t * d));
}

/// A point strictly inside edge (p, q) where it passes through the inside of the facet.
std::optional<Vec<3>> pierces(const Domain<3> &domain, Index p, Index q, const Facet &facet,
                              const Plane<3> &plane, double tolerance) {
  const Vec<3> &a = domain.vertices[at(p)];
  const Vec<3> &b = domain.vertices[at(q)];
  const double da = plane.distance(a);
  const double db = plane.distance(b);
  if (da * db >= 0 || std::abs(da) <= tolerance || std::abs(db) <= tolerance) return std::nullopt;
  const Vec<3> x = a + (da / (da - db)) * (b - a);
  const PlaneBasis basis(plane.normal);
  const Vec<2> y = basis.project(x);
  bool inside = false;
  for (const auto &loop : facet.loops) {
    std::vector<Vec<2>> polygon;
    for (const Index v : loop) polygon.push_back(basis.project(domain.vertices[at(v)]));
    for (std::size_t k = 0; k < polygon.size(); ++k)
      if (distanceToSegment(y, polygon[k], polygon[(k + 1) % polygon.size()]) <= tolerance)
        return std::nullopt;
    if (insidePolygon(polygon, y)) inside = !inside;
  }
  return inside ? std::optional<Vec<3>>(x) : std::nullopt;
}

} // namespace

std::optional<Intersection<2>> findIntersection(const Domain<2> &domain, double tolerance) {
  std::optional<Intersection<2>> found;
  sweep(domain, tolerance, [&](Index f, Index g) {
    const auto &s = domain.facets[at(f)].loops[0];
    const auto &t = domain.facets[at(g)].loops[0];
    const Vec<2> a = domain.vertices[at(s[0])];
    const Vec<2> b = domain.vertices[at(s[1])];
    const Vec<2> c = domain.vertices[at(t[0])];
    const Vec<2> d = domain.vertices[at(t[1])];
    const auto isShared = [&](Index v) { return v == s[0] || v == s[1]; };
    // An end of one on the other, unless it is a common end.
    for (const Index v : t)
      if (!isShared(v) && distanceToSegment(domain.vertices[at(v)], a, b) <= tolerance)
        found = {f, g, domain.vertices[at(v)]};
    for (const Index v : s)
      if (v != t[0] && v != t[1] && distanceToSegment(domain.vertices[at(v)], c, d) <= tolerance)
        found = {f, g, domain.vertices[at(v)]};
    const auto side = [](const Vec<2> &p, const Vec<2> &q, const Vec<2> &x) {
      return (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x);
    };
    if (!found && !isShared(t[0]) && !isShared(t[1]) && side(a, b, c) * side(a, b, d) < 0 &&
        side(c, d, a) * side(c, d, b) < 0) {
      const double u = side(c, d, a) / (side(c, d, a) - side(c, d, b));
      found = {f, g, a + u * (b - a)};
    }
    return found.has_value();
  });
  return found;
}

std::optional<Intersection<3>> findIntersection(const Domain<3> &domain, double tolerance) {
  std::vector<Plane<3>> planes;
  for (const Facet &facet : domain.facets) planes.push_back(facetPlane<3>(domain.vertices, facet));
  std::optional<Intersection<3>> found;
  const auto edgesPierce = [&](Index f, Index g) {
    for (const auto &loop : domain.facets[at(f)].loops)
      for (std::size_t k = 0; k < loop.size() && !found; ++k)
        if (const auto x = pierces(domain, loop[k], loop[(k + 1) % loop.size()], domain.facets[at(g)],
                                   planes[at(g)], tolerance))
          found = {std::min(f, g), std::max(f, g), *x};
  };
  sweep(domain, tolerance, [&](Index f, Index g) {
    edgesPierce(f, g);
    if (!found) edgesPierce(g, f);
    return found.has_value();
  });
  return found;
}

} // namespace dualblock
