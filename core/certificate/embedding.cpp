#include "certificate/embedding.h"

#include <cmath>
#include <optional>

#include "base/box_tree.h"
#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace dualblock {
namespace {

constexpr int kHalvings = 6;          // of a pair of faces: to a sixty-fourth of their size
constexpr Index kPairsOfFaces = 4000; // of pieces that are looked at before a pair counts as crossing

constexpr double kBorder = 1e-7; // of a face: nearer to its rim a ray counts as unclear

using Quad = std::array<Vec<3>, 4>;

Quad quadOf(const QuadSurface &surface, Index face) {
  Quad quad;
  for (std::size_t k = 0; k < 4; ++k) quad[k] = surface.positions[at(surface.faces[at(face)][k])];
  return quad;
}

Box boxOf(const Quad &quad) {
  Box box;
  for (const Vec<3> &x : quad) box.add(x);
  return box;
}

std::array<Quad, 4> quarters(const Quad &q) {
  const Vec<3> a = (q[0] + q[1]) / 2.0;
  const Vec<3> b = (q[1] + q[2]) / 2.0;
  const Vec<3> c = (q[2] + q[3]) / 2.0;
  const Vec<3> d = (q[3] + q[0]) / 2.0;
  const Vec<3> m = (a + c) / 2.0;
  return {{{q[0], a, m, d}, {a, q[1], b, m}, {m, b, q[2], c}, {d, m, c, q[3]}}};
}

/// Whether a plane lies between the hulls of two quadrilaterals, with at most `overlap` of them on its wrong
/// side. A bilinear quadrilateral lies in the hull of its corners, a tetrahedron, and two of those are apart
/// if and only if a plane parallel to a face of one, or to an edge of each, separates them. Flat ones need
/// the planes square to them along their edges, too.
class Separation {
public:
  Separation(const Quad &p, const Quad &q, double overlap) : overlap_(overlap) {
    for (std::size_t k = 0; k < 4; ++k) { // from the first corner, as differences of near points are exact
      p_[k] = p[k] - p[0];
      q_[k] = q[k] - p[0];
    }
  }

  bool exists() const {
    if (splits(q_[0] + q_[1] + q_[2] + q_[3] - p_[0] - p_[1] - p_[2] - p_[3])) return true;
    const Vec<3> normalP = glm::cross(p_[2] - p_[0], p_[3] - p_[1]);
    const Vec<3> normalQ = glm::cross(q_[2] - q_[0], q_[3] - q_[1]);
    if (splits(normalP) || splits(normalQ)) return true;
    for (std::size_t k = 0; k < 4; ++k)
      if (splits(glm::cross(edge(p_, k), normalP)) || splits(glm::cross(edge(q_, k), normalQ))) return true;
    for (std::size_t k = 0; k < 4; ++k)
      if (splits(faceNormal(p_, k)) || splits(faceNormal(q_, k))) return true;
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t m = 0; m < 6; ++m)
        if (splits(glm::cross(edge(p_, k), edge(q_, m)))) return true;
    return false;
  }

private:
  /// The four around, then the two diagonals.
  static Vec<3> edge(const Quad &q, std::size_t k) {
    return k < 4 ? q[(k + 1) % 4] - q[k] : q[k - 2] - q[k - 4];
  }
  static Vec<3> faceNormal(const Quad &q, std::size_t k) {
    return glm::cross(q[(k + 1) % 4] - q[k], q[(k + 2) % 4] - q[k]);
  }

  bool splits(const Vec<3> &axis) const {
    const double length = glm::length(axis);
    if (!(length > 0)) return false;
    double lowP = std::numeric_limits<double>::infinity();
    double lowQ = lowP;
    double highP = -lowP;
    double highQ = -lowP;
    for (std::size_t k = 0; k < 4; ++k) {
      const double a = glm::dot(axis, p_[k]);
      const double b = glm::dot(axis, q_[k]);
      lowP = std::min(lowP, a);
      highP = std::max(highP, a);
      lowQ = std::min(lowQ, b);
      highQ = std::max(highQ, b);
    }
    // What is thinner than the rounding of its own axis tells nothing.
    const double bound = overlap_ * length;
    const auto isBelow = [&](double lowA, double highA, double lowB, double highB) {
      return highA - lowB <= bound && lowA < highB - bound;
    };
    return isBelow(lowP, highP, lowQ, highQ) || isBelow(lowQ, highQ, lowP, highP);
  }

  Quad p_, q_;
  double overlap_;
};

