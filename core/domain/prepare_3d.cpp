#include <algorithm>

#include "base/sort.h"
#include "domain/merge_facets.h"
#include "domain/polygon.h"
#include "domain/prepare.h"
#include "domain/prepare_common.h"

namespace dualblock {
namespace {

/// Facets that the input itself calls planar may be off by this many tolerances: files often hold six digits.
constexpr double kGivenSlack = 10;

/// What is wrong with a facet of too little area.
std::string smallFacet(double area, double tolerance, double perimeter) {
  constexpr double kThin = 1e-7; // of a perimeter's square: no area at all, but for rounding
  if (area <= kThin * perimeter * perimeter)
    return " has no area: remove it, and join the facets on both sides of it.";
  return " is too small for a domain of this size: its area is " + formatNumber(area) +
         ", and the tolerance is " + formatNumber(tolerance) + " times its perimeter of " +
         formatNumber(perimeter) +
         ". Give a smaller tolerance, or remove the facet and join those on both sides of it.";
}

/// given: per facet, its number in the input; repeated: whether one before it has the same corners.
std::optional<Error> checkFacets(const Domain<3> &domain, const std::vector<Index> &given,
                                 const std::vector<bool> &repeated, double tolerance) {
  if (domain.facets.size() < 4)
    return Error{ErrorCode::tooFewFacets,
                 "The domain has " + std::to_string(domain.facets.size()) +
                     " facets; a solid needs at least 4.",
                 {}};
  std::vector<Index> corners;
  for (std::size_t f = 0; f < domain.facets.size(); ++f) {
    const auto error = [&](ErrorCode code, const std::string &what) {
      return Error{code, "Facet " + std::to_string(given[f]) + what, {{"facet", given[f]}}};
    };
    corners.clear();
    for (const auto &loop : domain.facets[f].loops) {
      if (loop.size() < 3)
        return error(ErrorCode::degenerateFacet, " has a loop of fewer than three vertices.");
      corners.insert(corners.end(), loop.begin(), loop.end());
    }
    sortItems(corners);
    if (const auto twice = std::adjacent_find(corners.begin(), corners.end()); twice != corners.end())
      return error(ErrorCode::degenerateFacet,
                   " uses vertex " + std::to_string(*twice) + " twice: give each loop its corners once.");
    const Vec<3> area = areaVector(domain.vertices, domain.facets[f]);
    double perimeter = 0;
    for (const auto &loop : domain.facets[f].loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        perimeter +=
            glm::length(domain.vertices[at(loop[(k + 1) % loop.size()])] - domain.vertices[at(loop[k])]);
    if (!(glm::length(area) > tolerance * perimeter))
      return error(ErrorCode::degenerateFacet, smallFacet(glm::length(area) / 2, tolerance / 2, perimeter));
    if (repeated[f])
      return error(ErrorCode::duplicateFacet,
                   " has the same corners as an earlier facet: remove one of them.");
    const double off =
        deviation<3>(domain.vertices, domain.facets[f], facetPlane<3>(domain.vertices, domain.facets[f]));
    if (off > kGivenSlack * tolerance)
      return error(ErrorCode::nonPlanarFacet, " is not planar: a corner lies " + formatNumber(off) +
                                                  " off its plane, more than the " +
                                                  formatNumber(kGivenSlack * tolerance) +
                                                  " allowed. Triangulate it, or raise the tolerance.");
  }
  return std::nullopt;
}

/// Gives vertices with equal coordinates one number. Files that repeat a vertex per facet are common, and
/// equal coordinates leave no doubt.
void mergeEqualVertices(PreparedDomain<3> &prepared) {
  Domain<3> &domain = prepared.domain;
  if (domain.reference) return; // its nodes are numbered like the vertices
  std::vector<Index> order(domain.vertices.size());
  for (std::size_t v = 0; v < order.size(); ++v) order[v] = toIndex(v);
  const auto key = [&](Index v) {
    const Vec<3> &x = domain.vertices[at(v)];
    return std::array<double, 3>{x.x, x.y, x.z};
  };
  sortItems(order, [&](Index a, Index b) { return key(a) < key(b); });
  std::vector<Index> first(order.size());
  Index merged = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && key(order[k]) == key(order[k - 1]);
    first[at(order[k])] = same ? first[at(order[k - 1])] : order[k];
    merged += same ? 1 : 0;
  }
  if (merged == 0) return;
  prepared.repairs.push_back(std::to_string(merged) +
                             " vertices with the coordinates of another were merged with it");
  for (Facet &facet : domain.facets)
    for (auto &loop : facet.loops)
      for (Index &v : loop) v = first[at(v)];
}

/// Per facet, the last one before it that has the same corners in any order, or kNone.
std::vector<Index> earlierTwins(const std::vector<Facet> &facets) {
  Lists<Index> corners; // of each facet, sorted
  std::vector<Index> order;
  Index most = 0;
  for (const Facet &facet : facets) {
    for (const auto &loop : facet.loops) corners.items.insert(corners.items.end(), loop.begin(), loop.end());
    Index *const begin = corners.items.data() + corners.offsets.back();
    Index *const end = corners.items.data() + corners.items.size();
    sortRange(begin, end);
    if (begin != end) most = std::max(most, *begin);
    corners.closeList();
    order.push_back(toIndex(order.size()));
  }
  sortByIndex( // stable: equal ones stay in the order of their numbers
      order, at(most) + 1, [&](Index f) { return corners.size(f) > 0 ? *corners.begin(f) : 0; },
      [&](Index a, Index b) {
        return std::lexicographical_compare(corners.begin(a), corners.end(a), corners.begin(b),
                                            corners.end(b));
      });
  std::vector<Index> earlier(facets.size(), kNone);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Index a = order[k - 1];
    const Index b = order[k];
    if (std::equal(corners.begin(a), corners.end(a), corners.begin(b), corners.end(b))) earlier[at(b)] = a;
  }
  return earlier;
}

/// 1 if the loops are the same but for where they begin, -1 if one is the other turned over, 0 else.
int sameLoop(const std::vector<Index> &a, const std::vector<Index> &b) {
  const std::size_t n = a.size();
  if (n == 0 || b.size() != n) return 0;
  const std::size_t start =
      static_cast<std::size_t>(std::find(a.begin(), a.end(), b[0]) - a.begin()); // n where there is none
  const auto runs = [&](std::size_t step) {
    for (std::size_t k = 0, m = start; k < n; ++k, m = (m + step) % n)
      if (a[m % n] != b[k]) return false;
    return true;
  };
  return runs(1) ? 1 : runs(n - 1) ? -1 : 0;
}

struct KeptFacets {
  std::vector<Index> number;  // per facet of the input: its new number, or kNone
  std::vector<bool> repeated; // per facet kept: whether one before it has the same corners
};

/// Drops what equal points leave no doubt about: triangles that lost a corner when equal vertices were
/// merged, and the second of two facets that are the same but turned over, which is how solids that share a
/// facet are given.
KeptFacets dropRepeatedFacets(PreparedDomain<3> &prepared, const Domain<3> &given) {
  std::vector<Facet> &facets = prepared.domain.facets;
  const std::vector<Index> earlier = earlierTwins(facets);
  const auto distinct = [](const std::vector<Index> &triangle) {
    const bool first = triangle[0] == triangle[1];
    return first && triangle[1] == triangle[2]                                 ? 1
           : first || triangle[1] == triangle[2] || triangle[2] == triangle[0] ? 2
                                                                               : 3;
  };
  // Of the facets with one's corners before it: the last one that was kept, and the last one whose loop none
  // before has.
  std::vector<std::array<Index, 2>> before(facets.size(), {kNone, kNone});
  std::vector<bool> isNew(facets.size(), false);
  KeptFacets result{std::vector<Index>(facets.size(), kNone), {}};
  std::vector<Facet> kept;
  Index collapsed = 0;
  Index shared = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (const Index e = earlier[f]; e != kNone)
      before[f] = {result.number[at(e)] == kNone ? before[at(e)][0] : e, isNew[at(e)] ? e : before[at(e)][1]};
    if (facets[f].loops.size() == 1) {
      const std::vector<Index> &loop = facets[f].loops[0];
      if (loop.size() == 3 && distinct(loop) < distinct(given.facets[f].loops[0])) {
        ++collapsed;
        continue;
      }
      isNew[f] = true;
      Index turned = kNone;
      for (Index e = before[f][1]; e != kNone; e = before[at(e)][1]) {
        const int sense = sameLoop(kept[at(result.number[at(e)])].loops[0], loop);
        if (sense > 0) isNew[f] = false;
        if (sense < 0) turned = result.number[at(e)];
      }
      if (turned != kNone && !kept[at(turned)].isInterface) {
        kept[at(turned)].isInterface = true;
        result.number[f] = turned;
        isNew[f] = false;
        ++shared;
        continue;
      }
    }
    result.number[f] = toIndex(kept.size());
    result.repeated.push_back(before[f][0] != kNone);
    kept.push_back(std::move(facets[f]));
  }
  facets = std::move(kept);
  if (collapsed > 0)
    prepared.repairs.push_back(std::to_string(collapsed) +
                               " triangles with two corners at one point were dropped");
  if (shared > 0)
    prepared.repairs.push_back(std::to_string(shared) +
                               " facets that two solids share, given by both, were taken once");
  return result;
}

