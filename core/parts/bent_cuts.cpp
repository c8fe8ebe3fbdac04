#include "parts/bent_cuts.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "parts/chains.h"
#include "reference/cut.h"
#include "reference/refine.h"

namespace dualblock {
namespace {

/// A side may turn away from its mean normal by this much; a half cylinder does by 90 degrees.
const double kLeastCosine = std::cos(70 * std::numbers::pi / 180);
constexpr double kOnAxis = 1e-6;     // of the domain's size: nearer than this is on the axis
constexpr double kAlike = 1e-6;      // of the domain's size: mirror images
constexpr double kNearMiddle = 0.8;  // cosine: corners that are this near to the middle attract a cut

/// A proposal: where to cut, and the nodes from which the cut spreads (none: from anywhere in the part).
struct Proposal {
  Surface<3> surface;
  std::vector<Index> from;
};

Surface<3> planeSurface(const Vec<3> &point, const Vec<3> &normal) {
  Surface<3> surface{SurfaceKind::bentCut, kNone, planeThrough(point, normal)};
  return surface;
}

/// What one part consists of.
struct PartView {
  const ReferenceMesh<3> &mesh;
  const Parts<3> &parts;
  Index part;
  std::vector<const Curve<3> *> curves;
  std::vector<const Corner *> corners;

  const Vec<3> &node(Index n) const { return mesh.nodes[at(n)]; }
  /// On the domain's boundary or an interface: bent cuts are ragged on coarse meshes, and their turns mean little.
  bool isGiven(Index side) const {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))].kind == SurfaceKind::facet;
  }
  bool isBent(Index side) const {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))].bent;
  }
};

/// No curve at all: through the middle, across the direction in which the part extends least; of directions that
/// are as good the coordinate axes, z first, go before.
std::optional<Proposal> halve(const PartView &v) {
  Vec<3> mean{0.0};
  double weight = 0;
  std::vector<std::pair<Vec<3>, double>> cells;
  for (Index s = 0; s < v.mesh.simplexCount(); ++s) {
    if (v.parts.partOfSimplex[at(s)] != v.part) continue;
    const auto &n = v.mesh.simplices[at(s)];
    const double volume = orientation<3>(v.mesh.nodes, n);
    cells.emplace_back((v.node(n[0]) + v.node(n[1]) + v.node(n[2]) + v.node(n[3])) / 4.0, volume);
    mean += volume * cells.back().first;
    weight += volume;
  }
  mean /= weight;
  std::array<Vec<3>, 3> second{Vec<3>(0.0), Vec<3>(0.0), Vec<3>(0.0)}; // moments, by rows
  for (const auto &[x, w] : cells)
    for (int k = 0; k < 3; ++k) second[at(k)] += w * (x - mean)[k] * (x - mean);
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

/// Two sides that meet in several curves: between the first of them and the others.
std::optional<Proposal> separate(const PartView &v, const std::vector<Chain> &chains) {
  Proposal proposal{planeSurface({}, {0, 0, 1}), {}};
  std::vector<Segment<3>> first = segmentsOf(chains[0], v.mesh.nodes);
  std::vector<Segment<3>> others;
  for (std::size_t c = 1; c < chains.size(); ++c) {
    const auto more = segmentsOf(chains[c], v.mesh.nodes);
    others.insert(others.end(), more.begin(), more.end());
  }
  for (const Chain &chain : chains) proposal.from.insert(proposal.from.end(), chain.nodes.begin(), chain.nodes.end());
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
    bool mirrored = true;
    for (const Segment<3> &s : first)
      for (const Vec<3> &x : s) {
        double least = std::numeric_limits<double>::infinity();
        const Vec<3> image = x - 2 * plane.distance(x) * plane.normal;
        for (const Segment<3> &o : others) least = std::min(least, distanceTo<3>(o, image));
        mirrored &= least <= kAlike * v.mesh.size;
      }
    if (mirrored) {
      proposal.surface.plane = plane;
      return proposal;
    }
    proposal.surface.plane = plane;
  }
  proposal.surface.bent = true;
  proposal.surface.field = std::make_shared<MiddleField<3>>(std::move(first), std::move(others));
  return proposal;
}

