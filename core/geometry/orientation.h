// Which way round blocks are (ARCHITECTURE.md 5).
#pragma once

#include "primal/primal.h"

namespace dualblock {

/// Exchanges two axes of blocks so that all that hang together by faces are turned alike, with neighbours on
/// opposite sides of the face they share, and hold a positive area or volume in all. A block by itself may
/// then be inverted: that is what tells a folded mesh from one that is merely numbered the other way round.
template <int N> void orientBlocks(Primal<N> &primal);

extern template void orientBlocks(Primal<2> &);
extern template void orientBlocks(Primal<3> &);

} // namespace dualblock