/// Puts each facet's largest loop first, and turns the others as they nest: holes against it, islands in them
/// and pieces beside it as it runs.
void orientHoleLoops(PreparedDomain<3> &prepared) {
  const std::vector<Vec<3>> &vertices = prepared.domain.vertices;
  const auto loopArea = [&](const std::vector<Index> &loop) { return areaVector(vertices, Facet{{loop}}); };
  Index turned = 0;
  for (Facet &facet : prepared.domain.facets) {
    const bool isSound =
        std::all_of(facet.loops.begin(), facet.loops.end(), [](const auto &loop) { return loop.size() > 2; });
    if (facet.loops.size() < 2 || !isSound) continue; // refused later
    const auto outer =
        std::max_element(facet.loops.begin(), facet.loops.end(), [&](const auto &a, const auto &b) {
          return glm::length(loopArea(a)) < glm::length(loopArea(b));
        });
    std::iter_swap(facet.loops.begin(), outer);
    const Vec<3> area = loopArea(facet.loops[0]);
    if (!(glm::length(area) > 0)) continue;
    const auto polygons = projected(vertices, facet, PlaneBasis(glm::normalize(area)));
    const auto around = nestingOf(polygons);
    for (std::size_t l = 1; l < facet.loops.size(); ++l) {
      const bool isHole = around[l].size() % 2 == 1;
      if ((polygonArea2(polygons[l]) < 0) == isHole) continue;
      std::reverse(facet.loops[l].begin(), facet.loops[l].end());
      ++turned;
    }
  }
  if (turned > 0)
    prepared.repairs.push_back(std::to_string(turned) + " loops inside of facets were turned round");
}