bool areApart(const Quad &p, const Quad &q, double overlap, int halvings, Index &left) {
  if (Separation(p, q, overlap).exists()) return true;
  if (halvings == 0 || --left < 0) return false;
  for (const Quad &a : quarters(p))
    for (const Quad &b : quarters(q))
      if (!areApart(a, b, overlap, halvings - 1, left)) return false;
  return true;
}

bool shareAPlace(const Quad &p, const Quad &q) {
  return std::any_of(p.begin(), p.end(),
                     [&](const Vec<3> &x) { return std::find(q.begin(), q.end(), x) != q.end(); });
}

/// The signed crossings of a ray with faces.
class Ray {
public:
  Ray(const Vec<3> &from, const Vec<3> &direction) : from_(from), direction_(glm::normalize(direction)) {
    const Vec<3> n = glm::abs(direction_);
    const Vec<3> least = n.x <= n.y && n.x <= n.z ? Vec<3>(1, 0, 0)
                         : n.y <= n.z             ? Vec<3>(0, 1, 0)
                                                  : Vec<3>(0, 0, 1);
    right_ = glm::normalize(glm::cross(direction_, least));
    up_ = glm::cross(direction_, right_);
  }

  const Vec<3> &from() const { return from_; }
  const Vec<3> &direction() const { return direction_; }
  bool isClear() const { return isClear_; }
  /// How often the surface winds around where the ray begins: times that it is left less times that it is
  /// entered.
  int layers() const { return layers_; }

  /// `isOwn`: the ray begins on this face.
  void cross(const Quad &q, bool isOwn) {
    // Seen along the ray the face is (a + u b) + v (c + u d), and is met where that vanishes.
    const auto seen = [&](const Vec<3> &x) {
      return Vec<2>(glm::dot(x - from_, right_), glm::dot(x - from_, up_));
    };
    const Vec<2> a = seen(q[0]);
    const Vec<2> b = seen(q[1]) - a;
    const Vec<2> c = seen(q[3]) - a;
    const Vec<2> d = seen(q[2]) - a - b - c;
    const auto area = [](const Vec<2> &x, const Vec<2> &y) { return x.x * y.y - x.y * y.x; };
    const double constant = area(a, c);
    const double linear = area(a, d) + area(b, c);
    const double square = area(b, d);
    const double scale = std::abs(constant) + std::abs(linear) + std::abs(square);
    if (!(scale > 0)) return;
    std::array<double, 2> roots{};
    int count = 0;
    if (std::abs(square) <= 1e-13 * scale) {
      if (std::abs(linear) > 1e-13 * scale) roots[static_cast<std::size_t>(count++)] = -constant / linear;
    } else {
      const double inner = linear * linear - 4 * square * constant;
      if (std::abs(inner) <= 1e-12 * scale * scale) { // it grazes the face, if it meets it
        look(q, a, b, c, d, -linear / (2 * square), isOwn, true);
        return;
      }
      if (inner < 0) return;
      const double sum = -(linear + std::copysign(std::sqrt(inner), linear)) / 2;
      roots[static_cast<std::size_t>(count++)] = sum / square;
      if (sum != 0) roots[static_cast<std::size_t>(count++)] = constant / sum;
    }
    for (int k = 0; k < count; ++k) look(q, a, b, c, d, roots[static_cast<std::size_t>(k)], isOwn, false);
  }

private:
  void look(const Quad &q, const Vec<2> &a, const Vec<2> &b, const Vec<2> &c, const Vec<2> &d, double u,
            bool isOwn, bool grazes) {
    if (!(u >= -kBorder && u <= 1 + kBorder)) return;
    const Vec<2> across = c + u * d;
    const double length = glm::dot(across, across);
    if (!(length > 0)) {
      isClear_ = false;
      return;
    }
    const double v = -glm::dot(a + u * b, across) / length;
    if (!(v >= -kBorder && v <= 1 + kBorder)) return;
    const Vec<3> x = (1 - u) * (1 - v) * q[0] + u * (1 - v) * q[1] + u * v * q[2] + (1 - u) * v * q[3];
    const double along = glm::dot(x - from_, direction_);
    const double size = glm::length(q[2] - q[0]) + glm::length(q[3] - q[1]);
    if (isOwn && std::abs(along) <= 1e-9 * size) return;
    if (along < 0) return;
    const Vec<3> byU = (1 - v) * (q[1] - q[0]) + v * (q[2] - q[3]);
    const Vec<3> byV = (1 - u) * (q[3] - q[0]) + u * (q[2] - q[1]);
    const Vec<3> normal = glm::cross(byU, byV);
    const double outward = glm::dot(normal, direction_);
    const double rim = std::min(std::min(u, 1 - u), std::min(v, 1 - v));
    if (grazes || rim < kBorder || std::abs(outward) <= 1e-7 * glm::length(normal)) isClear_ = false;
    layers_ += outward > 0 ? 1 : -1;
  }

