// The project's own domain format, version 1 (see README): 2D loops or 3D facets, optionally with a reference
// mesh and contributions.
#pragma once

#include <string_view>

#include "domain/domain.h"

namespace dualblock {

/// Parses a domain. Checks the grammar and every reference; geometry is checked by prepareDomain. Errors:
/// fileEmpty, syntax, versionUnknown, notFinite, indexOutOfRange.
Result<AnyDomain> readJson(std::string_view text);

} // namespace dualblock
