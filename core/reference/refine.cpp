#include "reference/refine.h"

#include "base/deadline.h"
#include "base/sort.h"
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

namespace dualblock {
namespace {

constexpr int kRounds = 8;

struct WantedSplit {
  Index a, b;
  double position; // from a to b
};

/// Splits the edges in the given order of precedence.
template <int N> void splitInOrder(ReferenceMesh<N> &mesh, const std::vector<WantedSplit> &wanted) {
  std::vector<EdgeSplit> splits;
  std::vector<bool> marked(mesh.nodes.size(), false);
  for (const WantedSplit &w : wanted) {
    splits.push_back({w.a, w.b, mesh.nodeCount()});
    mesh.nodes.push_back(mesh.nodes[at(w.a)] + w.position * (mesh.nodes[at(w.b)] - mesh.nodes[at(w.a)]));
    marked[at(w.a)] = marked[at(w.b)] = true;
  }
  sortItems(splits,
            [](const EdgeSplit &x, const EdgeSplit &y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  std::vector<Index> affected;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    const auto &v = mesh.simplices[at(s)];
    bool hit = false;
    for (int i = 0; i < N + 1 && !hit; ++i)
      for (int k = i + 1; k < N + 1 && !hit; ++k)
        hit = marked[at(v[i])] && marked[at(v[k])] && splitNode(splits, v[i], v[k]) != kNone;
    if (hit) affected.push_back(s);
  }
  subdivide(mesh, splits, affected);
}

template <int N> std::vector<std::pair<Index, Index>> allEdges(const ReferenceMesh<N> &mesh) {
  std::vector<std::pair<Index, Index>> edges;
  for (const auto &v : mesh.simplices)
    for (int i = 0; i < N + 1; ++i)
      for (int k = i + 1; k < N + 1; ++k) edges.emplace_back(std::minmax(v[i], v[k]));
  sortItems(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

} // namespace

template <int N> void splitLongEdges(ReferenceMesh<N> &mesh, double length) {
  while (true) {
    std::vector<std::pair<double, std::pair<Index, Index>>> tooLong;
    for (const auto &edge : allEdges(mesh)) {
      const double l = glm::length(mesh.nodes[at(edge.second)] - mesh.nodes[at(edge.first)]);
      if (l > length) tooLong.push_back({-l, edge});
    }
    if (tooLong.empty()) return;
    sortItems(tooLong);
    std::vector<WantedSplit> wanted;
    for (const auto &[l, edge] : tooLong) wanted.push_back({edge.first, edge.second, 0.5});
    splitInOrder(mesh, wanted);
  }
}

template <int N> void splitRandomEdges(ReferenceMesh<N> &mesh, std::uint32_t seed) {
  std::vector<std::pair<Index, Index>> edges = allEdges(mesh);
  std::mt19937 random(seed);
  std::vector<WantedSplit> wanted;
  const std::size_t count = std::min(edges.size(), std::max<std::size_t>(4, edges.size() / 8));
  for (std::size_t k = 0; k < count; ++k) {
    std::swap(edges[k], edges[k + random() % (edges.size() - k)]);
    wanted.push_back({edges[k].first, edges[k].second, 0.25 + static_cast<double>(random()) / 8589934592.0});
  }
  splitInOrder(mesh, wanted);
}

template <int N> void splitEdges(ReferenceMesh<N> &mesh, std::vector<std::pair<Index, Index>> edges) {
  for (auto &[a, b] : edges)
    if (a > b) std::swap(a, b);
  sortItems(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<WantedSplit> wanted;
  for (const auto &[a, b] : edges) wanted.push_back({a, b, 0.5});
  splitInOrder(mesh, wanted);
}

namespace {

/// Where an edge has to be split before it is cut along a field, from a to b; 0 for nowhere.
template <int N>
double splitPosition(const ReferenceMesh<N> &mesh, const CutField<N> &field, Index a, Index b, double va,
                     double vb, double tolerance) {
  constexpr double kChord = 0.05;    // of the edge's length: how far the middle of a chord may be off
  constexpr double kAnchored = 1e-3; // likewise, of one between two places of the curve that the cut holds
  const Vec<N> from = mesh.nodes[at(a)];
  const Vec<N> along = mesh.nodes[at(b)] - from;
  if (std::min(va, vb) < -tolerance && std::max(va, vb) > tolerance) return 0;
  if (std::max(std::abs(va), std::abs(vb)) <= tolerance) { // a chord from the cut to the cut
    const double off = std::abs(field.value(from + 0.5 * along)) / glm::length(along);
    const auto isAnchored = [&] {
      return field.isAnchor(from, tolerance) && field.isAnchor(from + along, tolerance);
    };
    return off > kChord || (off > kAnchored && isAnchored()) ? 0.5 : 0;
  }
  // The point between the ends that lies furthest on their other side.
  const double sign = va + vb > 0 ? 1 : -1;
  double furthest = -tolerance;
  double position = 0;
  for (const double t : {0.25, 0.5, 0.75}) {
    const double value = sign * field.value(from + t * along);
    if (value >= furthest) continue;
    furthest = value;
    position = t;
  }
  return position;
}

/// Whether the cut would go straight through simplex s where the zero set is bent: from one crossed edge to
/// another, with the middle off.
template <int N>
bool hasBentChord(const ReferenceMesh<N> &mesh, const CutField<N> &field, const std::vector<double> &values,
                  Index s, double tolerance, double sagitta) {
  std::array<Vec<N>, 4> crossings; // no plane crosses more edges of a tetrahedron
  std::size_t count = 0;
  const auto &v = mesh.simplices[at(s)];
  for (int i = 0; i < N + 1; ++i)
    for (int k = i + 1; k < N + 1; ++k) {
      const double va = values[at(v[i])];
      const double vb = values[at(v[k])];
      if (std::min(va, vb) >= -tolerance || std::max(va, vb) <= tolerance) continue;
      const Vec<N> a = mesh.nodes[at(v[i])];
      const Vec<N> b = mesh.nodes[at(v[k])];
      crossings[count++] = a + rootBetween<N>(field, a, b, va, vb) * (b - a);
    }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i + 1; k < count; ++k)
      if (std::abs(field.value(0.5 * (crossings[i] + crossings[k]))) >
          sagitta * glm::length(crossings[k] - crossings[i]))
        return true;
  return false;
}

/// The longest edge of simplex s, to be split where it is crossed or, if that is near an end, in the middle.
template <int N>
WantedSplit splitOfLongest(const ReferenceMesh<N> &mesh, const std::vector<double> &values, Index s) {
  WantedSplit longest{kNone, kNone, 0.5};
  double most = 0;
  const auto &v = mesh.simplices[at(s)];
  for (int i = 0; i < N + 1; ++i)
    for (int k = i + 1; k < N + 1; ++k) {
      const auto [a, b] = sortedPair(v[i], v[k]);
      const Vec<N> along = mesh.nodes[at(b)] - mesh.nodes[at(a)];
      if (glm::dot(along, along) <= most) continue;
      most = glm::dot(along, along);
      longest = {a, b, 0.5};
    }
  const double t = values[at(longest.a)] / (values[at(longest.a)] - values[at(longest.b)]);
  if (t > 0.25 && t < 0.75) longest.position = t;
  return longest;
}

/// The simplices that a cut crosses, and those beside them in the same part, where it may do so unseen.
template <int N>
std::vector<Index> nearSection(const ReferenceMesh<N> &mesh, const Surface<N> &surface,
                               const std::vector<CutSeed<N>> &seeds, double tolerance) {
  std::vector<Index> near = sectionOf(mesh, surface, seeds, tolerance);
  for (std::size_t n = near.size(); n-- > 0;)
    for (int i = 0; i < N + 1; ++i)
      if (mesh.tags[at(near[n])][i] == kNone) near.push_back(mesh.neighbors[at(near[n])][i]);
  sortItems(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

} // namespace

template <int N>
void resolve(ReferenceMesh<N> &mesh, const Surface<N> &surface,
             const std::function<std::vector<CutSeed<N>>()> &seeds, double tolerance, double sagitta) {
  const CutField<N> &field = *surface.field;
  // A field that is uneven everywhere has no end of splits.
  const Index limit = mesh.simplexCount() + std::min(2 * mesh.simplexCount() + 10000, 100000);
  std::vector<double> values(mesh.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  for (int round = 0; round < kRounds && mesh.simplexCount() <= limit; ++round) {
    checkDeadline();
    const std::vector<Index> near = nearSection(mesh, surface, seeds(), tolerance);
    values.resize(mesh.nodes.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<std::pair<Index, Index>> edges;
    for (const Index s : near)
      for (int i = 0; i < N + 1; ++i) {
        const Index a = mesh.simplices[at(s)][i];
        if (std::isnan(values[at(a)])) values[at(a)] = field.value(mesh.nodes[at(a)]);
        for (int k = i + 1; k < N + 1; ++k) edges.emplace_back(std::minmax(a, mesh.simplices[at(s)][k]));
      }
    sortItems(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<WantedSplit> wanted;
    for (const auto &[a, b] : edges)
      if (const double t = splitPosition(mesh, field, a, b, values[at(a)], values[at(b)], tolerance); t > 0)
        wanted.push_back({a, b, t});
    for (const Index s : near)
      if (sagitta > 0 && hasBentChord(mesh, field, values, s, tolerance, sagitta))
        wanted.push_back(splitOfLongest(mesh, values, s));
    if (wanted.empty()) break;
    sortItems(wanted, [](const WantedSplit &x, const WantedSplit &y) {
      return std::tie(x.a, x.b) < std::tie(y.a, y.b);
    });
    wanted.erase(
        std::unique(wanted.begin(), wanted.end(),
                    [](const WantedSplit &x, const WantedSplit &y) { return x.a == y.a && x.b == y.b; }),
        wanted.end());
    splitInOrder(mesh, wanted);
  }
}

template void resolve(ReferenceMesh<3> &, const Surface<3> &,
                      const std::function<std::vector<CutSeed<3>>()> &, double, double);
template void splitLongEdges(ReferenceMesh<2> &, double);
template void splitLongEdges(ReferenceMesh<3> &, double);
template void splitRandomEdges(ReferenceMesh<2> &, std::uint32_t);
template void splitRandomEdges(ReferenceMesh<3> &, std::uint32_t);
template void splitEdges(ReferenceMesh<2> &, std::vector<std::pair<Index, Index>>);
template void splitEdges(ReferenceMesh<3> &, std::vector<std::pair<Index, Index>>);

} // namespace dualblock
