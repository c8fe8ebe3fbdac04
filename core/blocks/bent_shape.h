// The bent sides of a domain as points are put onto them: their facets, and the curves between them.
#pragma once

#include <optional>

#include "base/box_tree.h"
#include "parts/parts.h"

namespace dualblock {

/// The facets of bent sides and the segments of the curves that bound them, with the patches (half of
/// ReferenceMesh::sideKey) that they belong to. Empty in 2D, where every side is straight.
template <int N> struct BentFacets {
  std::vector<std::array<Vec<N>, N>>
      faces; // counter-clockwise from outside, or from one side of an interface
  std::vector<Index> patchOfFace;
  std::vector<Segment<N>> segments;
  std::vector<std::array<Index, 2>> patchesOfSegment; // ascending; one of them is bent
};

/// Cosine between normals of facets of one bent side that meet sharply, in a crease: 50 degrees, well over
/// what the coarsest tessellation turns by from one facet to the next.
inline constexpr double kCreaseCosine = 0.64;

/// `features`: of the uncut mesh, whose nodes are `featureNodes`. `allCurves`: those between planes as well,
/// and creases, as curves between a side and itself.
template <int N>
BentFacets<N> bentFacetsOf(const ReferenceMesh<N> &mesh, const Parts<N> &features,
                           const std::vector<Vec<N>> &featureNodes, bool allCurves = false);

/// The same, arranged for finding what is next to a point.
template <int N> class BentShape {
public:
  struct Nearest {
    Vec<N> point{0.0};
    Vec<N> direction{0.0}; // normal of the facet, or direction of the segment
  };

  explicit BentShape(const BentFacets<N> &facets);

  bool isBent(Index patch) const { return at(patch) < sides_.size() && !sides_[at(patch)].faces.empty(); }
  /// Of a bent patch's facets.
  Nearest onSide(Index patch, const Vec<N> &x) const;
  /// Of the curve between two patches; x itself, without a direction, where there is none.
  Nearest onCurve(Index a, Index b, const Vec<N> &x) const;
  bool hasCurve(Index a, Index b) const;
  /// The point next to x on what lies on all these patches: their curve, or the one bent side. x itself where
  /// they are plane, and where sides only touch, so that nothing says where it should be.
  Vec<N> project(const Index *first, const Index *last, const Vec<N> &x) const;

private:
  struct Side {
    std::vector<std::array<Vec<N>, N>> faces;
    std::optional<BoxTree> tree;
  };

  std::vector<Side> sides_;                     // per patch; without faces where it is plane
  std::vector<std::array<Index, 2>> curveKeys_; // patches of each curve, ascending
  Lists<Segment<N>> curves_;                    // the segments of each
};

extern template BentFacets<2> bentFacetsOf(const ReferenceMesh<2> &, const Parts<2> &,
                                           const std::vector<Vec<2>> &, bool);
extern template BentFacets<3> bentFacetsOf(const ReferenceMesh<3> &, const Parts<3> &,
                                           const std::vector<Vec<3>> &, bool);
extern template class BentShape<2>;
extern template class BentShape<3>;

} // namespace dualblock
