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

/// A matching point as one of its edge's triangles sees it.
struct End {
  Point point;
  Index opposite = kNone;    // the same point from the other triangle; none at the boundary
  int hard = 0;              // contributions of the triangle that arrive
  std::vector<Index> softTo; // the ends of its soft ones that lead away
};

/// All matching points that are touched, and how soft contributions join them: the ends of one set are one
/// point, a virtual one where there are soft contributions.
class Arrangement {
public:
  Arrangement(const std::vector<std::array<Index, 3>> &triangles,
              const std::vector<GivenContribution> &contributions)
      : triangles_(triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        trianglesAt_[sortedPair(triangles[t][k], triangles[t][(k + 1) % 3])].push_back(toIndex(t));
    std::vector<int> longIn(triangles.size(), 0); // contributions of two nodes: they cross one another
    std::vector<int> hardIn(triangles.size(), 0); // those of them that are hard
    for (const GivenContribution &c : contributions)
      if (c.nodes.size() == 2) {
        ++longIn[at(c.simplex)];
        hardIn[at(c.simplex)] += c.hard ? 1 : 0;
      }
    std::vector<std::pair<Index, int>> crossings; // an end of a contribution, how many others cross it
    for (const GivenContribution &c : contributions) {
      const auto [p, q] = endsOf(c);
      joined_.push_back({p, q});
      if (c.hard) {
        ++ends[at(p)].hard;
        ++ends[at(q)].hard;
        isNode_.push_back(c.nodes.size() == 2 && hardIn[at(c.simplex)] > 1);
      } else {
        ends[at(p)].softTo.push_back(q);
        ends[at(q)].softTo.push_back(p);
        if (c.nodes.size() == 2) crossings.emplace_back(p, longIn[at(c.simplex)] - 1);
        isNode_.push_back(false);
      }
    }
    collectSets();
    for (const auto &[end, others] : crossings) multiplicity[at(setOf[at(end)])] += 2 * others;
  }

  /// The first end, in the order of the points, of each D-bar-curve that crosses no other nor itself.
  std::vector<Index> loneCurves() const {
    DisjointSets curves(multiplicity.size());
    for (const auto &[p, q] : joined_) curves.unite(setOf[at(p)], setOf[at(q)]);
    std::vector<bool> crosses(multiplicity.size(), false);
    for (std::size_t set = 0; set < multiplicity.size(); ++set)
      if (multiplicity[set] == 4) crosses[at(curves.find(toIndex(set)))] = true;
    for (std::size_t c = 0; c < joined_.size(); ++c)
      if (isNode_[c]) crosses[at(curves.find(setOf[at(joined_[c][0])]))] = true;
    std::vector<Index> found;
    for (const auto &[key, end] : number_) {
      const std::size_t curve = at(curves.find(setOf[at(end)]));
      if (crosses[curve]) continue;
      crosses[curve] = true;
      found.push_back(end);
    }
    return found;
  }

  /// Ends in the order of their points.
  template <typename Visit> void visit(Visit visitor) const {
    for (const auto &[key, end] : number_) visitor(end);
  }

  std::vector<End> ends;
  std::vector<Index> setOf;      // per end
  std::vector<int> multiplicity; // per set: hard contributions that arrive, and twice those that cross it
  std::vector<bool> isRing;      // per set: soft contributions come back to where they began
  std::vector<int> beyond;       // per end with an opposite: hard contributions that arrive on its side

private:
  /// The two ends of a contribution, where its triangle has two edges with one of its nodes.
  std::array<Index, 2> endsOf(const GivenContribution &c) {
    const auto holds = [&](Index v) { return std::find(c.nodes.begin(), c.nodes.end(), v) != c.nodes.end(); };
    std::array<Index, 2> found{kNone, kNone};
    for (const Index a : triangles_[at(c.simplex)])
      for (const Index b : triangles_[at(c.simplex)])
        if (a != b && holds(a) && !holds(b)) found[found[0] == kNone ? 0 : 1] = endAt({a, b}, c.simplex);
    return found;
  }

  Index endAt(const Point &point, Index triangle) {
    const std::vector<Index> &around = trianglesAt_[sortedPair(point.first, point.second)];
    for (const Index t : around)
      if (number_.emplace(std::pair(point, t), toIndex(ends.size())).second)
        ends.push_back({point, kNone, 0, {}});
    const Index here = number_.at({point, triangle});
    if (around.size() == 2)
      ends[at(here)].opposite = number_.at({point, around[0] == triangle ? around[1] : around[0]});
    return here;
  }

