// Coplanar neighbours become one facet, and vertices on a straight curve disappear: the domain as a
// polyhedron, however finely its surface was triangulated. Internal to domain/.
#pragma once

#include "domain/domain.h"

namespace dualblock {

/// How facets hang together over edges.
struct EdgeUse {
  std::array<Index, 2> nodes; // ascending
  Index facet;
  bool forward; // the facet's loop runs from the lower to the higher node
};

/// Every use of every edge, sorted by nodes, then facet.
std::vector<EdgeUse> edgeUses(const std::vector<Facet> &facets);

/// A facet's neighbour over an edge that no third facet has.
struct FacetNeighbour {
  Index facet;
  bool agrees; // they run through the edge in opposite directions
};

/// Per facet, its neighbours. uses: of the facets' edges, as from edgeUses.
Lists<FacetNeighbour> facetNeighbours(const std::vector<EdgeUse> &uses, std::size_t facets);

struct MergedFacets {
  std::vector<Facet> facets;
  std::vector<Index> facetOfGiven;
};

/// Merges facets that share an edge used by exactly two facets and lie in one plane within `tolerance`
/// (absolute). Facets on both sides of such an edge must run through it in opposite directions.
MergedFacets mergeCoplanar(const std::vector<Vec<3>> &vertices, std::vector<Facet> facets, double tolerance);

/// Removes vertices where exactly two edges meet, straight within `tolerance` (absolute).
void dropStraightVertices(const std::vector<Vec<3>> &vertices, std::vector<Facet> &facets, double tolerance);

} // namespace dualblock
