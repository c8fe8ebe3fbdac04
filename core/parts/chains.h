// Curves as chains of nodes: the pieces that two sides meet in, each open or closed. Internal to parts/.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// A connected piece of a curve: nodes in a row; a closed one does not repeat its first node.
struct Chain {
  std::vector<Index> nodes;
  bool closed;
};

/// The pieces of a curve, in the order of their lowest nodes. A branched curve gives one chain per branch.
std::vector<Chain> chainsOf(const Curve<3> &curve);

/// The chain's segments, the closing one included.
std::vector<Segment<3>> segmentsOf(const Chain &chain, const std::vector<Vec<3>> &nodes);

/// The line around which a chain turns: of a circle its axis; of another closed chain its centre and the
/// direction of its vector area; of an open one the axis of the circle through its ends and its middle node.
/// Nothing for a straight chain.
struct Axis {
  Vec<3> centre;
  Vec<3> direction; // unit length
};
bool axisOf(const Chain &chain, const std::vector<Vec<3>> &nodes, Axis &axis);

/// The nodes of a chain on the side of an axis that `towards` points to.
std::vector<Index> halfOf(const Chain &chain, const std::vector<Vec<3>> &nodes, const Axis &axis,
                          const Vec<3> &towards);

/// The axes of all curves that turn.
std::vector<Axis> axesOf(const Parts<3> &parts, const std::vector<Vec<3>> &nodes);

/// The one of the known axes that a chain's `axis` is meant to be, or null: cuts have put nodes beside the
/// circle.
const Axis *knownAxis(const std::vector<Axis> &known, const Chain &chain, const std::vector<Vec<3>> &nodes,
                      const Axis &axis);

/// The axis of a chain, by the known one where there is such a one.
bool axisOf(const Chain &chain, const std::vector<Vec<3>> &nodes, const std::vector<Axis> &known, Axis &axis);

} // namespace dualblock
