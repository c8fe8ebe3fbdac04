// The fallback that always works (ARCHITECTURE.md 3, rule 3): every inner face of the reference mesh is a
// split surface, every simplex a part of N + 1 blocks.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// A mesh whose components are taken from `cut`, where replace[component] is false, or from the uncut mesh
/// `coarse`, all of whose inner faces become split surfaces.
template <int N> struct FallbackMesh {
  ReferenceMesh<N> mesh;
  std::vector<bool> everyFace; // per simplex: it is a part of its own
};
template <int N>
FallbackMesh<N> applyFallback(const ReferenceMesh<N> &cut, const ReferenceMesh<N> &coarse,
                              const std::vector<bool> &replace);

extern template FallbackMesh<2> applyFallback(const ReferenceMesh<2> &, const ReferenceMesh<2> &,
                                              const std::vector<bool> &);
extern template FallbackMesh<3> applyFallback(const ReferenceMesh<3> &, const ReferenceMesh<3> &,
                                              const std::vector<bool> &);

} // namespace dualblock
