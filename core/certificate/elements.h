// The certificate of a refined mesh: of the elements that are handed out, not of the blocks they come from.
// Nothing here is shared with refinement but data types.
#pragma once

#include "blocks/bent_shape.h"
#include "certificate/certificate.h"
#include "refinement/refine_blocks.h"

namespace dualblock {

template <int N> struct ElementInput {
  const RefinedMesh<N> &refined;
  const BlockMesh<N> &blocks; // that it came from, certified
  const std::vector<Index> &patchOfSurface;
  const BentFacets<N> &bent;
  double domainMeasure; // 0: not known
  bool mayStayStraight; // elements of blocks that stay straight beside a bent side, and what is next to them,
                        // may leave it as far as they do
};

/// Checks 3 to 5 of the elements: faces fit together on opposite sides and make the boundary that is handed
/// out; all are positive, and add up to the blocks where nothing bends; where sides bend the boundary is
/// embedded and stays near them. Failures name elements.
template <int N> Certificate certifyElements(const ElementInput<N> &input);

extern template Certificate certifyElements(const ElementInput<2> &);
extern template Certificate certifyElements(const ElementInput<3> &);

} // namespace dualblock
