// What keeps a part from being simple (condition (c) of ARCHITECTURE.md 2), in the order in which they are
// looked for: a part is named by the first.
#pragma once

#include <cstdint>
#include <string>

namespace dualblock {

enum class Defect : std::uint8_t {
  none,
  tornSplit,     // a side on a split surface is not one whole side of both its parts
  severalShells, // the boundary is in several pieces
  closedSide,    // a side is not a disc
  severalCurves, // two sides meet in more than one curve, or in a closed one
  crowdedCorner, // more than N sides meet
  kink,          // a curve turns sharply between two sides
  noBall,
  fewSides,
  unlikeSides // a split side has a corner that the side behind it lacks
};

/// In words, as the end of a sentence about the part.
std::string describe(Defect defect, int dimension);

} // namespace dualblock