  Vec<3> from_, direction_, right_, up_;
  int layers_ = 0;
  bool isClear_ = true;
};

/// A ray that leaves a face outwards, unlike every other one that is tried; none where that has no outside.
std::optional<Ray> rayFrom(const Quad &q, int attempt) {
  const Vec<3> across = glm::cross(q[2] - q[0], q[3] - q[1]);
  if (!(glm::length(across) > 0)) return {};
  const Vec<3> normal = glm::normalize(across);
  const double turn = 2.399963229728653 * (attempt + 1); // the golden angle
  const double lean = 0.15 + 0.6 * (attempt % 7) / 7;
  const Vec<3> aside =
      std::cos(turn) * glm::normalize(q[2] - q[0]) + std::sin(turn) * glm::normalize(q[3] - q[1]);
  return Ray((q[0] + q[1] + q[2] + q[3]) / 4.0, normal + lean * aside);
}

} // namespace

std::vector<std::array<Index, 2>> crossingFaces(const QuadSurface &surface, double margin, std::size_t most) {
  std::vector<Box> boxes;
  boxes.reserve(surface.faces.size());
  for (Index f = 0; f < toIndex(surface.faces.size()); ++f) {
    boxes.push_back(boxOf(quadOf(surface, f)));
    boxes.back().low -= Vec<3>(margin);
    boxes.back().high += Vec<3>(margin);
  }
  const BoxTree tree(boxes);
  std::vector<std::array<Index, 2>> crossing;
  for (Index f = 0; f < toIndex(surface.faces.size()) && crossing.size() < most; ++f) {
    const Quad p = quadOf(surface, f);
    tree.visit([&](const Box &box) { return box.meets(boxes[at(f)]); },
               [&](Index g) {
                 if (g <= f || crossing.size() >= most) return;
                 const Quad q = quadOf(surface, g);
                 Index left = kPairsOfFaces;
                 if (!areApart(p, q, shareAPlace(p, q) ? margin : -margin, kHalvings, left))
                   crossing.push_back({f, g});
               });
  }
  return crossing;
}

std::vector<WrongShell> wrongShells(const QuadSurface &surface) {
  constexpr int kAttempts = 32; // rays, from as many faces as there are
  std::vector<Box> boxes;
  DisjointSets shells(surface.positions.size());
  for (Index f = 0; f < toIndex(surface.faces.size()); ++f) {
    Box &box = boxes.emplace_back(boxOf(quadOf(surface, f)));
    const Vec<3> border(kBorder * glm::length(box.high - box.low)); // rays along its rim meet it, too
    box.low -= border;
    box.high += border;
    for (const Index node : surface.faces[at(f)]) shells.unite(node, surface.faces[at(f)][0]);
  }
  const BoxTree tree(boxes);
  std::vector<std::pair<Index, Index>> byShell; // shell, face
  for (Index f = 0; f < toIndex(surface.faces.size()); ++f)
    byShell.emplace_back(shells.find(surface.faces[at(f)][0]), f);
  sortItems(byShell);
  std::vector<WrongShell> wrong;
  for (std::size_t begin = 0, end = 0; begin < byShell.size(); begin = end) {
    while (end < byShell.size() && byShell[end].first == byShell[begin].first) ++end;
    WrongShell shell{byShell[begin].second, 0, false};
    for (int attempt = 0; attempt < kAttempts && !shell.isKnown; ++attempt) {
      const Index from = byShell[begin + static_cast<std::size_t>(attempt) % (end - begin)].second;
      std::optional<Ray> ray = rayFrom(quadOf(surface, from), attempt);
      if (!ray) continue;
      tree.visit([&](const Box &box) { return box.meetsRay(ray->from(), ray->direction()); },
                 [&](Index f) { ray->cross(quadOf(surface, f), f == from); });
      shell = {from, ray->layers(), ray->isClear()};
    }
    if (!shell.isKnown || shell.layers != 0) wrong.push_back(shell);
  }
  return wrong;
}

} // namespace dualblock
