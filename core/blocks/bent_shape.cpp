#include "blocks/bent_shape.h"

#include <limits>

#include <glm/common.hpp>

#include "base/sort.h"
#include "geometry/nearest.h"

namespace dualblock {

template <int N>
BentFacets<N> bentFacetsOf(const ReferenceMesh<N> &mesh, const Parts<N> &features,
                           const std::vector<Vec<N>> &featureNodes, bool allCurves) {
  BentFacets<N> result;
  if constexpr (N == 3) {
    std::vector<bool> isBent(mesh.surfaces.size(), false);
    for (Index s = 0; s < mesh.simplexCount(); ++s)
      for (int i = 0; i < 4; ++i) {
        const Index tag = mesh.tags[at(s)][i];
        if (tag == kNone || (mesh.neighbors[at(s)][i] != kNone && mesh.neighbors[at(s)][i] < s)) continue;
        const Surface<N> &surface = mesh.surfaces[at(FaceTag::surface(tag))];
        if (surface.kind != SurfaceKind::facet || !surface.bent) continue;
        auto &face = result.faces.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) face[k] = mesh.nodes[at(mesh.sortedFace(s, i)[k])];
        const Vec<3> normal = glm::cross(face[1] - face[0], face[2] - face[0]);
        if ((glm::dot(normal, mesh.faceNormal(s, i)) < 0) != FaceTag::isFront(tag))
          std::swap(face[1], face[2]);
        result.patchOfFace.push_back(mesh.sideKey(tag) / 2);
        isBent[at(result.patchOfFace.back())] = true;
      }
    std::vector<std::pair<std::array<Index, 2>, std::size_t>> order;
    for (std::size_t c = 0; c < features.curves.size(); ++c) {
      std::array<Index, 2> patch;
      for (std::size_t k = 0; k < 2; ++k)
        patch[k] = mesh.sideKey(features.sides[at(features.curves[c].sides[k])].tag) / 2;
      if (allCurves || isBent[at(patch[0])] || isBent[at(patch[1])])
        order.emplace_back(sortedPair(patch[0], patch[1]), c);
    }
    sortItems(order);
    for (const auto &[patches, c] : order)
      for (const auto &[a, b] : features.curves[c].ridges) {
        result.segments.push_back({featureNodes[at(a)], featureNodes[at(b)]});
        result.patchesOfSegment.push_back(patches);
      }
  }
  return result;
}

template <int N> BentShape<N>::BentShape(const BentFacets<N> &facets) {
  for (std::size_t f = 0; f < facets.faces.size(); ++f) {
    const std::size_t patch = at(facets.patchOfFace[f]);
    if (patch >= sides_.size()) sides_.resize(patch + 1);
    sides_[patch].faces.push_back({0, facets.faces[f]});
  }
  for (Side &side : sides_) sortAlong(side);
  for (std::size_t s = 0; s < facets.segments.size(); ++s) {
    if (s == 0 || facets.patchesOfSegment[s] != curveKeys_.back()) {
      if (s > 0) curves_.closeList();
      curveKeys_.push_back(facets.patchesOfSegment[s]);
    }
    curves_.items.push_back(facets.segments[s]);
  }
  curves_.closeList();
}

template <int N> void BentShape<N>::sortAlong(Side &side) {
  if (side.faces.empty()) return;
  const double infinity = std::numeric_limits<double>::infinity();
  Vec<N> low{infinity};
  Vec<N> high{-infinity};
  for (const FaceAlong &f : side.faces)
    for (const Vec<N> &x : f.face) {
      low = glm::min(low, x);
      high = glm::max(high, x);
    }
  for (int k = 1; k < N; ++k)
    if (high[k] - low[k] > high[side.axis] - low[side.axis]) side.axis = k;
  for (FaceAlong &f : side.faces) {
    double first = infinity;
    double last = -infinity;
    for (const Vec<N> &x : f.face) {
      first = std::min(first, x[side.axis]);
      last = std::max(last, x[side.axis]);
    }
    f.middle = (first + last) / 2;
    side.reach = std::max(side.reach, (last - first) / 2);
  }
  sortItems(side.faces, [](const FaceAlong &a, const FaceAlong &b) { return a.middle < b.middle; });
}

template <int N> typename BentShape<N>::Nearest BentShape<N>::onSide(Index patch, const Vec<N> &x) const {
  Nearest best;
  if constexpr (N == 3) {
    // From where x is along the side outwards, as far as something nearer may be.
    const Side &side = sides_[at(patch)];
    const double along = x[side.axis];
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](const FaceAlong &f) {
      const Vec<3> y = nearestOnTriangle(x, f.face[0], f.face[1], f.face[2]);
      if (glm::length(y - x) >= least) return;
      least = glm::length(y - x);
      best = {y, glm::normalize(glm::cross(f.face[1] - f.face[0], f.face[2] - f.face[0]))};
    };
    const auto start = std::lower_bound(side.faces.begin(), side.faces.end(), along,
                                        [](const FaceAlong &f, double value) { return f.middle < value; });
    for (auto f = start; f != side.faces.end() && f->middle - along - side.reach < least; ++f) look(*f);
    for (auto f = start; f != side.faces.begin() && along - (f - 1)->middle - side.reach < least; --f)
      look(*(f - 1));
  }
  return best;
}

template <int N> bool BentShape<N>::hasCurve(Index a, Index b) const {
  return std::binary_search(curveKeys_.begin(), curveKeys_.end(), sortedPair(a, b));
}

template <int N>
typename BentShape<N>::Nearest BentShape<N>::onCurve(Index a, Index b, const Vec<N> &x) const {
  const auto found = std::lower_bound(curveKeys_.begin(), curveKeys_.end(), sortedPair(a, b));
  Nearest best{x, Vec<N>(0.0)};
  if (found == curveKeys_.end() || *found != sortedPair(a, b)) return best;
  double least = std::numeric_limits<double>::infinity();
  const Index curve = toIndex(static_cast<std::size_t>(found - curveKeys_.begin()));
  for (const Segment<N> *s = curves_.begin(curve); s != curves_.end(curve); ++s) {
    const Vec<N> y = nearestOnSegment<N>(x, (*s)[0], (*s)[1]);
    if (glm::length(y - x) >= least || (*s)[0] == (*s)[1]) continue;
    least = glm::length(y - x);
    best = {y, glm::normalize((*s)[1] - (*s)[0])};
  }
  return best;
}

template <int N> Vec<N> BentShape<N>::project(const Index *first, const Index *last, const Vec<N> &x) const {
  for (const Index *a = first; a != last; ++a)
    for (const Index *b = a + 1; b != last; ++b)
      if (hasCurve(*a, *b)) return onCurve(*a, *b, x).point;
  return last - first == 1 && isBent(*first) ? onSide(*first, x).point : x;
}

template BentFacets<2> bentFacetsOf(const ReferenceMesh<2> &, const Parts<2> &, const std::vector<Vec<2>> &,
                                    bool);
template BentFacets<3> bentFacetsOf(const ReferenceMesh<3> &, const Parts<3> &, const std::vector<Vec<3>> &,
                                    bool);
template class BentShape<2>;
template class BentShape<3>;

} // namespace dualblock
