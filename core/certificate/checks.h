// The five checks of the certificate, one file each. Internal to certificate/.
#pragma once

#include <tuple>

#include "certificate/certificate.h"

namespace dualblock {

/// Corner k of face f of a block, in VTK's order of corners.
template <int N> constexpr int faceCorner(int f, int k) {
  constexpr int kFaces[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  constexpr int kQuadSides[4][2] = {{3, 0}, {1, 2}, {0, 1}, {2, 3}};
  return N == 3 ? kFaces[f][k] : kQuadSides[f % 4][k % 2];
}

/// A face of a block, by its nodes in the block's order and by its sorted nodes.
template <int N> struct BlockFace {
  std::array<Index, 1 << (N - 1)> key;   // sorted
  std::array<Index, 1 << (N - 1)> cycle; // around the face
  Index block;
  int local;  // its number in the block: 2a and 2a + 1 are across axis a, the second one on the corner's side
  Index side; // the side of the part that the face lies on, or kNone for a face towards the part's centre
};

/// A node that the domain's boundary comes back to, once per further time, with a simplex that has it.
struct Pinch {
  Index node, simplex;
};

/// The blocks' faces, sorted by key, so that the faces of two blocks stand together.
template <int N> struct BlockComplex {
  std::vector<BlockFace<N>> faces;
  std::vector<Index> boundary;             // of `faces`: those with one block only
  std::vector<Index> faceOf;               // per block and local number: index in `faces`
  std::vector<std::array<Index, 2>> edges; // sorted node pairs, each once
  std::vector<Index> blocksAtEdge;         // per edge
  std::vector<Pinch> pinches;
};

/// An edge of the blocks (2D: node) where the blocks around it lie between two patches.
struct Crease {
  std::array<Index, 2> keys;  // of the patches and the sides that they are seen from, ascending
  std::array<Index, 2> nodes; // ascending; 2D: the node twice
  Index blocks;               // around it, from one patch to the other
  bool operator<(const Crease &o) const { return std::tie(keys, nodes) < std::tie(o.keys, o.nodes); }
  bool operator==(const Crease &o) const { return keys == o.keys && nodes == o.nodes; }
};

/// The facet that a block's face lies on, or kNone.
template <int N> Index facetOf(const CertificateInput<N> &in, const BlockFace<N> &face) {
  if (face.side == kNone) return kNone;
  const Index surface = FaceTag::surface(in.parts.sides[at(face.side)].tag);
  return in.mesh.surfaces[at(surface)].kind == SurfaceKind::facet ? surface : kNone;
}

/// Sorted. Turns around each edge of each block face on a facet, through the blocks, until another facet ends
/// the fan.
template <int N>
std::vector<Crease> findCreases(const CertificateInput<N> &input, const BlockComplex<N> &complex);

/// Whether any facet is part of a bent side: the blocks then only approximate the domain.
template <int N> bool isBent(const CertificateInput<N> &input) {
  return std::any_of(input.mesh.surfaces.begin(), input.mesh.surfaces.end(),
                     [](const Surface<N> &s) { return s.kind == SurfaceKind::facet && s.bent; });
}

template <int N> BlockComplex<N> buildBlockComplex(const CertificateInput<N> &input);

template <int N> void checkMatching(const CertificateInput<N> &input, Certificate &certificate);
template <int N>
void checkCells(const CertificateInput<N> &input, const BlockComplex<N> &complex, Certificate &certificate);
template <int N>
void checkTopology(const CertificateInput<N> &input, const BlockComplex<N> &complex,
                   Certificate &certificate);
template <int N> void checkGeometry(const CertificateInput<N> &input, Certificate &certificate);
template <int N>
void checkFeatures(const CertificateInput<N> &input, const BlockComplex<N> &complex,
                   Certificate &certificate);

/// Of check 5: the creases are the domain's curves, node by node.
void checkCurves(const CertificateInput<3> &input, const std::vector<Crease> &creases, double tolerance,
                 Certificate &certificate);
void checkCurves(const CertificateInput<2> &input, const std::vector<Crease> &creases, double tolerance,
                 Certificate &certificate);
/// Of check 5, where sides are bent: nodes on them lie on their facets, and no part of the boundary meets
/// another.
void checkBentSides(const CertificateInput<3> &input, const BlockComplex<3> &complex, double tolerance,
                    Certificate &certificate);

/// Whether the Jacobian of the block is positive everywhere: +1 certified, -1 refuted, 0 neither within the
/// depth of subdivision. `ratio` is the smallest Bezier coefficient met over the largest.
template <int N> int jacobianSign(const std::array<Vec<N>, 1 << N> &corners, double &ratio);

} // namespace dualblock
