// How many intervals the edges of a block mesh are divided into, and where. All edges that one D-bar-surface
// crosses are divided alike, so that the refinement is conformal (ARCHITECTURE.md 9).
#pragma once

#include "base/error.h"
#include "blocks/skeleton.h"

namespace dualblock {

/// Elements become larger by the factor `growth` (over 1) from one to the next, away from a facet's side.
struct Grading {
  Index facet;
  double growth;
};

struct RefineOptions {
  Index intervals = 1; // on every edge
  double size = 0;     // over 0: as many intervals as keep elements no longer than this, instead
  std::vector<std::array<Index, 2>> ofSurface; // D-bar-surface, and the intervals of the edges it crosses
  std::vector<Grading> gradings;
  double elementLimit = 2e7; // more are refused
};

struct Spacing {
  std::vector<Index> intervals; // per D-bar-surface; 0 for one that is not in the mesh
  Lists<double> places;         // per D-bar-surface: from 0 to 1 along its edges, one more than its intervals
  std::vector<bool> isReversed; // per edge: from its higher node to its lower one, as its surface runs

  /// Where node k of an edge is, counted from the edge's lower node.
  double placeOf(Index edge, Index surface, Index k) const {
    const double *const p = places.begin(surface);
    return isReversed[at(edge)] ? 1 - p[places.size(surface) - 1 - k] : p[k];
  }
};

/// Errors (badOption) name a D-bar-surface or a facet that does not exist, or a count or factor that cannot
/// be.
template <int N>
Result<Spacing> spacingOf(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton,
                          const std::vector<Index> &patchOfSurface, const RefineOptions &options);

extern template Result<Spacing> spacingOf(const BlockMesh<2> &, const Skeleton<2> &,
                                          const std::vector<Index> &, const RefineOptions &);
extern template Result<Spacing> spacingOf(const BlockMesh<3> &, const Skeleton<3> &,
                                          const std::vector<Index> &, const RefineOptions &);

} // namespace dualblock