/// Every edge must belong to at least two facets; and where to two only, solids share both of them or none.
/// kept: per facet of the input, its number here; given: the other way round.
std::optional<Error> checkClosed(const PreparedDomain<3> &prepared, const std::vector<EdgeUse> &uses,
                                 const std::vector<Index> &kept, const std::vector<Index> &given) {
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].nodes == uses[begin].nodes) ++end;
    if (end - begin == 1)
      return Error{ErrorCode::openBoundary,
                   "The boundary is open: the edge from vertex " + std::to_string(uses[begin].nodes[0]) +
                       " to vertex " + std::to_string(uses[begin].nodes[1]) + " belongs to facet " +
                       std::to_string(given[at(uses[begin].facet)]) +
                       " only. Close the gap, or merge vertices that should be one.",
                   {{"facet", given[at(uses[begin].facet)]},
                    {"vertex", uses[begin].nodes[0]},
                    {"vertex", uses[begin].nodes[1]}}};
    const auto shared = [&](std::size_t u) { return prepared.domain.facets[at(uses[u].facet)].isInterface; };
    if (end - begin != 2 || shared(begin) == shared(begin + 1)) continue;
    const Index facet = uses[shared(begin) ? begin : begin + 1].facet;
    const auto twin = std::find(kept.rbegin(), kept.rend(), facet);
    const Index second = toIndex(static_cast<std::size_t>(kept.rend() - twin)) - 1;
    return Error{ErrorCode::duplicateFacet,
                 "Facet " + std::to_string(second) + " has the same corners as facet " +
                     std::to_string(given[at(facet)]) + ", but no second solid is there: remove one of them.",
                 {{"facet", second}}};
  }
  return std::nullopt;
}

