// Where cuts do not serve a component (ARCHITECTURE.md 3, rule 4): the simplices of the parts that are not
// simple, or those of the whole reference mesh, become parts. The latter always works.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// What a component's parts are made of.
enum class PartSource : std::uint8_t {
  cuts,     // the cut mesh
  pulled,   // simplices where cuts left parts that are not simple, pull.h
  simplices // every reference simplex a part of N + 1 blocks
};

template <int N> struct MixedMesh {
  ReferenceMesh<N> mesh;
  std::vector<bool> everyFace; // per simplex: it is a part of its own
};

/// Takes each component from the mesh that its source names: `cut`; `pulled`, whose surfaces begin like those
/// of `cut` and end in that of its simplices' faces, and pulledFace says which simplices are parts; or
/// `coarse`, all of whose inner faces become split surfaces. Meshes that no component names may be null.
template <int N>
MixedMesh<N> mixMeshes(const ReferenceMesh<N> &cut, const ReferenceMesh<N> *pulled,
                       const std::vector<bool> *pulledFace, const ReferenceMesh<N> *coarse,
                       const std::vector<PartSource> &source);

extern template MixedMesh<2> mixMeshes(const ReferenceMesh<2> &, const ReferenceMesh<2> *,
                                       const std::vector<bool> *, const ReferenceMesh<2> *,
                                       const std::vector<PartSource> &);
extern template MixedMesh<3> mixMeshes(const ReferenceMesh<3> &, const ReferenceMesh<3> *,
                                       const std::vector<bool> *, const ReferenceMesh<3> *,
                                       const std::vector<PartSource> &);

} // namespace dualblock
