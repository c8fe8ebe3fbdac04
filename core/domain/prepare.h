// Checks a domain and brings it into the form that the stages work on: facets as large as they are planar,
// vertices only where curves end.
#pragma once

#include "domain/domain.h"

namespace dualblock {

template <int N> struct PreparedDomain {
  Domain<N> domain;                 // merged facets; vertices only those that facets still use
  std::vector<Index> givenVertex;   // per vertex: its index in the input
  std::vector<Index> facetOfGiven;  // per facet of the input: the merged facet it went into
  double deviation = 0;             // of facet corners from their facet's plane, at most
  std::vector<std::string> repairs; // what was changed, each unambiguous, in words
};

/// tolerance: of planarity and collinearity, relative to the domain's size. Neighbours are merged within it;
/// a facet that the input gives as one may be off its plane by ten times as much. Errors: every code in the
/// groups "numbers and references" and "the domain" of error_codes.def.
Result<PreparedDomain<2>> prepareDomain(const Domain<2> &domain, double tolerance);
Result<PreparedDomain<3>> prepareDomain(const Domain<3> &domain, double tolerance);

} // namespace dualblock
