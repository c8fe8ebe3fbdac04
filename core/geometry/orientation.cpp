#include "geometry/orientation.h"

#include <numeric>

#include "base/sort.h"
#include "geometry/jacobian.h"

namespace dualblock {
namespace {

/// A block's face: the number across its axis, its nodes around it counter-clockwise from outside, beginning
/// with the lowest.
template <int N> struct Face {
  std::array<Index, 1 << (N - 1)> cycle;
  Index block;
};

template <int N> std::vector<Face<N>> facesOf(const Primal<N> &primal) {
  static constexpr std::array<std::array<std::size_t, 4>, 6> kHexahedron{
      {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
  std::vector<Face<N>> faces;
  faces.reserve(primal.blocks.size() * 2 * N);
  for (Index b = 0; b < toIndex(primal.blocks.size()); ++b)
    for (std::size_t f = 0; f < 2 * N; ++f) {
      Face<N> face{{}, b};
      for (std::size_t k = 0; k < face.cycle.size(); ++k)
        face.cycle[k] = primal.blocks[at(b)].nodes[N == 2 ? (f + k) % 4 : kHexahedron[f][k]];
      if constexpr (N == 3)
        std::rotate(face.cycle.begin(), std::min_element(face.cycle.begin(), face.cycle.end()),
                    face.cycle.end());
      faces.push_back(face);
    }
  return faces;
}

/// Equal for faces of the same nodes, however they run around them.
template <int N> std::array<Index, 1 << (N - 1)> keyOf(const Face<N> &face) {
  auto key = face.cycle;
  sortItems(key);
  return key;
}

struct Neighbour {
  Index block;
  bool isTurned; // the two are not turned alike
};

template <int N> Lists<Neighbour> neighboursOf(const Primal<N> &primal) {
  std::vector<Face<N>> faces = facesOf(primal);
  sortByIndex(
      faces, at(primal.nodeCount),
      [](const Face<N> &f) { return *std::min_element(f.cycle.begin(), f.cycle.end()); },
      [](const Face<N> &a, const Face<N> &b) { return keyOf<N>(a) < keyOf<N>(b); });
  return collectLists<Neighbour>(primal.blocks.size(), [&](auto put) {
    for (std::size_t f = 0; f + 1 < faces.size(); ++f) {
      if (keyOf<N>(faces[f]) != keyOf<N>(faces[f + 1])) continue;
      const bool isTurned = faces[f].cycle[1] == faces[f + 1].cycle[1];
      put(faces[f].block, Neighbour{faces[f + 1].block, isTurned});
      put(faces[f + 1].block, Neighbour{faces[f].block, isTurned});
    }
  });
}

template <int N> double measureOf(const Primal<N> &primal, Index b) {
  const auto c = jacobianCoefficients<N>(cornersOf<N>(primal.blocks[at(b)].nodes, primal.positions));
  return std::accumulate(c.begin(), c.end(), 0.0);
}

} // namespace

template <int N> void orientBlocks(Primal<N> &primal) {
  const Lists<Neighbour> neighbours = neighboursOf(primal);
  std::vector<std::int8_t> sign(primal.blocks.size(), 0); // -1: its axes have to be exchanged
  std::vector<Index> body;
  for (Index first = 0; first < toIndex(primal.blocks.size()); ++first) {
    if (sign[at(first)] != 0) continue;
    sign[at(first)] = 1;
    body.assign(1, first);
    double measure = 0;
    for (std::size_t k = 0; k < body.size(); ++k) {
      const Index b = body[k];
      measure += sign[at(b)] * measureOf(primal, b);
      for (const Neighbour *n = neighbours.begin(b); n != neighbours.end(b); ++n) {
        if (sign[at(n->block)] != 0) continue;
        sign[at(n->block)] = n->isTurned ? static_cast<std::int8_t>(-sign[at(b)]) : sign[at(b)];
        body.push_back(n->block);
      }
    }
    for (const Index b : body) {
      if ((sign[at(b)] > 0) == (measure >= 0)) continue;
      Block<N> &block = primal.blocks[at(b)];
      std::swap(block.sides[0], block.sides[1]);
      for (std::size_t k = 1; k < block.nodes.size(); k += 4) std::swap(block.nodes[k], block.nodes[k + 2]);
    }
  }
}

template void orientBlocks(Primal<2> &);
template void orientBlocks(Primal<3> &);

} // namespace dualblock
