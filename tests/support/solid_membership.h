// Whether a point is inside of a solid, by the solid angles of its facets. For judging meshes: nothing of the
// core is used but plain arrays.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/domain.h"

namespace dualblock::test {

/// The facets of a domain, all oriented outward, as triangles.
class SolidMembership {
public:
  explicit SolidMembership(const Domain<3> &domain) : vertices_(domain.vertices) {
    for (const Facet &facet : domain.facets) {
      if (facet.isInterface) continue; // the domain is on both of its sides
      Vec<3> outer{0.0};
      for (std::size_t l = 0; l < facet.loops.size(); ++l) {
        const auto &loop = facet.loops[l];
        Vec<3> normal{0.0};
        for (std::size_t k = 2; k < loop.size(); ++k) normal += normalOf({loop[0], loop[k - 1], loop[k]});
        if (l == 0) outer = normal;
        // A hole runs against its facet, an island in a hole with it.
        const bool turned = l > 0 && (glm::dot(normal, outer) > 0) != isIsland(facet, l, outer);
        // Where a fan covers a place of the plane twice or leaves the loop, its triangles cancel out.
        for (std::size_t k = 2; k < loop.size(); ++k)
          triangles_.push_back(turned ? Triangle{loop[0], loop[k], loop[k - 1]}
                                      : Triangle{loop[0], loop[k - 1], loop[k]});
      }
    }
    low_ = high_ = vertices_.empty() ? Vec<3>{0.0} : vertices_[0];
    for (const Vec<3> &v : vertices_) {
      low_ = glm::min(low_, v);
      high_ = glm::max(high_, v);
    }
    markCells();
  }

  const Vec<3> &low() const { return low_; }
  const Vec<3> &high() const { return high_; }

  /// By the divergence theorem, from the middle of the box: far from 0, digits would be lost.
  double volume() const {
    const Vec<3> middle = (low_ + high_) / 2.0;
    double sum = 0;
    for (const Triangle &t : triangles_)
      sum += glm::dot(vertices_[at(t[0])] - middle,
                      glm::cross(vertices_[at(t[1])] - middle, vertices_[at(t[2])] - middle));
    return sum / 6;
  }

  /// How often the facets wind around p: their solid angles by 4 pi. tan of half of a triangle's is y / x
  /// below (Van Oosterom and Strackee); the angles are added as those of complex numbers are, by multiplying,
  /// and full turns counted, which takes one arc tangent instead of one a triangle.
  double windingNumber(const Vec<3> &p) const {
    std::vector<Vec<3>> rays(vertices_.size());
    for (std::size_t v = 0; v < rays.size(); ++v) rays[v] = glm::normalize(vertices_[v] - p);
    double x = 1;
    double y = 0;
    int turns = 0;
    for (const Triangle &t : triangles_) {
      const Vec<3> &a = rays[at(t[0])];
      const Vec<3> &b = rays[at(t[1])];
      const Vec<3> &c = rays[at(t[2])];
      const double ty = glm::dot(a, glm::cross(b, c));
      const double tx = 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
      const double nx = x * tx - y * ty;
      const double ny = x * ty + y * tx;
      if (y >= 0 && ty >= 0 && ny < 0) ++turns;
      if (y < 0 && ty < 0 && ny >= 0) --turns;
      const double size = std::abs(nx) + std::abs(ny);
      if (size == 0) continue; // p lies on the triangle
      x = nx / size;
      y = ny / size;
    }
    return turns + std::atan2(y, x) / (2 * std::numbers::pi);
  }

  /// All points of a cell that no facet comes near are on the same side: its middle is asked for once.
  bool holds(const Vec<3> &p) const {
    std::array<int, 3> place;
    for (int k = 0; k < 3; ++k) {
      if (!(p[k] >= low_[k] && p[k] <= high_[k])) return false;
      place[at(k)] = placeOf(p[k], k);
    }
    Cell &cell = cells_[cellAt(place[0], place[1], place[2])];
    if (cell == Cell::near) return windingNumber(p) > 0.5;
    if (cell == Cell::unknown) {
      const bool isInside = windingNumber(middleOf(place[0], place[1], place[2])) > 0.5;
      cell = isInside ? Cell::inside : Cell::outside;
    }
    return cell == Cell::inside;
  }

private:
  using Triangle = std::array<Index, 3>;
  enum class Cell : std::uint8_t { unknown, near, inside, outside };
  static constexpr int kCells = 20; // per axis

  Vec<3> normalOf(const Triangle &t) const {
    return glm::cross(vertices_[at(t[1])] - vertices_[at(t[0])], vertices_[at(t[2])] - vertices_[at(t[0])]);
  }
  /// Whether a loop is within an even number of the facet's others, by a ray in the facet's plane.
  bool isIsland(const Facet &facet, std::size_t loop, const Vec<3> &normal) const {
    const Vec<3> size = glm::abs(normal);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int u = (drop + 1) % 3;
    const int w = (drop + 2) % 3;
    const Vec<3> &p = vertices_[at(facet.loops[loop][0])];
    bool even = true;
    for (std::size_t l = 0; l < facet.loops.size(); ++l) {
      const auto &other = facet.loops[l];
      for (std::size_t k = 0; l != loop && k < other.size(); ++k) {
        const Vec<3> &a = vertices_[at(other[k])];
        const Vec<3> &b = vertices_[at(other[(k + 1) % other.size()])];
        if ((a[w] > p[w]) == (b[w] > p[w])) continue;
        if (a[u] + (p[w] - a[w]) / (b[w] - a[w]) * (b[u] - a[u]) > p[u]) even = !even;
      }
    }
    return even;
  }
  int placeOf(double x, int axis) const {
    const double share = (x - low_[axis]) / (high_[axis] - low_[axis]);
    return std::clamp(static_cast<int>(share * kCells), 0, kCells - 1);
  }
  static std::size_t cellAt(int i, int j, int k) { return at((i * kCells + j) * kCells + k); }
  Vec<3> middleOf(int i, int j, int k) const {
    return low_ + (Vec<3>(i, j, k) + 0.5) * (high_ - low_) / static_cast<double>(kCells);
  }

  /// Cells that meet a triangle's box and its plane are near it, and those just beside them, for rounding.
  void markCells() {
    cells_.assign(at(kCells * kCells * kCells), Cell::unknown);
    const double reach = 0.51 * glm::length(high_ - low_) / kCells;
    const double pad = 1e-9 * glm::length(high_ - low_);
    for (const Triangle &t : triangles_) {
      const Vec<3> &a = vertices_[at(t[0])];
      const Vec<3> low = glm::min(a, glm::min(vertices_[at(t[1])], vertices_[at(t[2])])) - pad;
      const Vec<3> high = glm::max(a, glm::max(vertices_[at(t[1])], vertices_[at(t[2])])) + pad;
      const Vec<3> normal = normalOf(t);
      const double limit = reach * glm::length(normal);
      for (int i = placeOf(low.x, 0); i <= placeOf(high.x, 0); ++i)
        for (int j = placeOf(low.y, 1); j <= placeOf(high.y, 1); ++j)
          for (int k = placeOf(low.z, 2); k <= placeOf(high.z, 2); ++k)
            if (std::abs(glm::dot(normal, middleOf(i, j, k) - a)) <= limit)
              cells_[cellAt(i, j, k)] = Cell::near;
    }
  }

  std::vector<Vec<3>> vertices_;
  std::vector<Triangle> triangles_;
  Vec<3> low_, high_;
  mutable std::vector<Cell> cells_;
};

} // namespace dualblock::test
