// Bent sides given as triangles: facets that meet at a small angle are one patch (paper 2.4: curves of type
// side).
#pragma once

#include "reference/reference_mesh.h"

namespace dualblock {

/// Where none is asked for: facets that meet at less than 35 degrees are smooth, if at least six of them
/// join; so a roof keeps its ridge, and a cylinder of twelve facets or more is round.
inline constexpr double kSmoothAngle = 35;
inline constexpr Index kSmoothFacets = 6;

/// Gives facets that meet at less than `featureAngle` degrees between their normals a common patch. Below
/// zero: kSmoothAngle, for patches of at least kSmoothFacets facets. Only what is in the domain on the same
/// sides joins.
void joinSmoothFacets(ReferenceMesh<3> &mesh, double featureAngle);

/// Patches of facets that were joined: each is numbered by one of its surfaces.
template <int N> Index bentSideCount(const ReferenceMesh<N> &mesh) {
  Index count = 0;
  for (std::size_t f = 0; f < mesh.surfaces.size(); ++f)
    if (mesh.surfaces[f].patch == toIndex(f)) ++count;
  return count;
}

} // namespace dualblock
