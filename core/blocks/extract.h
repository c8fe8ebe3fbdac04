// Extraction of a D-bar-surface: the layer of blocks that it crosses collapses, so that two sides of the
// layer become one (ARCHITECTURE.md 8).
#pragma once

#include "blocks/freedom.h"

namespace dualblock {

/// What came of it: a mesh without the layer, or why there is none.
template <int N> struct Extraction {
  BlockMesh<N> blocks;
  std::vector<bool> isNear; // per node: it was on the layer, or shares a block with one that was
  std::string why;          // empty where it worked
};

/// Collapses the layer of `surface`. Refused where that would lose a feature: nodes go together only if one
/// of them lies on no patch but those that the edge between them lies on. Refused as well where the surface
/// crosses or touches itself, and where a block would have a node twice. Shapes are not looked at: nodes are
/// put where the node on more patches was, else halfway.
template <int N>
Extraction<N> extract(const ReferenceMesh<N> &mesh, const Freedom<N> &freedom, const BlockMesh<N> &blocks,
                      Index surface);

extern template Extraction<2> extract(const ReferenceMesh<2> &, const Freedom<2> &, const BlockMesh<2> &,
                                      Index);
extern template Extraction<3> extract(const ReferenceMesh<3> &, const Freedom<3> &, const BlockMesh<3> &,
                                      Index);

} // namespace dualblock
