#include "domain/merge_facets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "domain/polygon.h"

namespace dualblock {
namespace {

/// The plane of a growing group of facets, by area.
struct GroupPlane {
  Vec<3> area{0.0};   // twice the vector area
  Vec<3> moment{0.0}; // sum of corners
  double corners = 0;

  void add(const std::vector<Vec<3>> &vertices, const Facet &facet, const Vec<3> &areaOfFacet) {
    area += areaOfFacet;
    for (const auto &loop : facet.loops)
      for (const Index v : loop) {
        moment += vertices[at(v)];
        corners += 1;
      }
  }
  Plane<3> plane() const { return planeThrough(moment / corners, area); }
};

/// Boundary edges of a group of facets, chained into loops. Where loops touch at a vertex, each goes on along
/// the gap between facets that it came along: a hole that touches the outline stays a loop of its own.
std::vector<std::vector<Index>> boundaryLoops(const std::vector<Vec<3>> &vertices,
                                              const std::vector<Facet> &facets,
                                              const std::vector<Index> &group, const Vec<3> &normal) {
  std::map<std::pair<Index, Index>, int> directed;
  for (const Index f : group)
    for (const auto &loop : facets[at(f)].loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Index a = loop[k];
        const Index b = loop[(k + 1) % loop.size()];
        if (const auto back = directed.find({b, a}); back != directed.end()) directed.erase(back);
        else directed[{a, b}] = 1;
      }
  std::map<Index, std::vector<Index>> next;
  for (const auto &[edge, count] : directed) next[edge.first].push_back(edge.second);
  const PlaneBasis basis(normal);
  std::vector<std::vector<Index>> loops;
  while (!next.empty()) {
    std::vector<Index> loop;
    Index previous = kNone;
    Index here = next.begin()->first;
    const Index first = here;
    do {
      loop.push_back(here);
      auto &choices = next[here];
      std::size_t best = 0;
      if (choices.size() > 1 && previous != kNone) {
        const auto angleTo = [&](Index v) {
          const Vec<2> d = basis.project(vertices[at(v)] - vertices[at(here)]);
          return std::atan2(d.y, d.x);
        };
        const double from = angleTo(previous);
        double smallest = 1e9;
        for (std::size_t c = 0; c < choices.size(); ++c) {
          double turn = angleTo(choices[c]) - from; // counter-clockwise: across what is no facet
          while (turn <= 1e-12) turn += 2 * 3.14159265358979323846;
          if (turn < smallest) {
            smallest = turn;
            best = c;
          }
        }
      }
      const Index to = choices[best];
      choices.erase(choices.begin() + static_cast<std::ptrdiff_t>(best));
      if (choices.empty()) next.erase(here);
      previous = here;
      here = to;
    } while (here != first && next.count(here));
    loops.push_back(std::move(loop));
  }
  // The outer loop has the largest area.
  const auto area = [&](const std::vector<Index> &loop) {
    std::vector<Vec<2>> polygon;
    for (const Index v : loop) polygon.push_back(basis.project(vertices[at(v)]));
    return polygonArea2(polygon);
  };
  sortItems(loops, [&](const auto &a, const auto &b) { return area(a) > area(b); });
  return loops;
}

} // namespace

std::vector<EdgeUse> edgeUses(const std::vector<Facet> &facets) {
  std::vector<EdgeUse> uses;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const auto &loop : facets[f].loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Index a = loop[k];
        const Index b = loop[(k + 1) % loop.size()];
        uses.push_back({sortedPair(a, b), toIndex(f), a < b});
      }
  Index last = 0;
  for (const EdgeUse &use : uses) last = std::max(last, use.nodes[0]);
  sortByIndex(
      uses, at(last) + 1, [](const EdgeUse &use) { return use.nodes[0]; },
      [](const EdgeUse &a, const EdgeUse &b) {
        return std::tie(a.nodes, a.facet) < std::tie(b.nodes, b.facet);
      });
  return uses;
}

Lists<FacetNeighbour> facetNeighbours(const std::vector<EdgeUse> &uses, std::size_t facets) {
  return collectLists<FacetNeighbour>(facets, [&](auto put) {
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
      while (end < uses.size() && uses[end].nodes == uses[begin].nodes) ++end;
      if (end - begin != 2) continue;
      const EdgeUse &a = uses[begin];
      const EdgeUse &b = uses[begin + 1];
      put(a.facet, {b.facet, a.forward != b.forward});
      put(b.facet, {a.facet, a.forward != b.forward});
    }
  });
}

