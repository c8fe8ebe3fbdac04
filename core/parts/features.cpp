#include "parts/features.h"

#include "base/sort.h"
#include <numbers>

namespace dualblock {

CurveKind curveKind(double angle) {
  constexpr double kDegree = std::numbers::pi / 180;
  if (angle <= 135 * kDegree + kAngleSlack) return CurveKind::end;
  if (angle <= 225 * kDegree + kAngleSlack) return CurveKind::side;
  return angle <= 315 * kDegree + kAngleSlack ? CurveKind::corner : CurveKind::reversal;
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

template Features classifyFeatures(const Parts<2> &);
template Features classifyFeatures(const Parts<3> &);

} // namespace dualblock
