// How often the blocks of a hexahedral mesh hold a point. For judging meshes: nothing of the core is used but
// plain arrays.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/types.h"

namespace dualblock::test {

/// A hexahedral mesh and nothing else; nodes of a block in VTK's order.
struct HexMesh {
  std::vector<Vec<3>> positions;
  std::vector<std::array<Index, 8>> blocks;
};

/// The faces of a block, each seen from outside counter-clockwise.
inline constexpr std::array<std::array<int, 4>, 6> kOutwardFaces = {
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/// A point of a block and the determinant of the trilinear map there; every coordinate from 0 to 1.
struct TrilinearPoint {
  Vec<3> x;
  double determinant;
};

inline TrilinearPoint trilinear(const HexMesh &mesh, std::size_t block, const Vec<3> &at01) {
  constexpr int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const Vec<3> origin = mesh.positions[at(mesh.blocks[block][0])];
  Vec<3> x{0.0};
  std::array<Vec<3>, 3> derivative{Vec<3>{0.0}, Vec<3>{0.0}, Vec<3>{0.0}};
  for (std::size_t c = 0; c < 8; ++c) {
    const Vec<3> corner = mesh.positions[at(mesh.blocks[block][c])] - origin;
    double weight[3];
    for (int k = 0; k < 3; ++k) weight[k] = kCorners[c][k] ? at01[k] : 1 - at01[k];
    x += weight[0] * weight[1] * weight[2] * corner;
    for (std::size_t k = 0; k < 3; ++k)
      derivative[k] += (kCorners[c][k] ? 1 : -1) * weight[(k + 1) % 3] * weight[(k + 2) % 3] * corner;
  }
  return {origin + x, glm::dot(derivative[0], glm::cross(derivative[1], derivative[2]))};
}

/// The integral of the determinant: Gauss's two points per axis are exact for its degree.
inline double volumeOfBlock(const HexMesh &mesh, std::size_t block) {
  const double g[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
  double sum = 0;
  for (const double u : g)
    for (const double v : g)
      for (const double w : g) sum += trilinear(mesh, block, {u, v, w}).determinant;
  return sum / 8;
}

/// Looks blocks up by a grid. A block holds a point as often as its boundary, six bilinear faces, winds
/// around it: the sum of the signs of the crossings of a ray. That is the number of points that the trilinear
/// map takes there, less twice those where it is inverted.
class BlockMembership {
public:
  explicit BlockMembership(const HexMesh &mesh) : blocks_(mesh.blocks) {
    positions_.reserve(mesh.positions.size());
    for (const Vec<3> &x : mesh.positions) positions_.push_back(turned(x));
    for (const auto &block : blocks_) boxes_.push_back(boxOf(block));
    if (!boxes_.empty()) fillGrid();
  }

  /// Calls visit(block, times) for all blocks that hold p.
  template <typename Visit> void forBlocksAt(const Vec<3> &p, const Visit &visit) const {
    if (boxes_.empty()) return;
    const Vec<3> q = turned(p);
    if (!all_.holds(q)) return;
    const Index cell = cellOf(q);
    for (const Index *b = cells_.begin(cell); b != cells_.end(cell); ++b)
      if (boxes_[at(*b)].holds(q))
        if (const int times = timesAround(blocks_[at(*b)], q)) visit(*b, times);
  }

  /// How many blocks hold p, each as often as it does; without `but`.
  int count(const Vec<3> &p, Index but = kNone) const {
    int sum = 0;
    forBlocksAt(p, [&](Index block, int times) { sum += block == but ? 0 : std::abs(times); });
    return sum;
  }

private:
  struct Box {
    Vec<3> low, high;
    bool holds(const Vec<3> &p) const {
      return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
    }
  };

  /// So that no ray along the third axis runs within faces that are parallel to an axis or a diagonal.
  static Vec<3> turned(const Vec<3> &x) {
    static const Vec<3> c = glm::normalize(Vec<3>{0.3138, -0.5471, 0.7761});
    static const Vec<3> a = glm::normalize(glm::cross(c, Vec<3>{0.8127, 0.2913, 0.1379}));
    static const Vec<3> b = glm::cross(c, a);
    return {glm::dot(a, x), glm::dot(b, x), glm::dot(c, x)};
  }

  Box boxOf(const std::array<Index, 8> &block) const {
    Box box{positions_[at(block[0])], positions_[at(block[0])]};
    for (const Index v : block) {
      box.low = glm::min(box.low, positions_[at(v)]);
      box.high = glm::max(box.high, positions_[at(v)]);
    }
    return box;
  }

  void fillGrid() {
    all_ = boxes_[0];
    for (const Box &box : boxes_) {
      all_.low = glm::min(all_.low, box.low);
      all_.high = glm::max(all_.high, box.high);
    }
    size_ = std::clamp(static_cast<int>(2 * std::cbrt(static_cast<double>(boxes_.size()))), 1, 64);
    cells_ = collectLists<Index>(at(size_ * size_ * size_), [&](auto put) {
      for (std::size_t b = 0; b < boxes_.size(); ++b) {
        const auto low = placeOf(boxes_[b].low);
        const auto high = placeOf(boxes_[b].high);
        for (int i = low[0]; i <= high[0]; ++i)
          for (int j = low[1]; j <= high[1]; ++j)
            for (int k = low[2]; k <= high[2]; ++k) put((i * size_ + j) * size_ + k, toIndex(b));
      }
    });
  }

  std::array<int, 3> placeOf(const Vec<3> &p) const {
    std::array<int, 3> place;
    for (int k = 0; k < 3; ++k) {
      const double width = all_.high[k] - all_.low[k];
      const double share = width > 0 ? (p[k] - all_.low[k]) / width : 0;
      place[at(k)] = std::clamp(static_cast<int>(share * size_), 0, size_ - 1);
    }
    return place;
  }
  Index cellOf(const Vec<3> &p) const {
    const auto place = placeOf(p);
    return (place[0] * size_ + place[1]) * size_ + place[2];
  }

  int timesAround(const std::array<Index, 8> &block, const Vec<3> &p) const {
    int sum = 0;
    for (const auto &face : kOutwardFaces) {
      std::array<Vec<3>, 4> x;
      for (std::size_t k = 0; k < 4; ++k) x[k] = positions_[at(block[at(face[k])])] - p;
      sum += crossings(x);
    }
    return sum;
  }

  /// Signs of the places where the ray from 0 along the third axis leaves (1) or enters (-1) through a
  /// bilinear face x(u, v) = a + u b + v c + u v d. In the plane across the ray, a + v c and b + v d are
  /// parallel there: a quadratic equation in v.
  static int crossings(const std::array<Vec<3>, 4> &x) {
    const auto [xLow, xHigh] = std::minmax({x[0].x, x[1].x, x[2].x, x[3].x});
    const auto [yLow, yHigh] = std::minmax({x[0].y, x[1].y, x[2].y, x[3].y});
    if (xLow > 0 || xHigh < 0 || yLow > 0 || yHigh < 0) return 0;
    if (std::max({x[0].z, x[1].z, x[2].z, x[3].z}) < 0) return 0;
    const Vec<3> b = x[1] - x[0];
    const Vec<3> c = x[3] - x[0];
    const Vec<3> d = (x[0] - x[1]) + (x[2] - x[3]);
    const double second = across(c, d);
    const double first = across(x[0], d) + across(c, b);
    const double constant = across(x[0], b);
    const double discriminant = first * first - 4 * second * constant;
    if (discriminant < 0) return 0;
    const double q = -0.5 * (first + std::copysign(std::sqrt(discriminant), first)); // no digits cancel
    int sum = 0;
    for (const double v : {q / second, constant / q}) {
      if (!(v >= 0 && v < 1)) continue; // nor where a root is at infinity, or not a number
      const Vec<3> along = b + v * d;
      const Vec<3> start = x[0] + v * c;
      const double u = -(start.x * along.x + start.y * along.y) / (along.x * along.x + along.y * along.y);
      if (!(u >= 0 && u < 1) || start.z + u * along.z < 0) continue;
      sum += across(along, c + u * d) > 0 ? 1 : -1;
    }
    return sum;
  }
  static double across(const Vec<3> &a, const Vec<3> &b) { return a.x * b.y - a.y * b.x; }

  std::vector<Vec<3>> positions_; // turned
  std::vector<std::array<Index, 8>> blocks_;
  std::vector<Box> boxes_;
  Box all_{};
  int size_ = 1;       // cells of the grid per axis
  Lists<Index> cells_; // per cell: the blocks whose boxes meet it
};

} // namespace dualblock::test