/// Makes neighbours run through their common edge in opposite directions, shell by shell, turning as few
/// facets as possible. Edges of more than two facets bind nobody.
void orientShells(PreparedDomain<3> &prepared, const std::vector<EdgeUse> &uses) {
  std::vector<Facet> &facets = prepared.domain.facets;
  const Lists<FacetNeighbour> neighbours = facetNeighbours(uses, facets.size());
  std::vector<int> turn(facets.size(), -1);
  Index turned = 0;
  for (std::size_t seed = 0; seed < facets.size(); ++seed) {
    if (turn[seed] >= 0) continue;
    std::vector<Index> shell{toIndex(seed)};
    turn[seed] = 0;
    std::size_t flips = 0;
    for (std::size_t head = 0; head < shell.size(); ++head)
      for (auto n = neighbours.begin(shell[head]); n != neighbours.end(shell[head]); ++n) {
        int &turns = turn[at(n->facet)];
        if (turns >= 0) continue;
        turns = n->agrees ? turn[at(shell[head])] : 1 - turn[at(shell[head])];
        flips += turns == 1 ? 1 : 0;
        shell.push_back(n->facet);
      }
    const bool invert = 2 * flips > shell.size();
    for (const Index f : shell) {
      if ((turn[at(f)] == 1) == invert) continue;
      for (auto &loop : facets[at(f)].loops) std::reverse(loop.begin(), loop.end());
      ++turned;
    }
  }
  if (turned > 0) prepared.repairs.push_back(std::to_string(turned) + " facets were turned round");
}

} // namespace

Result<PreparedDomain<3>> prepareDomain(const Domain<3> &given, double tolerance) {
  if (auto error = checkNumbers(given)) return *error;
  const double allowed = tolerance * domainSize(given.vertices);
  PreparedDomain<3> prepared;
  prepared.domain = given;
  mergeEqualVertices(prepared);
  const auto [kept, repeated] = dropRepeatedFacets(prepared, given);
  std::vector<Index> givenFacet;
  for (std::size_t f = 0; f < kept.size(); ++f)
    if (kept[f] == toIndex(givenFacet.size())) givenFacet.push_back(toIndex(f));
  orientHoleLoops(prepared);
  if (auto error = checkFacets(prepared.domain, givenFacet, repeated, allowed)) return *error;
  const std::vector<EdgeUse> uses = edgeUses(prepared.domain.facets);
  if (auto error = checkClosed(prepared, uses, kept, givenFacet)) return *error;
  orientShells(prepared, uses);
  MergedFacets merged = mergeCoplanar(given.vertices, std::move(prepared.domain.facets), allowed);
  dropStraightVertices(given.vertices, merged.facets, allowed);
  prepared.domain.facets = std::move(merged.facets);
  for (const Index f : kept) prepared.facetOfGiven.push_back(f == kNone ? kNone : merged.facetOfGiven[at(f)]);
  for (const Facet &facet : prepared.domain.facets)
    prepared.deviation = std::max(prepared.deviation,
                                  deviation<3>(given.vertices, facet, facetPlane<3>(given.vertices, facet)));
  prepared.deviation = std::max(prepared.deviation, coordinateRounding(given));
  compactVertices(prepared);
  return prepared;
}

} // namespace dualblock
