// Which contributions each simplex gets (ARCHITECTURE.md 2): in simplex T, side P has the contribution of the
// set of T's vertices that lie on P. That one rule is all three steps of the paper's Algorithm 2.
#pragma once

#include "contributions/region_tables.h"
#include "parts/parts.h"

namespace dualblock {

/// One side's piece of its D-bar-surface in one simplex.
struct Contribution {
  Index side;
  std::uint8_t mask; // of the simplex's vertices on the side
};

/// Where condition (a) fails: all nodes of an edge, triangle or whole simplex lie on a side that it is not
/// in.
struct NotFull {
  Index simplex;
  Contribution contribution;
};

/// Which edges of the mesh are part of which sides.
class SideEdges {
public:
  /// wanted: per side, whether its edges are asked for.
  template <int N>
  SideEdges(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const std::vector<bool> &wanted);
  bool has(Index side, Index a, Index b) const;

private:
  std::vector<std::array<Index, 3>> edges_; // side and nodes, ascending
};

template <int N> struct Contributions {
  Lists<Contribution> ofSimplex;        // per simplex, by side
  std::vector<ContributionSet> present; // per simplex: the masks that occur
  std::vector<ContributionSet> soft;    // those used by two or more sides: crossing them gives no primal edge
  std::vector<NotFull> notFull;         // empty, or the result is not to be used
  Index hardCount = 0;                  // (simplex, mask) pairs
  Index softCount = 0;
};

template <int N>
Contributions<N> assignContributions(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                                     const Earlier<Contributions<N>> &earlier = {});

extern template Contributions<2> assignContributions(const ReferenceMesh<2> &, const Parts<2> &,
                                                     const Earlier<Contributions<2>> &);
extern template Contributions<3> assignContributions(const ReferenceMesh<3> &, const Parts<3> &,
                                                     const Earlier<Contributions<3>> &);

} // namespace dualblock
