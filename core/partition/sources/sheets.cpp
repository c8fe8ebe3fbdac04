#include "partition/sources/sheets.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/sort.h"
#include "partition/heuristics.h"
#include "parts/chains.h"

namespace dualblock {
namespace {

using std::numbers::pi;

/// Headings at both ends of each ridge of a run: those of the ridges around a node together, smoothed along
/// the run, as the facets of bent sides tilt.
std::vector<std::array<Heading<3>, 2>> smoothHeadings(const Curve<3> &curve, std::span<const std::size_t> run,
                                                      const std::vector<Heading<3>> &ofRidges) {
  std::vector<Index> nodes;
  for (const std::size_t k : run) nodes.insert(nodes.end(), curve.ridges[k].begin(), curve.ridges[k].end());
  sortItems(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto number = [&](Index node) {
    return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  std::vector<Heading<3>> atRidges = ofRidges;
  std::vector<Heading<3>> atNodes;
  for (int pass = 0; pass < kHeadingPasses; ++pass) {
    atNodes.assign(nodes.size(), {Vec<3>(0.0), Vec<3>(0.0)});
    for (std::size_t k = 0; k < run.size(); ++k)
      for (const Index node : curve.ridges[run[k]]) {
        atNodes[number(node)].ahead += atRidges[k].ahead;
        atNodes[number(node)].normal += atRidges[k].normal;
      }
    for (Heading<3> &h : atNodes) h = {glm::normalize(h.ahead), glm::normalize(h.normal)};
    for (std::size_t k = 0; k < run.size(); ++k) {
      const auto &[a, b] = curve.ridges[run[k]];
      atRidges[k] = {atNodes[number(a)].ahead + atNodes[number(b)].ahead,
                     atNodes[number(a)].normal + atNodes[number(b)].normal};
    }
  }
  std::vector<std::array<Heading<3>, 2>> headings;
  for (const std::size_t k : run)
    headings.push_back({atNodes[number(curve.ridges[k][0])], atNodes[number(curve.ridges[k][1])]});
  return headings;
}

/// Ahead in a direction from the first side; the normal points back to that side.
Heading<3> headingAt(const RidgeFrame<3> &frame, double direction) {
  return {std::cos(direction) * frame.into - std::sin(direction) * frame.outward,
          std::sin(direction) * frame.into + std::cos(direction) * frame.outward};
}

/// The middle of what is outside at a ridge, as an angle from a heading towards its normal.
double gapAt(const RidgeFrame<3> &frame, double direction) { return direction + pi - frame.angle / 2; }

struct Foot {
  Vec<3> place{0.0};
  double distance = std::numeric_limits<double>::infinity();
};

/// Of the places where a curve crosses the plane square to a ridge, the nearest one that `isWanted`.
template <typename IsWanted>
Foot footSquareTo(const std::vector<Vec<3>> &nodes, const std::array<Index, 2> &ridge, const Curve<3> &curve,
                  IsWanted isWanted) {
  const Vec<3> middle = (nodes[at(ridge[0])] + nodes[at(ridge[1])]) / 2.0;
  const Vec<3> along = glm::normalize(nodes[at(ridge[1])] - nodes[at(ridge[0])]);
  Foot best;
  for (const auto &[a, b] : curve.ridges) {
    const double da = glm::dot(nodes[at(a)] - middle, along);
    const double db = glm::dot(nodes[at(b)] - middle, along);
    if (da * db > 0 || da == db) continue;
    const Vec<3> place = glm::mix(nodes[at(a)], nodes[at(b)], da / (da - db));
    const double distance = glm::length(place - middle);
    if (distance < best.distance && distance > 0 && isWanted(place - middle)) best = {place, distance};
  }
  return best;
}

/// The directions from a run to a curve, if all are in range and alike, and the largest distance.
std::optional<std::vector<double>> directionsTo(const std::vector<Vec<3>> &nodes, const SheetStart &start,
                                                const Curve<3> &target, double &distance) {
  std::vector<double> directions;
  distance = 0;
  for (const std::size_t k : start.run) {
    const RidgeFrame<3> &frame = start.curve.frames[k];
    const Foot foot = footSquareTo(nodes, start.curve.ridges[k], target, [&](const Vec<3> &away) {
      return start.range.has(directionOf<3>(frame, away));
    });
    if (foot.distance == std::numeric_limits<double>::infinity()) return std::nullopt;
    const auto &[a, b] = start.curve.ridges[k];
    directions.push_back(directionOf<3>(frame, foot.place - (nodes[at(a)] + nodes[at(b)]) / 2.0));
    distance = std::max(distance, foot.distance);
  }
  const auto [low, high] = std::minmax_element(directions.begin(), directions.end());
  if (*high - *low > kSteadyHeading) return std::nullopt;
  return directions;
}

std::vector<Heading<3>> headingsAt(const SheetStart &start, const std::vector<double> &directions) {
  std::vector<Heading<3>> headings;
  for (std::size_t k = 0; k < start.run.size(); ++k)
    headings.push_back(headingAt(start.curve.frames[start.run[k]], directions[k]));
  return headings;
}

std::vector<std::size_t> allRidges(const Curve<3> &curve) {
  std::vector<std::size_t> all(curve.ridges.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Whether the curve that a sheet would end in wants a cut there itself.
bool isWelcome(const std::vector<Vec<3>> &nodes, const SheetStart &start, const Curve<3> &target) {
  const std::vector<std::size_t> all = allRidges(target);
  for (std::size_t sector = 0; sector < sectorPlanes(curveKind(target.angle), target.angle).size();
       ++sector) {
    double distance = 0;
    if (directionsTo(nodes, {target, all, {}, rangeOfSheet(target, all, sector)}, start.curve, distance))
      return true;
  }
  return false;
}

/// Headings of the ridges of the curve that a sheet ends in, back to where it starts; none where it does not
/// reach a ridge.
std::vector<Heading<3>> headingsBack(const std::vector<Vec<3>> &nodes, const SheetStart &start,
                                     const std::vector<Heading<3>> &ofRun, const Curve<3> &target) {
  std::vector<Heading<3>> headings;
  for (const auto &ridge : target.ridges) {
    const Vec<3> middle = (nodes[at(ridge[0])] + nodes[at(ridge[1])]) / 2.0;
    // The nearest ridge of the run by its own heading tells the side.
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < start.run.size(); ++k) {
      const auto &[a, b] = start.curve.ridges[start.run[k]];
      const Vec<3> away = middle - (nodes[at(a)] + nodes[at(b)]) / 2.0;
      const double off = glm::length(away - glm::dot(away, ofRun[k].ahead) * ofRun[k].ahead);
      if (off >= least) continue;
      least = off;
      nearest = k;
    }
    const Vec<3> along = glm::normalize(nodes[at(ridge[1])] - nodes[at(ridge[0])]);
    Vec<3> back = -ofRun[nearest].ahead;
    back -= glm::dot(back, along) * along;
    if (!(glm::length(back) > 0.5)) return {};
    back = glm::normalize(back);
    Vec<3> normal = glm::cross(back, along);
    if (glm::dot(normal, ofRun[nearest].normal) < 0) normal = -normal;
    headings.push_back({back, normal});
  }
  return headings;
}

} // namespace

DirectionRange rangeOfSheet(const Curve<3> &curve, std::span<const std::size_t> run, std::size_t sector) {
  return rangeOfSector(curveKind(curve.angle), meanAngle(curve, run), sector, kSheetTurn);
}

std::optional<SheetStart> dishFrom(const ReferenceMesh<3> &mesh, const Curve<3> &curve,
                                   std::span<const std::size_t> run) {
  const std::vector<Chain> chains = chainsOf(curve);
  Axis axis;
  if (curve.open || chains.size() > 1 || run.size() < curve.ridges.size() ||
      !axisOf(chains[0], mesh.nodes, axis))
    return std::nullopt;
  const Vec<3> radius = mesh.nodes[at(chains[0].nodes[0])] - axis.centre;
  SheetStart start{curve, run, {}, {1, 0}, 0, 0, kDishDepth * glm::length(radius)};
  for (const std::size_t k : run) {
    const RidgeFrame<3> &frame = curve.frames[k];
    const Vec<3> half = headingAt(frame, frame.angle / 2).ahead;
    const Vec<3> along = half - glm::dot(half, axis.direction) * axis.direction;
    if (glm::length(along) < kLeastDishCosine) return std::nullopt;
    start.directions.push_back(directionOf<3>(frame, along));
    start.slope += std::tan(frame.angle / 2 - start.directions.back()) / static_cast<double>(run.size());
  }
  return start;
}

std::shared_ptr<const CutField<3>> sheetThrough(const ReferenceMesh<3> &mesh, const SheetStart &start,
                                                std::span<const Curve<3>> curves) {
  if (start.curve.open || start.run.size() < start.curve.ridges.size()) curves = {}; // ends in none
  Sweep<3> sweep{{}, {}, {}, start.reach, start.slope, start.depth};
  std::vector<double> directions = start.directions;
  std::vector<Heading<3>> headings = headingsAt(start, directions);
  const Curve<3> *target = nullptr;
  std::vector<Heading<3>> back;
  for (const Curve<3> &curve : curves) {
    if (curve.part != start.curve.part || curve.open || curve.sides == start.curve.sides ||
        curve.frames.empty())
      continue;
    double distance = 0;
    auto found = directionsTo(mesh.nodes, start, curve, distance);
    if (!found || distance >= sweep.reach || !isWelcome(mesh.nodes, start, curve)) continue;
    auto there = headingsAt(start, *found);
    auto fromThere = headingsBack(mesh.nodes, start, there, curve);
    if (fromThere.empty()) continue;
    sweep.reach = distance;
    target = &curve;
    directions = std::move(*found);
    headings = std::move(there);
    back = std::move(fromThere);
  }
  const auto add = [&](const Curve<3> &curve, std::span<const std::size_t> run,
                       const std::vector<Heading<3>> &ofRidges) {
    for (const std::size_t k : run)
      sweep.segments.push_back({mesh.nodes[at(curve.ridges[k][0])], mesh.nodes[at(curve.ridges[k][1])]});
    const auto smooth = smoothHeadings(curve, run, ofRidges);
    sweep.headings.insert(sweep.headings.end(), smooth.begin(), smooth.end());
  };
  add(start.curve, start.run, headings);
  for (std::size_t k = 0; k < start.run.size(); ++k)
    sweep.gaps.push_back(gapAt(start.curve.frames[start.run[k]], directions[k]));
  if (target) add(*target, allRidges(*target), back);
  for (std::size_t k = 0; k < back.size(); ++k) {
    const RidgeFrame<3> &frame = target->frames[k];
    const double direction = directionOf<3>(frame, back[k].ahead);
    const double own = gapAt(frame, direction);
    const bool isTurned = glm::dot(headingAt(frame, direction).normal, back[k].normal) < 0;
    sweep.gaps.push_back(isTurned ? 2 * pi - own : own);
  }
  return std::make_shared<SweptField<3>>(std::move(sweep));
}

} // namespace dualblock
