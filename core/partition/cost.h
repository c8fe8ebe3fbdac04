// What is wrong with parts that are still to be cut, in one number.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// What cuts may do harm to, and what is left.
struct Cost {
  Index joints = 0; // corners of too many sides, sides unlike those behind them, and torn ones, by weight
  Index others = 0; // parts that are not simple for another reason

  Index sum() const { return joints + others; }
};

Cost costOf(const Parts<3> &parts);

} // namespace dualblock
