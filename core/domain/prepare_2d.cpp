#include <algorithm>
#include <cmath>

#include "domain/intersections.h"
#include "domain/polygon.h"
#include "domain/prepare.h"
#include "domain/prepare_common.h"

namespace dualblock {
namespace {

struct Loop {
  std::vector<Index> vertices;
  std::vector<Index> givenSegments; // the input's segment that starts at each vertex
  std::vector<Vec<2>> points;
};

Error loopError(ErrorCode code, const std::string &message, std::size_t loop) {
  return {code, message, {{"loop", static_cast<std::int64_t>(loop)}}};
}

/// Chains the segments, which follow one another loop by loop.
Result<std::vector<Loop>> chainLoops(const Domain<2> &domain) {
  std::vector<Loop> loops;
  for (std::size_t begin = 0, end = 0; begin < domain.facets.size(); begin = end) {
    Loop loop;
    const Index first = domain.facets[begin].loops[0][0];
    while (true) {
      loop.vertices.push_back(domain.facets[end].loops[0][0]);
      loop.givenSegments.push_back(toIndex(end));
      loop.points.push_back(domain.vertices[at(loop.vertices.back())]);
      const Index next = domain.facets[end].loops[0][1];
      ++end;
      if (next == first) break;
      if (end == domain.facets.size() || domain.facets[end].loops[0][0] != next)
        return loopError(ErrorCode::openBoundary, "Loop " + std::to_string(loops.size()) + " is not closed.",
                         loops.size());
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Loops that share a vertex touch, which segments alone do not show.
std::optional<Error> checkVerticesOnce(const Domain<2> &domain) {
  std::vector<Index> startsAt(domain.vertices.size(), kNone);
  for (std::size_t f = 0; f < domain.facets.size(); ++f) {
    const Index v = domain.facets[f].loops[0][0];
    Index &first = startsAt[at(v)];
    if (first != kNone)
      return Error{ErrorCode::selfIntersection,
                   "Two segments start at vertex " + std::to_string(v) +
                       ": loops must neither cross nor touch, themselves or one another.",
                   {{"vertex", v}, {"edge", first}, {"edge", static_cast<std::int64_t>(f)}}};
    first = toIndex(f);
  }
  return std::nullopt;
}

/// Drops vertices on a straight line between their neighbours: they bound no curve of their own.
void dropCollinear(Loop &loop, double tolerance, std::vector<Index> &facetOfGiven, std::vector<Index> &kept) {
  const std::size_t n = loop.vertices.size();
  kept.clear();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec<2> &a = loop.points[(k + n - 1) % n];
    const Vec<2> &b = loop.points[k];
    const Vec<2> &c = loop.points[(k + 1) % n];
    const Vec<2> d = glm::normalize(c - a);
    const double off = std::abs(d.x * (b.y - a.y) - d.y * (b.x - a.x));
    const bool between = glm::dot(b - a, c - b) > 0;
    if (!(between && off <= tolerance)) kept.push_back(toIndex(k));
  }
  // Each input segment belongs to the merged one that starts at the last kept vertex before it.
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t owner = kept.size() - 1;
    while (owner > 0 && at(kept[owner]) > k) --owner;
    if (at(kept[0]) > k) owner = kept.size() - 1;
    facetOfGiven[at(loop.givenSegments[k])] = toIndex(owner); // made absolute by the caller
  }
}

} // namespace

Result<PreparedDomain<2>> prepareDomain(const Domain<2> &given, double tolerance) {
  if (auto error = checkNumbers(given)) return *error;
  const double size = domainSize(given.vertices);
  if (given.facets.size() < 3)
    return Error{ErrorCode::tooFewFacets, "A plane domain needs at least one loop of three segments.", {}};
  auto chained = chainLoops(given);
  if (!chained.ok()) return chained.error();
  std::vector<Loop> &loops = chained.value();
  for (std::size_t f = 0; f < given.facets.size(); ++f) {
    const auto &s = given.facets[f].loops[0];
    if (glm::length(given.vertices[at(s[1])] - given.vertices[at(s[0])]) <= tolerance * size)
      return Error{ErrorCode::degenerateFacet,
                   "The segment from vertex " + std::to_string(s[0]) + " to vertex " + std::to_string(s[1]) +
                       " has no length: remove one of the two.",
                   {{"edge", static_cast<std::int64_t>(f)}, {"vertex", s[0]}, {"vertex", s[1]}}};
  }
  if (const auto crossings = findIntersections(given, tolerance * size, kFoundPlaces); !crossings.empty())
    return Error{ErrorCode::selfIntersection,
                 describeIntersections("Segments", crossings) +
                     ", where they share no vertex: loops must neither cross nor touch.",
                 culpritsOf("edge", crossings)};
  if (auto error = checkVerticesOnce(given)) return *error;
  PreparedDomain<2> prepared;
  prepared.domain = given;
  prepared.domain.facets.clear();
  prepared.facetOfGiven.assign(given.facets.size(), kNone);

  // Nesting decides which loops are outer ones; the first must be.
  for (std::size_t l = 0; l < loops.size(); ++l) {
    int depth = 0;
    for (std::size_t o = 0; o < loops.size(); ++o)
      if (o != l && insidePolygon(loops[o].points, loops[l].points[0])) ++depth;
    const double area = polygonArea2(loops[l].points);
    if (std::abs(area) <= tolerance * size * size)
      return loopError(ErrorCode::degenerateFacet, "Loop " + std::to_string(l) + " encloses no area.", l);
    const bool isHole = area < 0;
    if (isHole && depth % 2 == 0 && l > 0)
      return loopError(ErrorCode::holeOutside,
                       "Loop " + std::to_string(l) +
                           " runs clockwise, as a hole does, but lies in no other loop: move "
                           "it inside the domain, or turn it round to make it a component of its own.",
                       l);
    const bool shouldBeHole = depth % 2 == 1;
    if (isHole != shouldBeHole) {
      std::reverse(loops[l].points.begin(), loops[l].points.end());
      std::reverse(loops[l].vertices.begin(), loops[l].vertices.end());
      // Segment k now runs from vertex k to k + 1 of the reversed list.
      std::reverse(loops[l].givenSegments.begin(), loops[l].givenSegments.end() - 1);
      prepared.repairs.push_back("loop " + std::to_string(l) + " was turned round");
    }
  }
  std::vector<Index> kept;
  for (Loop &loop : loops) {
    dropCollinear(loop, tolerance * size, prepared.facetOfGiven, kept);
    const Index first = toIndex(prepared.domain.facets.size());
    for (const Index segment : loop.givenSegments) prepared.facetOfGiven[at(segment)] += first;
    for (std::size_t k = 0; k < kept.size(); ++k)
      prepared.domain.facets.push_back(
          {{{loop.vertices[at(kept[k])], loop.vertices[at(kept[(k + 1) % kept.size()])]}}});
  }
  prepared.deviation = coordinateRounding(given);
  compactVertices(prepared);
  return prepared;
}

} // namespace dualblock
