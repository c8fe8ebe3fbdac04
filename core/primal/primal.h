// The primal (paper 3.2; ARCHITECTURE.md 4): a node per D-bar-cell, an edge per pair of cells that a hard
// contribution separates, a face per pair of crossing D-bar-surfaces, a block per D-bar-node.
#pragma once

#include <string>

#include "dual/dual_cells.h"

namespace dualblock {

/// A block: the corner of a part that it fills, and its nodes. Node k lies inside the D-bar-surfaces of those
/// of the corner's sides whose bits are set in kBlockBits<N>[k]; that is VTK's order of a quad or hexahedron.
///
///        3-----2            7------6       node   side bits            node   side bits
///        |     |           /|     /|        0       00                  0       000
///        |     |          4------5 |        1       01                  1       001
///        0-----1          | 3----|-2        2       11                  2       011
///                         |/     |/         3       10                  3       010, and 4 to 7 with 100
///                         0------1
template <int N> struct Block {
  Index part;
  std::array<Index, N> sides; // of the corner, in the order of the block's axes
  std::array<Index, 1 << N> nodes;
};

template <int N> inline constexpr std::array<unsigned, 1 << N> kBlockBits;
template <> inline constexpr std::array<unsigned, 4> kBlockBits<2> = {0, 1, 3, 2};
template <> inline constexpr std::array<unsigned, 8> kBlockBits<3> = {0, 1, 3, 2, 4, 5, 7, 6};

struct PrimalEdge {
  std::array<Index, 2> nodes; // ascending
  Index surface;              // the D-bar-surface that the edge crosses
};

struct PrimalFace {
  std::array<Index, 4> nodes;    // in a cycle, from the lowest node towards its lower neighbour
  std::array<Index, 2> surfaces; // D-bar-surfaces whose crossing is dual to the face, ascending
};

template <int N> struct Primal {
  Index nodeCount = 0;             // node k is D-bar-cell k
  std::vector<PrimalEdge> edges;   // sorted
  std::vector<PrimalFace> faces;   // sorted; in 2D the blocks themselves
  std::vector<Block<N>> blocks;    // by part, then corner
  std::vector<Vec<N>> positions;   // per node
  std::vector<Index> nodePiece;    // per node: one of its cell pieces
  std::vector<std::string> faults; // what the two derivations, from the dual and from the blocks, differ in
};

/// Reads the primal off the D-bar-cells, without positions. Edges and faces are derived from the
/// contributions and, independently, from the blocks; differences are listed in `faults`.
template <int N>
Primal<N> buildPrimal(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                      const Contributions<N> &contributions, const DualCells<N> &dual,
                      const DualSurfaces &surfaces);

extern template Primal<2> buildPrimal(const ReferenceMesh<2> &, const Parts<2> &, const Contributions<2> &,
                                      const DualCells<2> &, const DualSurfaces &);
extern template Primal<3> buildPrimal(const ReferenceMesh<3> &, const Parts<3> &, const Contributions<3> &,
                                      const DualCells<3> &, const DualSurfaces &);

} // namespace dualblock