  /// Sets as trees over `softTo` and `opposite`, each summed up from its leaves.
  void collectSets() {
    for (End &end : ends)
      if (end.opposite != kNone) ends[at(end.opposite)].opposite = toIndex(&end - ends.data());
    setOf.assign(ends.size(), kNone);
    beyond.assign(ends.size(), 0);
    std::vector<Index> parent(ends.size(), kNone);
    for (Index root = 0; root < toIndex(ends.size()); ++root) {
      if (setOf[at(root)] != kNone) continue;
      const Index set = toIndex(multiplicity.size());
      std::vector<Index> tree{root};
      setOf[at(root)] = set;
      std::size_t links = 0; // each seen from both of its ends
      for (std::size_t head = 0; head < tree.size(); ++head) {
        const Index here = tree[head];
        const auto reach = [&](Index there) {
          ++links;
          if (setOf[at(there)] != kNone) return;
          setOf[at(there)] = set;
          parent[at(there)] = here;
          tree.push_back(there);
        };
        for (const Index there : ends[at(here)].softTo) reach(there);
        if (ends[at(here)].opposite != kNone) reach(ends[at(here)].opposite);
      }
      isRing.push_back(links / 2 >= tree.size());
      for (std::size_t k = tree.size(); k-- > 0;) {
        beyond[at(tree[k])] += ends[at(tree[k])].hard;
        if (k > 0) beyond[at(parent[at(tree[k])])] += beyond[at(tree[k])];
      }
      const int total = beyond[at(root)];
      multiplicity.push_back(total);
      for (const Index end : tree) { // so far what is below each end
        const Index opposite = ends[at(end)].opposite;
        if (opposite != kNone && parent[at(opposite)] == end) beyond[at(end)] = total - beyond[at(opposite)];
      }
    }
  }

  const std::vector<std::array<Index, 3>> &triangles_;
  std::map<std::array<Index, 2>, std::vector<Index>> trianglesAt_; // per edge
  std::map<std::pair<Point, Index>, Index> number_;                // of ends, by point and triangle
  std::vector<std::array<Index, 2>> joined_;                       // per contribution: its ends
  std::vector<bool> isNode_; // per contribution: hard, and another hard one crosses it in its triangle
};

} // namespace

std::vector<MatchingFault> checkGivenContributions(const std::vector<std::array<Index, 3>> &triangles,
                                                   const std::vector<GivenContribution> &contributions) {
  const Arrangement arrangement(triangles, contributions);
  std::vector<MatchingFault> faults;
  const auto report = [&](const End &end, int hard, const std::string &what) {
    const auto [near, far] = end.point;
    faults.push_back({near, far, hard,
                      "On the edge between nodes " + std::to_string(near) + " and " + std::to_string(far) +
                          ", near " + std::to_string(near) + ": " + what});
  };
  std::vector<bool> isSoft(arrangement.multiplicity.size(), false);
  for (std::size_t e = 0; e < arrangement.ends.size(); ++e)
    if (!arrangement.ends[e].softTo.empty()) isSoft[at(arrangement.setOf[e])] = true;
  std::vector<bool> reported(arrangement.multiplicity.size(), false);
  arrangement.visit([&](Index e) {
    const End &end = arrangement.ends[at(e)];
    const std::size_t set = at(arrangement.setOf[at(e)]);
    if (end.opposite == kNone) {
      if (!end.softTo.empty())
        report(end, end.hard,
               "a soft contribution ends at the boundary, where nothing can match it "
               "(paper 4.3, boundary edge).");
      else if (end.hard > 1)
        report(end, end.hard,
               std::to_string(end.hard) +
                   " hard contributions meet the boundary at one point; one or none may "
                   "(paper 4.3, boundary edge).");
      return;
    }
    if (reported[set]) return;
    const int left = arrangement.beyond[at(e)];
    const int right = arrangement.beyond[at(end.opposite)];
    const int all = arrangement.multiplicity[set];
    const std::string sides =
        std::to_string(left) + " from one side and " + std::to_string(right) + " from the other";
    if (isSoft[set] && arrangement.isRing[set])
      report(end, all,
             "soft contributions close a ring, and what is within would collapse with them "
             "(paper 4.2, virtual collapse).");
    else if (isSoft[set] && (left != right || (all != 2 && all != 4)))
      report(end, all,
             "soft contributions collapse to one virtual point where " + std::to_string(all) +
                 " hard ones meet, " + sides +
                 "; it must be two or four, as many from the one side as from the other "
                 "(paper 4.3, figure 12b).");
    else if (left != right)
      report(end, all,
             std::to_string(left) + " hard contribution(s) arrive from one side and " +
                 std::to_string(right) +
                 " from the other; the numbers must be equal (paper 4.3, figure 12a).");
    else return;
    reported[set] = true;
  });
  if (faults.empty())
    for (const Index e : arrangement.loneCurves())
      report(arrangement.ends[at(e)], arrangement.ends[at(e)].hard,
             "the D-bar-curve through here crosses none: a block is where two cross, and there is none "
             "behind this one (paper 2.2).");
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
