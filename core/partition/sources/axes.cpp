// Cuts along the axes of closed curves.
#include <cmath>
#include <tuple>

#include "base/sort.h"
#include "partition/heuristics.h"
#include "partition/sources.h"

namespace dualblock {
namespace {

/// A closed curve and the sides that meet in it.
struct Loop {
  Chain chain;
  std::array<Index, 2> sides;
};

/// The part's closed curves, and the axes of the domain's that its open ones are arcs of.
struct Turns {
  std::vector<Loop> loops;
  std::vector<const Axis *> arcs; // each once
};

/// Curves that bent cuts have left are ragged: those of the domain itself know their axis better, and those
/// on a given side and a plane cut hardly less so.
int raggedness(const PartView &v, const Loop &loop) {
  int ragged = 0;
  for (const Index side : loop.sides)
    if (!v.isGiven(side)) ragged += v.isBent(side) ? 3 : 1;
  return ragged;
}

Turns turnsOf(const PartView &v) {
  Turns turns;
  for (const Curve<3> *curve : v.curves)
    for (const Chain &chain : chainsOf(*curve)) {
      Axis axis;
      if (chain.closed) turns.loops.push_back({chain, curve->sides});
      else if (axisOf(chain, v.mesh.nodes, axis))
        if (const Axis *known = knownAxis(v.axes, chain, v.mesh.nodes, axis);
            known && std::find(turns.arcs.begin(), turns.arcs.end(), known) == turns.arcs.end())
          turns.arcs.push_back(known);
    }
  sortItems(turns.loops, [&](const Loop &a, const Loop &b) { return raggedness(v, a) < raggedness(v, b); });
  return turns;
}

/// Tells planes through the axis that divide a chain along or across its length: of a circle's all do. Others
/// would leave parts that are skew.
auto principalPlanes(const PartView &v, const Chain &chain, const Axis &axis) {
  std::array<Vec<3>, 3> moments{Vec<3>(0.0), Vec<3>(0.0), Vec<3>(0.0)}; // by rows
  double sum = 0;
  for (const Segment<3> &s : segmentsOf(chain, v.mesh.nodes)) {
    const Vec<3> x = (s[0] + s[1]) / 2.0 - axis.centre;
    const double length = glm::length(s[1] - s[0]);
    for (int k = 0; k < 3; ++k) moments[at(k)] += length * x[k] * x;
    sum += length * glm::dot(x, x);
  }
  return [=](const Plane<3> &plane) {
    const Vec<3> along = glm::cross(axis.direction, plane.normal);
    const Vec<3> row(glm::dot(moments[0], along), glm::dot(moments[1], along), glm::dot(moments[2], along));
    return std::abs(glm::dot(plane.normal, row)) <= kPrincipal * sum;
  };
}

std::vector<Cut> alongAxis(const PartView &v, const Loop &loop, const Turns &turns) {
  Axis axis;
  if (!axisOf(loop.chain, v.mesh.nodes, v.axes, axis)) return {};
  const double reach = kOnAxis * v.mesh.size;
  struct Other {
    Axis axis;
    std::span<const Index> nodes;
  };
  std::vector<Other> others;
  Axis opposite; // the other end of a bent side that the loop bounds
  Index ends = 0;
  for (const Loop &other : turns.loops) {
    Axis o;
    if (&other == &loop || raggedness(v, other) > 2 || !axisOf(other.chain, v.mesh.nodes, v.axes, o))
      continue;
    others.push_back({o, other.chain.nodes});
    for (const Index side : loop.sides)
      if (v.isBent(side) && (side == other.sides[0] || side == other.sides[1])) {
        opposite = o;
        ++ends;
      }
  }
  for (const Axis *arc : turns.arcs) others.push_back({*arc, {}});
  others.push_back({axis, {}});
  // A tube runs from end to end, which need not be square to its ends.
  if (ends == 1 && glm::length(opposite.centre - axis.centre) > 1e3 * reach) {
    const Vec<3> along = glm::normalize(opposite.centre - axis.centre);
    if (std::abs(glm::dot(along, axis.direction)) > 0.5) axis.direction = along;
  }
  // Axes that are this one tell nothing about directions.
  const auto isSame = [&](const Other &other) {
    const Axis &o = other.axis;
    return glm::length(glm::cross(o.centre - axis.centre, axis.direction)) <= reach &&
           glm::length(glm::cross(o.direction, axis.direction)) <= kOnAxis;
  };
  others.erase(std::remove_if(others.begin(), others.end(), isSame), others.end());
  std::vector<Vec<3>> targets;
  for (const Other &o : others) {
    targets.push_back(o.axis.centre);
    targets.push_back(axis.centre + o.axis.direction * v.mesh.size);
  }
  for (const Corner *corner : v.corners) targets.push_back(v.node(corner->node));
  for (int k = 0; k < 3; ++k) {
    Vec<3> unit{0.0};
    unit[k] = v.mesh.size;
    targets.push_back(axis.centre + unit);
  }
  for (const Index n : loop.chain.nodes) targets.push_back(v.node(n));
  const auto divides = principalPlanes(v, loop.chain, axis);
  const bool isLone = others.empty() && v.corners.empty(); // nothing else tells about directions
  using Score = std::tuple<int, int, int, int, double>;
  std::vector<std::pair<Score, Cut>> ranked;
  for (const Vec<3> &target : targets) {
    const Vec<3> across = glm::cross(axis.direction, target - axis.centre);
    if (glm::length(across) <= 1e3 * reach) continue;
    const Plane<3> plane = planeThrough(axis.centre, across);
    Score score{0, 0, 0, 0, 0};
    std::vector<Index> from = loop.chain.nodes;
    for (const Other &o : others) {
      if (std::abs(plane.distance(o.axis.centre)) > reach ||
          std::abs(glm::dot(o.axis.direction, plane.normal)) > kOnAxis)
        continue;
      ++std::get<0>(score);
      from.insert(from.end(), o.nodes.begin(), o.nodes.end()); // as far as the plane goes
    }
    const Vec<3> towards = target - axis.centre;
    int behind = 0;
    for (const Corner *corner : v.corners) {
      if (std::abs(plane.distance(v.node(corner->node))) > reach) continue;
      const Vec<3> d = v.node(corner->node) - axis.centre;
      ++(glm::dot(d - glm::dot(d, axis.direction) * axis.direction, towards) > 0 ? std::get<1>(score)
                                                                                 : behind);
    }
    const bool half = std::get<0>(score) == 0 && std::get<1>(score) > 0 && behind == 0;
    std::get<1>(score) += behind;
    int held = 0;
    for (const Index n : loop.chain.nodes) held += std::abs(plane.distance(v.node(n))) <= reach ? 1 : 0;
    std::get<2>(score) = isLone && divides(plane) ? 1 : 0;
    std::get<3>(score) = std::min(held, 2);
    const Vec<3> n = glm::abs(plane.normal);
    std::get<4>(score) = std::round(1e6 * std::max({n.x, n.y, n.z}));
    const auto known = std::find_if(ranked.begin(), ranked.end(), [&](const auto &r) {
      return std::abs(glm::dot(r.second.surface.plane.normal, plane.normal)) > 1 - 1e-9;
    });
    if (known != ranked.end() && known->first >= score) continue;
    ranked.emplace_back(score, Cut{planeSurface(axis.centre, plane.normal),
                                   half ? halfOf(loop.chain, v.mesh.nodes, axis, towards) : std::move(from)});
  }
  sortItems(ranked, [](const auto &a, const auto &b) { return a.first > b.first; });
  std::vector<Cut> list;
  for (std::size_t k = 0; k < std::min(ranked.size(), kAxisPlanes); ++k)
    list.push_back(std::move(ranked[k].second));
  return list;
}

} // namespace

std::vector<Cut> alongAxes(const PartView &v) {
  std::vector<Cut> list;
  if (!v.hasBentSide()) return list;
  const Turns turns = turnsOf(v);
  for (const Loop &loop : turns.loops)
    for (Cut &cut : alongAxis(v, loop, turns)) list.push_back(std::move(cut));
  return list;
}

Plane<3> plainPlane(const PartView &v, const Plane<3> &plane) {
  const double reach = kOnAxis * v.mesh.size;
  std::optional<Plane<3>> plain;
  const auto offer = [&](const Vec<3> &point, const Vec<3> &across) {
    if (plain || !(glm::length(across) > 1e-3)) return;
    const double cosine = glm::dot(glm::normalize(across), plane.normal);
    if (std::abs(cosine) > kPlainCosine && std::abs(plane.distance(point)) <= kPlainDistance * v.mesh.size)
      plain = planeThrough(point, cosine < 0 ? -across : across);
  };
  for (const Axis &a : v.axes)
    for (const Axis &b : v.axes) {
      const Vec<3> beside = b.centre - a.centre;
      const Vec<3> both = glm::cross(a.direction, b.direction);
      const double sine = glm::length(both);
      if (sine <= kOnAxis) {
        offer(a.centre, glm::cross(a.direction, beside) / v.mesh.size);
      } else if (std::abs(glm::dot(beside, both)) <= reach * sine) {
        const Vec<3> meet =
            a.centre + glm::dot(glm::cross(beside, b.direction), both) / (sine * sine) * a.direction;
        for (const Vec<3> &normal : {both, a.direction + b.direction, a.direction - b.direction, a.direction})
          offer(meet, normal);
      }
    }
  for (const Axis &a : v.axes)
    for (int k = 0; k < 3; ++k) {
      Vec<3> unit{0.0};
      unit[k] = 1;
      offer(a.centre, glm::cross(a.direction, unit));
    }
  return plain.value_or(plane);
}

} // namespace dualblock
