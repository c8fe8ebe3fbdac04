// Which facets keep a domain from being filled.
#pragma once

#include "base/error.h"
#include "domain/prepare.h"

namespace dualblock {

/// An error of fillDomain that names facets of the input, as far as they can be found: two that cross, or one
/// with nothing of the domain on either side. Other errors as they are. `given`: the input, for facets that
/// overlap in one plane may have been merged; `tolerance`: as for prepareDomain.
template <int N>
Error nameCulprits(const Error &error, const Domain<N> &given, const PreparedDomain<N> &prepared,
                   double tolerance);

extern template Error nameCulprits(const Error &, const Domain<2> &, const PreparedDomain<2> &, double);
extern template Error nameCulprits(const Error &, const Domain<3> &, const PreparedDomain<3> &, double);

} // namespace dualblock
