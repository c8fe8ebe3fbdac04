// Check 5: the blocks keep the domain's features. Each vertex is a primal node, each curve a chain of primal
// edges, each facet a union of primal faces; and the blocks around each curve are counted against the ideal.
#include <cmath>
#include <numbers>

#include "certificate/checks.h"

namespace dualblock {
namespace {

template <int N> Index facetOf(const CertificateInput<N> &in, const BlockFace<N> &face) {
  if (face.side == kNone) return kNone;
  const Index surface = FaceTag::surface(in.parts.sides[at(face.side)].tag);
  return in.mesh.surfaces[at(surface)].kind == SurfaceKind::facet ? surface : kNone;
}

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

/// An edge of the blocks (2D: node) where the blocks around it lie between two patches.
struct Crease {
  std::array<Index, 2> keys;  // of the patches and the sides that they are seen from, ascending
  std::array<Index, 2> nodes; // ascending; 2D: the node twice
  Index blocks;               // around it, from one patch to the other
  bool operator<(const Crease &o) const { return keys != o.keys ? keys < o.keys : nodes < o.nodes; }
  bool operator==(const Crease &o) const { return keys == o.keys && nodes == o.nodes; }
};

/// Turns around each edge of each block face on a facet, through the blocks, until another facet ends the fan.
template <int N>
std::vector<Crease> findCreases(const CertificateInput<N> &in, const BlockComplex<N> &complex) {
  const auto key = [&](const BlockFace<N> &face) {
    return in.mesh.sideKey(in.parts.sides[at(face.side)].tag);
  };
  const auto mateOf = [&](Index f) { // the same face, seen from the other block
    if (f > 0 && complex.faces[at(f - 1)].key == complex.faces[at(f)].key) return f - 1;
    if (at(f + 1) < complex.faces.size() && complex.faces[at(f + 1)].key == complex.faces[at(f)].key) return f + 1;
    return kNone;
  };
  const auto holds = [](const BlockFace<N> &face, Index node) {
    return std::binary_search(face.key.begin(), face.key.end(), node);
  };
  std::vector<Crease> creases;
  for (const BlockFace<N> &start : complex.faces) {
    if (facetOf(in, start) == kNone) continue;
    for (std::size_t k = 0; k < start.cycle.size(); ++k) {
      const Index a = start.cycle[k];
      const Index b = N == 2 ? a : start.cycle[(k + 1) % start.cycle.size()];
      Index block = start.block;
      int from = start.local;
      Crease crease{{kNone, kNone}, {std::min(a, b), std::max(a, b)}, 0};
      while (at(crease.blocks) < in.primal.blocks.size()) {
        ++crease.blocks;
        Index across = kNone;
        for (int f = 0; f < 2 * N; ++f) {
          const Index face = complex.faceOf[at(2 * N * block + f)];
          if (f != from && holds(complex.faces[at(face)], a) && holds(complex.faces[at(face)], b)) across = face;
        }
        if (across == kNone) break;
        if (facetOf(in, complex.faces[at(across)]) != kNone) {
          crease.keys = {key(start), key(complex.faces[at(across)])};
          break;
        }
        const Index next = mateOf(across);
        if (next == kNone) break; // no facet where there is no block: checkFacets says so
        block = complex.faces[at(next)].block;
        from = complex.faces[at(next)].local;
      }
      if (crease.keys[0] < crease.keys[1]) creases.push_back(crease); // each fan is met from both of its ends
    }
  }
  std::sort(creases.begin(), creases.end());
  creases.erase(std::unique(creases.begin(), creases.end()), creases.end());
  return creases;
}

template <int N>
void checkFacets(const CertificateInput<N> &in, const BlockComplex<N> &complex, double tolerance,
                 Certificate &certificate) {
  std::vector<double> covered(in.domain.facets.size(), 0);
  for (const BlockFace<N> &face : complex.faces) {
    const Index facet = facetOf(in, face);
    if (facet == kNone) continue;
    const Plane<N> &plane = in.mesh.surfaces[at(facet)].plane;
    for (const Index v : face.cycle)
      if (std::abs(plane.distance(in.primal.positions[at(v)])) > tolerance)
        certificate.fail(Check::features,
                         "node " + std::to_string(v) + " is off facet " + std::to_string(facet),
                         {{"node", v}, {"facet", facet}});
    covered[at(facet)] += polygonMeasure(in.primal.positions, face.cycle, plane.normal);
  }
  for (std::size_t k = 0; k < complex.boundary.size(); ++k)
    if (facetOf(in, complex.faces[at(complex.boundary[k])]) == kNone)
      certificate.fail(Check::features, "a boundary face of the blocks lies on no facet",
                       {{"block", complex.faces[at(complex.boundary[k])].block}});
  std::vector<int> sheets(in.domain.facets.size(), 0); // an interface is covered from both sides
  for (const auto &side : in.features.sides) {
    const Index surface = FaceTag::surface(side.tag);
    sheets[at(surface)] |= FaceTag::isFront(side.tag) ? 2 : 1;
  }
  for (std::size_t f = 0; f < covered.size(); ++f) {
    if (sheets[f] == 0) continue; // the wall of a hole that was taken away on both sides
    const double area = facetArea(in.domain.vertices, in.domain.facets[f]) * (sheets[f] == 3 ? 2 : 1);
    const double allowed = 1e-9 * area + (N == 3 ? tolerance * in.mesh.size : tolerance);
    if (!(std::abs(covered[f] - area) <= allowed))
      certificate.fail(Check::features, "facet " + std::to_string(f) + " is not covered once by primal faces",
                       {{"facet", static_cast<std::int64_t>(f)}});
  }
}

} // namespace

template <int N>
void checkFeatures(const CertificateInput<N> &in, const BlockComplex<N> &complex, Certificate &certificate) {
  const double tolerance = 1e-9 * in.mesh.size + 2 * in.facetDeviation;
  checkFacets(in, complex, tolerance, certificate);

  // Vertices: sort the primal nodes by position and look each vertex up.
  std::vector<Index> byPosition(in.primal.positions.size());
  for (std::size_t k = 0; k < byPosition.size(); ++k) byPosition[k] = toIndex(k);
  std::sort(byPosition.begin(), byPosition.end(),
            [&](Index a, Index b) { return in.primal.positions[at(a)].x < in.primal.positions[at(b)].x; });
  for (const Corner &corner : in.features.corners) {
    const Vec<N> x = in.featureNodes[at(corner.node)];
    auto near =
        std::lower_bound(byPosition.begin(), byPosition.end(), x.x - tolerance,
                         [&](Index node, double value) { return in.primal.positions[at(node)].x < value; });
    bool found = false;
    for (; near != byPosition.end() && in.primal.positions[at(*near)].x <= x.x + tolerance && !found; ++near)
      found = glm::length(in.primal.positions[at(*near)] - x) <= tolerance;
    if (!found)
      certificate.fail(Check::features,
                       "vertex " + std::to_string(corner.node) + " of the domain is no primal node",
                       {{"vertex", corner.node}});
  }

  // Curves: the creases of the blocks between two facets have the length of the domain's curves there.
  const std::vector<Crease> creases = findCreases(in, complex);
  const auto keysOf = [&](const Curve<N> &curve) {
    return sortedPair(in.mesh.sideKey(in.features.sides[at(curve.sides[0])].tag),
                      in.mesh.sideKey(in.features.sides[at(curve.sides[1])].tag));
  };
  std::vector<std::pair<std::array<Index, 2>, double>> lengths; // per pair of keys: of the domain's curves
  for (const Curve<N> &curve : in.features.curves) {
    double length = 0;
    for (const auto &ridge : curve.ridges) {
      if constexpr (N == 2) length += 1;
      else length += glm::length(in.featureNodes[at(ridge[1])] - in.featureNodes[at(ridge[0])]);
    }
    const auto keys = keysOf(curve);
    const auto first = std::lower_bound(creases.begin(), creases.end(), Crease{keys, {kNone, kNone}, 0});
    Index actual = 0;
    for (auto c = first; c != creases.end() && c->keys == keys; ++c)
      actual = actual == 0 ? c->blocks : std::min(actual, c->blocks);
    certificate.features.push_back({idealBlocks(curve.angle), actual});
    lengths.emplace_back(keys, length);
  }
  std::sort(lengths.begin(), lengths.end());
  for (std::size_t begin = 0, end = 0; begin < lengths.size(); begin = end) {
    double wanted = 0;
    for (; end < lengths.size() && lengths[end].first == lengths[begin].first; ++end)
      wanted += lengths[end].second;
    double made = 0;
    const std::array<Index, 2> keys = lengths[begin].first;
    for (auto c = std::lower_bound(creases.begin(), creases.end(), Crease{keys, {kNone, kNone}, 0});
         c != creases.end() && c->keys == keys; ++c)
      made += N == 2
                  ? 1
                  : glm::length(in.primal.positions[at(c->nodes[1])] - in.primal.positions[at(c->nodes[0])]);
    const std::array<Index, 2> facets{keys[0] / 2, keys[1] / 2};
    if (!(std::abs(made - wanted) <= 1e-9 * in.mesh.size + 4 * in.facetDeviation))
      certificate.fail(Check::features,
                       "the curve between facets " + std::to_string(facets[0]) + " and " +
                           std::to_string(facets[1]) + " is no chain of primal edges",
                       {{"facet", facets[0]}, {"facet", facets[1]}});
  }
}

template void checkFeatures(const CertificateInput<2> &, const BlockComplex<2> &, Certificate &);
template void checkFeatures(const CertificateInput<3> &, const BlockComplex<3> &, Certificate &);

} // namespace dualblock
