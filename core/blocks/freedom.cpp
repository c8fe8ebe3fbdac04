#include "blocks/freedom.h"

#include <limits>

#include <glm/common.hpp>

#include "base/sort.h"
#include "geometry/nearest.h"

namespace dualblock {
namespace {

/// An orthonormal basis of what is perpendicular to all of the given unit vectors.
template <int N> std::vector<Vec<N>> complement(const std::vector<Vec<N>> &normals) {
  constexpr double kSame = 1e-5; // sine of an angle between planes that count as one
  std::vector<Vec<N>> basis;
  const auto rest = [&](Vec<N> v) {
    for (const Vec<N> &b : basis) v -= glm::dot(v, b) * b;
    return v;
  };
  for (const Vec<N> &n : normals)
    if (const Vec<N> v = rest(n); glm::length(v) > kSame) basis.push_back(glm::normalize(v));
  std::vector<Vec<N>> added;
  while (basis.size() < N) {
    Vec<N> best{0.0};
    for (int k = 0; k < N; ++k) {
      Vec<N> unit{0.0};
      unit[k] = 1;
      if (const Vec<N> v = rest(unit); glm::length(v) > glm::length(best) + 1e-9) best = v;
    }
    basis.push_back(glm::normalize(best));
    added.push_back(basis.back());
  }
  return added;
}

template <int N> std::array<double, N> coordinates(const Vec<N> &x) {
  std::array<double, N> c;
  for (int k = 0; k < N; ++k) c[at(k)] = x[k];
  return c;
}

} // namespace

template <int N>
Freedom<N>::Freedom(const ReferenceMesh<N> &mesh, const Parts<N> &features,
                    const std::vector<Vec<N>> &featureNodes, const BlockMesh<N> &blocks, bool holdsBent)
    : patches_(patchesOfNodes(mesh, blocks)), fixed_(blocks.positions.size(), false),
      normals_(mesh.surfaces.size()), bent_(mesh.surfaces.size()) {
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) normals_[s] = mesh.surfaces[s].plane.normal;
  if constexpr (N == 3) {
    for (Index s = 0; s < mesh.simplexCount(); ++s)
      for (int i = 0; i < 4; ++i) {
        const Index tag = mesh.tags[at(s)][i];
        if (tag == kNone || (mesh.neighbors[at(s)][i] != kNone && mesh.neighbors[at(s)][i] < s)) continue;
        const Surface<N> &surface = mesh.surfaces[at(FaceTag::surface(tag))];
        if (surface.kind != SurfaceKind::facet || !surface.bent) continue;
        Face face;
        for (std::size_t k = 0; k < 3; ++k) face[k] = mesh.nodes[at(mesh.sortedFace(s, i)[k])];
        bent_[at(mesh.sideKey(tag) / 2)].faces.push_back({0, face});
      }
    for (Patch &patch : bent_) sortAlong(patch);
    std::vector<std::pair<std::array<Index, 2>, std::size_t>> order;
    for (std::size_t c = 0; c < features.curves.size(); ++c) {
      std::array<Index, 2> patch;
      for (std::size_t k = 0; k < 2; ++k)
        patch[k] = mesh.sideKey(features.sides[at(features.curves[c].sides[k])].tag) / 2;
      if (hasFaces(patch[0]) || hasFaces(patch[1])) order.emplace_back(sortedPair(patch[0], patch[1]), c);
    }
    sortItems(order);
    for (const auto &[patches, c] : order) {
      if (curveKeys_.empty() || curveKeys_.back() != patches) {
        curveKeys_.push_back(patches);
        curves_.emplace_back();
      }
      for (const auto &[a, b] : features.curves[c].ridges)
        curves_.back().push_back({featureNodes[at(a)], featureNodes[at(b)]});
    }
  }
  std::vector<std::array<double, N>> corners;
  for (const Corner &corner : features.corners)
    corners.push_back(coordinates<N>(featureNodes[at(corner.node)]));
  sortItems(corners);
  for (Index v = 0; v < blocks.nodeCount(); ++v) {
    const Vec<N> &x = blocks.positions[at(v)];
    if (patches_.size(v) == 0) continue;
    fixed_[at(v)] = std::binary_search(corners.begin(), corners.end(), coordinates<N>(x));
    if (holdsBent && isBent(v)) fixed_[at(v)] = true;
    if (!fixed_[at(v)]) fixed_[at(v)] = directions(v, x).empty();
  }
}

