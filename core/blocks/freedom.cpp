#include "blocks/freedom.h"

#include <limits>

#include "base/sort.h"

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
                    const std::vector<Vec<N>> &featureNodes, const BlockMesh<N> &blocks, bool holdsBent,
                    bool followsCreases)
    : patches_(patchesOfNodes(mesh, blocks)), fixed_(blocks.positions.size(), false),
      normals_(mesh.surfaces.size()), shape_(bentFacetsOf(mesh, features, featureNodes, true)) {
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) normals_[s] = mesh.surfaces[s].plane.normal;
  if (followsCreases) findCreases(blocks);
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

template <int N> void Freedom<N>::findCreases(const BlockMesh<N> &blocks) {
  constexpr double kNear =
      0.15; // of the shortest edge: the middles of faces beside a crease are further away
  std::vector<double> shortest(blocks.positions.size(), std::numeric_limits<double>::infinity());
  for (const auto &block : blocks.blocks)
    for (std::size_t a = 0; a < block.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const double length = glm::length(blocks.positions[at(block[a])] - blocks.positions[at(block[b])]);
        for (const Index v : {block[a], block[b]}) shortest[at(v)] = std::min(shortest[at(v)], length);
      }
  onCrease_.assign(blocks.positions.size(), false);
  for (Index v = 0; v < blocks.nodeCount(); ++v) {
    if (patches_.size(v) != 1) continue;
    const Index patch = *patches_.begin(v);
    const Vec<N> &x = blocks.positions[at(v)];
    if (shape_.hasCurve(patch, patch))
      onCrease_[at(v)] = glm::length(shape_.onCurve(patch, patch, x).point - x) < kNear * shortest[at(v)];
  }
}

template <int N> std::vector<Vec<N>> Freedom<N>::directions(Index node, const Vec<N> &x) const {
  if (fixed_[at(node)]) return {};
  const Index *const p = patches_.begin(node);
  // Of a curve between planes as well: they are fitted to their facets, and where two of them are nearly one,
  // the line in which they cross may lead away from the domain's own.
  if (patches_.size(node) == 2)
    if (const Vec<N> direction = shape_.onCurve(p[0], p[1], x).direction; direction != Vec<N>(0.0))
      return {direction};
  if (isOnCrease(node)) return {shape_.onCurve(p[0], p[0], x).direction};
  if (isBent(node)) {
    if (patches_.size(node) == 1) return complement<N>({shape_.onSide(p[0], x).direction});
    return {}; // where bent sides touch without a curve, or more than two meet, it stays
  }
  std::vector<Vec<N>> normals; // of an assembly's curve three patches or more may share one line
  for (Index k = 0; k < patches_.size(node); ++k) normals.push_back(normals_[at(p[k])]);
  return complement<N>(normals);
}

template <int N> Vec<N> Freedom<N>::project(Index node, const Vec<N> &x) const {
  const Index *const p = patches_.begin(node);
  if (!isBent(node)) return x;
  if (isOnCrease(node)) return shape_.onCurve(p[0], p[0], x).point;
  return patches_.size(node) == 1 ? shape_.onSide(p[0], x).point : shape_.onCurve(p[0], p[1], x).point;
}

template <int N> Index Freedom<N>::commonPatches(Index a, Index b) const {
  Index count = 0;
  for (const Index *p = patches_.begin(a); p != patches_.end(a); ++p)
    count += std::binary_search(patches_.begin(b), patches_.end(b), *p) ? 1 : 0;
  return count;
}

template <int N> bool Freedom<N>::isBent(Index node) const {
  return std::any_of(patches_.begin(node), patches_.end(node), [&](Index p) { return shape_.isBent(p); });
}

template class Freedom<2>;
template class Freedom<3>;

} // namespace dualblock
