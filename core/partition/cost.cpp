#include "partition/cost.h"

#include "partition/heuristics.h"

namespace dualblock {

Cost costOf(const Parts<3> &parts) {
  Cost cost;
  for (const Corner &corner : parts.corners)
    if (corner.sides.size() > 3) cost.joints += kCrowdedWeight * toIndex(corner.sides.size() - 3);
  cost.joints += kUnlikeWeight * toIndex(unlikeCorners(parts).size());
  for (const PartInfo &part : parts.parts) {
    if (part.defect == Defect::tornSplit) cost.joints += kTornWeight;
    const bool isCounted = part.isSimple() || part.defect == Defect::tornSplit ||
                           part.defect == Defect::crowdedCorner || part.defect == Defect::unlikeSides;
    cost.others += isCounted ? 0 : 1;
  }
  return cost;
}

} // namespace dualblock
