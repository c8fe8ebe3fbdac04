#include "parts/decompose.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "parts/bent_cuts.h"
#include "parts/features.h"
#include "reference/cut.h"
#include "reference/patches.h"
#include "reference/refine.h"

namespace dualblock {
namespace {

using std::numbers::pi;

constexpr double kSamePlane = 1e-7; // radians between directions that count as the same
// A block cannot fill a flat corner, and badly what is nearly flat.
constexpr double kLargestAngle = 170 * pi / 180;
constexpr int kReflexRounds = 4;
constexpr int kVertexRounds = 40;
constexpr int kBentRounds = 80;
constexpr double kBentShare = 0.4; // bent cuts are dear, and those that help come early

template <int N> struct Ridge {
  Index simplex;
  int from, to;
};

/// What each component may still spend. Where planes cross so often that they multiply the mesh, or the parts
/// would give more blocks than the fallback, that is cheaper and no worse.
template <int N> class Budget {
public:
  explicit Budget(const ReferenceMesh<N> &mesh) : gaveUp(at(mesh.componentCount), false) {
    for (const Index n : sizes(mesh)) limits_.push_back(40 * n + 20000);
  }

  /// `share`: of the whole budget that may be spent so far.
  void update(const ReferenceMesh<N> &mesh, double share = 1) {
    const std::vector<Index> now = sizes(mesh);
    for (std::size_t c = 0; c < now.size(); ++c)
      if (now[c] > share * limits_[c]) gaveUp[c] = true;
  }

  void limitBlocks(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                   const std::function<double(Index)> &limit) {
    std::vector<double> blocks(gaveUp.size(), 0);
    std::vector<bool> needed(gaveUp.size(), false);
    const std::vector<Index> component = componentOfParts(mesh, parts);
    for (const Corner &corner : parts.corners) {
      const std::size_t c = at(component[at(corner.part)]);
      blocks[c] += static_cast<double>(corner.sides.size()) - (N - 1);
      if (corner.sides.size() > N) needed[c] = true;
    }
    for (std::size_t c = 0; c < blocks.size(); ++c)
      if (needed[c] && !gaveUp[c] && blocks[c] > limit(toIndex(c))) gaveUp[c] = true;
  }

  std::vector<bool> gaveUp; // per component

private:
  static std::vector<Index> sizes(const ReferenceMesh<N> &mesh) {
    std::vector<Index> count(at(mesh.componentCount), 0);
    for (const Index c : mesh.component) ++count[at(c)];
    return count;
  }
  std::vector<Index> limits_;
};

/// The ridge at `node`, towards `goal`, that leads from a face with tag f to one with tag g, turning through
/// surfaces numbered from crossFrom on. It is looked up by identity, since earlier cuts may have divided it.
template <int N>
std::optional<Ridge<N>> findRidge(const ReferenceMesh<N> &mesh, Index node, Index goal, Index f, Index g,
                                  Index crossFrom) {
  std::vector<Index> star;
  collectStar(mesh, node, star);
  std::optional<Ridge<N>> best;
  double bestCosine = 0.5;
  for (const Index s : star) {
    const int local = mesh.localVertex(s, node);
    for (int i = 0; i < N + 1; ++i) {
      if (i == local || mesh.tags[at(s)][i] != f) continue;
      for (int k = 0; k < N + 1; ++k) {
        if (k == i || k == local) continue;
        const FaceRef<N> end = turnAroundRidge(mesh, s, i, k, crossFrom, [](Index) {});
        if (mesh.tags[at(end.simplex)][end.face] != g) continue;
        double cosine = 1;
        if constexpr (N == 3) {
          const Index other = mesh.simplices[at(s)][6 - i - k - local];
          cosine = glm::dot(glm::normalize(mesh.nodes[at(other)] - mesh.nodes[at(node)]),
                            glm::normalize(mesh.nodes[at(goal)] - mesh.nodes[at(node)]));
        }
        if (cosine <= bestCosine) continue;
        bestCosine = cosine;
        best = Ridge<N>{s, i, k};
      }
    }
  }
  return best;
}

/// Whether the plane already is a split surface at this ridge.
template <int N>
bool isCutAlready(const ReferenceMesh<N> &mesh, const Ridge<N> &ridge, const Plane<N> &plane,
                  Index facetSurfaces, double tolerance) {
  bool found = false;
  const auto inspect = [&](Index s) {
    for (int i = 0; i < N + 1; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone || FaceTag::surface(tag) < facetSurfaces) continue;
      bool inPlane = true; // a face in the plane that holds the ridge
      for (int v = 0; v < N + 1; ++v)
        if (v != i)
          inPlane &= std::abs(plane.distance(mesh.nodes[at(mesh.simplices[at(s)][v])])) <= tolerance;
      for (int v = 0; v < N + 1; ++v) {
        if (v == ridge.from || v == ridge.to) continue;
        const int here = mesh.localVertex(s, mesh.simplices[at(ridge.simplex)][v]);
        inPlane &= here >= 0 && here != i;
      }
      found |= inPlane;
    }
  };
  turnAroundRidge(mesh, ridge.simplex, ridge.from, ridge.to, facetSurfaces, inspect);
  return found;
}

/// The ridges of a curve by smooth runs: a curve between two plane sides may turn sharply, and each run then
/// has a cut of its own.
template <int N>
std::vector<std::vector<std::size_t>> smoothRuns(const ReferenceMesh<N> &mesh, const Curve<N> &curve) {
  DisjointSets sets(curve.ridges.size());
  if constexpr (N == 3) {
    std::vector<std::pair<Index, std::size_t>> ends; // node, ridge
    for (std::size_t k = 0; k < curve.ridges.size(); ++k)
      for (const Index node : curve.ridges[k]) ends.emplace_back(node, k);
    sortItems(ends);
    const double leastCosine = std::cos(kSmoothAngle * pi / 180);
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
      if (ends[e].first != ends[e + 1].first) continue;
      const auto away = [&](std::size_t k) {
        const auto &r = curve.ridges[k];
        const Index other = r[0] == ends[e].first ? r[1] : r[0];
        return glm::normalize(mesh.nodes[at(other)] - mesh.nodes[at(ends[e].first)]);
      };
      if (-glm::dot(away(ends[e].second), away(ends[e + 1].second)) > leastCosine)
        sets.unite(toIndex(ends[e].second), toIndex(ends[e + 1].second));
    }
  }
  Index count = 0;
  const std::vector<Index> number = sets.numbering(count);
  std::vector<std::vector<std::size_t>> runs(at(count));
  for (std::size_t k = 0; k < number.size(); ++k) runs[at(number[k])].push_back(k);
  return runs;
}

