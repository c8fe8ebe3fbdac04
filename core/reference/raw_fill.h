// Simplices that cover a domain, before it is known which of them are inside. Internal to reference/.
#pragma once

#include <string>

#include "base/error.h"
#include "domain/domain.h"
#include "reference/fill.h"

namespace dualblock {

template <int N> struct RawFill {
  ReferenceMesh<N> mesh;              // connected; no tags, surfaces or regions yet
  std::vector<FaceRef<N>> facetFaces; // each face on a facet, seen from one side
  std::vector<Index> facetOfFace;
  std::string remedy;
  double tetgenMilliseconds = 0;
  double deviation = 0; // how far nodes on facets lie off them, at most, in a given mesh
};

Result<RawFill<3>> fillByTetgen(const Domain<3> &domain, double edgeLength);
Result<RawFill<2>> fillByTetgen(const Domain<2> &domain, double edgeLength);
template <int N> Result<RawFill<N>> fillByGiven(const Domain<N> &domain, double planarTolerance);

extern template Result<RawFill<2>> fillByGiven(const Domain<2> &, double);
extern template Result<RawFill<3>> fillByGiven(const Domain<3> &, double);

} // namespace dualblock
