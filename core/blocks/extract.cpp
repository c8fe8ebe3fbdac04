#include "blocks/extract.h"

#include <tuple>

#include "base/sort.h"

namespace dualblock {
namespace {

/// An edge that the surface crosses, seen from one of its blocks.
struct Rung {
  std::array<Index, 2> nodes; // ascending
  Index patch;                // of a facet that the edge lies on, or kNone
};

/// The axis along which the surface crosses a block, kNone for none, or N where it crosses more than once.
template <int N> int axisOf(const BlockMesh<N> &mesh, std::size_t block, Index surface) {
  int axis = kNone;
  for (int a = 0; a < N; ++a)
    if (mesh.surfaces[block][at(a)] == surface) axis = axis == kNone ? a : N;
  return axis;
}

/// The edges that the surface crosses, sorted, each once per patch that it lies on and once for none.
template <int N>
std::vector<Rung> rungsOf(const ReferenceMesh<N> &mesh, const BlockMesh<N> &blocks,
                          const std::vector<int> &axis) {
  std::vector<Rung> rungs;
  for (std::size_t b = 0; b < axis.size(); ++b) {
    if (axis[b] < 0) continue;
    for (int f = 0; f < 2 * N; ++f) {
      if (f / 2 == axis[b]) continue;
      const Index tag = blocks.tags[b][at(f)];
      const Index patch = tag == kNone ? kNone : mesh.sideKey(tag) / 2;
      for (int k = 0; k < 1 << (N - 1); ++k)
        for (int m = 0; m < k; ++m) {
          const auto low = at(faceCorner<N>(f, k));
          const auto high = at(faceCorner<N>(f, m));
          if ((kBlockBits<N>[low] ^ kBlockBits<N>[high]) != 1U << axis[b]) continue;
          rungs.push_back({sortedPair(blocks.blocks[b][low], blocks.blocks[b][high]), patch});
          rungs.push_back({rungs.back().nodes, kNone});
        }
    }
  }
  sortByIndex(
      rungs, blocks.positions.size(), [](const Rung &r) { return r.nodes[0]; },
      [](const Rung &a, const Rung &b) { return std::tie(a.nodes, a.patch) < std::tie(b.nodes, b.patch); });
  rungs.erase(
      std::unique(rungs.begin(), rungs.end(),
                  [](const Rung &a, const Rung &b) { return a.nodes == b.nodes && a.patch == b.patch; }),
      rungs.end());
  return rungs;
}

/// A face of a block, by its nodes.
template <int N> struct FaceKey {
  std::array<Index, 1 << (N - 1)> nodes; // ascending
  Index block;
  int local;
};

/// What lies behind a collapsing block becomes the face that was in front of it: facets are handed through.
template <int N> void handTagsOn(BlockMesh<N> &blocks, const std::vector<int> &axis) {
  std::vector<FaceKey<N>> faces;
  for (std::size_t b = 0; b < axis.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) {
      FaceKey<N> key{{}, toIndex(b), f};
      for (std::size_t k = 0; k < key.nodes.size(); ++k)
        key.nodes[k] = blocks.blocks[b][at(faceCorner<N>(f, static_cast<int>(k)))];
      sortItems(key.nodes);
      faces.push_back(key);
    }
  sortByIndex(
      faces, blocks.positions.size(), [](const FaceKey<N> &f) { return f.nodes[0]; },
      [](const FaceKey<N> &a, const FaceKey<N> &b) { return a.nodes < b.nodes; });
  std::vector<std::array<Index, 2>> received; // 2N * block + face, tag
  for (std::size_t f = 0; f + 1 < faces.size(); ++f) {
    if (faces[f].nodes != faces[f + 1].nodes) continue;
    for (const auto &[from, to] : {std::pair(faces[f], faces[f + 1]), std::pair(faces[f + 1], faces[f])}) {
      if (axis[at(from.block)] != from.local / 2) continue;
      const Index tag = blocks.tags[at(from.block)][at(from.local ^ 1)];
      if (tag != kNone) received.push_back({2 * N * to.block + to.local, tag});
    }
  }
  for (const auto &[slot, tag] : received) blocks.tags[at(slot / (2 * N))][at(slot % (2 * N))] = tag;
}

} // namespace

template <int N>
Extraction<N> extract(const ReferenceMesh<N> &mesh, const Freedom<N> &freedom, const BlockMesh<N> &blocks,
                      Index surface) {
  Extraction<N> result;
  const auto refuse = [&](const char *why) {
    result.why = why;
    return std::move(result);
  };
  std::vector<int> axis(blocks.blocks.size());
  bool any = false;
  for (std::size_t b = 0; b < axis.size(); ++b) {
    axis[b] = axisOf(blocks, b, surface);
    if (axis[b] == N) return refuse("the surface crosses itself");
    any |= axis[b] >= 0;
  }
  if (!any) return refuse("there is no such surface");
  if (std::find(axis.begin(), axis.end(), kNone) == axis.end()) return refuse("no block would be left");

  // Which nodes go together, and where to.
  const std::vector<Rung> rungs = rungsOf(mesh, blocks, axis);
  std::vector<Index> mate(blocks.positions.size(), kNone);
  BlockMesh<N> &out = result.blocks;
  out = blocks;
  for (std::size_t begin = 0, end = 0; begin < rungs.size(); begin = end) {
    const auto [u, v] = rungs[begin].nodes;
    while (end < rungs.size() && rungs[end].nodes == rungs[begin].nodes) ++end;
    const Index shared = toIndex(end - begin) - 1; // patches that the edge lies on
    if (mate[at(u)] != kNone || mate[at(v)] != kNone) return refuse("the surface touches itself");
    mate[at(u)] = v;
    mate[at(v)] = u;
    const Index ofU = freedom.patchCount(u);
    const Index ofV = freedom.patchCount(v);
    const bool canLose = (ofU == shared && !freedom.isFixed(u)) || (ofV == shared && !freedom.isFixed(v));
    if (freedom.commonPatches(u, v) != shared || !canLose)
      return refuse("a feature of the domain would be lost");
    const bool keepsU = ofU > shared || freedom.isFixed(u);
    const bool keepsV = ofV > shared || freedom.isFixed(v);
    Vec<N> x = (blocks.positions[at(u)] + blocks.positions[at(v)]) / 2.0;
    if (keepsU || (!keepsV && freedom.isBent(u))) x = blocks.positions[at(u)];
    if (keepsV) x = blocks.positions[at(v)];
    out.positions[at(u)] = x;
  }
  handTagsOn(out, axis);

  // What is left, numbered anew.
  std::vector<bool> touched(blocks.positions.size(), false);
  for (std::size_t b = 0; b < axis.size(); ++b) {
    bool near = false;
    for (const Index v : blocks.blocks[b]) near |= mate[at(v)] != kNone;
    if (near)
      for (const Index v : blocks.blocks[b]) touched[at(v)] = true;
  }
  std::vector<Index> number(blocks.positions.size(), kNone);
  Index count = 0;
  for (Index v = 0; v < blocks.nodeCount(); ++v) {
    if (mate[at(v)] != kNone && mate[at(v)] < v) {
      number[at(v)] = number[at(mate[at(v)])];
      continue;
    }
    out.positions[at(count)] = out.positions[at(v)];
    result.isNear.push_back(touched[at(v)]);
    number[at(v)] = count++;
  }
  out.positions.resize(at(count));
  std::size_t kept = 0;
  for (std::size_t b = 0; b < axis.size(); ++b) {
    if (axis[b] >= 0) continue;
    auto block = blocks.blocks[b];
    for (Index &v : block) v = number[at(v)];
    auto sorted = block;
    sortItems(sorted);
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      return refuse("a block would be flattened");
    out.blocks[kept] = block;
    out.tags[kept] = out.tags[b];
    out.surfaces[kept] = out.surfaces[b];
    out.part[kept] = out.part[b];
    ++kept;
  }
  out.blocks.resize(kept);
  out.tags.resize(kept);
  out.surfaces.resize(kept);
  out.part.resize(kept);
  return result;
}

template Extraction<2> extract(const ReferenceMesh<2> &, const Freedom<2> &, const BlockMesh<2> &, Index);
template Extraction<3> extract(const ReferenceMesh<3> &, const Freedom<3> &, const BlockMesh<3> &, Index);

} // namespace dualblock
