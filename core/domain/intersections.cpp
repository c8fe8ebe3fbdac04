#include "domain/intersections.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

template <int N> double distanceToSegment(const Vec<N> &x, const Vec<N> &a, const Vec<N> &b) {
  const Vec<N> d = b - a;
  const double t = std::clamp(glm::dot(x - a, d) / glm::dot(d, d), 0.0, 1.0);
  return glm::length(x - (a + t * d));
}

/// A facet in its plane's coordinates.
class FlatFacet {
public:
  FlatFacet(const Domain<3> &domain, const Facet &facet, const Plane<3> &plane) : basis_(plane.normal) {
    for (const auto &loop : facet.loops) {
      loops_.emplace_back();
      for (const Index v : loop) loops_.back().push_back(basis_.project(domain.vertices[at(v)]));
    }
  }

  Vec<2> project(const Vec<3> &x) const { return basis_.project(x); }

  /// Inside, and further than the tolerance from every edge.
  bool holds(const Vec<2> &x, double tolerance) const {
    bool inside = false;
    for (const auto &loop : loops_) {
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (distanceToSegment<2>(x, loop[k], loop[(k + 1) % loop.size()]) <= tolerance) return false;
      if (insidePolygon(loop, x)) inside = !inside;
    }
    return inside;
  }

  /// A point of the segment inside, if any: between two places where it meets edges.
  std::optional<Vec<2>> passes(const Vec<2> &a, const Vec<2> &b, double tolerance) const {
    const auto cross = [](const Vec<2> &u, const Vec<2> &v) { return u.x * v.y - u.y * v.x; };
    std::vector<double> places{0, 1};
    for (const auto &loop : loops_)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec<2> edge = loop[(k + 1) % loop.size()] - loop[k];
        const double t = cross(loop[k] - a, edge) / cross(b - a, edge);
        if (t > 0 && t < 1) places.push_back(t); // not where they are parallel
      }
    sortItems(places);
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      const Vec<2> middle = a + (places[k] + places[k + 1]) / 2 * (b - a);
      if (holds(middle, tolerance)) return middle;
    }
    return std::nullopt;
  }

private:
  PlaneBasis basis_;
  std::vector<std::vector<Vec<2>>> loops_;
};

/// A point where edge (p, q) meets the inside of the facet: passes through it, ends on it, or lies in it
/// across one of its edges.
std::optional<Vec<3>> meets(const Domain<3> &domain, Index p, Index q, const Facet &facet,
                            const Plane<3> &plane, double tolerance) {
  const Vec<3> &a = domain.vertices[at(p)];
  const Vec<3> &b = domain.vertices[at(q)];
  const double da = plane.distance(a);
  const double db = plane.distance(b);
  const bool onA = std::abs(da) <= tolerance;
  const bool onB = std::abs(db) <= tolerance;
  if (!onA && !onB && da * db > 0) return std::nullopt;
  const FlatFacet flat(domain, facet, plane);
  if (onA && flat.holds(flat.project(a), tolerance)) return a;
  if (onB && flat.holds(flat.project(b), tolerance)) return b;
  if (onA && onB) {
    const Vec<2> u = flat.project(a);
    const Vec<2> v = flat.project(b);
    const auto x = flat.passes(u, v, tolerance);
    if (!x) return std::nullopt;
    return a + glm::length(*x - u) / glm::length(v - u) * (b - a);
  }
  if (onA || onB) return std::nullopt;
  const Vec<3> x = a + (da / (da - db)) * (b - a);
  return flat.holds(flat.project(x), tolerance) ? std::optional<Vec<3>>(x) : std::nullopt;
}

/// Where two edges without a common vertex meet, or one ends on the other.
std::optional<Vec<3>> edgesMeet(const std::array<Vec<3>, 2> &e, const std::array<Vec<3>, 2> &f,
                                double tolerance) {
  const Vec<3> u = e[1] - e[0];
  const Vec<3> v = f[1] - f[0];
  const Vec<3> w = f[0] - e[0];
  const double uu = glm::dot(u, u);
  const double vv = glm::dot(v, v);
  const double uv = glm::dot(u, v);
  const double square = uu * vv - uv * uv;
  constexpr double kParallel = 1e-16; // of the product of their squares
  if (square > kParallel * uu * vv) {
    const double s = (glm::dot(u, w) * vv - glm::dot(v, w) * uv) / square;
    const double t = (glm::dot(u, w) * uv - glm::dot(v, w) * uu) / square;
    const Vec<3> x = e[0] + s * u;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1 && glm::length(x - (f[0] + t * v)) <= tolerance) return x;
  }
  for (const Vec<3> &x : f)
    if (distanceToSegment<3>(x, e[0], e[1]) <= tolerance) return x;
  for (const Vec<3> &x : e)
    if (distanceToSegment<3>(x, f[0], f[1]) <= tolerance) return x;
  return std::nullopt;
}