/// A plane through the axis of a closed curve: the one that holds most axes of other closed curves, then most
/// corners of the part, then nodes of the curve on both sides, then the nearest to a coordinate plane.
std::optional<Proposal> alongAxis(const PartView &v, const Chain &loop, const std::vector<Chain> &loops) {
  Axis axis;
  if (!axisOf(loop, v.mesh.nodes, axis)) return std::nullopt;
  const double reach = kOnAxis * v.mesh.size;
  std::vector<Axis> others;
  for (const Chain &other : loops) {
    Axis o;
    if (&other != &loop && axisOf(other, v.mesh.nodes, o)) others.push_back(o);
  }
  std::vector<Vec<3>> targets;
  for (const Axis &o : others) {
    targets.push_back(o.centre);
    targets.push_back(axis.centre + o.direction * v.mesh.size);
  }
  for (const Corner *corner : v.corners) targets.push_back(v.node(corner->node));
  for (int k = 0; k < 3; ++k) {
    Vec<3> unit{0.0};
    unit[k] = v.mesh.size;
    targets.push_back(axis.centre + unit);
  }
  for (const Index n : loop.nodes) targets.push_back(v.node(n));
  using Score = std::tuple<int, int, int, double>;
  std::optional<std::pair<Score, Vec<3>>> best;
  for (const Vec<3> &target : targets) {
    const Vec<3> across = glm::cross(axis.direction, target - axis.centre);
    if (glm::length(across) <= 1e3 * reach) continue;
    const Plane<3> plane = planeThrough(axis.centre, across);
    Score score{0, 0, 0, 0};
    for (const Axis &o : others)
      if (std::abs(plane.distance(o.centre)) <= reach && std::abs(glm::dot(o.direction, plane.normal)) <= kOnAxis)
        ++std::get<0>(score);
    for (const Corner *corner : v.corners)
      if (std::abs(plane.distance(v.node(corner->node))) <= reach) ++std::get<1>(score);
    int held = 0;
    for (const Index n : loop.nodes) held += std::abs(plane.distance(v.node(n))) <= reach ? 1 : 0;
    std::get<2>(score) = std::min(held, 2);
    const Vec<3> n = glm::abs(plane.normal);
    std::get<3>(score) = std::round(1e6 * std::max({n.x, n.y, n.z}));
    if (!best || score > best->first) best = {score, plane.normal};
  }
  if (!best) return std::nullopt;
  return Proposal{planeSurface(axis.centre, best->second), loop.nodes};
}

/// Half way between two corners where the same sides meet.
std::optional<Proposal> betweenCorners(const PartView &v) {
  std::map<std::vector<Index>, const Corner *> known;
  for (const Corner *corner : v.corners) {
    const auto [other, isNew] = known.emplace(corner->sides, corner);
    if (isNew) continue;
    const Vec<3> a = v.node(other->second->node);
    const Vec<3> b = v.node(corner->node);
    return Proposal{planeSurface((a + b) / 2.0, b - a), {}};
  }
  return std::nullopt;
}

bool turnsTooFar(const PartView &v, Index side) {
  Vec<3> sum{0.0};
  double total = 0;
  std::vector<std::pair<Vec<3>, double>> normals;
  for (const FaceRef<3> *f = v.parts.sideFaces.begin(side); f != v.parts.sideFaces.end(side); ++f) {
    const auto face = v.mesh.sortedFace(f->simplex, f->face);
    const Vec<3> area =
        glm::cross(v.node(face[1]) - v.node(face[0]), v.node(face[2]) - v.node(face[0]));
    const Vec<3> normal = v.mesh.outwardNormal(f->simplex, f->face);
    sum += glm::length(area) * normal;
    total += glm::length(area);
    normals.emplace_back(normal, glm::length(area));
  }
  if (glm::length(sum) == 0) return true;
  const Vec<3> mean = glm::normalize(sum);
  double beyond = 0; // by area: normals of slivers mean nothing
  for (const auto &[normal, area] : normals) beyond += glm::dot(normal, mean) < kLeastCosine ? area : 0;
  return beyond > 0.02 * total;
}

