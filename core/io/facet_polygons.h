// The polygons of one facet of a .poly file, sorted into facets with an outer loop and holes.
#pragma once

#include "domain/domain.h"

namespace dualblock {

/// A facet as TetGen's .poly gives it: polygons of at least three corners that do not cross, in any order and
/// orientation, and points that each mark the polygon right around them as a hole.
struct FacetPolygons {
  std::vector<std::vector<Index>> polygons;
  std::vector<Vec<3>> holes;
};

/// Splits a facet into facets whose inside is connected. Every polygon that is no hole bounds a facet, and
/// the polygons directly inside it, holes or not, are hole loops of that facet: an inner polygon that no
/// point marks divides the facet, and is both a facet and a hole in the one around it. The largest polygon's
/// facet comes first; polygons side by side become facets of their own. `steps` is what all calls for one
/// file may still spend, about the number of corners looked at. Errors (without line and entity):
/// degenerateFacet for a point that marks an outermost polygon, holeOutside for one in no polygon, notFinite
/// for coordinates whose products overflow, syntax where `steps` runs out.
Result<std::vector<Facet>> splitFacet(const std::vector<Vec<3>> &vertices, FacetPolygons facet,
                                      std::int64_t &steps);

} // namespace dualblock
