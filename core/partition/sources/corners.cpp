#include "partition/sources/corners.h"

#include <cmath>
#include <optional>
#include <tuple>

#include "base/sort.h"
#include "parts/place.h"
#include "parts/ridge.h"
#include "reference/cut.h"

namespace dualblock {
namespace {

/// A curve that ends at the corner under repair, seen from it.
struct Spoke {
  std::array<Index, 2> sides;
  Index next; // node on the curve next to the corner
  Index end;  // the corner at the curve's other end
};

/// In the order of the places where they end.
std::vector<Spoke> spokesOf(const ReferenceMesh<3> &mesh, const Parts<3> &parts, const Corner &corner,
                            Index curveBegin, Index curveEnd, const std::vector<Index> &partCornerNodes) {
  std::vector<Spoke> spokes;
  for (Index c = curveBegin; c < curveEnd; ++c) {
    const Curve<3> &curve = parts.curves[at(c)];
    Spoke spoke{curve.sides, kNone, kNone};
    for (const auto &[a, b] : curve.ridges) {
      if (a == corner.node) spoke.next = b;
      if (b == corner.node) spoke.next = a;
    }
    if (spoke.next == kNone) continue;
    for (const auto &ridge : curve.ridges)
      for (const Index v : ridge)
        if (v != corner.node && std::binary_search(partCornerNodes.begin(), partCornerNodes.end(), v))
          spoke.end = v;
    if (spoke.end != kNone) spokes.push_back(spoke);
  }
  sortItems(spokes,
            [&](const Spoke &a, const Spoke &b) { return placeOf(mesh, a.end) < placeOf(mesh, b.end); });
  return spokes;
}

Index splitSurfacesAt(const ReferenceMesh<3> &mesh, Index node, Index facetSurfaces) {
  std::vector<Index> star;
  std::vector<Index> found;
  collectStar(mesh, node, star);
  for (const Index s : star)
    for (int i = 0; i < 4; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone || FaceTag::surface(tag) < facetSurfaces || mesh.simplices[at(s)][i] == node) continue;
      found.push_back(FaceTag::surface(tag));
    }
  sortItems(found);
  return toIndex(static_cast<std::size_t>(std::unique(found.begin(), found.end()) - found.begin()));
}

/// Cuts a part through a corner where more than three sides meet, along two of its curves that share no
/// side. Among the planes that offer themselves it takes the one that holds most corners of the part; then
/// the one whose far ends lie on most split surfaces already (cuts then share corners); then the one that
/// divides the corner's sides most evenly; then the first by its places.
bool cutCorner(ReferenceMesh<3> &mesh, const Parts<3> &parts, const Corner &corner,
               const std::vector<Spoke> &spokes, const std::vector<Index> &partCornerNodes,
               const CutOptions &options) {
  using Score = std::tuple<Index, Index, Index>;
  std::optional<std::pair<Score, std::pair<std::size_t, Plane<3>>>> best;
  const Vec<3> apex = mesh.nodes[at(corner.node)];
  for (std::size_t i = 0; i < spokes.size(); ++i)
    for (std::size_t k = i + 1; k < spokes.size(); ++k) {
      const auto shares = [&](Index side) {
        return side == spokes[k].sides[0] || side == spokes[k].sides[1];
      };
      if (shares(spokes[i].sides[0]) || shares(spokes[i].sides[1])) continue;
      const Vec<3> d1 = glm::normalize(mesh.nodes[at(spokes[i].end)] - apex);
      const Vec<3> d2 = glm::normalize(mesh.nodes[at(spokes[k].end)] - apex);
      const Vec<3> normal = glm::cross(d1, d2);
      if (glm::length(normal) < 1e-6) continue;
      const Plane<3> plane = planeThrough(apex, normal);
      Index held = 0;
      for (const Index v : partCornerNodes)
        if (std::abs(plane.distance(mesh.nodes[at(v)])) <= options.tolerance) ++held;
      Index behind = 0;
      Index front = 0;
      for (const Spoke &spoke : spokes) {
        const double d = plane.distance(mesh.nodes[at(spoke.end)]);
        behind += d < -options.tolerance ? 1 : 0;
        front += d > options.tolerance ? 1 : 0;
      }
      if (behind == 0 || front == 0) continue;
      const Score score{held,
                        splitSurfacesAt(mesh, spokes[i].end, options.facetSurfaces) +
                            splitSurfacesAt(mesh, spokes[k].end, options.facetSurfaces),
                        std::min(behind, front)};
      if (!best || score > best->first) best = {score, {i, plane}};
    }
  if (!best) return false;
  const auto &[spokeIndex, plane] = best->second;
  const Spoke &spoke = spokes[spokeIndex];
  const auto ridge = findRidge(mesh, corner.node, spoke.next, parts.sides[at(spoke.sides[0])].tag,
                               parts.sides[at(spoke.sides[1])].tag, kCrossNone);
  if (!ridge) return false;
  const Index surface = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back({SurfaceKind::vertexCut, corner.node, plane});
  const CutSeed<3> seed{ridge->simplex, ridge->from, ridge->to, kCrossNone};
  if (cutAlong<3>(mesh, surface, {seed}, options.tolerance) > 0) return true;
  mesh.surfaces.pop_back();
  return false;
}

} // namespace