/// The surface through a run of a curve at an angle from its first side, given per ridge: a plane where one
/// holds the whole run, else the planes of all ridges. Where it extends a facet it is the facet's own plane,
/// so that neighbouring curves share it to the last bit.
template <int N>
Surface<N> surfaceThrough(const ReferenceMesh<N> &mesh, const Curve<N> &curve,
                          const std::vector<std::size_t> &run, std::size_t sector, double tolerance) {
  const auto planeAt = [&](std::size_t k) {
    const RidgeFrame<N> &frame = curve.frames[k];
    const double direction = sectorPlanes(curveKind(curve.angle), frame.angle)[sector];
    const auto facet = [&](std::size_t side) {
      return mesh.surfaces[at(FaceTag::surface(frame.tags[side]))].plane;
    };
    if (std::abs(direction - pi) < kSamePlane) return facet(0);
    if (std::abs(direction - (frame.angle - pi)) < kSamePlane) return facet(1);
    return planeThrough(mesh.nodes[at(curve.ridges[k].front())],
                        std::sin(direction) * frame.into + std::cos(direction) * frame.outward);
  };
  Surface<N> surface{SurfaceKind::reflexCut, FaceTag::surface(curve.frames[run[0]].tags[0]), planeAt(run[0])};
  if constexpr (N == 3) {
    for (const std::size_t k : run)
      for (const Index node : curve.ridges[k])
        surface.bent |= std::abs(surface.plane.distance(mesh.nodes[at(node)])) > tolerance;
    if (!surface.bent) return surface;
    std::vector<Segment<N>> segments;
    std::vector<Plane<N>> planes;
    for (const std::size_t k : run) {
      segments.push_back({mesh.nodes[at(curve.ridges[k][0])], mesh.nodes[at(curve.ridges[k][1])]});
      planes.push_back(planeAt(k));
    }
    surface.field = std::make_shared<SweptField<N>>(std::move(segments), std::move(planes));
  }
  return surface;
}

