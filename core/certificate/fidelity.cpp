#include "certificate/fidelity.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "base/box_tree.h"
#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr int kPieces = 2;         // along each direction of a face, for distances from it
constexpr int kMostDivisions = 6;  // of a side's triangle, along each edge, for samples
constexpr double kSliver = 0.05;   // of what a face stands for: less is a sliver, or its neighbour's by right
constexpr std::size_t kFewest = 8; // segments of a chain that count as they are

using Triangle = std::array<Vec<3>, 3>;

/// Square of the distance of a point from a triangle, by Voronoi regions.
double squareTo(const Triangle &t, const Vec<3> &x) {
  const Vec<3> ab = t[1] - t[0];
  const Vec<3> ac = t[2] - t[0];
  const Vec<3> normal = glm::cross(ab, ac);
  const double square = glm::dot(normal, normal);
  bool isInside = square > 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec<3> d = t[(k + 1) % 3] - t[k];
    const Vec<3> to = x - t[k];
    isInside = isInside && glm::dot(glm::cross(normal, d), to) >= 0;
    const double length = glm::dot(d, d);
    const Vec<3> gap = to - (length > 0 ? std::clamp(glm::dot(to, d) / length, 0.0, 1.0) : 0.0) * d;
    least = std::min(least, glm::dot(gap, gap));
  }
  const double height = glm::dot(normal, x - t[0]);
  return isInside ? height * height / square : least;
}

Box boxOf(const Triangle &t) {
  Box box;
  for (const Vec<3> &x : t) box.add(x);
  return box;
}

Vec<3> pointOf(const std::vector<Vec<3>> &x, const std::array<Index, 4> &q, double u, double v) {
  return (1 - u) * (1 - v) * x[at(q[0])] + u * (1 - v) * x[at(q[1])] + u * v * x[at(q[2])] +
         (1 - u) * v * x[at(q[3])];
}

