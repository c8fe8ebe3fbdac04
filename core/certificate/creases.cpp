// Where the blocks keep the domain's curves: edges at which the fan of blocks between two facets opens.
#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

/// Per face of a block and place in its cycle: the block's other face at the edge that begins there (2D: at
/// the node), from the cycles that buildBlockComplex gives the faces.
template <int N> constexpr auto acrossTable() {
  std::array<std::array<int, 1 << (N - 1)>, 2 * N> table{};
  for (int f = 0; f < 2 * N; ++f)
    for (int k = 0; k < 1 << (N - 1); ++k)
      for (int g = 0; g < 2 * N; ++g) {
        const auto has = [&](int corner) {
          for (int c = 0; c < 1 << (N - 1); ++c)
            if (faceCorner<N>(g, c) == corner) return true;
          return false;
        };
        if (g != f && has(faceCorner<N>(f, k)) && (N == 2 || has(faceCorner<N>(f, (k + 1) % 4))))
          table[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)] = g;
      }
  return table;
}
template <int N> constexpr auto kAcross = acrossTable<N>();

} // namespace

/// Turns around each edge of each block face on a facet, through the blocks, until another facet ends the
/// fan.
template <int N> std::vector<Crease> findCreases(const BlockInput<N> &in, const BlockComplex<N> &complex) {
  constexpr std::size_t kCorners = 1 << (N - 1);
  const auto nodeAt = [&](Index block, int local, std::size_t k) {
    return in.blocks.blocks[at(block)][at(faceCorner<N>(local, static_cast<int>(k % kCorners)))];
  };
  const auto place = [&](Index block, int local, Index node) {
    std::size_t k = 0;
    while (k < kCorners && nodeAt(block, local, k) != node) ++k;
    return k;
  };
  std::vector<Crease> creases;
  for (const BlockFace<N> &start : complex.faces) {
    if (facetOf(start) == kNone) continue;
    for (std::size_t k = 0; k < start.cycle.size(); ++k) {
      const Index a = start.cycle[k];
      const Index b = N == 2 ? a : start.cycle[(k + 1) % start.cycle.size()];
      Index block = start.block;
      int local = start.local;
      Crease crease{{kNone, kNone}, sortedPair(a, b), 0};
      while (at(crease.blocks) < in.blocks.blocks.size()) {
        ++crease.blocks;
        // The block's other face at a and b.
        std::size_t edge = place(block, local, a);
        if (N == 3 && nodeAt(block, local, edge + 1) != b) edge = place(block, local, b);
        if (edge == kCorners) break; // a face of the same nodes in another order: checkTopology says so
        local = kAcross<N>[at(local)][edge];
        if (const Index tag = in.blocks.tags[at(block)][at(local)]; tag != kNone) {
          crease.keys = {in.mesh.sideKey(start.tag), in.mesh.sideKey(tag)};
          break;
        }
        const Index next = complex.behind[at(2 * N * block + local)];
        if (next == kNone) break; // no facet where there is no block: checkFacets says so
        block = next / (2 * N);
        local = next % (2 * N);
      }
      if (crease.keys[0] < crease.keys[1]) creases.push_back(crease); // each fan is met from both of its ends
    }
  }
  sortByIndex(creases, 2 * in.mesh.surfaces.size(), [](const Crease &c) { return c.keys[0]; });
  creases.erase(std::unique(creases.begin(), creases.end()), creases.end());
  return creases;
}

template std::vector<Crease> findCreases(const BlockInput<2> &, const BlockComplex<2> &);
template std::vector<Crease> findCreases(const BlockInput<3> &, const BlockComplex<3> &);

} // namespace dualblock
