#include "primal/boundary.h"

namespace dualblock {

template <int N>
BoundaryFaces<N> boundaryFaces(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const Primal<N> &primal) {
  // Per axis, the face of the block on the far side, where the corner's side is.
  static constexpr std::size_t kQuad[2][2] = {{1, 2}, {2, 3}};
  static constexpr std::size_t kHex[3][4] = {{1, 2, 6, 5}, {3, 7, 6, 2}, {4, 5, 6, 7}};
  BoundaryFaces<N> result;
  for (const Block<N> &block : primal.blocks)
    for (std::size_t axis = 0; axis < N; ++axis) {
      const Side &side = parts.sides[at(block.sides[axis])];
      const Index surface = FaceTag::surface(side.tag);
      if (side.opposite != kNone || mesh.surfaces[at(surface)].kind != SurfaceKind::facet) continue;
      std::array<Index, 1 << (N - 1)> face;
      for (std::size_t k = 0; k < face.size(); ++k) {
        if constexpr (N == 2) face[k] = block.nodes[kQuad[axis][k]];
        else face[k] = block.nodes[kHex[axis][k]];
      }
      result.faces.push_back(face);
      result.facet.push_back(surface);
    }
  return result;
}

template BoundaryFaces<2> boundaryFaces(const ReferenceMesh<2> &, const Parts<2> &, const Primal<2> &);
template BoundaryFaces<3> boundaryFaces(const ReferenceMesh<3> &, const Parts<3> &, const Primal<3> &);

} // namespace dualblock
