// The front door of the readers that give facets as they stand in the file, by the name of the format.
#pragma once

#include <string_view>

#include "domain/domain.h"

namespace dualblock {

/// Parses a domain in the format "json", "off", "poly" or "smesh". Errors: formatUnknown; those of readJson,
/// readOff and readPoly.
Result<AnyDomain> readDomain(std::string_view format, std::string_view text);

} // namespace dualblock