template <int N> void Freedom<N>::sortAlong(Patch &patch) {
  if (patch.faces.empty()) return;
  const double infinity = std::numeric_limits<double>::infinity();
  Vec<N> low{infinity};
  Vec<N> high{-infinity};
  for (const FaceAlong &f : patch.faces)
    for (const Vec<N> &x : f.face) {
      low = glm::min(low, x);
      high = glm::max(high, x);
    }
  for (int k = 1; k < N; ++k)
    if (high[k] - low[k] > high[patch.axis] - low[patch.axis]) patch.axis = k;
  for (FaceAlong &f : patch.faces) {
    double first = infinity;
    double last = -infinity;
    for (const Vec<N> &x : f.face) {
      first = std::min(first, x[patch.axis]);
      last = std::max(last, x[patch.axis]);
    }
    f.middle = (first + last) / 2;
    patch.reach = std::max(patch.reach, (last - first) / 2);
  }
  sortItems(patch.faces, [](const FaceAlong &a, const FaceAlong &b) { return a.middle < b.middle; });
}

template <int N> typename Freedom<N>::Nearest Freedom<N>::onSide(Index patch, const Vec<N> &x) const {
  Nearest best;
  if constexpr (N == 3) {
    // From where x is along the patch outwards, as far as something nearer may be.
    const Patch &bent = bent_[at(patch)];
    const double along = x[bent.axis];
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](const FaceAlong &f) {
      const Vec<3> y = nearestOnTriangle(x, f.face[0], f.face[1], f.face[2]);
      if (glm::length(y - x) >= least) return;
      least = glm::length(y - x);
      best = {y, glm::normalize(glm::cross(f.face[1] - f.face[0], f.face[2] - f.face[0]))};
    };
    const auto start = std::lower_bound(bent.faces.begin(), bent.faces.end(), along,
                                        [](const FaceAlong &f, double value) { return f.middle < value; });
    for (auto f = start; f != bent.faces.end() && f->middle - along - bent.reach < least; ++f) look(*f);
    for (auto f = start; f != bent.faces.begin() && along - (f - 1)->middle - bent.reach < least; --f)
      look(*(f - 1));
  }
  return best;
}

template <int N> typename Freedom<N>::Nearest Freedom<N>::onCurve(Index a, Index b, const Vec<N> &x) const {
  const auto found = std::lower_bound(curveKeys_.begin(), curveKeys_.end(), sortedPair(a, b));
  Nearest best{x, Vec<N>(0.0)};
  if (found == curveKeys_.end() || *found != sortedPair(a, b)) return best;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment<N> &s : curves_[static_cast<std::size_t>(found - curveKeys_.begin())]) {
    const Vec<N> y = nearestOnSegment<N>(x, s[0], s[1]);
    if (glm::length(y - x) >= least || s[0] == s[1]) continue;
    least = glm::length(y - x);
    best = {y, glm::normalize(s[1] - s[0])};
  }
  return best;
}

template <int N> std::vector<Vec<N>> Freedom<N>::directions(Index node, const Vec<N> &x) const {
  if (fixed_[at(node)]) return {};
  const Index *const p = patches_.begin(node);
  if (isBent(node)) {
    if (patches_.size(node) == 1) return complement<N>({onSide(p[0], x).direction});
    if (patches_.size(node) > 2) return {};
    const Vec<N> direction = onCurve(p[0], p[1], x).direction;
    if (direction == Vec<N>(0.0)) return {}; // no curve: where bent sides touch, it stays
    return {direction};
  }
  std::vector<Vec<N>> normals; // of an assembly's curve three patches or more may share one line
  for (Index k = 0; k < patches_.size(node); ++k) normals.push_back(normals_[at(p[k])]);
  return complement<N>(normals);
}

template <int N> Vec<N> Freedom<N>::project(Index node, const Vec<N> &x) const {
  const Index *const p = patches_.begin(node);
  if (!isBent(node)) return x;
  return patches_.size(node) == 1 ? onSide(p[0], x).point : onCurve(p[0], p[1], x).point;
}

template <int N> Index Freedom<N>::commonPatches(Index a, Index b) const {
  Index count = 0;
  for (const Index *p = patches_.begin(a); p != patches_.end(a); ++p)
    count += std::binary_search(patches_.begin(b), patches_.end(b), *p) ? 1 : 0;
  return count;
}

template <int N> bool Freedom<N>::isBent(Index node) const {
  return std::any_of(patches_.begin(node), patches_.end(node), [&](Index p) { return hasFaces(p); });
}

template class Freedom<2>;
template class Freedom<3>;

} // namespace dualblock
