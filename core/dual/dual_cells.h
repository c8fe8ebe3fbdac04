// D-bar-cells (paper 3.2; ARCHITECTURE.md 4): union-find over the regions of all simplices. Regions of one
// simplex join where no contribution separates them, regions of neighbours across their common face.
#pragma once

#include "contributions/contributions.h"

namespace dualblock {

/// The piece of a D-bar-cell inside one part: all of it lies inside the D-bar-surfaces of the same sides.
template <int N> struct CellPiece {
  Index part;
  std::array<Index, N> sides; // ascending, padded with kNone: the piece's label
  Index cell;                 // the D-bar-cell that it belongs to

  int sideCount() const {
    int n = 0;
    while (n < N && sides[at(n)] != kNone) ++n;
    return n;
  }
  /// The place of a side in the label, or -1.
  int slot(Index side) const {
    for (int k = 0; k < N; ++k)
      if (sides[at(k)] == side) return k;
    return -1;
  }
};

template <int N> struct DualCells {
  std::vector<Index> classOffset;   // per simplex, and one more: where its classes begin in pieceOf
  std::vector<Index> pieceOf;       // per (simplex, class of RegionTables): the cell piece
  std::vector<CellPiece<N>> pieces; // by part, then label; equal labels stand together
  std::vector<Index> partOffset;    // per part, and one more: where its pieces begin
  Index cellCount = 0;
  std::vector<Index> surplus; // pieces whose label an earlier piece has: bubbles, condition (b); if there are
                              // any, no cells are made
  bool overfull = false;      // a region lies inside more than N D-bar-surfaces of a part

  /// The piece with this label (ascending, padded), or kNone.
  Index findPiece(Index part, const std::array<Index, N> &sides) const;
};

/// D-bar-surfaces: sides that continue across split surfaces (ARCHITECTURE.md 3).
struct DualSurfaces {
  std::vector<Index> ofSide;
  Index count = 0;
};

template <int N>
DualCells<N> buildDualCells(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                            const Contributions<N> &contributions, const Earlier<DualCells<N>> &earlier = {});

/// Joins side P of part A and side P' of part B where they meet a split surface between A and B in the same
/// curve.
template <int N> DualSurfaces buildDualSurfaces(const Parts<N> &parts);

extern template struct DualCells<2>;
extern template struct DualCells<3>;
extern template DualCells<2> buildDualCells(const ReferenceMesh<2> &, const Parts<2> &,
                                            const Contributions<2> &, const Earlier<DualCells<2>> &);
extern template DualCells<3> buildDualCells(const ReferenceMesh<3> &, const Parts<3> &,
                                            const Contributions<3> &, const Earlier<DualCells<3>> &);
extern template DualSurfaces buildDualSurfaces<2>(const Parts<2> &);
extern template DualSurfaces buildDualSurfaces<3>(const Parts<3> &);

} // namespace dualblock
