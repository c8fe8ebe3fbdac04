#include "parts/defects.h"

namespace dualblock {

std::string describe(Defect defect, int dimension) {
  switch (defect) {
  case Defect::none: return "";
  case Defect::tornSplit: return "a split surface is not one whole side of both its parts";
  case Defect::severalShells: return "its boundary is in several pieces";
  case Defect::closedSide: return dimension == 3 ? "a side is not a disc" : "a side is not a path";
  case Defect::severalCurves: return "two sides meet in more than one curve, or in a closed one";
  case Defect::crowdedCorner: return "more sides meet at a corner than there are dimensions";
  case Defect::kink: return "a curve turns sharply where only two sides meet";
  case Defect::noBall: return "it is not a ball";
  case Defect::fewSides: return "it has too few sides";
  case Defect::unlikeSides: return "a side has a corner that the side behind it lacks";
  }
  return "";
}

} // namespace dualblock
