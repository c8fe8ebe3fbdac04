// Cuts along the axes of open arcs, for the shape of parts.
#include <cmath>
#include <numbers>

#include "base/sort.h"
#include "partition/heuristics.h"
#include "partition/sources.h"

namespace dualblock {
namespace {

/// Whether a side turns away from its mean normal too far.
bool turnsTooFar(const PartView &v, Index side) {
  const double leastCosine = std::cos(kMostLean);
  const double hollowCosine = std::cos(kHollowLean);
  struct Facet {
    Vec<3> place, normal;
    double area;
  };
  std::vector<Facet> facets;
  Facet mean{Vec<3>(0.0), Vec<3>(0.0), 0};
  for (const FaceRef<3> *f = v.parts.sideFaces.begin(side); f != v.parts.sideFaces.end(side); ++f) {
    const auto face = v.mesh.sortedFace(f->simplex, f->face);
    const Vec<3> a = v.node(face[0]);
    const double area = glm::length(glm::cross(v.node(face[1]) - a, v.node(face[2]) - a));
    facets.push_back(
        {(a + v.node(face[1]) + v.node(face[2])) / 3.0, v.mesh.outwardNormal(f->simplex, f->face), area});
    mean.place += area * facets.back().place;
    mean.normal += area * facets.back().normal;
    mean.area += area;
  }
  if (glm::length(mean.normal) == 0) return true;
  mean.normal = glm::normalize(mean.normal);
  mean.place /= mean.area;
  double beyond = 0; // by area: normals of slivers mean nothing
  double hollow = 0;
  double spread = 0; // below 0 where normals converge
  for (const Facet &f : facets) {
    const double cosine = glm::dot(f.normal, mean.normal);
    beyond += cosine < leastCosine ? f.area : 0;
    hollow += cosine < hollowCosine ? f.area : 0;
    spread += f.area * glm::dot(f.place - mean.place, f.normal - mean.normal);
  }
  return beyond > 0.02 * mean.area || (v.cutsHollows && spread < 0 && hollow > 0.02 * mean.area);
}

/// Across a side that turns too far: through the axis of the arc that turns most, and that of another arc or,
/// failing that, a vertex near the middle, or else the middle itself. Where there is a second such arc the
/// plane runs from one to the other.
std::optional<Cut> acrossArc(const PartView &v, Index side) {
  struct Arc {
    double turn;
    Chain chain;
    Axis axis;
  };
  std::vector<Arc> arcs;
  std::vector<Axis> others; // of arcs of any side
  for (const Curve<3> *curve : v.curves) {
    const bool isOfSide = curve->sides[0] == side || curve->sides[1] == side;
    for (Chain &chain : chainsOf(*curve)) {
      Axis axis;
      if (chain.closed || !axisOf(chain, v.mesh.nodes, v.axes, axis)) continue;
      others.push_back(axis);
      if (!isOfSide) continue;
      const Vec<3> a = glm::normalize(v.node(chain.nodes.front()) - axis.centre);
      const Vec<3> b = glm::normalize(v.node(chain.nodes.back()) - axis.centre);
      const Vec<3> middle = v.node(chain.nodes[chain.nodes.size() / 2]) - axis.centre;
      // Half the angle between the ends, or 180 degrees less that, as the middle lies between or beyond them.
      const double half = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) / 2;
      arcs.push_back({glm::dot(a + b, middle) >= 0 ? half : std::numbers::pi - half, std::move(chain), axis});
    }
  }
  sortItems(arcs, [](const Arc &a, const Arc &b) { return a.turn > b.turn; });
  if (arcs.empty()) return std::nullopt;
  const Chain &chain = arcs[0].chain;
  Axis axis = arcs[0].axis;
  if (arcs.size() > 1 && arcs[1].turn > 0.9 * arcs[0].turn) {
    const Vec<3> along = arcs[1].axis.centre - axis.centre;
    if (std::abs(glm::dot(along, axis.direction)) > 0.5 * glm::length(along))
      axis.direction = glm::normalize(along);
  }
  Vec<3> middle = v.node(chain.nodes[chain.nodes.size() / 2]) - axis.centre;
  const Vec<3> across = v.node(chain.nodes.back()) - v.node(chain.nodes.front());
  if (glm::length(across) > 0) middle -= glm::dot(middle, across) / glm::dot(across, across) * across;
  const auto flat = [&](const Vec<3> &x) { return x - glm::dot(x, axis.direction) * axis.direction; };
  middle = glm::normalize(flat(middle));
  Vec<3> towards = middle;
  double nearest = std::cos(kNearMiddle);
  const auto attract = [&](const Vec<3> &x) {
    const Vec<3> d = flat(x - axis.centre);
    if (glm::length(d) <= kOnAxis * v.mesh.size) return;
    const double cosine = glm::dot(glm::normalize(d), middle);
    if (cosine <= nearest) return;
    nearest = cosine;
    towards = glm::normalize(d);
  };
  for (const Axis &other : others)
    if (glm::length(glm::cross(other.direction, axis.direction)) <= kOnAxis) attract(other.centre);
  if (towards == middle)
    for (const Corner *corner : v.corners) // others are where a bent cut happens to end
      if (std::count_if(corner->sides.begin(), corner->sides.end(),
                        [&](Index s) { return v.kindOf(s) != SurfaceKind::bentCut; }) >= 3)
        attract(v.node(corner->node));
  return Cut{planeSurface(axis.centre, glm::cross(axis.direction, towards)),
             halfOf(chain, v.mesh.nodes, axis, towards)};
}

/// Where a chain turns: at its nodes, or at every few of them where there are many, as cuts leave jags.
struct Bends {
  std::vector<std::size_t> at; // places in the chain
  std::vector<double> turned;  // radians, up to each of them and at it
};

Bends bendsOf(const PartView &v, const Chain &chain) {
  Bends bends;
  const std::size_t stride = std::max<std::size_t>(1, chain.nodes.size() / kManyNodes);
  const auto direction = [&](std::size_t from, std::size_t to) {
    return glm::normalize(v.node(chain.nodes[to]) - v.node(chain.nodes[from]));
  };
  double turned = 0;
  for (std::size_t k = stride; k + 1 < chain.nodes.size(); k += stride) {
    const std::size_t next = std::min(k + stride, chain.nodes.size() - 1);
    turned += std::acos(std::clamp(glm::dot(direction(k - stride, k), direction(k, next)), -1.0, 1.0));
    bends.at.push_back(k);
    bends.turned.push_back(turned);
  }
  return bends;
}

/// Square to a chain at one of its nodes; through the axis where it is an arc of a circle.
Cut squareTo(const PartView &v, const Chain &chain, std::size_t place) {
  const Vec<3> x = v.node(chain.nodes[place]);
  Vec<3> normal =
      glm::normalize(x - v.node(chain.nodes[place - 1])) + glm::normalize(v.node(chain.nodes[place + 1]) - x);
  if (Axis axis; axisOf(chain, v.mesh.nodes, v.axes, axis)) {
    const double radius = glm::length(x - axis.centre);
    const bool isArc = std::all_of(chain.nodes.begin(), chain.nodes.end(), [&](Index n) {
      return std::abs(glm::length(v.node(n) - axis.centre) - radius) <= kArc * radius;
    });
    if (isArc) normal = glm::cross(axis.direction, x - axis.centre);
  }
  return {planeSurface(x, normal), {chain.nodes[place]}};
}

/// Across the curves that `wanted` accepts and that turn by more than `least`, half way of what they turn by;
/// those that turn most first.
template <typename Wanted> std::vector<Cut> acrossSome(const PartView &v, double least, Wanted wanted) {
  std::vector<std::pair<double, Cut>> ranked;
  for (const Curve<3> *curve : v.curves) {
    if (!wanted(*curve)) continue;
    for (const Chain &chain : chainsOf(*curve)) {
      if (chain.closed) continue;
      const Bends bends = bendsOf(v, chain);
      if (bends.at.empty() || bends.turned.back() <= least) continue;
      std::size_t middle = 0;
      while (bends.turned[middle] < 0.5 * bends.turned.back()) ++middle;
      ranked.emplace_back(bends.turned.back(), squareTo(v, chain, bends.at[middle]));
    }
  }
  sortItems(ranked, [](const auto &a, const auto &b) { return a.first > b.first; });
  std::vector<Cut> list;
  for (auto &[turn, cut] : ranked) list.push_back(std::move(cut));
  return list;
}

} // namespace

std::vector<Cut> acrossCurves(const PartView &v) {
  return acrossSome(v, kMostCurveTurn, [&](const Curve<3> &curve) {
    return v.isGiven(curve.sides[0]) && v.isGiven(curve.sides[1]);
  });
}

std::vector<Cut> halving(const PartView &v) {
  return acrossSome(v, kLeastCurveTurn, [&](const Curve<3> &curve) {
    return std::any_of(curve.sides.begin(), curve.sides.end(),
                       [&](Index side) { return v.isGiven(side) && v.isBent(side); });
  });
}

std::vector<Cut> acrossTurns(const PartView &v) {
  std::vector<Cut> list;
  for (const Index *side = v.firstSide(); side != v.lastSide(); ++side)
    if (v.isGiven(*side) && v.isBent(*side) && turnsTooFar(v, *side))
      if (std::optional<Cut> cut = acrossArc(v, *side)) list.push_back(std::move(*cut));
  return list;
}

} // namespace dualblock
