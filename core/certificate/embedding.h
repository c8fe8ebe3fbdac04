// Whether a surface of bilinear quadrilaterals is embedded: no two faces cross, and no shell encloses what
// another one does.
//
// Why that matters. Blocks are positive, and neighbours are on opposite sides of their faces: so the map from
// the block complex to space is open and keeps the orientation, and over each point that is on no face lie as
// many blocks as its degree there says. The degree is the winding number of the boundary around the point. A
// boundary that does not cross itself, and has nothing outside and one layer inside of each of its shells,
// winds around every point once or not at all: no two blocks overlap.
#pragma once

#include "base/types.h"

namespace dualblock {

/// Faces by their nodes, counter-clockwise from outside.
struct QuadSurface {
  const std::vector<Vec<3>> &positions;
  std::vector<std::array<Index, 4>> faces;
};

/// Up to `most` pairs of faces that could not be shown not to cross. Faces that share a place may touch by
/// `margin` (in the units of the input); all others are further apart than it. Quadrilaterals are divided
/// until planes separate their hulls, six times at most.
std::vector<std::array<Index, 2>> crossingFaces(const QuadSurface &surface, double margin, std::size_t most);

/// A shell of a surface that winds wrongly: the space just outside of one of its faces is not free.
struct WrongShell {
  Index face;
  int layers;   // how often blocks cover what is just outside of it, where isKnown
  bool isKnown; // false: no ray could tell
};

/// The shells of a surface that does not cross itself, that lie where there is something already.
std::vector<WrongShell> wrongShells(const QuadSurface &surface);

} // namespace dualblock
