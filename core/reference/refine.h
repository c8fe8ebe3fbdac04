// Refinement of a reference mesh by splitting edges: the same code in every dimension.
#pragma once

#include <functional>

#include "reference/cut.h"

namespace dualblock {

/// Splits edges longer than `length` at their midpoints, longest first, until none is left.
template <int N> void splitLongEdges(ReferenceMesh<N> &mesh, double length);

/// Splits about an eighth of the edges, at least four, each at a random point of its middle half. The
/// same seed gives the same mesh.
template <int N> void splitRandomEdges(ReferenceMesh<N> &mesh, std::uint32_t seed);

/// Splits the given edges (pairs of nodes, any order) at their midpoints.
template <int N> void splitEdges(ReferenceMesh<N> &mesh, std::vector<std::pair<Index, Index>> edges);

/// Prepares a cut along a surface with a field: splits edges that it crosses unseen, twice, where three
/// points between the ends show it, and those where a node put by linear interpolation would stand clearly
/// off it; several times over, as new edges appear. Only where the cut that begins at the `seeds`, asked for
/// anew each time, would come. `sagitta` above 0: also the longest edges of simplices that the cut would go
/// straight through where the zero set is bent by more than this share of a chord's length. That takes many
/// more nodes, and helps where a later cut has to cross this one once.
template <int N>
void resolve(ReferenceMesh<N> &mesh, const Surface<N> &surface,
             const std::function<std::vector<CutSeed<N>>()> &seeds, double tolerance, double sagitta);

extern template void resolve(ReferenceMesh<3> &, const Surface<3> &,
                             const std::function<std::vector<CutSeed<3>>()> &, double, double);

} // namespace dualblock
