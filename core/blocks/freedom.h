// Where a node of a block mesh may go: corners of the domain stay, nodes of curves slide along them, nodes of
// facets and bent sides within those, all others move freely (ARCHITECTURE.md 5).
#pragma once

#include "blocks/block_mesh.h"

namespace dualblock {

template <int N> class Freedom {
public:
  /// `features`: of the uncut mesh, whose nodes are `featureNodes`. `holdsBent`: nodes of bent sides stay, as
  /// where every facet of one has block faces of its own, which then hold its volume exactly.
  Freedom(const ReferenceMesh<N> &mesh, const Parts<N> &features, const std::vector<Vec<N>> &featureNodes,
          const BlockMesh<N> &blocks, bool holdsBent = false);

  /// Orthonormal directions in which the node may go from x: none for a fixed one, N for a free one.
  std::vector<Vec<N>> directions(Index node, const Vec<N> &x) const;

  /// The place next to x on what the node lies on: x itself where that is plane or straight.
  Vec<N> project(Index node, const Vec<N> &x) const;

  bool isFixed(Index node) const { return fixed_[at(node)]; }
  Index patchCount(Index node) const { return patches_.size(node); }
  Index commonPatches(Index a, Index b) const;
  /// Whether it lies on a bent side.
  bool isBent(Index node) const;

private:
  using Face = std::array<Vec<N>, N>;
  struct Nearest {
    Vec<N> point{0.0};
    Vec<N> direction{0.0}; // normal of the face, or direction of the segment
  };
  struct Patch;
  static void sortAlong(Patch &patch);
  Nearest onSide(Index patch, const Vec<N> &x) const;
  Nearest onCurve(Index a, Index b, const Vec<N> &x) const;
  bool hasFaces(Index patch) const { return !bent_[at(patch)].faces.empty(); }

  Lists<Index> patches_;
  std::vector<bool> fixed_;
  std::vector<Vec<N>> normals_; // per patch, of its plane
  struct FaceAlong {
    double middle; // along the patch's longest extent
    Face face;
  };
  struct Patch {                  // of a bent side
    std::vector<FaceAlong> faces; // sorted
    int axis = 0;
    double reach = 0; // from a face's middle to its ends, at most
  };
  std::vector<Patch> bent_;                     // per patch; without faces where it is plane
  std::vector<std::array<Index, 2>> curveKeys_; // patches of each curve with a bent side, ascending
  std::vector<std::vector<Segment<N>>> curves_; // the segments of each
};

extern template class Freedom<2>;
extern template class Freedom<3>;

} // namespace dualblock
