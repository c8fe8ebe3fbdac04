#include "parts/bent_cuts.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "base/sort.h"
#include "partition/heuristics.h"
#include "parts/bent_proposals.h"
#include "reference/refine.h"

namespace dualblock {
namespace {

/// No curve at all: through the middle, across the direction in which the part extends least; of directions
/// that are as good the coordinate axes, z first, go before.
std::optional<Proposal> halve(const PartView &v) {
  Vec<3> mean{0.0};
  double weight = 0;
  std::vector<std::pair<std::array<Vec<3>, 4>, double>> cells; // corners, volume
  for (Index s = 0; s < v.mesh.simplexCount(); ++s) {
    if (v.parts.partOfSimplex[at(s)] != v.part) continue;
    const auto &n = v.mesh.simplices[at(s)];
    const double volume = orientation<3>(v.mesh.nodes, n);
    cells.push_back({{v.node(n[0]), v.node(n[1]), v.node(n[2]), v.node(n[3])}, volume});
    for (const Vec<3> &x : cells.back().first) mean += volume / 4 * x;
    weight += volume;
  }
  mean /= weight;
  // Second moments by rows, exactly: the reference mesh is coarse, and nothing may depend on it.
  std::array<Vec<3>, 3> second{Vec<3>(0.0), Vec<3>(0.0), Vec<3>(0.0)};
  for (const auto &[corners, volume] : cells) {
    Vec<3> sum{0.0};
    for (const Vec<3> &x : corners) sum += x - mean;
    for (int k = 0; k < 3; ++k) {
      second[at(k)] += volume / 20 * sum[k] * sum;
      for (const Vec<3> &x : corners) second[at(k)] += volume / 20 * (x - mean)[k] * (x - mean);
    }
  }
  const auto extent = [&](const Vec<3> &d) {
    return d.x * glm::dot(second[0], d) + d.y * glm::dot(second[1], d) + d.z * glm::dot(second[2], d);
  };
  std::vector<Vec<3>> directions{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  for (int k = 0; k < 64; ++k) { // a spiral over the half sphere
    const double z = (k + 0.5) / 64;
    const double turn = 2.399963229728653 * k; // the golden angle
    directions.emplace_back(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vec<3> &d : directions) least = std::min(least, extent(d));
  for (const Vec<3> &d : directions)
    if (extent(d) <= 1.1 * least) return Proposal{planeSurface(mean, d), {}};
  return std::nullopt;
}

/// A bent side that is closed in itself, a void in the part: across the part, through its middle.
std::optional<Proposal> throughVoid(const PartView &v, Index side) {
  if (std::any_of(v.curves.begin(), v.curves.end(),
                  [&](const Curve<3> *curve) { return curve->sides[0] == side || curve->sides[1] == side; }))
    return std::nullopt;
  Vec<3> middle{0.0};
  double area = 0;
  std::vector<Index> from;
  for (const FaceRef<3> *f = v.parts.sideFaces.begin(side); f != v.parts.sideFaces.end(side); ++f) {
    const auto face = v.mesh.sortedFace(f->simplex, f->face);
    const double a =
        glm::length(glm::cross(v.node(face[1]) - v.node(face[0]), v.node(face[2]) - v.node(face[0])));
    middle += a / 3 * (v.node(face[0]) + v.node(face[1]) + v.node(face[2]));
    area += a;
    from.insert(from.end(), face.begin(), face.end());
  }
  if (!(area > 0)) return std::nullopt;
  return Proposal{planeSurface(middle / area, {0, 0, 1}), std::move(from)};
}

/// Whether all of one chain is behind a plane and all of the other in front.
bool isBetween(const Plane<3> &plane, const std::vector<Segment<3>> &behind,
               const std::vector<Segment<3>> &front, double tolerance) {
  const auto isOn = [&](const std::vector<Segment<3>> &chain, double sign) {
    return std::all_of(chain.begin(), chain.end(), [&](const Segment<3> &s) {
      return sign * plane.distance(s[0]) > tolerance && sign * plane.distance(s[1]) > tolerance;
    });
  };
  return isOn(behind, -1) && isOn(front, 1);
}

/// Of the planes through axes of the domain the one that is most like a given one and lies between two
/// chains; along the coordinate axes where it is nearly so.
std::optional<Plane<3>> planeBetween(const PartView &v, const Plane<3> &given,
                                     const std::vector<Segment<3>> &behind,
                                     const std::vector<Segment<3>> &front) {
  std::optional<Plane<3>> best;
  double most = kLikeCosine;
  for (const Axis &axis : v.axes) {
    std::vector<Vec<3>> normals{given.normal};
    for (int k = 0; k < 3; ++k) {
      Vec<3> unit{0.0};
      unit[k] = given.normal[k] < 0 ? -1 : 1;
      normals.push_back(unit);
    }
    for (std::size_t k = normals.size(); k-- > 0;) {
      const Vec<3> flat = normals[k] - glm::dot(normals[k], axis.direction) * axis.direction;
      const double cosine = glm::dot(flat, given.normal);
      if (cosine <= most) continue;
      const Plane<3> plane = planeThrough(axis.centre, flat);
      if (!isBetween(plane, behind, front, 1e-3 * v.mesh.size)) continue;
      most = cosine;
      best = plane;
    }
  }
  return best;
}

/// Two sides that meet in several curves: between the first of them and the others.
std::optional<Proposal> separate(const PartView &v, const std::vector<Chain> &chains) {
  Proposal proposal{planeSurface({}, {0, 0, 1}), {}};
  std::vector<Segment<3>> first = segmentsOf(chains[0], v.mesh.nodes);
  std::vector<Segment<3>> others;
  for (std::size_t c = 1; c < chains.size(); ++c) {
    const auto more = segmentsOf(chains[c], v.mesh.nodes);
    others.insert(others.end(), more.begin(), more.end());
  }
  // Mirror images lie on both sides of a plane: better than a field, which is no plane between its nodes.
  const auto centre = [](const std::vector<Segment<3>> &chain) {
    Vec<3> sum{0.0};
    double length = 0;
    for (const Segment<3> &s : chain) {
      const double l = glm::length(s[1] - s[0]);
      sum += 0.5 * l * (s[0] + s[1]);
      length += l;
    }
    return sum / length;
  };
  const Vec<3> a = centre(first);
  const Vec<3> b = centre(others);
  if (glm::length(b - a) > kOnAxis * v.mesh.size) {
    const Plane<3> plane = planeThrough((a + b) / 2.0, b - a);
    proposal.surface.plane = plane;
    bool mirrored = true;
    for (const Segment<3> &s : first)
      for (const Vec<3> &x : s) {
        double least = std::numeric_limits<double>::infinity();
        const Vec<3> image = x - 2 * plane.distance(x) * plane.normal;
        for (const Segment<3> &o : others) least = std::min(least, distanceTo<3>(o, image));
        mirrored &= least <= kMirrored * v.mesh.size;
      }
    if (mirrored) return proposal;
    if (const auto between = planeBetween(v, plane, first, others)) {
      proposal.surface.plane = *between;
      return proposal;
    }
  }
  proposal.surface.bent = true;
  proposal.surface.field = std::make_shared<MiddleField<3>>(std::move(first), std::move(others));
  return proposal;
}

/// Square to a curve where it turns sharply between two sides, so that a third one meets them there.
std::optional<Proposal> throughKink(const PartView &v, const Corner &kink) {
  Vec<3> tangent{0.0};
  for (const Curve<3> *curve : v.curves) {
    if (curve->sides[0] != kink.sides[0] || curve->sides[1] != kink.sides[1]) continue;
    for (const auto &[a, b] : curve->ridges) {
      if (a != kink.node && b != kink.node) continue;
      const Vec<3> away = glm::normalize(v.node(a == kink.node ? b : a) - v.node(kink.node));
      tangent = away - tangent; // of two ridges: from the one to the other
    }
  }
  if (glm::length(tangent) == 0) return std::nullopt;
  return Proposal{planeSurface(v.node(kink.node), tangent), {kink.node}};
}

/// Half way between two corners where the same sides meet.
std::optional<Proposal> betweenCorners(const PartView &v) {
  for (std::size_t k = 0; k < v.corners.size(); ++k)
    for (std::size_t m = 0; m < k; ++m) { // a part has few corners
      const std::span<const Index> sides = v.corners[k]->sides;
      if (sides.size() < 3 ||
          !std::equal(sides.begin(), sides.end(), v.corners[m]->sides.begin(), v.corners[m]->sides.end()))
        continue;
      const Vec<3> a = v.node(v.corners[m]->node);
      const Vec<3> b = v.node(v.corners[k]->node);
      return Proposal{planeSurface((a + b) / 2.0, b - a), {}};
    }
  return std::nullopt;
}

/// What would leave its bent sides smooth.
std::vector<Proposal> smoothing(const PartView &v) {
  std::vector<Proposal> list;
  for (const Index *side = v.parts.partSides.begin(v.part); side != v.parts.partSides.end(v.part); ++side)
    if (v.isGiven(*side) && v.isBent(*side))
      if (std::optional<Proposal> proposal = throughCrease(v, *side)) list.push_back(std::move(*proposal));
  return list;
}

/// What would make a part simple.
std::vector<Proposal> simplifying(const PartView &v) {
  std::vector<Proposal> list;
  const auto add = [&](std::optional<Proposal> proposal) {
    if (proposal) list.push_back(std::move(*proposal));
  };
  const auto first = v.parts.partSides.begin(v.part);
  const auto last = v.parts.partSides.end(v.part);
  const bool bent = std::any_of(first, last, [&](Index side) { return v.isBent(side); });
  if (!bent) return list;
  if (v.curves.empty()) {
    add(halve(v));
    return list;
  }
  for (const Index *side = first; side != last; ++side)
    if (v.isBent(*side)) add(throughVoid(v, *side));
  Turns turns;
  std::vector<std::vector<Chain>> several;
  for (const Curve<3> *curve : v.curves) {
    std::vector<Chain> chains = chainsOf(*curve);
    for (const Chain &chain : chains) {
      Axis axis;
      if (chain.closed) turns.loops.push_back({chain, curve->sides});
      else if (axisOf(chain, v.mesh.nodes, axis))
        if (const Axis *known = knownAxis(v.axes, chain, v.mesh.nodes, axis);
            known && std::find(turns.arcs.begin(), turns.arcs.end(), known) == turns.arcs.end())
          turns.arcs.push_back(known);
    }
    if (chains.size() > 1) several.push_back(std::move(chains));
  }
  for (const auto &chains : several) add(separate(v, chains));
  sortItems(turns.loops, [&](const Loop &a, const Loop &b) { return raggedness(v, a) < raggedness(v, b); });
  for (const Loop &loop : turns.loops)
    for (Proposal &proposal : alongAxis(v, loop, turns)) list.push_back(std::move(proposal));
  for (const Corner *corner : v.corners)
    if (corner->sides.size() < 3) add(throughKink(v, *corner));
  add(betweenCorners(v));
  return list;
}

/// The part's simplices, with those that have been split off them since the part was found.
std::vector<Index> simplicesOf(const ReferenceMesh<3> &mesh, const PartView &v) {
  const auto &partOf = v.parts.partOfSimplex;
  std::vector<Index> list{
      toIndex(static_cast<std::size_t>(std::find(partOf.begin(), partOf.end(), v.part) - partOf.begin()))};
  std::vector<bool> seen(mesh.simplices.size(), false);
  seen[at(list[0])] = true;
  for (std::size_t n = 0; n < list.size(); ++n)
    for (int i = 0; i < 4; ++i) {
      const Index s = list[n];
      const Index t = mesh.neighbors[at(s)][i];
      if (t == kNone || mesh.tags[at(s)][i] != kNone || seen[at(t)]) continue;
      seen[at(t)] = true;
      list.push_back(t);
    }
  sortItems(list);
  return list;
}

bool carryOut(ReferenceMesh<3> &mesh, const PartView &v, const Proposal &proposal,
              const BentCutOptions &options) {
  Surface<3> surface = proposal.surface;
  if (!surface.field) surface.plane = plainPlane(v, surface.plane);
  for (const Plane<3> &refused : options.refused)
    if (!surface.field && std::abs(glm::dot(refused.normal, surface.plane.normal)) > 1 - 1e-12 &&
        std::abs(refused.distance(surface.plane.offset * surface.plane.normal)) <= options.tolerance)
      return false;
  std::vector<Index> from = proposal.from;
  sortItems(from);
  const auto seedsNow = [&] {
    std::vector<CutSeed<3>> seeds;
    for (const Index s : simplicesOf(mesh, v)) {
      const auto &nodes = mesh.simplices[at(s)];
      const bool touches = from.empty() || std::any_of(nodes.begin(), nodes.end(), [&](Index n) {
                             return std::binary_search(from.begin(), from.end(), n);
                           });
      if (touches) seeds.push_back({s});
    }
    return seeds;
  };
  if (surface.field) resolve<3>(mesh, surface, seedsNow, options.tolerance, 0);
  const std::vector<CutSeed<3>> seeds = seedsNow();
  const Index number = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back(std::move(surface));
  if (cutAlong<3>(mesh, number, seeds, options.tolerance) > 0) return true;
  mesh.surfaces.pop_back();
  return false;
}

} // namespace

CutReason cutBentPart(ReferenceMesh<3> &mesh, const Parts<3> &parts, const BentCutOptions &options,
                      const std::vector<bool> &gaveUp) {
  const std::vector<Index> component = componentOfParts(mesh, parts);
  for (const auto propose :
       {smoothing, simplifying, following, shaping}) { // all parts are simple before any is bettered
    PartView v{mesh, parts, 0, {}, {}, options.axes};
    std::size_t curve = 0;
    std::size_t corner = 0;
    for (; v.part < toIndex(parts.parts.size()); ++v.part) {
      v.curves.clear();
      v.corners.clear();
      for (; curve < parts.curves.size() && parts.curves[curve].part == v.part; ++curve)
        v.curves.push_back(&parts.curves[curve]);
      for (; corner < parts.corners.size() && parts.corners[corner].part == v.part; ++corner)
        v.corners.push_back(&parts.corners[corner]);
      if (gaveUp[at(component[at(v.part)])]) continue;
      v.cutsHollows = !options.policies.empty() && options.policies[at(component[at(v.part)])].isLast;
      for (const Proposal &proposal : propose(v))
        if (carryOut(mesh, v, proposal, options))
          return propose == shaping ? CutReason::shape : CutReason::needed;
    }
  }
  return CutReason::none;
}

namespace {

PartView viewOf(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index part,
                const BentCutOptions &options) {
  PartView v{mesh, parts, part, {}, {}, options.axes};
  for (const Curve<3> &curve : parts.curves)
    if (curve.part == part) v.curves.push_back(&curve);
  for (const Corner &corner : parts.corners)
    if (corner.part == part) v.corners.push_back(&corner);
  return v;
}

Index notSimple(const Parts<3> &parts) {
  return toIndex(static_cast<std::size_t>(std::count_if(parts.parts.begin(), parts.parts.end(),
                                                        [](const PartInfo &part) { return !part.simple; })));
}

/// Halves a part by whichever of its proposals leaves the fewest blocks in all. A plane that leaves the part
/// through a split side runs on behind it, and may divide much that nobody asked for: such ones are refused.
bool halveAlone(ReferenceMesh<3> &mesh, Parts<3> &parts, Index part, const BentCutOptions &options,
                int &triesLeft) {
  const PartView v = viewOf(mesh, parts, part, options);
  const Index before = notSimple(parts);
  std::optional<ReferenceMesh<3>> best;
  Parts<3> bestParts;
  std::size_t proposals = 0;
  const ReferenceMesh<3> uncut = mesh;
  for (const Proposal &proposal : halving(v)) {
    if (++proposals > kProposalsAlone || --triesLeft < 0) break;
    if (!carryOut(mesh, v, proposal, options)) continue;
    Parts<3> now = buildParts(mesh, PartOptions{});
    if (notSimple(now) <= before && now.parts.size() <= parts.parts.size() + kMostSpread &&
        (!best || now.corners.size() < bestParts.corners.size())) {
      best = std::move(mesh);
      bestParts = std::move(now);
    }
    mesh = uncut;
  }
  if (!best) return false;
  mesh = std::move(*best);
  parts = std::move(bestParts);
  return true;
}

} // namespace

Index halveParts(ReferenceMesh<3> &mesh, Parts<3> &parts, const std::vector<Index> &which,
                 const BentCutOptions &options, int &triesLeft) {
  parts = buildParts(mesh, PartOptions{}); // as they are judged again below
  // All at once where that serves: mostly it does. The parts are those of before; what has been split off
  // their simplices since is found from them.
  ReferenceMesh<3> uncut = mesh;
  Index cuts = 0;
  for (const Index part : which) {
    const PartView v = viewOf(mesh, parts, part, options);
    for (const Proposal &proposal : halving(v))
      if (carryOut(mesh, v, proposal, options)) {
        ++cuts;
        break;
      }
  }
  Parts<3> halved = buildParts(mesh, PartOptions{});
  if (notSimple(halved) <= notSimple(parts) && halved.parts.size() <= parts.parts.size() + 2 * which.size()) {
    parts = std::move(halved);
    return cuts;
  }
  // Else one by one: a simplex of each part leads back to what is left of it after the other cuts.
  mesh = std::move(uncut);
  std::vector<Index> seeds;
  for (const Index part : which)
    seeds.push_back(toIndex(
        static_cast<std::size_t>(std::find(parts.partOfSimplex.begin(), parts.partOfSimplex.end(), part) -
                                 parts.partOfSimplex.begin())));
  cuts = 0;
  for (const Index seed : seeds)
    if (triesLeft > 0)
      cuts += halveAlone(mesh, parts, parts.partOfSimplex[at(seed)], options, triesLeft) ? 1 : 0;
  return cuts;
}

} // namespace dualblock
