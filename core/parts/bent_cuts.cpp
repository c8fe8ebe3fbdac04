#include "parts/bent_cuts.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "base/sort.h"
#include "parts/chains.h"
#include "reference/cut.h"
#include "reference/refine.h"

namespace dualblock {
namespace {

/// A side may turn away from its mean normal by this much; a half cylinder does by 90 degrees.
const double kLeastCosine = std::cos(70 * std::numbers::pi / 180);
constexpr double kOnAxis = 1e-6;    // of the domain's size: nearer than this is on the axis
constexpr double kAlike = 1e-6;     // of the domain's size: mirror images
constexpr double kNearMiddle = 0.8; // cosine: corners that are this near to the middle attract a cut

/// A proposal: where to cut, and the nodes from which the cut spreads (none: from anywhere in the part).
struct Proposal {
  Surface<3> surface;
  std::vector<Index> from;
};

Surface<3> planeSurface(const Vec<3> &point, const Vec<3> &normal) {
  Surface<3> surface{SurfaceKind::bentCut, kNone, planeThrough(point, normal)};
  return surface;
}

/// A closed curve and the sides that meet in it.
struct Loop {
  Chain chain;
  std::array<Index, 2> sides;
};

/// What one part consists of.
struct PartView {
  const ReferenceMesh<3> &mesh;
  const Parts<3> &parts;
  Index part;
  std::vector<const Curve<3> *> curves;
  std::vector<const Corner *> corners;

  const Vec<3> &node(Index n) const { return mesh.nodes[at(n)]; }
  /// On the domain's boundary or an interface: bent cuts are ragged on coarse meshes, and their turns mean
  /// little.
  bool isGiven(Index side) const {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))].kind == SurfaceKind::facet;
  }
  bool isBent(Index side) const {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))].bent;
  }
};

/// No curve at all: through the middle, across the direction in which the part extends least; of directions
/// that are as good the coordinate axes, z first, go before.
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

/// Curves that bent cuts have left are ragged: those of the domain itself know their axis better, and those
/// on a given side and a plane cut hardly less so.
int raggedness(const PartView &v, const Loop &loop) {
  int ragged = 0;
  for (const Index side : loop.sides)
    if (!v.isGiven(side)) ragged += v.isBent(side) ? 3 : 1;
  return ragged;
}

/// The nodes of a chain on the side of its axis that `towards` points to.
std::vector<Index> halfOf(const PartView &v, const Chain &chain, const Axis &axis, const Vec<3> &towards) {
  std::vector<Index> half;
  for (const Index n : chain.nodes)
    if (glm::dot(v.node(n) - axis.centre, towards) > 0) half.push_back(n);
  return half;
}

