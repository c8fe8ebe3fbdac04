// TetGen behind a function that returns: flat arrays in and out, errors as values.
#pragma once

#include <string>

#include "base/error.h"
#include "domain/domain.h"

namespace dualblock {

/// What TetGen makes of a piecewise linear complex.
struct Tetrahedra {
  std::vector<Vec<3>> nodes; // the input's vertices first, in their order
  std::vector<std::array<Index, 4>> simplices;
  std::vector<std::array<Index, 4>> neighbors; // across the face opposite to vertex i
  std::vector<std::array<Index, 3>> faces;     // on the facets
  std::vector<Index> faceFacet;
  std::vector<std::array<Index, 2>> faceSimplices; // the first one has the face
  std::string remedy;      // empty, or how the input had to be changed slightly for TetGen to succeed
  double milliseconds = 0; // spent inside TetGen
};

struct TetgenOptions {
  double size;          // of the domain, for the remedies' scales
  double maxVolume = 0; // > 0: refine until every tetrahedron is at most this large
  bool onGrid = true;   // decide by plain arithmetic where it is exact; off: TetGen as it is, to compare with
};

/// Fills what the facets enclose. TetGen 1.5 fails on about 2 % of valid domains whose facets are planar only
/// up to rounding; the call is then repeated with a wider tolerance, with coordinates snapped to a grid of
/// 2^-30 of the size, and with a shift of 1e-9 of the size, each of which leaves the result's coordinates
/// at the original ones. Errors: tetgenFailed, selfIntersection, outOfMemory;
/// they name a facet that TetGen found the outside on both sides of.
Result<Tetrahedra> runTetgen(const std::vector<Vec<3>> &vertices, const std::vector<Facet> &facets,
                             const TetgenOptions &options);

} // namespace dualblock
