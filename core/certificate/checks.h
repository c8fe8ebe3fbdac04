// The five checks of the certificate, one file each. Internal to certificate/.
#pragma once

#include "certificate/certificate.h"

namespace dualblock {

/// A face of a block, by its nodes in the block's order and by its sorted nodes.
template <int N> struct BlockFace {
  std::array<Index, 1 << (N - 1)> key;   // sorted
  std::array<Index, 1 << (N - 1)> cycle; // around the face
  Index block;
  int local;  // its number in the block: 2a and 2a + 1 are across axis a, the second one on the corner's side
  Index side; // the side of the part that the face lies on, or kNone for a face towards the part's centre
};

/// The blocks' faces, sorted by key, so that the faces of two blocks stand together.
template <int N> struct BlockComplex {
  std::vector<BlockFace<N>> faces;
  std::vector<Index> boundary;             // of `faces`: those with one block only
  std::vector<Index> faceOf;               // per block and local number: index in `faces`
  std::vector<std::array<Index, 2>> edges; // sorted node pairs, each once
  std::vector<Index> blocksAtEdge;         // per edge
};

template <int N> BlockComplex<N> buildBlockComplex(const CertificateInput<N> &input);

template <int N> void checkMatching(const CertificateInput<N> &input, Certificate &certificate);
template <int N> void checkCells(const CertificateInput<N> &input, Certificate &certificate);
template <int N>
void checkTopology(const CertificateInput<N> &input, const BlockComplex<N> &complex,
                   Certificate &certificate);
template <int N> void checkGeometry(const CertificateInput<N> &input, Certificate &certificate);
template <int N>
void checkFeatures(const CertificateInput<N> &input, const BlockComplex<N> &complex,
                   Certificate &certificate);

/// Whether the Jacobian of the block is positive everywhere: +1 certified, -1 refuted, 0 neither within the
/// depth of subdivision. `ratio` is the smallest Bezier coefficient met over the largest.
template <int N> int jacobianSign(const std::array<Vec<N>, 1 << N> &corners, double &ratio);

} // namespace dualblock
