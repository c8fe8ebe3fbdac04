// TetGen's piecewise linear complexes: .poly and .smesh (TetGen 1.5 manual, sections 5.2.2 and 5.2.3).
#pragma once

#include <string_view>

#include "domain/domain.h"

namespace dualblock {

/// Parses a .poly file or, with `smesh`, a .smesh file, whose facets are one polygon each: nodes, numbered
/// from 0 or 1 in order, facets, holes, and regions (the last two may be missing). Attributes, markers and
/// volume bounds are skipped. A region's id is its attribute where that is a whole number, otherwise its
/// place in the list, from 1. What several polygons in one facet mean, see facet_polygons.h; facet i of the
/// file is facet i of the domain, and further facets that its polygons make come after the file's last.
/// Always gives a Domain<3>; geometry is checked by prepareDomain. Errors: fileEmpty, syntax, fileTruncated,
/// notFinite, indexOutOfRange, tooFewVertices (also for nodes in a separate .node file), tooFewFacets,
/// degenerateFacet, holeOutside. Entities: the vertex, facet, hole or region (zero-based), and the line
/// (one-based).
Result<AnyDomain> readPoly(std::string_view text, bool smesh);

} // namespace dualblock