Index cutCorners(ReferenceMesh<3> &mesh, const Parts<3> &parts, const CutOptions &options,
                 const std::vector<bool> &gaveUp) {
  const std::vector<Index> component = componentOfParts(mesh, parts);
  const Index oldSimplices = mesh.simplexCount();
  struct Task {
    Extent<3> place; // of the corner, and of the part's last one
    const Corner *corner;
    std::size_t curveBegin, curveEnd, cornerBegin, cornerEnd; // the part's
  };
  std::vector<Task> tasks;
  std::size_t curveBegin = 0;
  std::size_t cornerBegin = 0;
  for (Index part = 0; part < toIndex(parts.parts.size()); ++part) {
    Task task{{}, nullptr, curveBegin, curveBegin, cornerBegin, cornerBegin};
    while (task.curveEnd < parts.curves.size() && parts.curves[task.curveEnd].part == part) ++task.curveEnd;
    for (; task.cornerEnd < parts.corners.size() && parts.corners[task.cornerEnd].part == part;
         ++task.cornerEnd) {
      const Corner &corner = parts.corners[task.cornerEnd];
      const Place<3> place = placeOf(mesh, corner.node);
      task.place[1] = task.cornerEnd == cornerBegin ? place : std::max(task.place[1], place);
      if (corner.sides.size() <= 3) continue;
      if (task.corner && (corner.sides.size() < task.corner->sides.size() ||
                          (corner.sides.size() == task.corner->sides.size() && !(place < task.place[0]))))
        continue;
      task.corner = &corner;
      task.place[0] = place;
    }
    curveBegin = task.curveEnd;
    cornerBegin = task.cornerEnd;
    if (task.corner && !gaveUp[at(component[at(part)])]) tasks.push_back(task);
  }
  sortItems(tasks, [](const Task &a, const Task &b) { return a.place < b.place; });
  Index cuts = 0;
  std::vector<Index> cornerNodes;
  for (const Task &task : tasks) {
    // A cut of an earlier part of this round may have run through this one: leave it to the next round.
    std::vector<Index> star;
    collectStar(mesh, task.corner->node, star);
    if (std::any_of(star.begin(), star.end(), [&](Index s) { return s >= oldSimplices; })) continue;
    cornerNodes.clear();
    for (std::size_t c = task.cornerBegin; c < task.cornerEnd; ++c)
      cornerNodes.push_back(parts.corners[c].node);
    const std::vector<Spoke> spokes =
        spokesOf(mesh, parts, *task.corner, toIndex(task.curveBegin), toIndex(task.curveEnd), cornerNodes);
    if (cutCorner(mesh, parts, *task.corner, spokes, cornerNodes, options)) ++cuts;
  }
  return cuts;
}

} // namespace dualblock
