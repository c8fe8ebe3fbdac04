// Check 5: the blocks keep the domain's features. Each vertex is a primal node, each curve a chain of primal
// edges, each facet a union of primal faces; and the blocks around each curve are counted against the ideal.
#include <cmath>
#include <numbers>

#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

std::uint8_t idealBlocks(double angle) {
  constexpr double kDegree = std::numbers::pi / 180;
  if (angle <= 135 * kDegree) return 1;
  if (angle <= 225 * kDegree) return 2;
  return angle <= 315 * kDegree ? 3 : 4;
}

double polygonMeasure(const std::vector<Vec<2>> &x, const std::array<Index, 2> &cycle, const Vec<2> &) {
  return glm::length(x[at(cycle[1])] - x[at(cycle[0])]);
}

double polygonMeasure(const std::vector<Vec<3>> &x, const std::array<Index, 4> &cycle, const Vec<3> &normal) {
  return std::abs(glm::dot(
             normal, glm::cross(x[at(cycle[2])] - x[at(cycle[0])], x[at(cycle[3])] - x[at(cycle[1])]))) /
         2;
}

double facetArea(const std::vector<Vec<2>> &v, const Facet &f) {
  return glm::length(v[at(f.loops[0][1])] - v[at(f.loops[0][0])]);
}

double facetArea(const std::vector<Vec<3>> &v, const Facet &f) {
  Vec<3> sum{0.0};
  for (const auto &loop : f.loops)
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      sum += glm::cross(v[at(loop[k])] - v[at(loop[0])], v[at(loop[k + 1])] - v[at(loop[0])]) / 2.0;
  return glm::length(sum);
}

template <int N>
void checkFacets(const BlockInput<N> &in, const BlockComplex<N> &complex, double tolerance,
                 Certificate &certificate) {
  std::vector<double> covered(in.domain.facets.size(), 0);
  for (const BlockFace<N> &face : complex.faces) {
    const Index facet = facetOf(face);
    if (facet == kNone) continue;
    if (in.mesh.surfaces[at(facet)].bent) continue; // checkBentSides
    const Plane<N> &plane = in.mesh.surfaces[at(facet)].plane;
    for (const Index v : face.cycle)
      if (std::abs(plane.distance(in.blocks.positions[at(v)])) > tolerance)
        certificate.fail(Check::features,
                         "node " + std::to_string(v) + " is off facet " + std::to_string(facet),
                         {{"node", v}, {"facet", facet}});
    covered[at(facet)] += polygonMeasure(in.blocks.positions, face.cycle, plane.normal);
  }
  for (std::size_t k = 0; k < complex.boundary.size(); ++k)
    if (facetOf(complex.faces[at(complex.boundary[k])]) == kNone)
      certificate.fail(Check::features, "a boundary face of the blocks lies on no facet",
                       {{"block", complex.faces[at(complex.boundary[k])].block}});
  std::vector<int> sheets(in.domain.facets.size(), 0); // an interface is covered from both sides
  for (const auto &side : in.features.sides) {
    const Index surface = FaceTag::surface(side.tag);
    sheets[at(surface)] |= FaceTag::isFront(side.tag) ? 2 : 1;
  }
  std::vector<bool> straight(covered.size(), true); // facets that end at a bent side lose area to its chords
  for (std::size_t f = 0; f < covered.size(); ++f) straight[f] = !in.mesh.surfaces[f].bent;
  for (const Curve<N> &curve : in.features.curves) {
    std::array<std::size_t, 2> f;
    for (std::size_t k = 0; k < 2; ++k)
      f[k] = at(FaceTag::surface(in.features.sides[at(curve.sides[k])].tag));
    if (in.mesh.surfaces[f[0]].bent || in.mesh.surfaces[f[1]].bent) straight[f[0]] = straight[f[1]] = false;
  }
  for (std::size_t f = 0; f < covered.size(); ++f) {
    if (sheets[f] == 0 || !straight[f]) continue; // the wall of a hole that was taken away, or no polygon
    const double area = facetArea(in.domain.vertices, in.domain.facets[f]) * (sheets[f] == 3 ? 2 : 1);
    const double allowed = 1e-9 * area + (N == 3 ? tolerance * in.mesh.size : tolerance);
    if (!(std::abs(covered[f] - area) <= allowed))
      certificate.fail(Check::features, "facet " + std::to_string(f) + " is not covered once by primal faces",
                       {{"facet", static_cast<std::int64_t>(f)}});
  }
}

} // namespace

template <int N>
void checkFeatures(const BlockInput<N> &in, const BlockComplex<N> &complex, Certificate &certificate) {
  const double tolerance = 1e-9 * in.mesh.size + 2 * in.facetDeviation;
  checkFacets(in, complex, tolerance, certificate);
  if constexpr (N == 3)
    if (isBent(in)) checkBentSides(in, complex, tolerance, certificate);

  // Vertices: the primal nodes in the order of their heights along a direction that few of them share a plane
  // across, and each vertex looked up.
  Vec<N> slanted{1.0};
  for (int k = 1; k < N; ++k) slanted[k] = slanted[k - 1] * 0.7320508075688772;
  slanted = glm::normalize(slanted);
  std::vector<std::pair<double, Index>> byHeight;
  byHeight.reserve(in.blocks.positions.size());
  for (const Vec<N> &x : in.blocks.positions)
    byHeight.emplace_back(glm::dot(x, slanted), toIndex(byHeight.size()));
  sortItems(byHeight);
  for (const Corner &corner : in.features.corners) {
    const Vec<N> x = in.featureNodes[at(corner.node)];
    const double height = glm::dot(x, slanted);
    const double slack = 2 * tolerance; // heights are rounded, too
    auto near = std::lower_bound(byHeight.begin(), byHeight.end(), std::pair(height - slack, Index{0}));
    bool found = false;
    for (; near != byHeight.end() && near->first <= height + slack && !found; ++near)
      found = glm::length(in.blocks.positions[at(near->second)] - x) <= tolerance;
    if (!found)
      certificate.fail(Check::features,
                       "vertex " + std::to_string(corner.node) + " of the domain is no primal node",
                       {{"vertex", corner.node}});
  }

  const std::vector<Crease> creases = findCreases(in, complex);
  const auto keysOf = [&](const Curve<N> &curve) {
    return sortedPair(in.mesh.sideKey(in.features.sides[at(curve.sides[0])].tag),
                      in.mesh.sideKey(in.features.sides[at(curve.sides[1])].tag));
  };
  for (const Curve<N> &curve : in.features.curves) {
    const auto keys = keysOf(curve);
    const auto first = std::lower_bound(creases.begin(), creases.end(), Crease{keys, {kNone, kNone}, 0});
    Index actual = 0;
    for (auto c = first; c != creases.end() && c->keys == keys; ++c)
      actual = actual == 0 ? c->blocks : std::min(actual, c->blocks);
    certificate.features.push_back({idealBlocks(curve.angle), actual});
  }
  checkCurves(in, creases, tolerance, certificate);
}

template void checkFeatures(const BlockInput<2> &, const BlockComplex<2> &, Certificate &);
template void checkFeatures(const BlockInput<3> &, const BlockComplex<3> &, Certificate &);

} // namespace dualblock