MergedFacets mergeCoplanar(const std::vector<Vec<3>> &vertices, std::vector<Facet> facets, double tolerance) {
  const Lists<FacetNeighbour> neighbours = facetNeighbours(edgeUses(facets), facets.size());
  std::vector<Vec<3>> area(facets.size());
  std::vector<double> size(facets.size());
  std::vector<Index> order(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    area[f] = areaVector(vertices, facets[f]);
    size[f] = glm::length(area[f]);
    order[f] = toIndex(f);
  }
  sortItems(order, [&](Index a, Index b) { return size[at(a)] > size[at(b)]; });

  // Grow groups from the largest facets; their normals are the best known.
  std::vector<Index> groupOf(facets.size(), kNone);
  std::vector<std::vector<Index>> groups;
  for (const Index seed : order) {
    if (groupOf[at(seed)] != kNone) continue;
    const Index g = toIndex(groups.size());
    std::vector<Index> group{seed};
    groupOf[at(seed)] = g;
    GroupPlane plane;
    plane.add(vertices, facets[at(seed)], area[at(seed)]);
    Plane<3> p = plane.plane();
    for (std::size_t head = 0; head < group.size(); ++head)
      for (auto n = neighbours.begin(group[head]); n != neighbours.end(group[head]); ++n) {
        const std::size_t f = at(n->facet);
        if (groupOf[f] != kNone || !n->agrees) continue;
        if (facets[f].isInterface != facets[at(group[head])].isInterface) continue;
        const bool alike = glm::dot(area[f], p.normal) > 0.9 * size[f];
        if (!alike || deviation<3>(vertices, facets[f], p) > tolerance) continue;
        groupOf[f] = g;
        group.push_back(n->facet);
        plane.add(vertices, facets[f], area[f]);
        p = plane.plane();
      }
    groups.push_back(std::move(group));
  }

  MergedFacets merged;
  merged.facetOfGiven.assign(facets.size(), kNone);
  // In the order of their lowest facet, so that untouched domains keep their numbering.
  for (auto &group : groups) sortItems(group);
  sortItems(groups);
  for (const auto &group : groups) {
    std::vector<std::vector<Index>> loops;
    if (group.size() > 1) {
      GroupPlane plane;
      for (const Index f : group) plane.add(vertices, facets[at(f)], area[at(f)]);
      const Plane<3> p = plane.plane();
      bool flat = true;
      for (const Index f : group) flat &= deviation<3>(vertices, facets[at(f)], p) <= 2 * tolerance;
      if (flat) loops = boundaryLoops(vertices, facets, group, p.normal);
    }
    if (loops.empty()) {
      for (const Index f : group) {
        merged.facetOfGiven[at(f)] = toIndex(merged.facets.size());
        merged.facets.push_back(std::move(facets[at(f)]));
      }
      continue;
    }
    for (const Index f : group) merged.facetOfGiven[at(f)] = toIndex(merged.facets.size());
    merged.facets.push_back({std::move(loops), facets[at(group[0])].isInterface});
  }
  return merged;
}

void dropStraightVertices(const std::vector<Vec<3>> &vertices, std::vector<Facet> &facets, double tolerance) {
  const std::vector<EdgeUse> uses = edgeUses(facets);
  std::vector<std::array<Index, 3>> ends(vertices.size(),
                                         {kNone, kNone, 0}); // two neighbours, and the degree
  for (std::size_t u = 0; u < uses.size(); ++u) {
    if (u > 0 && uses[u].nodes == uses[u - 1].nodes) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      auto &e = ends[at(uses[u].nodes[k])];
      if (e[2] < 2) e[at(e[2])] = uses[u].nodes[1 - k];
      ++e[2];
    }
  }
  std::vector<bool> straight(vertices.size(), false);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (ends[v][2] != 2) continue;
    const Vec<3> a = vertices[at(ends[v][0])];
    const Vec<3> b = vertices[at(ends[v][1])];
    const double length = glm::length(b - a);
    if (length <= tolerance || glm::dot(vertices[v] - a, b - vertices[v]) <= 0) continue;
    straight[v] = glm::length(glm::cross(vertices[v] - a, b - a)) / length <= tolerance;
  }
  for (Facet &facet : facets)
    for (auto &loop : facet.loops)
      loop.erase(std::remove_if(loop.begin(), loop.end(), [&](Index v) { return straight[at(v)]; }),
                 loop.end());
}

} // namespace dualblock
