#include "contributions/given_matching.h"

#include <algorithm>
#include <bit>
#include <map>

#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace dualblock {
namespace {

/// A matching point: on the edge {near, far}, nearer to `near`.
using Point = std::pair<Index, Index>;

struct Arrivals {
  std::vector<Index> hardFrom; // triangles
  bool soft = false;
};

} // namespace

std::vector<MatchingFault> checkGivenContributions(const ReferenceMesh<2> &mesh,
                                                   const std::vector<std::array<Index, 3>> &triangles,
                                                   const std::vector<GivenContribution> &contributions) {
  std::map<std::array<Index, 2>, int> trianglesAt; // per edge
  for (const auto &t : mesh.simplices)
    for (std::size_t k = 0; k < 3; ++k) ++trianglesAt[sortedPair(t[k], t[(k + 1) % 3])];

  std::map<Point, Arrivals> points;
  std::vector<std::array<Point, 2>> collapsed;
  for (const GivenContribution &c : contributions) {
    std::vector<Point> ends;
    for (const Index a : triangles[at(c.simplex)])
      for (const Index b : triangles[at(c.simplex)]) {
        const auto holds = [&](Index v) {
          return std::find(c.nodes.begin(), c.nodes.end(), v) != c.nodes.end();
        };
        if (a != b && holds(a) && !holds(b)) ends.emplace_back(a, b);
      }
    for (const Point &p : ends) {
      if (c.hard) points[p].hardFrom.push_back(c.simplex);
      else points[p].soft = true;
    }
    if (!c.hard) collapsed.push_back({ends[0], ends[1]});
  }

  std::map<Point, Index> number;
  for (const auto &[point, arrivals] : points) number.emplace(point, toIndex(number.size()));
  DisjointSets sets(number.size());
  for (const auto &[a, b] : collapsed) sets.unite(number[a], number[b]);
  std::vector<int> hardInSet(number.size(), 0);
  for (const auto &[point, arrivals] : points)
    hardInSet[at(sets.find(number[point]))] += static_cast<int>(arrivals.hardFrom.size());

  std::vector<MatchingFault> faults;
  std::vector<bool> reported(number.size(), false);
  for (const auto &[point, arrivals] : points) {
    const auto [near, far] = point;
    const Index set = sets.find(number[point]);
    const int total = hardInSet[at(set)];
    const int here = static_cast<int>(arrivals.hardFrom.size());
    const std::string place = "On the edge between nodes " + std::to_string(near) + " and " +
                              std::to_string(far) + ", near " + std::to_string(near) + ": ";
    if (trianglesAt[sortedPair(near, far)] == 1) {
      if (arrivals.soft)
        faults.push_back({near, far, here,
                          place + "a soft contribution ends at the boundary, where nothing can "
                                  "match it (paper 4.3, boundary edge)."});
      else if (here > 1)
        faults.push_back({near, far, here,
                          place + std::to_string(here) +
                              " hard contributions meet the boundary at "
                              "one point; one or none may (paper 4.3, boundary edge)."});
      continue;
    }
    if (arrivals.soft) {
      if (total == 2 || total == 4 || reported[at(set)]) continue;
      reported[at(set)] = true;
      faults.push_back({near, far, total,
                        place + "soft contributions collapse to one virtual point where " +
                            std::to_string(total) +
                            " hard ones arrive; it must be two or four "
                            "(paper 4.3, figure 12b)."});
      continue;
    }
    const int left = static_cast<int>(
        std::count(arrivals.hardFrom.begin(), arrivals.hardFrom.end(), arrivals.hardFrom[0]));
    if (left != here - left)
      faults.push_back({near, far, here,
                        place + std::to_string(left) + " hard contribution(s) arrive from one side and " +
                            std::to_string(here - left) +
                            " from the other; the numbers must be equal "
                            "(paper 4.3, figure 12a)."});
  }
  return faults;
}

Contributions<2> givenContributions(const ReferenceMesh<2> &mesh,
                                    const std::vector<GivenContribution> &contributions) {
  Contributions<2> result;
  result.present.assign(mesh.simplices.size(), 0);
  result.soft.assign(mesh.simplices.size(), 0);
  std::vector<const GivenContribution *> bySimplex;
  bySimplex.reserve(contributions.size());
  for (const GivenContribution &c : contributions) bySimplex.push_back(&c);
  sortItems(bySimplex, [](const auto *a, const auto *b) { return a->simplex < b->simplex; });
  auto next = bySimplex.begin();
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    for (; next != bySimplex.end() && (*next)->simplex == s; ++next) {
      unsigned mask = 0;
      for (const Index node : (*next)->nodes) mask |= 1U << mesh.localVertex(s, node);
      const ContributionSet bit = contributionBit(mask);
      result.present[at(s)] = result.present[at(s)] | bit;
      if (!(*next)->hard) result.soft[at(s)] = result.soft[at(s)] | bit;
      result.ofSimplex.items.push_back({kNone, static_cast<std::uint8_t>(mask)});
    }
    result.ofSimplex.closeList();
    result.softCount += std::popcount(unsigned{result.soft[at(s)]});
    result.hardCount += std::popcount(unsigned{result.present[at(s)]} & ~unsigned{result.soft[at(s)]});
  }
  return result;
}

} // namespace dualblock
