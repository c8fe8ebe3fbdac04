// The reference mesh of a domain: TetGen's tetrahedra in 3D, the constrained Delaunay triangulation that
// TetGen makes of a cone's base in 2D, or a mesh given with the domain.
#pragma once

#include "domain/domain.h"
#include "reference/reference_mesh.h"

namespace dualblock {

struct FillOptions {
  double edgeLength = 0;    // > 0: refine until no edge (3D: no tetrahedron) is larger than this
  std::uint32_t seed = 0;   // > 0: split some random edges, to try another reference mesh
  double planarTolerance;   // relative to the size: which boundary faces of a given mesh lie on a facet
  double featureAngle = -1; // see PipelineOptions
};

template <int N> struct Filled {
  ReferenceMesh<N> mesh; // surfaces 0 .. facets - 1 are the facets, their normals pointing out
  std::string remedy;    // see Tetrahedra
  double tetgenMilliseconds = 0;
  double deviation = 0; // how far nodes on facets lie off them, at most, in a given mesh
};

/// Fills a validated domain. Errors: those of runTetgen, referenceInvalid, holeOutside, regionOutside,
/// emptyDomain.
template <int N> Result<Filled<N>> fillDomain(const Domain<N> &domain, const FillOptions &options);

extern template Result<Filled<2>> fillDomain(const Domain<2> &, const FillOptions &);
extern template Result<Filled<3>> fillDomain(const Domain<3> &, const FillOptions &);

} // namespace dualblock