/// Planes through the axis of a closed curve, best first: by axes of other closed curves that they hold, then
/// corners of the part, then nodes of the curve, then how near they are to a coordinate plane. Where all
/// corners are on one side of the axis, the half plane there is enough.
std::vector<Proposal> alongAxis(const PartView &v, const Loop &loop, const std::vector<Loop> &loops) {
  Axis axis;
  if (!axisOf(loop.chain, v.mesh.nodes, axis)) return {};
  const double reach = kOnAxis * v.mesh.size;
  std::vector<Axis> others;
  Axis opposite; // the other end of a bent side that the loop bounds
  Index ends = 0;
  for (const Loop &other : loops) {
    Axis o;
    if (&other == &loop || raggedness(v, other) > 2 || !axisOf(other.chain, v.mesh.nodes, o)) continue;
    others.push_back(o);
    for (const Index side : loop.sides)
      if (v.isBent(side) && (side == other.sides[0] || side == other.sides[1])) {
        opposite = o;
        ++ends;
      }
  }
  others.push_back(axis);
  // A tube runs from end to end, which need not be square to its ends.
  if (ends == 1 && glm::length(opposite.centre - axis.centre) > 1e3 * reach) {
    const Vec<3> along = glm::normalize(opposite.centre - axis.centre);
    if (std::abs(glm::dot(along, axis.direction)) > 0.5) axis.direction = along;
  }
  // Axes that are this one tell nothing about directions.
  const auto isSame = [&](const Axis &o) {
    return glm::length(glm::cross(o.centre - axis.centre, axis.direction)) <= reach &&
           glm::length(glm::cross(o.direction, axis.direction)) <= kOnAxis;
  };
  others.erase(std::remove_if(others.begin(), others.end(), isSame), others.end());
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
  for (const Index n : loop.chain.nodes) targets.push_back(v.node(n));
  using Score = std::tuple<int, int, int, double>;
  std::vector<std::pair<Score, Proposal>> ranked;
  for (const Vec<3> &target : targets) {
    const Vec<3> across = glm::cross(axis.direction, target - axis.centre);
    if (glm::length(across) <= 1e3 * reach) continue;
    const Plane<3> plane = planeThrough(axis.centre, across);
    Score score{0, 0, 0, 0};
    for (const Axis &o : others)
      if (std::abs(plane.distance(o.centre)) <= reach &&
          std::abs(glm::dot(o.direction, plane.normal)) <= kOnAxis)
        ++std::get<0>(score);
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
    std::get<2>(score) = std::min(held, 2);
    const Vec<3> n = glm::abs(plane.normal);
    std::get<3>(score) = std::round(1e6 * std::max({n.x, n.y, n.z}));
    const auto known = std::find_if(ranked.begin(), ranked.end(), [&](const auto &r) {
      return std::abs(glm::dot(r.second.surface.plane.normal, plane.normal)) > 1 - 1e-9;
    });
    if (known != ranked.end() && known->first >= score) continue;
    ranked.emplace_back(score, Proposal{planeSurface(axis.centre, plane.normal),
                                        half ? halfOf(v, loop.chain, axis, towards) : loop.chain.nodes});
  }
  sortItems(ranked, [](const auto &a, const auto &b) { return a.first > b.first; });
  constexpr std::size_t kTried = 8;
  std::vector<Proposal> list;
  for (std::size_t k = 0; k < std::min(ranked.size(), kTried); ++k)
    list.push_back(std::move(ranked[k].second));
  return list;
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
    const Vec<3> area = glm::cross(v.node(face[1]) - v.node(face[0]), v.node(face[2]) - v.node(face[0]));
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

/// Across a side that turns too far: through the axis of the arc that turns most, and a corner of the part
/// near the middle, or else the middle itself. Where there is a second such arc the plane runs from one to
/// the other.
std::optional<Proposal> acrossArc(const PartView &v, Index side) {
  struct Arc {
    double turn;
    Chain chain;
    Axis axis;
  };
  std::vector<Arc> arcs;
  for (const Curve<3> *curve : v.curves) {
    if (curve->sides[0] != side && curve->sides[1] != side) continue;
    for (Chain &chain : chainsOf(*curve)) {
      Axis axis;
      if (chain.closed || !axisOf(chain, v.mesh.nodes, axis)) continue;
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
  double nearest = kNearMiddle;
  for (const Corner *corner : v.corners) {
    const Vec<3> d = flat(v.node(corner->node) - axis.centre);
    if (glm::length(d) <= kOnAxis * v.mesh.size) continue;
    const double cosine = glm::dot(glm::normalize(d), middle);
    if (cosine <= nearest) continue;
    nearest = cosine;
    towards = glm::normalize(d);
  }
  return Proposal{planeSurface(axis.centre, glm::cross(axis.direction, towards)),
                  halfOf(v, chain, axis, towards)};
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
  std::vector<Loop> loops;
  std::vector<std::vector<Chain>> several;
  for (const Curve<3> *curve : v.curves) {
    if (curve->open) continue;
    std::vector<Chain> chains = chainsOf(*curve);
    for (const Chain &chain : chains)
      if (chain.closed) loops.push_back({chain, curve->sides});
    if (chains.size() > 1) several.push_back(std::move(chains));
  }
  for (const auto &chains : several) add(separate(v, chains));
  sortItems(loops, [&](const Loop &a, const Loop &b) { return raggedness(v, a) < raggedness(v, b); });
  for (const Loop &loop : loops)
    for (Proposal &proposal : alongAxis(v, loop, loops)) list.push_back(std::move(proposal));
  add(betweenCorners(v));
  for (const Index *side = first; side != last; ++side)
    if (v.isGiven(*side) && v.isBent(*side) && turnsTooFar(v, *side)) add(acrossArc(v, *side));
  return list;
}

bool carryOut(ReferenceMesh<3> &mesh, const PartView &v, const Proposal &proposal,
              const CutOptions &options) {
  if (proposal.surface.field && resolve(mesh, *proposal.surface.field, options.tolerance) > 0)
    return true; // parts have to be found anew; the next round cuts
  std::vector<Index> from = proposal.from;
  sortItems(from);
  std::vector<CutSeed<3>> seeds;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    if (v.parts.partOfSimplex[at(s)] != v.part) continue;
    const bool touches =
        from.empty() || std::any_of(mesh.simplices[at(s)].begin(), mesh.simplices[at(s)].end(),
                                    [&](Index n) { return std::binary_search(from.begin(), from.end(), n); });
    if (touches) seeds.push_back({s});
  }
  const Index surface = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back(proposal.surface);
  if (cutAlong<3>(mesh, surface, seeds, options.tolerance) > 0) return true;
  mesh.surfaces.pop_back();
  return false;
}

} // namespace

bool cutBentPart(ReferenceMesh<3> &mesh, const Parts<3> &parts, const CutOptions &options,
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