/// The largest angle between directions of some area: between the extreme ones along 26 directions, slivers
/// left out.
double spreadOf(const std::vector<std::pair<Vec<3>, double>> &normals) {
  double area = 0;
  for (const auto &n : normals) area += n.second;
  std::vector<Vec<3>> extreme;
  std::vector<std::pair<double, std::size_t>> order;
  for (int direction = 0; direction < 27; ++direction) {
    const Vec<3> along(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
    if (along == Vec<3>(0.0)) continue;
    order.clear();
    for (std::size_t n = 0; n < normals.size(); ++n)
      order.emplace_back(-glm::dot(normals[n].first, along), n);
    std::make_heap(order.begin(), order.end(), std::greater<>());
    // The first one beyond which there is more than a sliver.
    for (double beyond = 0;; order.pop_back()) {
      std::pop_heap(order.begin(), order.end(), std::greater<>());
      beyond += normals[order.back().second].second;
      if (beyond <= kSliver * area && order.size() > 1) continue;
      extreme.push_back(normals[order.back().second].first);
      break;
    }
  }
  double least = 1;
  for (const Vec<3> &a : extreme)
    for (const Vec<3> &b : extreme) least = std::min(least, glm::dot(a, b));
  return std::acos(std::clamp(least, -1.0, 1.0)) * kDegrees;
}

/// One side: its triangles, and the faces that stand for it.
class SideMeter {
public:
  SideMeter(const std::vector<Vec<3>> &positions, std::span<const SideFace> faces,
            std::span<const SideTriangle> triangles)
      : positions_(positions), faces_(faces), triangles_(triangles), distance_(faces.size(), 0),
        turning_(faces.size(), 0), strayed_(faces.size(), 0) {
    for (const SideFace &face : faces)
      meanSize_ += std::min(faceSize(positions, face.nodes), face.column) / static_cast<double>(faces.size());
  }

  void measure(int samples) {
    fromFaces(samples);
    fromTriangles();
  }

  double distance(std::size_t face) const {
    return distance_[face] / faceSize(positions_, faces_[face].nodes);
  }
  double depth(std::size_t face) const { return distance_[face] / faces_[face].column; }
  double turning(std::size_t face) const { return turning_[face]; }
  /// The volume between the face and its side: half of what the one is off the other, from either.
  double strayed(std::size_t face) const { return strayed_[face]; }

private:
  double areaOf(const std::array<Index, 4> &q) const {
    return glm::length(glm::cross(positions_[at(q[2])] - positions_[at(q[0])],
                                  positions_[at(q[3])] - positions_[at(q[1])])) /
           2;
  }

  void fromFaces(int samples) {
    std::vector<Box> boxes;
    for (const SideTriangle &t : triangles_) boxes.push_back(boxOf(t.corners));
    const BoxTree tree(boxes);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int i = 0; i <= samples + 1; ++i)
        for (int j = 0; j <= samples + 1; ++j) {
          const Vec<3> x = pointOf(positions_, faces_[f].nodes, static_cast<double>(i) / (samples + 1),
                                   static_cast<double>(j) / (samples + 1));
          const double square = tree.nearest(x, std::numeric_limits<double>::infinity(),
                                             [&](Index t) { return squareTo(triangles_[at(t)].corners, x); });
          const bool isEnd = i % (samples + 1) == 0;
          const bool isSide = j % (samples + 1) == 0;
          if (!isEnd || !isSide) // that nodes lie on it is another check
            distance_[f] = std::max(distance_[f], std::sqrt(square));
          // By the trapezoidal rule.
          const double share = (isEnd ? 0.5 : 1) * (isSide ? 0.5 : 1) / ((samples + 1) * (samples + 1));
          strayed_[f] += std::sqrt(square) * share * areaOf(faces_[f].nodes) / 2;
        }
  }

  void fromTriangles() {
    std::vector<Triangle> pieces; // of faces, 2 kPieces^2 of each
    std::vector<Box> boxes;
    for (const SideFace &face : faces_)
      for (int i = 0; i < kPieces; ++i)
        for (int j = 0; j < kPieces; ++j) {
          const auto x = [&](int u, int v) {
            return pointOf(positions_, face.nodes, static_cast<double>(u) / kPieces,
                           static_cast<double>(v) / kPieces);
          };
          for (const Triangle &t : {Triangle{x(i, j), x(i + 1, j), x(i + 1, j + 1)},
                                    Triangle{x(i, j), x(i + 1, j + 1), x(i, j + 1)}}) {
            pieces.push_back(t);
            boxes.push_back(boxOf(t));
          }
        }
    const BoxTree tree(boxes);
    std::vector<std::vector<std::pair<Vec<3>, double>>> normals(faces_.size());
    const auto nearestFace = [&](const Vec<3> &x, double &distance) {
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      tree.nearest(x, least, [&](Index p) {
        const double square = squareTo(pieces[at(p)], x);
        if (square < least) {
          least = square;
          nearest = at(p) / (2 * kPieces * kPieces);
        }
        return square;
      });
      distance = std::sqrt(least);
      return nearest;
    };
    std::vector<std::array<double, 3>> samples; // triangles share most of them
    double gap = 0;
    for (const SideTriangle &t : triangles_) {
      const Vec<3> across = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
      if (!(glm::length(across) > 0)) continue;
      const Vec<3> unit = glm::normalize(across);
      double longest = 0;
      for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, glm::length(t.corners[(k + 1) % 3] - t.corners[k]));
      const int n = std::clamp(static_cast<int>(std::ceil(4 * longest / meanSize_)), 1, kMostDivisions);
      const auto x = [&](double a, double b) {
        return t.corners[0] + a / n * (t.corners[1] - t.corners[0]) + b / n * (t.corners[2] - t.corners[0]);
      };
      for (int a = 0; a <= n; ++a)
        for (int b = 0; a + b <= n; ++b) {
          const Vec<3> p = x(a, b);
          samples.push_back({p.x, p.y, p.z});
        }
      const double share = glm::length(across) / (n * (n + 1)); // of the triangle's area, of each place
      for (int a = 0; a < n; ++a)
        for (int b = 0; a + b < n; ++b) {
          const std::size_t f = nearestFace(x(a + 1.0 / 3, b + 1.0 / 3), gap);
          strayed_[f] += gap * share / 2;
          auto &known = normals[f];
          if (known.empty() || glm::dot(known.back().first, unit) < 1 - 1e-9) known.emplace_back(unit, 0);
          known.back().second += share;
        }
    }
    sortItems(samples);
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
    for (const auto &[a, b, c] : samples) {
      const std::size_t f = nearestFace({a, b, c}, gap);
      distance_[f] = std::max(distance_[f], gap);
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (normals[f].size() > 1) turning_[f] = spreadOf(normals[f]);
  }

  const std::vector<Vec<3>> &positions_;
  std::span<const SideFace> faces_;
  std::span<const SideTriangle> triangles_;
  double meanSize_ = 0;
  std::vector<double> distance_, turning_, strayed_;
};

} // namespace

double faceSize(const std::vector<Vec<3>> &x, const std::array<Index, 4> &q) {
  const double u = glm::length(pointOf(x, q, 1, 0.5) - pointOf(x, q, 0, 0.5));
  const double v = glm::length(pointOf(x, q, 0.5, 1) - pointOf(x, q, 0.5, 0));
  return std::max(u, v);
}

std::string describe(const FaceFault &fault) {
  switch (fault.kind) {
  case Fault::distance: return " by " + scientific(fault.value) + " of its face's size";
  case Fault::depth: return " by " + scientific(fault.value) + " of the thickness there";
  case Fault::turning: break;
  }
  return ", which turns by " + scientific(fault.value) + " degrees in its face";
}