std::optional<Vec<2>> segmentsMeet(const Domain<2> &domain, const std::vector<Index> &s,
                                   const std::vector<Index> &t, double tolerance) {
  const Vec<2> a = domain.vertices[at(s[0])];
  const Vec<2> b = domain.vertices[at(s[1])];
  const Vec<2> c = domain.vertices[at(t[0])];
  const Vec<2> d = domain.vertices[at(t[1])];
  // An end of one on the other, unless it is a common end.
  for (const Index v : s)
    if (v != t[0] && v != t[1] && distanceToSegment<2>(domain.vertices[at(v)], c, d) <= tolerance)
      return domain.vertices[at(v)];
  for (const Index v : t)
    if (v != s[0] && v != s[1] && distanceToSegment<2>(domain.vertices[at(v)], a, b) <= tolerance)
      return domain.vertices[at(v)];
  const auto side = [](const Vec<2> &p, const Vec<2> &q, const Vec<2> &x) {
    return (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x);
  };
  const auto isShared = [&](Index v) { return v == s[0] || v == s[1]; };
  if (isShared(t[0]) || isShared(t[1]) || side(a, b, c) * side(a, b, d) >= 0 ||
      side(c, d, a) * side(c, d, b) >= 0)
    return std::nullopt;
  const double u = side(c, d, a) / (side(c, d, a) - side(c, d, b));
  return a + u * (b - a);
}

/// Calls visit(v, w) for the ends of each edge of a facet, until it returns true.
template <typename Visit> bool visitEdges(const Facet &facet, Visit visit) {
  for (const auto &loop : facet.loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (visit(loop[k], loop[(k + 1) % loop.size()])) return true;
  return false;
}

} // namespace

std::vector<Intersection<2>> findIntersections(const Domain<2> &domain, double tolerance, std::size_t most) {
  std::vector<Intersection<2>> found;
  sweep(domain, tolerance, [&](Index f, Index g) {
    if (const auto x =
            segmentsMeet(domain, domain.facets[at(f)].loops[0], domain.facets[at(g)].loops[0], tolerance))
      found.push_back({f, g, *x});
    return found.size() >= most;
  });
  return found;
}

std::vector<Intersection<3>> findIntersections(const Domain<3> &domain, double tolerance, std::size_t most) {
  std::vector<Plane<3>> planes;
  for (const Facet &facet : domain.facets) planes.push_back(facetPlane<3>(domain.vertices, facet));
  std::vector<Intersection<3>> found;
  sweep(domain, tolerance, [&](Index f, Index g) {
    std::optional<Vec<3>> x;
    const auto entersFacet = [&](Index edges, Index facet) {
      return visitEdges(domain.facets[at(edges)], [&](Index p, Index q) {
        x = meets(domain, p, q, domain.facets[at(facet)], planes[at(facet)], tolerance);
        return x.has_value();
      });
    };
    const auto crossesEdge = [&] {
      return visitEdges(domain.facets[at(f)], [&](Index p, Index q) {
        return visitEdges(domain.facets[at(g)], [&](Index r, Index s) {
          const std::array<Vec<3>, 2> e{domain.vertices[at(p)], domain.vertices[at(q)]};
          const std::array<Vec<3>, 2> d{domain.vertices[at(r)], domain.vertices[at(s)]};
          // By place: the vertices of the input may be one per facet.
          if (e[0] == d[0] || e[0] == d[1] || e[1] == d[0] || e[1] == d[1]) return false;
          x = edgesMeet(e, d, tolerance);
          return x.has_value();
        });
      });
    };
    if (entersFacet(f, g) || entersFacet(g, f) || crossesEdge()) found.push_back({f, g, *x});
    return found.size() >= most;
  });
  return found;
}

template <int N>
std::string describeIntersections(const std::string &facets, const std::vector<Intersection<N>> &found) {
  std::string text = facets;
  for (std::size_t k = 0; k < found.size() && k < kNamedPlaces; ++k) {
    text += (k > 0 ? ", " : " ") + std::to_string(found[k].facetA) + " and " +
            std::to_string(found[k].facetB) + (k > 0 ? " at (" : " meet at (");
    for (int c = 0; c < N; ++c) text += (c > 0 ? ", " : "") + formatNumber(found[k].where[c]);
    text += ")";
  }
  if (found.size() <= kNamedPlaces) return text;
  const std::string count =
      found.size() < kFoundPlaces ? std::to_string(found.size()) : "over " + std::to_string(kFoundPlaces);
  return text + ", and others: " + count + " pairs in all";
}

template <int N>
std::vector<EntityRef> culpritsOf(const std::string &kind, const std::vector<Intersection<N>> &found) {
  std::vector<EntityRef> entities;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (const Index facet : {found[k].facetA, found[k].facetB})
      if (std::none_of(entities.begin(), entities.end(),
                       [&](const EntityRef &e) { return e.index == facet; }))
        entities.push_back({kind, facet});
  return entities;
}

template std::string describeIntersections(const std::string &, const std::vector<Intersection<2>> &);
template std::string describeIntersections(const std::string &, const std::vector<Intersection<3>> &);
template std::vector<EntityRef> culpritsOf(const std::string &, const std::vector<Intersection<2>> &);
template std::vector<EntityRef> culpritsOf(const std::string &, const std::vector<Intersection<3>> &);

} // namespace dualblock
