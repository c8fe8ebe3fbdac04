// Relaxation: nodes move to where blocks have a better shape, and never to where one is not valid.
#pragma once

#include <functional>

#include "blocks/freedom.h"

namespace dualblock {

struct RelaxOptions {
  std::function<void()> onRound; // after every round that moved something, if wanted
  int sweeps = 12;               // over all nodes, at most
  int worstRounds = 30;          // over the nodes around the worst corners, at most
  double precision = 1e-3;       // of the shortest edge at a node: it does not go for less
  /// The share of the smallest scaled Jacobian that moves may go down to on the way: where two nodes have to
  /// move together, as the ends of an upright edge, the first one gets in the other's way.
  double dip = 1;
};

struct RelaxResult {
  int sweeps = 0;
  Index moves = 0;
};

/// Moves nodes one by one. First all of them, down a mean over the corners around each of the angles' and the
/// edges' distortion, which evens out sizes as well; then those around the worst corners, up the smallest
/// scaled Jacobian around each, which at last is nowhere below what was the smallest. A move is taken only if
/// every Bezier coefficient of the blocks around the node is clearly positive afterwards, or no worse than it
/// was. `isWanted`: per node, whether it may move; empty: all.
template <int N>
RelaxResult relax(const Freedom<N> &freedom, BlockMesh<N> &blocks, const RelaxOptions &options,
                  const std::vector<bool> &isWanted = {});

extern template RelaxResult relax(const Freedom<2> &, BlockMesh<2> &, const RelaxOptions &,
                                  const std::vector<bool> &);
extern template RelaxResult relax(const Freedom<3> &, BlockMesh<3> &, const RelaxOptions &,
                                  const std::vector<bool> &);

} // namespace dualblock