SideMeasures measureSides(const std::vector<Vec<3>> &positions, const std::vector<SideFace> &faces,
                          const std::vector<SideTriangle> &triangles, int samples) {
  SideMeasures measures;
  std::vector<SideFace> facesByPatch = faces;
  std::vector<Index> order(faces.size()); // of `faces`, in the same order
  for (std::size_t f = 0; f < faces.size(); ++f) order[f] = toIndex(f);
  sortItems(order, [&](Index a, Index b) { return faces[at(a)].patch < faces[at(b)].patch; });
  for (std::size_t f = 0; f < order.size(); ++f) facesByPatch[f] = faces[at(order[f])];
  std::vector<SideTriangle> trianglesByPatch = triangles;
  sortItems(trianglesByPatch, [](const SideTriangle &a, const SideTriangle &b) {
    return a.patch != b.patch ? a.patch < b.patch : a.facet < b.facet;
  });
  std::vector<double> strayed(faces.size(), 0);
  std::size_t firstTriangle = 0;
  for (std::size_t begin = 0, end = 0; begin < facesByPatch.size(); begin = end) {
    SideFidelity side{facesByPatch[begin].patch};
    while (end < facesByPatch.size() && facesByPatch[end].patch == side.patch) ++end;
    while (firstTriangle < trianglesByPatch.size() && trianglesByPatch[firstTriangle].patch < side.patch)
      ++firstTriangle;
    std::size_t lastTriangle = firstTriangle;
    while (lastTriangle < trianglesByPatch.size() && trianglesByPatch[lastTriangle].patch == side.patch)
      ++lastTriangle;
    SideMeter meter(positions, {facesByPatch.data() + begin, end - begin},
                    {trianglesByPatch.data() + firstTriangle, lastTriangle - firstTriangle});
    meter.measure(samples);
    for (std::size_t f = begin; f < end; ++f) {
      const double distance = meter.distance(f - begin);
      const double depth = meter.depth(f - begin);
      const double turning = meter.turning(f - begin);
      side.distance = std::max(side.distance, distance);
      side.depth = std::max(side.depth, depth);
      side.turning = std::max(side.turning, turning);
      strayed[at(order[f])] = meter.strayed(f - begin);
      side.strayed += meter.strayed(f - begin);
      if (!(distance <= kMostDistance)) measures.faults.push_back({order[f], distance, Fault::distance});
      if (!(depth <= kMostDepth)) measures.faults.push_back({order[f], depth, Fault::depth});
      if (turning > kMostTurning) measures.faults.push_back({order[f], turning, Fault::turning});
      if (!(depth <= kAimedDepth)) measures.coarse.push_back(order[f]);
    }
    measures.sides.push_back(side);
  }
  if (!strayed.empty()) {
    const double most = *std::max_element(strayed.begin(), strayed.end());
    for (std::size_t f = 0; f < strayed.size(); ++f)
      if (strayed[f] > most / 2) measures.furthest.push_back(toIndex(f));
  }
  sortItems(measures.faults, [](const FaceFault &a, const FaceFault &b) { return a.face < b.face; });
  sortItems(measures.coarse);
  return measures;
}

double turningOf(std::span<const Vec<3>> chain) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) length += glm::length(chain[k + 1] - chain[k]);
  // Many segments: every other point, evenly spaced, so that jags of single ones even out.
  std::vector<Vec<3>> points;
  const std::size_t count = std::max(kFewest, (chain.size() - 1) / 2);
  if (chain.size() - 1 <= kFewest) {
    points.assign(chain.begin(), chain.end());
  } else {
    points.push_back(chain.front());
    double before = 0;
    for (std::size_t k = 0, n = 1; k + 1 < chain.size() && n < count; ++k) {
      const double step = glm::length(chain[k + 1] - chain[k]);
      for (; n < count && length * static_cast<double>(n) / static_cast<double>(count) <= before + step; ++n)
        points.push_back(chain[k] + (length * static_cast<double>(n) / static_cast<double>(count) - before) /
                                        step * (chain[k + 1] - chain[k]));
      before += step;
    }
    points.push_back(chain.back());
  }
  double turning = 0;
  Vec<3> last(0.0);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Vec<3> d = points[k + 1] - points[k];
    if (!(glm::length(d) > 1e-9 * length)) continue;
    const Vec<3> unit = glm::normalize(d);
    if (last != Vec<3>(0.0)) turning += std::acos(std::clamp(glm::dot(last, unit), -1.0, 1.0)) * kDegrees;
    last = unit;
  }
  return turning;
}

double sagOf(std::span<const Vec<3>> chain) {
  const Vec<3> d = chain.back() - chain.front();
  const double square = glm::dot(d, d);
  if (!(square > 0)) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (const Vec<3> &x : chain) {
    const double t = std::clamp(glm::dot(x - chain.front(), d) / square, 0.0, 1.0);
    most = std::max(most, glm::length(x - chain.front() - t * d));
  }
  return most / std::sqrt(square);
}

} // namespace dualblock
