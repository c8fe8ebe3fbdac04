#include "blocks/bent_shape.h"

#include <limits>
#include <tuple>

#include "base/sort.h"
#include "geometry/nearest.h"

namespace dualblock {

namespace {

/// Where facets of one bent side meet sharply: they are one by way of others.
std::vector<std::pair<std::array<Index, 2>, Segment<3>>> creasesOf(const BentFacets<3> &facets) {
  struct Ridge {
    Index patch;
    std::array<double, 6> ends;
    std::size_t face;
  };
  std::vector<Ridge> ridges;
  const auto less = [](const Vec<3> &a, const Vec<3> &b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  for (std::size_t f = 0; f < facets.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      Vec<3> a = facets.faces[f][k];
      Vec<3> b = facets.faces[f][(k + 1) % 3];
      if (less(b, a)) std::swap(a, b);
      ridges.push_back({facets.patchOfFace[f], {a.x, a.y, a.z, b.x, b.y, b.z}, f});
    }
  const auto key = [](const Ridge &r) { return std::tie(r.patch, r.ends); };
  sortItems(ridges, [&](const Ridge &a, const Ridge &b) {
    return key(a) != key(b) ? key(a) < key(b) : a.face < b.face;
  });
  std::vector<std::pair<std::array<Index, 2>, Segment<3>>> creases;
  const auto normalOf = [&](std::size_t f) {
    const auto &[a, b, c] = facets.faces[f];
    return glm::normalize(glm::cross(b - a, c - a));
  };
  for (std::size_t k = 1; k < ridges.size(); ++k) {
    const auto &[patch, e, face] = ridges[k];
    if (key(ridges[k - 1]) != key(ridges[k])) continue;
    if (glm::dot(normalOf(face), normalOf(ridges[k - 1].face)) > kCreaseCosine) continue;
    creases.push_back({{patch, patch}, {Vec<3>(e[0], e[1], e[2]), Vec<3>(e[3], e[4], e[5])}});
  }
  return creases;
}

} // namespace

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
    std::vector<std::pair<std::array<Index, 2>, Segment<N>>> segments;
    if (allCurves) segments = creasesOf(result);
    for (std::size_t c = 0; c < features.curves.size(); ++c) {
      std::array<Index, 2> patch;
      for (std::size_t k = 0; k < 2; ++k)
        patch[k] = mesh.sideKey(features.sides[at(features.curves[c].sides[k])].tag) / 2;
      if (!allCurves && !isBent[at(patch[0])] && !isBent[at(patch[1])]) continue;
      for (const auto &[a, b] : features.curves[c].ridges)
        segments.emplace_back(sortedPair(patch[0], patch[1]),
                              Segment<N>{featureNodes[at(a)], featureNodes[at(b)]});
    }
    sortItems(segments, [](const auto &a, const auto &b) { return a.first < b.first; });
    for (const auto &[patches, segment] : segments) {
      result.segments.push_back(segment);
      result.patchesOfSegment.push_back(patches);
    }
  }
  return result;
}

template <int N> BentShape<N>::BentShape(const BentFacets<N> &facets) {
  for (std::size_t f = 0; f < facets.faces.size(); ++f) {
    const std::size_t patch = at(facets.patchOfFace[f]);
    if (patch >= sides_.size()) sides_.resize(patch + 1);
    sides_[patch].faces.push_back(facets.faces[f]);
  }
  if constexpr (N == 3)
    for (Side &side : sides_) {
      std::vector<Box> boxes(side.faces.size());
      for (std::size_t f = 0; f < boxes.size(); ++f)
        for (const Vec<3> &x : side.faces[f]) boxes[f].add(x);
      if (!boxes.empty()) side.tree.emplace(boxes);
    }
  for (std::size_t s = 0; s < facets.segments.size(); ++s) {
    if (s == 0 || facets.patchesOfSegment[s] != curveKeys_.back()) {
      if (s > 0) curves_.closeList();
      curveKeys_.push_back(facets.patchesOfSegment[s]);
    }
    curves_.items.push_back(facets.segments[s]);
  }
  curves_.closeList();
}

template <int N> typename BentShape<N>::Nearest BentShape<N>::onSide(Index patch, const Vec<N> &x) const {
  Nearest best;
  if constexpr (N == 3) {
    const Side &side = sides_[at(patch)];
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    side.tree->nearest(x, least, [&](Index f) {
      const auto &[a, b, c] = side.faces[at(f)];
      const Vec<3> y = nearestOnTriangle(x, a, b, c);
      const double square = glm::dot(y - x, y - x);
      if (square < least) {
        least = square;
        best.point = y;
        nearest = at(f);
      }
      return square;
    });
    const auto &[a, b, c] = side.faces[nearest];
    best.direction = glm::normalize(glm::cross(b - a, c - a));
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
