// Where a node of a block mesh may go: corners of the domain stay, nodes of curves slide along them, nodes of
// facets and bent sides within those, all others move freely (ARCHITECTURE.md 5).
#pragma once

#include "blocks/bent_shape.h"
#include "blocks/block_mesh.h"

namespace dualblock {

template <int N> class Freedom {
public:
  /// `features`: of the uncut mesh, whose nodes are `featureNodes`. `holdsBent`: nodes of bent sides stay, as
  /// where every facet of one has block faces of its own, which then hold its volume exactly.
  /// `followsCreases`: nodes next to a crease of a bent side are on it, and stay there.
  Freedom(const ReferenceMesh<N> &mesh, const Parts<N> &features, const std::vector<Vec<N>> &featureNodes,
          const BlockMesh<N> &blocks, bool holdsBent = false, bool followsCreases = false);

  /// Orthonormal directions in which the node may go from x: none for a fixed one, N for a free one.
  std::vector<Vec<N>> directions(Index node, const Vec<N> &x) const;

  /// The place next to x on what the node lies on: x itself where that is plane or straight.
  Vec<N> project(Index node, const Vec<N> &x) const;

  bool isFixed(Index node) const { return fixed_[at(node)]; }
  Index patchCount(Index node) const { return patches_.size(node); }
  Index commonPatches(Index a, Index b) const;
  bool isOnCrease(Index node) const { return !onCrease_.empty() && onCrease_[at(node)]; }
  /// Whether it lies on a bent side.
  bool isBent(Index node) const;

private:
  void findCreases(const BlockMesh<N> &blocks);

  Lists<Index> patches_;
  std::vector<bool> fixed_;
  std::vector<bool> onCrease_;  // empty: none is
  std::vector<Vec<N>> normals_; // per patch, of its plane
  BentShape<N> shape_;
};

extern template class Freedom<2>;
extern template class Freedom<3>;

} // namespace dualblock
