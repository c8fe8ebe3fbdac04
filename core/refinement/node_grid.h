// The numbers of a refined mesh's nodes: the blocks' own first, then those inside edges, faces and blocks.
#pragma once

#include "refinement/spacing.h"

namespace dualblock {

/// Numbers the nodes, and gives those of one block after the other as a grid, first axis fastest.
template <int N> class NodeGrid {
public:
  NodeGrid(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton, const Spacing &spacing)
      : blocks_(blocks), skeleton_(skeleton), spacing_(spacing) {
    nodeCount_ = blocks.nodeCount();
    const auto take = [&](std::vector<Index> &first, Index inside) {
      first.push_back(nodeCount_);
      nodeCount_ += inside;
    };
    for (Index e = 0; e < toIndex(skeleton.edges.size()); ++e) take(firstOfEdge_, intervalsOf(e) - 1);
    firstInFaces_ = nodeCount_;
    for (Index f = 0; f < toIndex(skeleton.faces.size()); ++f) {
      const auto n = intervalsOfFace(f);
      take(firstOfFace_, (n[0] - 1) * (n[1] - 1));
    }
    firstInBlocks_ = nodeCount_;
    for (Index b = 0; b < blocks.blockCount(); ++b) {
      Index inside = 1;
      std::size_t elements = 1;
      for (const Index n : intervalsOfBlock(b)) {
        inside *= n - 1;
        elements *= at(n);
      }
      take(firstOfBlock_, inside);
      elementCount_ += elements;
    }
  }

  Index nodeCount() const { return nodeCount_; }
  std::size_t elementCount() const { return elementCount_; }

  Index intervalsOf(Index edge) const { return spacing_.intervals[at(skeleton_.surfaceOfEdge[at(edge)])]; }

  std::array<Index, N> intervalsOfBlock(Index b) const {
    std::array<Index, N> n;
    for (int a = 0; a < N; ++a) n[at(a)] = intervalsOf(skeleton_.edgesOf[at(b)][edgeAt<N>(a, 0)]);
    return n;
  }

  std::array<Index, 2> intervalsOfFace(Index f) const {
    const auto &edges = skeleton_.edgesOfFace[at(f)];
    return {intervalsOf(edges[0]), intervalsOf(edges[2])};
  }

  /// The first of the nodes inside an edge, which follow one another from its lower end.
  Index firstOfEdge(Index edge) const { return firstOfEdge_[at(edge)]; }

  /// Likewise of a face, row by row.
  Index firstOfFace(Index face) const { return firstOfFace_[at(face)]; }
  /// The nodes inside edges are numbered from the first on, those inside faces from the second, those inside
  /// blocks from the third.
  std::array<Index, 3> firstOfKind() const { return {blocks_.nodeCount(), firstInFaces_, firstInBlocks_}; }

  /// Node k of an edge, counted from its end `from`.
  Index nodeOfEdge(Index e, Index from, Index k) const {
    const auto &[low, high] = skeleton_.edges[at(e)];
    const Index n = intervalsOf(e);
    const Index up = from == low ? k : n - k;
    if (up == 0) return low;
    return up == n ? high : firstOfEdge_[at(e)] + up - 1;
  }

  /// Node (x, y) of a face, x from its node 0 to 1 and y from 0 to 3.
  Index nodeOfFace(Index f, Index x, Index y) const {
    const auto &v = skeleton_.faces[at(f)];
    const auto &edges = skeleton_.edgesOfFace[at(f)];
    const auto n = intervalsOfFace(f);
    if (y == 0) return nodeOfEdge(edges[0], v[0], x);
    if (y == n[1]) return nodeOfEdge(edges[1], v[3], x);
    if (x == 0) return nodeOfEdge(edges[2], v[0], y);
    if (x == n[0]) return nodeOfEdge(edges[3], v[1], y);
    return firstOfFace_[at(f)] + (x - 1) + (n[0] - 1) * (y - 1);
  }

  /// Where node k of an edge is, from 0 to 1, both counted from its end `from`.
  double placeOf(Index edge, Index from, Index k) const {
    const Index surface = skeleton_.surfaceOfEdge[at(edge)];
    if (skeleton_.edges[at(edge)][0] == from) return spacing_.placeOf(edge, surface, k);
    return 1 - spacing_.placeOf(edge, surface, intervalsOf(edge) - k);
  }

  /// Makes a block the one at hand.
  void enter(Index b) {
    n_ = intervalsOfBlock(b);
    std::size_t size = 1;
    for (std::size_t a = 0; a < N; ++a) {
      stride_[a] = size;
      size *= at(n_[a]) + 1;
    }
    grid_.resize(size);
    const auto &block = blocks_.blocks[at(b)];
    if constexpr (N == 2) {
      for (int axis = 0; axis < 2; ++axis)
        for (unsigned end = 0; end < 2; ++end) {
          const unsigned bits = end << (1 - axis);
          const Index edge = skeleton_.edgesOf[at(b)][edgeAt<2>(axis, bits)];
          const std::size_t start = end * at(n_[at(1 - axis)]) * stride_[at(1 - axis)];
          for (Index k = 0; k <= n_[at(axis)]; ++k)
            grid_[start + at(k) * stride_[at(axis)]] = nodeOfEdge(edge, block[cornerAt<2>(bits)], k);
        }
    } else {
      for (std::size_t f = 0; f < 6; ++f) fillFace(b, f);
    }
    Index next = firstOfBlock_[at(b)];
    forInside([&](std::size_t place, const std::array<Index, N> &) { grid_[place] = next++; });
  }

  /// Nodes of the block at hand.
  Index operator[](std::size_t place) const { return grid_[place]; }
  /// Its intervals along an axis, and how far apart neighbours along that axis are in the grid.
  Index intervals(std::size_t axis) const { return n_[axis]; }
  std::size_t stride(std::size_t axis) const { return stride_[axis]; }

  /// visit(place in the grid, its coordinates) for the nodes inside the block at hand; first axis fastest.
  template <typename Visit> void forInside(Visit visit) const {
    forCells(1, [&](std::size_t place, const std::array<Index, N> &c) { visit(place, c); });
  }

  /// The same for all coordinates from `low` to the intervals, exclusive.
  template <typename Visit> void forCells(Index low, Visit visit) const {
    std::array<Index, N> c;
    c.fill(low);
    for (std::size_t a = 0; a < N; ++a)
      if (n_[a] <= low) return;
    while (true) {
      std::size_t place = 0;
      for (std::size_t a = 0; a < N; ++a) place += at(c[a]) * stride_[a];
      for (c[0] = low; c[0] < n_[0]; ++c[0]) visit(place + at(c[0] - low), c);
      std::size_t a = 1;
      c[0] = low;
      while (a < N && ++c[a] == n_[a]) c[a++] = low;
      if (a == N) return;
    }
  }

  /// visit(place) for the nodes inside the block's face at the low end of an axis.
  template <typename Visit> void forFace(std::size_t axis, Visit visit) const {
    const std::size_t p = axis == 0 ? 1 : 0;
    const std::size_t q = axis == 2 ? 1 : 2;
    for (Index j = 1; j < n_[q]; ++j)
      for (Index i = 1; i < n_[p]; ++i) visit(at(i) * stride_[p] + at(j) * stride_[q]);
  }

  /// The nodes of the element whose lowest corner is at `place`.
  std::array<Index, 1 << N> elementAt(std::size_t place) const {
    std::array<Index, 1 << N> element;
    for (std::size_t k = 0; k < element.size(); ++k) {
      std::size_t corner = place;
      for (std::size_t a = 0; a < N; ++a)
        if (kBlockBits<N>[k] >> a & 1U) corner += stride_[a];
      element[k] = grid_[corner];
    }
    return element;
  }

  /// The number of an element within its block, in the order of forCells.
  Index elementInBlock(const std::array<Index, N> &c) const {
    Index number = 0;
    for (std::size_t a = N; a-- > 0;) number = number * n_[a] + c[a];
    return number;
  }

private:
  void fillFace(Index b, std::size_t face) {
    const auto &block = blocks_.blocks[at(b)];
    const std::size_t p = face / 2 == 0 ? 1 : 0; // its axes
    const std::size_t q = face / 2 == 2 ? 1 : 2;
    const unsigned fixed = static_cast<unsigned>(face % 2) << face / 2;
    const auto cornerNode = [&](unsigned i, unsigned j) {
      return block[cornerAt<3>(fixed | i << p | j << q)];
    };
    const Index f = skeleton_.facesOf[at(b)][face];
    const auto &v = skeleton_.faces[at(f)];
    unsigned i0 = 0;
    unsigned j0 = 0; // where the face's node 0 is
    while (cornerNode(i0, j0) != v[0]) (i0 == j0 ? i0 : j0) ^= 1U;
    const bool isSwapped = cornerNode(i0 ^ 1U, j0) != v[1];
    const std::size_t start = face % 2 * at(n_[face / 2]) * stride_[face / 2];
    for (Index j = 0; j <= n_[q]; ++j)
      for (Index i = 0; i <= n_[p]; ++i) {
        const Index x = i0 ? n_[p] - i : i;
        const Index y = j0 ? n_[q] - j : j;
        grid_[start + at(i) * stride_[p] + at(j) * stride_[q]] =
            isSwapped ? nodeOfFace(f, y, x) : nodeOfFace(f, x, y);
      }
  }

  const BlockMesh<N> &blocks_;
  const Skeleton<N> &skeleton_;
  const Spacing &spacing_;
  std::vector<Index> firstOfEdge_, firstOfFace_, firstOfBlock_; // the first node inside each
  Index firstInFaces_ = 0, firstInBlocks_ = 0;
  Index nodeCount_ = 0;
  std::size_t elementCount_ = 0;
  // Of the block at hand:
  std::array<Index, N> n_{};
  std::array<std::size_t, N> stride_{};
  std::vector<Index> grid_;
};

} // namespace dualblock
