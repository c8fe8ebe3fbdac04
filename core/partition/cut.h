// A cut that could be made.
#pragma once

#include <vector>

#include "reference/reference_mesh.h"

namespace dualblock {

struct Cut {
  Surface<3> surface;
  std::vector<Index> from; // nodes that it spreads from; none: from anywhere in its part
};

inline Surface<3> planeSurface(const Vec<3> &point, const Vec<3> &normal) {
  return {SurfaceKind::bentCut, kNone, planeThrough(point, normal)};
}

} // namespace dualblock
