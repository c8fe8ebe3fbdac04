// Geomview's Object File Format (http://www.geomview.org/docs/html/OFF.html), in text.
#pragma once

#include <string_view>

#include "domain/domain.h"

namespace dualblock {

/// Parses a closed surface: the header "OFF", with any of the prefixes ST, C and N; the counts of vertices,
/// faces and (optional) edges, on the header's line or the next; one vertex a line, then one face a line: the
/// number of its corners and their zero-based vertices. Texture coordinates, colours and normals are skipped.
/// Always gives a Domain<3>; geometry is checked by prepareDomain. Errors: fileEmpty, syntax (also for binary
/// and higher-dimensional OFF), fileTruncated, notFinite, indexOutOfRange, tooFewVertices, tooFewFacets,
/// degenerateFacet. Entities: the vertex or facet (zero-based), and the line (one-based).
Result<AnyDomain> readOff(std::string_view text);

} // namespace dualblock
