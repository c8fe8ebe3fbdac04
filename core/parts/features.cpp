#include "parts/features.h"

#include <cmath>
#include <numbers>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "partition/heuristics.h"

namespace dualblock {

CurveKind curveKind(double angle) {
  if (angle <= 135 * kDegree + kAngleSlack) return CurveKind::end;
  if (angle <= 225 * kDegree + kAngleSlack) return CurveKind::side;
  return angle <= 315 * kDegree + kAngleSlack ? CurveKind::corner : CurveKind::reversal;
}

template <int N> void keepVertices(const ReferenceMesh<N> &mesh, Parts<N> &uncut) {
  if constexpr (N == 3) {
    std::vector<Index> star;
    const auto isVertex = [&](const Corner &corner) {
      if (corner.sides.size() <= N) return true;
      collectStar(mesh, corner.node, star);
      sortItems(star);
      DisjointSets wedges(star.size());
      std::vector<std::pair<Index, Index>> sides; // by their place in the star, and then by wedge
      for (std::size_t k = 0; k < star.size(); ++k)
        for (int i = 0; i < N + 1; ++i) {
          if (mesh.simplices[at(star[k])][i] == corner.node) continue;
          const Index tag = mesh.tags[at(star[k])][i];
          if (tag == kNone) {
            const auto next = std::lower_bound(star.begin(), star.end(), mesh.neighbors[at(star[k])][i]);
            wedges.unite(toIndex(k), toIndex(static_cast<std::size_t>(next - star.begin())));
          } else if (uncut.partOfSimplex[at(star[k])] == corner.part) {
            sides.emplace_back(toIndex(k), mesh.sideKey(tag));
          }
        }
      for (auto &[place, side] : sides) place = wedges.find(place);
      sortItems(sides);
      sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
      std::size_t most = 0;
      for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        while (end < sides.size() && sides[end].first == sides[begin].first) ++end;
        most = std::max(most, end - begin);
      }
      return most >= N;
    };
    const auto last = std::remove_if(uncut.corners.begin(), uncut.corners.end(),
                                     [&](const Corner &corner) { return !isVertex(corner); });
    uncut.corners.erase(last, uncut.corners.end());
  }
}

template <int N> Features classifyFeatures(const Parts<N> &uncut) {
  Features features;
  for (const Curve<N> &curve : uncut.curves) features.curves.push_back(curveKind(curve.angle));
  for (const Corner &corner : uncut.corners) features.vertexNodes.push_back(corner.node);
  sortItems(features.vertexNodes);
  const auto last = std::unique(features.vertexNodes.begin(), features.vertexNodes.end());
  features.vertexNodes.erase(last, features.vertexNodes.end());
  std::vector<int> featureCurves(features.vertexNodes.size(), 0);
  std::vector<Index> nodes;
  for (std::size_t c = 0; c < uncut.curves.size(); ++c) {
    if (features.curves[c] == CurveKind::side) continue;
    nodes.clear();
    for (const auto &ridge : uncut.curves[c].ridges) nodes.insert(nodes.end(), ridge.begin(), ridge.end());
    sortItems(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const Index node : nodes) {
      const auto at = std::lower_bound(features.vertexNodes.begin(), features.vertexNodes.end(), node);
      if (at != features.vertexNodes.end() && *at == node)
        ++featureCurves[static_cast<std::size_t>(at - features.vertexNodes.begin())];
    }
  }
  // In 2D a vertex is a feature or not: its kind is that of its "curve".
  for (const int n : featureCurves)
    features.vertices.push_back(static_cast<VertexKind>(N == 2 ? 3 * std::min(n, 1) : std::min(n, 3)));
  return features;
}

template <int N> double angleBound(const ReferenceMesh<N> &mesh, const Parts<N> &uncut) {
  constexpr double kRight = 90 * kDegree;
  double smallest = kRight;
  for (const Curve<N> &curve : uncut.curves) smallest = std::min(smallest, curve.angle);
  if constexpr (N == 3) {
    std::vector<bool> isVertex(mesh.nodes.size(), false);
    for (const Corner &corner : uncut.corners) isVertex[at(corner.node)] = true;
    struct FaceAngle {
      Index node, part, side;
      double angle;
    };
    std::vector<FaceAngle> angles;
    for (Index s = 0; s < mesh.simplexCount(); ++s)
      for (int i = 0; i < 4; ++i) {
        if (mesh.tags[at(s)][i] == kNone) continue;
        const std::array<Index, 3> v = mesh.sortedFace(s, i);
        for (std::size_t k = 0; k < 3; ++k) {
          if (!isVertex[at(v[k])]) continue;
          const Vec<3> a = mesh.nodes[at(v[(k + 1) % 3])] - mesh.nodes[at(v[k])];
          const Vec<3> b = mesh.nodes[at(v[(k + 2) % 3])] - mesh.nodes[at(v[k])];
          angles.push_back({v[k], uncut.partOfSimplex[at(s)], mesh.sideKey(mesh.tags[at(s)][i]),
                            std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b))});
        }
      }
    const auto key = [](const FaceAngle &a) { return std::tie(a.node, a.part, a.side); };
    sortItems(angles, [&](const FaceAngle &a, const FaceAngle &b) { return key(a) < key(b); });
    for (std::size_t begin = 0, end = 0; begin < angles.size(); begin = end) {
      double sum = 0;
      for (; end < angles.size() && key(angles[end]) == key(angles[begin]); ++end) sum += angles[end].angle;
      smallest = std::min(smallest, sum);
    }
  }
  return smallest < kRight ? std::sin(smallest) : 1;
}

template double angleBound(const ReferenceMesh<2> &, const Parts<2> &);
template double angleBound(const ReferenceMesh<3> &, const Parts<3> &);
template void keepVertices(const ReferenceMesh<2> &, Parts<2> &);
template void keepVertices(const ReferenceMesh<3> &, Parts<3> &);
template Features classifyFeatures(const Parts<2> &);
template Features classifyFeatures(const Parts<3> &);

} // namespace dualblock
