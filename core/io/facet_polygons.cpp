#include "io/facet_polygons.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "domain/polygon.h"

namespace dualblock {
namespace {

/// A polygon in the facet's plane.
struct Outline {
  std::vector<Index> loop;
  std::vector<Vec<2>> corners;
  Vec<2> low, high;
  double area = 0;
  std::size_t parent = 0; // the smallest outline around it; itself if there is none
  bool isHole = false;
};

double cross(const Vec<2> &a, const Vec<2> &b) { return a.x * b.y - a.y * b.x; }

/// A point inside a simple polygon, in linear time: near its leftmost corner, which is convex.
Vec<2> pointNearCorner(const std::vector<Vec<2>> &polygon) {
  const std::size_t n = polygon.size();
  const auto isLeft = [](const Vec<2> &p, const Vec<2> &q) { return p.x < q.x || (p.x == q.x && p.y < q.y); };
  const auto leftmost =
      static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end(), isLeft) - polygon.begin());
  const Vec<2> tip = polygon[leftmost];
  Vec<2> a = polygon[(leftmost + n - 1) % n];
  Vec<2> b = polygon[(leftmost + 1) % n];
  if (cross(a - tip, b - tip) < 0) std::swap(a, b);
  // Of the corners in the triangle tip, a, b, none is nearer to the tip, in the direction from ab, than this.
  const Vec<2> *nearest = nullptr;
  double farthest = 0;
  for (const Vec<2> &p : polygon) {
    if (p == tip || p == a || p == b) continue;
    const double fromBase = cross(p - b, a - b);
    if (cross(a - tip, p - tip) < 0 || cross(p - tip, b - tip) < 0 || fromBase <= farthest) continue;
    farthest = fromBase;
    nearest = &p;
  }
  return nearest != nullptr ? (tip + *nearest) / 2.0 : (tip + a + b) / 3.0;
}

bool surrounds(const Outline &outline, const Vec<2> &x, std::int64_t &steps) {
  if (x.x < outline.low.x || x.y < outline.low.y || x.x > outline.high.x || x.y > outline.high.y)
    return false;
  steps -= static_cast<std::int64_t>(outline.corners.size());
  return insidePolygon(outline.corners, x);
}

/// The polygons in the plane of the one with the largest area, largest first; none if numbers overflow.
std::vector<Outline> outlinesOf(const std::vector<Vec<3>> &vertices, FacetPolygons &facet,
                                std::vector<Vec<2>> &holes) {
  const Vec<3> origin = vertices[at(facet.polygons[0][0])];
  Vec<3> normal{0.0};
  for (const auto &polygon : facet.polygons) {
    const Vec<3> candidate = areaVector(vertices, Facet{{polygon}});
    if (!std::isfinite(glm::length(candidate))) return {};
    if (glm::length(candidate) > glm::length(normal)) normal = candidate;
  }
  const PlaneBasis plane(glm::length(normal) > 0 ? glm::normalize(normal) : Vec<3>{0, 0, 1});
  const auto isFinite = [](const Vec<2> &x) { return std::isfinite(x.x) && std::isfinite(x.y); };
  std::vector<Outline> outlines;
  for (auto &polygon : facet.polygons) {
    Outline outline;
    for (const Index v : polygon) {
      const Vec<2> x = plane.project(vertices[at(v)] - origin);
      outline.low = outline.corners.empty() ? x : glm::min(outline.low, x);
      outline.high = outline.corners.empty() ? x : glm::max(outline.high, x);
      outline.corners.push_back(x);
    }
    outline.area = std::abs(polygonArea2(outline.corners));
    // A NaN would break the order that sorting relies on.
    if (!isFinite(outline.low) || !isFinite(outline.high) || !std::isfinite(outline.area)) return {};
    outline.loop = std::move(polygon);
    outlines.push_back(std::move(outline));
  }
  for (const Vec<3> &hole : facet.holes) {
    holes.push_back(plane.project(hole - origin));
    if (!isFinite(holes.back())) return {};
  }
  sortItems(outlines, [](const Outline &a, const Outline &b) { return a.area > b.area; });
  return outlines;
}

/// From smallest to largest below `from`: the first outline around x that is clearly larger than `area`, or
/// none.
std::size_t innermost(const std::vector<Outline> &outlines, std::size_t from, double area, const Vec<2> &x,
                      std::size_t none, std::int64_t &steps) {
  constexpr double kLarger = 1 + 1e-9; // the same polygon twice is not inside itself
  for (std::size_t k = from; k-- > 0 && --steps > 0;)
    if (outlines[k].area > area * kLarger && surrounds(outlines[k], x, steps)) return k;
  return none;
}

} // namespace

Result<std::vector<Facet>> splitFacet(const std::vector<Vec<3>> &vertices, FacetPolygons facet,
                                      std::int64_t &steps) {
  if (facet.polygons.size() == 1 && facet.holes.empty())
    return std::vector<Facet>{Facet{{std::move(facet.polygons[0])}}};

  std::vector<Vec<2>> holes;
  std::vector<Outline> outlines = outlinesOf(vertices, facet, holes);
  if (outlines.empty())
    return Error{
        ErrorCode::notFinite, "the facet's coordinates are too large to calculate with. Scale the file.", {}};

  for (std::size_t k = 0; k < outlines.size(); ++k) {
    outlines[k].parent =
        innermost(outlines, k, outlines[k].area, pointNearCorner(outlines[k].corners), k, steps);
    steps -= static_cast<std::int64_t>(outlines[k].corners.size());
  }
  for (const Vec<2> &hole : holes) {
    const std::size_t around = innermost(outlines, outlines.size(), 0, hole, outlines.size(), steps);
    if (steps <= 0) break; // the search was cut short
    if (around == outlines.size())
      return Error{
          ErrorCode::holeOutside,
          "a hole point of the facet lies in none of its polygons. Move it into the hole, or remove it.",
          {}};
    if (outlines[around].parent == around)
      return Error{
          ErrorCode::degenerateFacet,
          "a hole point lies in the facet itself and in no inner polygon, so that the whole facet would be "
          "removed. Move it into the hole, or give the hole's polygon.",
          {}};
    outlines[around].isHole = true;
  }
  if (steps <= 0)
    return Error{
        ErrorCode::syntax,
        "the facets have too many polygons to sort out which lies in which. Write each polygon without "
        "holes as a facet of its own.",
        {}};

  std::vector<Facet> facets;
  std::vector<std::size_t> facetOf(outlines.size());
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    if (const std::size_t parent = outlines[k].parent; parent != k && !outlines[parent].isHole)
      facets[facetOf[parent]].loops.push_back(outlines[k].loop);
    if (outlines[k].isHole) continue;
    facetOf[k] = facets.size();
    facets.push_back({{outlines[k].loop}});
  }
  return facets;
}

} // namespace dualblock
