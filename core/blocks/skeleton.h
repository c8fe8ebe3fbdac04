// The edges and faces of a block mesh, each once, how its blocks see them, and the facets they lie on.
#pragma once

#include "blocks/block_mesh.h"

namespace dualblock {

/// The number of a block's corner at the ends of its axes that the bits give.
template <int N> constexpr std::size_t cornerAt(unsigned bits) {
  std::size_t k = 0;
  while (kBlockBits<N>[k] != bits) ++k;
  return k;
}

/// The number, within a block, of the edge along `axis` at the ends of the other axes that the bits give.
template <int N> constexpr std::size_t edgeAt(int axis, unsigned bits) {
  const unsigned low = bits & ((1U << axis) - 1);
  return static_cast<std::size_t>(axis << (N - 1)) + (low | (bits >> (axis + 1)) << axis);
}

template <int N> struct Skeleton {
  std::vector<std::array<Index, 2>> edges;                // the lower node first
  std::vector<Index> surfaceOfEdge;                       // the D-bar-surface that crosses it
  std::vector<std::array<Index, (N << (N - 1))>> edgesOf; // per block, as edgeAt says
  Lists<Index> patchesOfEdge;                             // that it lies on, ascending

  // Of hexahedra. A face's first node is its lowest, the next one the lower of those beside that.
  std::vector<std::array<Index, 4>> faces;       // in a cycle
  std::vector<std::array<Index, 4>> edgesOfFace; // from its node 0 to 1, 3 to 2, 0 to 3, 1 to 2
  std::vector<std::array<Index, 6>> facesOf;     // per block, as in BlockMesh::tags
  std::vector<Index> patchOfFace;                // that it lies on, or kNone
};

/// Face f of a block, as in BlockMesh::tags, among the faces of its mesh; 2D: among its edges.
template <int N> Index sharedFace(const Skeleton<N> &skeleton, std::size_t block, int f) {
  if constexpr (N == 3) return skeleton.facesOf[block][at(f)];
  else return skeleton.edgesOf[block][edgeAt<2>(1 - f / 2, f % 2 ? 3U : 0U)];
}

/// How many blocks have each face: one on the domain's boundary, else two.
template <int N> std::vector<Index> blocksAtFaces(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton) {
  std::vector<Index> count(N == 3 ? skeleton.faces.size() : skeleton.edges.size(), 0);
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) ++count[at(sharedFace(skeleton, b, f))];
  return count;
}

/// Surface::patch of each surface of the reference mesh.
template <int N> std::vector<Index> patchOfSurface(const ReferenceMesh<N> &mesh) {
  std::vector<Index> patches;
  for (const Surface<N> &surface : mesh.surfaces) patches.push_back(surface.patch);
  return patches;
}

/// The patch of a surface, given Surface::patch of each: half of ReferenceMesh::sideKey.
inline Index patchOf(const std::vector<Index> &patchOfSurface, Index surface) {
  const Index patch = patchOfSurface[at(surface)];
  return patch == kNone ? surface : patch;
}

/// `patchOfSurface`: per surface of the reference mesh, as in Surface; patches are numbered as half of
/// ReferenceMesh::sideKey.
template <int N> Skeleton<N> skeletonOf(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface);

extern template Skeleton<2> skeletonOf(const BlockMesh<2> &, const std::vector<Index> &);
extern template Skeleton<3> skeletonOf(const BlockMesh<3> &, const std::vector<Index> &);

} // namespace dualblock
