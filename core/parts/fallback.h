// The fallback that always works (ARCHITECTURE.md 3, rule 3): every inner face of the reference mesh is a
// split surface, every simplex a part of N + 1 blocks.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// Components of a mesh (over all faces), numbered by their lowest outer facet, so that two meshes of one
/// domain number them alike.
template <int N> struct Components {
  std::vector<Index> ofSimplex;
  Index count = 0;
};
template <int N> Components<N> findComponents(const ReferenceMesh<N> &mesh);

/// A mesh whose components are taken from `cut`, where replace[component] is false, or from the uncut mesh
/// `coarse`, all of whose inner faces become split surfaces.
template <int N> struct FallbackMesh {
  ReferenceMesh<N> mesh;
  std::vector<bool> everyFace; // per simplex: it is a part of its own
};
template <int N>
FallbackMesh<N> applyFallback(const ReferenceMesh<N> &cut, const ReferenceMesh<N> &coarse,
                              const std::vector<bool> &replace);

extern template Components<2> findComponents(const ReferenceMesh<2> &);
extern template Components<3> findComponents(const ReferenceMesh<3> &);
extern template FallbackMesh<2> applyFallback(const ReferenceMesh<2> &, const ReferenceMesh<2> &,
                                              const std::vector<bool> &);
extern template FallbackMesh<3> applyFallback(const ReferenceMesh<3> &, const ReferenceMesh<3> &,
                                              const std::vector<bool> &);

} // namespace dualblock
