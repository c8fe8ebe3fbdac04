#include "blocks/skeleton.h"

#include "base/sort.h"

namespace dualblock {
namespace {

/// Numbers things that blocks name by their nodes: equal keys get one number, in the order of the keys.
template <std::size_t Width>
std::vector<Index> numberByKey(std::vector<std::array<Index, Width>> keys, std::size_t nodeCount,
                               std::vector<std::array<Index, Width>> &each) {
  struct Use {
    std::array<Index, Width> key;
    Index use;
  };
  std::vector<Use> uses;
  uses.reserve(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) uses.push_back({keys[k], toIndex(k)});
  sortByIndex(
      uses, nodeCount, [](const Use &u) { return u.key[0]; },
      [](const Use &a, const Use &b) { return a.key < b.key; });
  std::vector<Index> numbers(keys.size());
  for (const Use &u : uses) {
    if (each.empty() || each.back() != u.key) each.push_back(u.key);
    numbers[at(u.use)] = toIndex(each.size()) - 1;
  }
  return numbers;
}

/// The corners of face f of a hexahedron in a cycle that starts at the lowest node and turns to the lower one
/// of the two beside it; as numbers within the block.
std::array<std::size_t, 4> startedCycle(const std::array<Index, 8> &block, int f) {
  std::array<std::size_t, 4> corner;
  std::size_t first = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    corner[k] = at(faceCorner<3>(f, static_cast<int>(k)));
    if (block[corner[k]] < block[corner[first]]) first = k;
  }
  const bool turns = block[corner[(first + 3) % 4]] < block[corner[(first + 1) % 4]];
  std::array<std::size_t, 4> cycle;
  for (std::size_t k = 0; k < 4; ++k) cycle[k] = corner[(first + (turns ? 4 - k : k)) % 4];
  return cycle;
}

/// The edge of a block between two of its corners.
template <int N> std::size_t edgeBetween(std::size_t a, std::size_t b) {
  const unsigned differ = kBlockBits<N>[a] ^ kBlockBits<N>[b];
  int axis = 0;
  while (differ >> axis != 1U) ++axis;
  return edgeAt<N>(axis, kBlockBits<N>[a] & ~differ);
}

void addFaces(const BlockMesh<3> &blocks, Skeleton<3> &skeleton) {
  std::vector<std::array<Index, 4>> keys;
  for (const auto &block : blocks.blocks)
    for (int f = 0; f < 6; ++f) {
      const auto cycle = startedCycle(block, f);
      keys.push_back({block[cycle[0]], block[cycle[1]], block[cycle[2]], block[cycle[3]]});
    }
  const std::vector<Index> numbers = numberByKey(keys, blocks.positions.size(), skeleton.faces);
  skeleton.edgesOfFace.resize(skeleton.faces.size());
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
    auto &own = skeleton.facesOf.emplace_back();
    for (int f = 0; f < 6; ++f) {
      own[at(f)] = numbers[6 * b + at(f)];
      const auto c = startedCycle(blocks.blocks[b], f);
      constexpr std::size_t kEnds[4][2] = {{0, 1}, {3, 2}, {0, 3}, {1, 2}};
      for (std::size_t e = 0; e < 4; ++e)
        skeleton.edgesOfFace[at(own[at(f)])][e] =
            skeleton.edgesOf[b][edgeBetween<3>(c[kEnds[e][0]], c[kEnds[e][1]])];
    }
  }
}

} // namespace

template <int N>
Skeleton<N> skeletonOf(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface) {
  constexpr std::size_t kEdges = N << (N - 1);
  Skeleton<N> skeleton;
  std::vector<std::array<Index, 2>> keys;
  keys.reserve(kEdges * blocks.blocks.size());
  for (const auto &block : blocks.blocks)
    for (int axis = 0; axis < N; ++axis)
      for (unsigned bits = 0; bits < 1U << N; ++bits)
        if (!(bits >> axis & 1U))
          keys.push_back(
              sortedPair(block[cornerAt<N>(bits)], block[cornerAt<N>(bits | 1U << axis)])); // as edgeAt
  const std::vector<Index> numbers = numberByKey(keys, blocks.positions.size(), skeleton.edges);
  skeleton.surfaceOfEdge.resize(skeleton.edges.size());
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
    auto &own = skeleton.edgesOf.emplace_back();
    for (std::size_t e = 0; e < kEdges; ++e) {
      own[e] = numbers[kEdges * b + e];
      skeleton.surfaceOfEdge[at(own[e])] = blocks.surfaces[b][e >> (N - 1)];
    }
  }
  if constexpr (N == 3) {
    addFaces(blocks, skeleton);
    skeleton.patchOfFace.assign(skeleton.faces.size(), kNone);
  }

  std::vector<std::array<Index, 2>> found; // edge, patch
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) {
      if (blocks.tags[b][at(f)] == kNone) continue;
      const Index patch = patchOf(patchOfSurface, FaceTag::surface(blocks.tags[b][at(f)]));
      if constexpr (N == 3) skeleton.patchOfFace[at(skeleton.facesOf[b][at(f)])] = patch;
      constexpr int kCycle = N == 3 ? 4 : 1; // edges of a face
      for (int k = 0; k < kCycle; ++k) {
        const std::size_t edge = edgeBetween<N>(at(faceCorner<N>(f, k)), at(faceCorner<N>(f, (k + 1) % 4)));
        found.push_back({skeleton.edgesOf[b][edge], patch});
      }
    }
  sortByIndex(found, skeleton.edges.size(), [](const auto &f) { return f[0]; });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::size_t next = 0;
  for (Index edge = 0; edge < toIndex(skeleton.edges.size()); ++edge) {
    for (; next < found.size() && found[next][0] == edge; ++next)
      skeleton.patchesOfEdge.items.push_back(found[next][1]);
    skeleton.patchesOfEdge.closeList();
  }
  return skeleton;
}

template Skeleton<2> skeletonOf(const BlockMesh<2> &, const std::vector<Index> &);
template Skeleton<3> skeletonOf(const BlockMesh<3> &, const std::vector<Index> &);

} // namespace dualblock