/// The plane of a facet that arrives at the ridge from behind the other two, where an assembly's regions
/// meet, if it leaves both sectors at least 45 degrees: a cut that goes on in it needs no new direction.
template <int N>
std::optional<Plane<N>> facetBeyond(const ReferenceMesh<N> &mesh, const Ridge<N> &ridge,
                                    const RidgeFrame<N> &frame, Index facetSurfaces) {
  std::optional<Plane<N>> found;
  const auto inspect = [&](Index s) {
    for (int i = 0; i < N + 1; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone || found) continue;
      const Index surface = FaceTag::surface(tag);
      if (surface >= facetSurfaces || surface == FaceTag::surface(frame.tags[0]) ||
          surface == FaceTag::surface(frame.tags[1]))
        continue;
      bool holdsRidge = true;
      for (int v = 0; v < N + 1; ++v) {
        if (v == ridge.from || v == ridge.to) continue;
        const int here = mesh.localVertex(s, mesh.simplices[at(ridge.simplex)][v]);
        holdsRidge &= here >= 0 && here != i;
      }
      if (!holdsRidge) continue;
      const Plane<N> &plane = mesh.surfaces[at(surface)].plane;
      double direction =
          std::atan2(glm::dot(plane.normal, frame.into), glm::dot(plane.normal, frame.outward));
      if (direction < 0) direction += pi;
      if (direction >= pi / 4 && direction <= frame.angle - pi / 4) found = plane;
    }
  };
  const FaceRef<N> stop = turnAroundRidge(mesh, ridge.simplex, ridge.from, ridge.to, kCrossAll, inspect);
  if (mesh.neighbors[at(stop.simplex)][stop.face] == kNone)
    turnAroundRidge(mesh, ridge.simplex, ridge.to, ridge.from, kCrossAll, inspect);
  return found;
}

/// Cuts along one sector plane of one run. Returns whether there was something to cut.
template <int N>
bool cutRun(ReferenceMesh<N> &mesh, const Curve<N> &curve, const std::vector<std::size_t> &run,
            std::size_t sector, const DecomposeOptions &options) {
  Surface<N> surface = surfaceThrough(mesh, curve, run, sector, options.tolerance);
  if (surface.field) resolve(mesh, *surface.field, options.tolerance);
  const auto [f, g] = curve.frames[run[0]].tags;
  const auto &first = curve.ridges[run[0]];
  const auto ridge = findRidge(mesh, first.front(), first.back(), f, g, options.facetSurfaces);
  if (!ridge) return false;
  if (!surface.field && curveKind(curve.angle) == CurveKind::side)
    if (const auto beyond = facetBeyond(mesh, *ridge, curve.frames[run[0]], options.facetSurfaces))
      surface.plane = *beyond;
  if (!surface.field && isCutAlready(mesh, *ridge, surface.plane, options.facetSurfaces, options.tolerance))
    return false;
  const Index number = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back(std::move(surface));
  const CutSeed<N> seed{ridge->simplex, ridge->from, ridge->to, options.facetSurfaces};
  if (cutAlong<N>(mesh, number, {seed}, options.tolerance) > 0) return true;
  mesh.surfaces.pop_back();
  return false;
}

template <int N>
void cutReflexCurves(ReferenceMesh<N> &mesh, const Parts<N> &parts, const DecomposeOptions &options,
                     Budget<N> &budget, Index &cuts) {
  const std::vector<Index> component = componentOfParts(mesh, parts);
  Index lastCount = mesh.simplexCount();
  for (const Curve<N> &curve : parts.curves) {
    if (curve.angle <= kLargestAngle || budget.gaveUp[at(component[at(curve.part)])]) continue;
    if (mesh.simplexCount() > 2 * lastCount) { // often enough to stop in time, seldom enough to cost nothing
      lastCount = mesh.simplexCount();
      budget.update(mesh);
    }
    const std::size_t sectors = sectorPlanes(curveKind(curve.angle), curve.angle).size();
    for (const auto &run : smoothRuns(mesh, curve))
      for (std::size_t sector = 0; sector < sectors; ++sector)
        if (cutRun(mesh, curve, run, sector, options)) ++cuts;
  }
}

/// A curve that ends at the corner under repair, seen from it.
struct Spoke {
  std::array<Index, 2> sides;
  Index next; // node on the curve next to the corner
  Index end;  // the corner at the curve's other end
};

