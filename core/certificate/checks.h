// The five checks of the certificate, one file each. Internal to certificate/.
#pragma once

#include <tuple>

#include "certificate/certificate.h"

namespace dualblock {

/// A face of a block, by its nodes in the block's order and by its sorted nodes.
template <int N> struct BlockFace {
  std::array<Index, 1 << (N - 1)> key;   // sorted
  std::array<Index, 1 << (N - 1)> cycle; // around the face
  Index block;
  int local; // its number in the block: 2a and 2a + 1 are across axis a, the second one on the corner's side
  Index tag; // of the domain's facet that the face lies on, as seen from the block, or kNone
};

/// The blocks' faces, sorted by key, so that the faces of two blocks stand together.
template <int N> struct BlockComplex {
  std::vector<BlockFace<N>> faces;
  std::vector<Index> boundary; // of `faces`: those with one block only
  std::vector<Index> behind;   // per block and local number: the other block's, 2N times its number plus the
                               // local one there, or kNone

  bool areTwins(std::size_t f, std::size_t g) const {
    for (std::size_t k = 0; k < faces[f].key.size(); ++k) // no call of memcmp for so little
      if (faces[f].key[k] != faces[g].key[k]) return false;
    return true;
  }
  /// The same face, seen from the other block, or kNone.
  Index twinOf(std::size_t f) const {
    if (f > 0 && areTwins(f - 1, f)) return toIndex(f) - 1;
    return f + 1 < faces.size() && areTwins(f, f + 1) ? toIndex(f) + 1 : kNone;
  }
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
template <int N> Index facetOf(const BlockFace<N> &face) {
  return face.tag == kNone ? kNone : FaceTag::surface(face.tag);
}

/// Sorted. Turns around each edge of each block face on a facet, through the blocks, until another facet ends
/// the fan.
template <int N> std::vector<Crease> findCreases(const BlockInput<N> &input, const BlockComplex<N> &complex);

/// Whether any facet is part of a bent side: the blocks then only approximate the domain.
template <int N> bool isBent(const BlockInput<N> &input) {
  return std::any_of(input.mesh.surfaces.begin(), input.mesh.surfaces.end(),
                     [](const Surface<N> &s) { return s.kind == SurfaceKind::facet && s.bent; });
}

template <int N> BlockComplex<N> buildBlockComplex(const BlockInput<N> &input);

template <int N> void checkMatching(const CertificateInput<N> &input, Certificate &certificate);
template <int N> void checkCells(const CertificateInput<N> &input, Certificate &certificate);
template <int N>
void checkTopology(const BlockInput<N> &input, const BlockComplex<N> &complex, Certificate &certificate);
template <int N> void checkGeometry(const BlockInput<N> &input, Certificate &certificate);
template <int N>
void checkFeatures(const BlockInput<N> &input, const BlockComplex<N> &complex, Certificate &certificate);

/// Of check 5: the creases are the domain's curves, node by node.
void checkCurves(const BlockInput<3> &input, const std::vector<Crease> &creases, double tolerance,
                 Certificate &certificate);
void checkCurves(const BlockInput<2> &input, const std::vector<Crease> &creases, double tolerance,
                 Certificate &certificate);
/// Of check 5, where sides are bent: nodes on them lie on their facets, no part of the boundary meets
/// another, and faces stay near their sides.
void checkBentSides(const BlockInput<3> &input, const BlockComplex<3> &complex, double tolerance,
                    Certificate &certificate);

std::string scientific(double x);

/// Completes what was measured of bent sides, each for itself, by the whole mesh's figures.
/// `volumeDifference`: of the mesh's volume from the domain's, as a share of that.
void summarize(Fidelity &fidelity, double volumeDifference, double domainMeasure);

/// Whether the Jacobian of the block is positive everywhere: +1 certified, -1 refuted, 0 neither within the
/// depth of subdivision. `ratio` is the smallest Bezier coefficient met over the largest, `measure` the
/// block's area or volume.
template <int N>
int jacobianSign(const std::array<Vec<N>, 1 << N> &corners, double &ratio, double *measure = nullptr);

} // namespace dualblock