/// Across a side that turns too far: through the axis of its longest arc, and a corner of the part near the middle,
/// or else the middle itself.
std::optional<Proposal> acrossArc(const PartView &v, Index side) {
  std::optional<Proposal> best;
  double longest = 0;
  for (const Curve<3> *curve : v.curves) {
    if (curve->sides[0] != side && curve->sides[1] != side) continue;
    for (const Chain &chain : chainsOf(*curve)) {
      Axis axis;
      if (chain.closed || !axisOf(chain, v.mesh.nodes, axis)) continue;
      const Vec<3> a = v.node(chain.nodes.front());
      const Vec<3> b = v.node(chain.nodes.back());
      const double turn = std::abs(glm::dot(glm::normalize(a - axis.centre), glm::normalize(b - axis.centre)) - 1);
      if (turn <= longest) continue;
      longest = turn;
      // The middle of the chain is off the line from end to end, seen from which side it is.
      Vec<3> middle = v.node(chain.nodes[chain.nodes.size() / 2]) - axis.centre;
      const Vec<3> across = glm::length(b - a) > 0 ? glm::normalize(b - a) : Vec<3>(0);
      middle = glm::normalize(middle - glm::dot(middle, across) * across);
      Vec<3> normal = glm::cross(axis.direction, middle);
      double nearest = kNearMiddle;
      for (const Corner *corner : v.corners) {
        Vec<3> d = v.node(corner->node) - axis.centre;
        d -= glm::dot(d, axis.direction) * axis.direction;
        if (glm::length(d) <= kOnAxis * v.mesh.size) continue;
        const double cosine = glm::dot(glm::normalize(d), middle);
        if (cosine <= nearest) continue;
        nearest = cosine;
        normal = glm::cross(axis.direction, glm::normalize(d));
      }
      best = Proposal{planeSurface(axis.centre, normal), chain.nodes};
    }
  }
  return best;
}

std::vector<Proposal> proposals(const PartView &v) {
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
  std::vector<Chain> loops;
  std::vector<std::vector<Chain>> several;
  for (const Curve<3> *curve : v.curves) {
    if (curve->open) continue;
    std::vector<Chain> chains = chainsOf(*curve);
    for (const Chain &chain : chains)
      if (chain.closed) loops.push_back(chain);
    if (chains.size() > 1) several.push_back(std::move(chains));
  }
  for (const auto &chains : several) add(separate(v, chains));
  for (const Chain &loop : loops) add(alongAxis(v, loop, loops));
  add(betweenCorners(v));
  for (const Index *side = first; side != last; ++side)
    if (v.isGiven(*side) && v.isBent(*side) && turnsTooFar(v, *side)) add(acrossArc(v, *side));
  return list;
}

bool carryOut(ReferenceMesh<3> &mesh, const PartView &v, const Proposal &proposal, const BentCutOptions &options) {
  if (proposal.surface.field && resolve(mesh, *proposal.surface.field, options.tolerance) > 0)
    return true; // parts have to be found anew; the next round cuts
  std::vector<Index> from = proposal.from;
  std::sort(from.begin(), from.end());
  std::vector<CutSeed<3>> seeds;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    if (v.parts.partOfSimplex[at(s)] != v.part) continue;
    const bool touches = from.empty() || std::any_of(mesh.simplices[at(s)].begin(), mesh.simplices[at(s)].end(), [&](Index n) {
                           return std::binary_search(from.begin(), from.end(), n);
                         });
    if (touches) seeds.push_back({s});
  }
  const Index surface = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back(proposal.surface);
  if (cutAlong<3>(mesh, surface, seeds, options.tolerance) > 0) return true;
  mesh.surfaces.pop_back();
  return false;
}

} // namespace

bool cutBentPart(ReferenceMesh<3> &mesh, const Parts<3> &parts, const BentCutOptions &options,
                 const std::vector<bool> &gaveUp) {
  const std::vector<Index> component = componentOfParts(mesh, parts);
  std::size_t curve = 0;
  std::size_t corner = 0;
  for (Index part = 0; part < toIndex(parts.parts.size()); ++part) {
    PartView v{mesh, parts, part, {}, {}};
    for (; curve < parts.curves.size() && parts.curves[curve].part == part; ++curve)
      v.curves.push_back(&parts.curves[curve]);
    for (; corner < parts.corners.size() && parts.corners[corner].part == part; ++corner)
      v.corners.push_back(&parts.corners[corner]);
    if (gaveUp[at(component[at(part)])]) continue;
    for (const Proposal &proposal : proposals(v))
      if (carryOut(mesh, v, proposal, options)) return true;
  }
  return false;
}

} // namespace dualblock