std::vector<Spoke> spokesOf(const Parts<3> &parts, const Corner &corner, Index curveBegin, Index curveEnd,
                            const std::vector<Index> &partCornerNodes) {
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
/// the one whose far ends lie on most split surfaces already (cuts then share corners, and the choice does
/// not hang on the numbering); then the one that divides the corner's sides most evenly.
bool cutCorner(ReferenceMesh<3> &mesh, const Parts<3> &parts, const Corner &corner,
               const std::vector<Spoke> &spokes, const std::vector<Index> &partCornerNodes,
               const DecomposeOptions &options) {
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

/// One round of rule 2: at most one cut in each part that has a corner of too many sides. Returns the cuts.
Index cutCorners(ReferenceMesh<3> &mesh, const Parts<3> &parts, const DecomposeOptions &options,
                 const std::vector<bool> &gaveUp) {
  const std::vector<Index> component = componentOfParts(mesh, parts);
  Index cuts = 0;
  const Index oldSimplices = mesh.simplexCount();
  std::vector<Index> cornerNodes;
  std::size_t curveBegin = 0;
  std::size_t cornerBegin = 0;
  for (Index part = 0; part < toIndex(parts.parts.size()); ++part) {
    std::size_t curveEnd = curveBegin;
    while (curveEnd < parts.curves.size() && parts.curves[curveEnd].part == part) ++curveEnd;
    std::size_t cornerEnd = cornerBegin;
    cornerNodes.clear();
    const Corner *worst = nullptr;
    for (; cornerEnd < parts.corners.size() && parts.corners[cornerEnd].part == part; ++cornerEnd) {
      const Corner &corner = parts.corners[cornerEnd];
      cornerNodes.push_back(corner.node);
      if (corner.sides.size() > 3 && (!worst || corner.sides.size() > worst->sides.size())) worst = &corner;
    }
    // A cut of an earlier part of this round may have run through this one: leave it to the next round.
    const bool untouched = worst && [&] {
      std::vector<Index> star;
      collectStar(mesh, worst->node, star);
      return std::all_of(star.begin(), star.end(), [&](Index s) { return s < oldSimplices; });
    }();
    if (worst && untouched && !gaveUp[at(component[at(part)])]) {
      const std::vector<Spoke> spokes =
          spokesOf(parts, *worst, toIndex(curveBegin), toIndex(curveEnd), cornerNodes);
      if (cutCorner(mesh, parts, *worst, spokes, cornerNodes, options)) ++cuts;
    }
    curveBegin = curveEnd;
    cornerBegin = cornerEnd;
  }
  return cuts;
}

} // namespace

std::vector<double> sectorPlanes(CurveKind kind, double angle) {
  switch (kind) {
  case CurveKind::end: return {};
  case CurveKind::side: return {angle / 2};
  case CurveKind::corner: // the planes of both facets: sectors of angle - 180, 360 - angle and angle - 180
                          // degrees
    return {pi, angle - pi};
  case CurveKind::reversal: // two whole planes: the bisector, and one across it that runs on beyond the curve
    return {angle / 2, (angle - pi) / 2};
  }
  return {};
}

template <int N>
Decomposition<N> decompose(ReferenceMesh<N> &mesh, const Parts<N> &uncut, const DecomposeOptions &options) {
  const PartOptions partOptions;
  Decomposition<N> result;
  result.parts = uncut;
  Budget<N> budget(mesh);
  for (int round = 0; round < kReflexRounds; ++round) {
    const Index before = result.cuts;
    cutReflexCurves(mesh, result.parts, options, budget, result.cuts);
    if (result.cuts == before) break;
    result.parts = buildParts(mesh, partOptions);
  }
  if constexpr (N == 3) {
    for (int round = 0; round < kBentRounds; ++round) {
      if (!cutBentPart(mesh, result.parts, {options.tolerance, options.facetSurfaces}, budget.gaveUp)) break;
      ++result.bentCuts;
      result.parts = buildParts(mesh, partOptions);
      budget.update(mesh, kBentShare);
    }
    const bool needed = std::any_of(result.parts.corners.begin(), result.parts.corners.end(),
                                    [](const Corner &c) { return c.sides.size() > 3; });
    if (needed) result.pulled = pullParts(mesh, result.parts);
    const auto limit = [&](Index component) {
      return std::min(options.blockLimit(component), result.pulled->blocks[at(component)]);
    };
    for (int round = 0; needed && round < kVertexRounds; ++round) {
      budget.limitBlocks(mesh, result.parts, limit);
      const Index cuts = cutCorners(mesh, result.parts, options, budget.gaveUp);
      if (cuts == 0) break;
      result.vertexCuts += cuts;
      result.parts = buildParts(mesh, partOptions);
      budget.update(mesh);
    }
  }
  result.cuts += result.bentCuts + result.vertexCuts;
  result.gaveUp = std::move(budget.gaveUp);
  return result;
}

template Decomposition<2> decompose(ReferenceMesh<2> &, const Parts<2> &, const DecomposeOptions &);
template Decomposition<3> decompose(ReferenceMesh<3> &, const Parts<3> &, const DecomposeOptions &);

} // namespace dualblock
