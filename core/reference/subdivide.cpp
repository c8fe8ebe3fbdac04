#include "reference/subdivide.h"

#include <tuple>

#include "base/sort.h"

namespace dualblock {
namespace {

template <int N> struct Piece {
  std::array<Index, N + 1> nodes;
  std::array<Index, N + 1> tags;
};

/// The first edge of the piece, in the global order, that is to be split.
template <int N>
const EdgeSplit *firstSplit(std::span<const EdgeSplit> edges, const std::array<Index, N + 1> &nodes, int &ia,
                            int &ib) {
  const EdgeSplit *best = nullptr;
  for (int i = 0; i < N + 1; ++i)
    for (int k = i + 1; k < N + 1; ++k) {
      const Index a = std::min(nodes[i], nodes[k]);
      const Index b = std::max(nodes[i], nodes[k]);
      const auto found = std::lower_bound(edges.begin(), edges.end(), std::pair(a, b),
                                          [](const EdgeSplit &e, const std::pair<Index, Index> &key) {
                                            return e.a != key.first ? e.a < key.first : e.b < key.second;
                                          });
      if (found == edges.end() || found->a != a || found->b != b) continue;
      if (best && best->node < found->node) continue;
      best = &*found;
      ia = i;
      ib = k;
    }
  return best;
}

/// A set of simplices on its way to being replaced by pieces. Faces on its rim are not divided.
template <int N> class Patch {
public:
  /// `affected`: ascending, without repeats. Remembers what lies behind the rim.
  Patch(ReferenceMesh<N> &mesh, std::vector<Index> &affected) : mesh_(mesh), affected_(affected) {
    mesh.nodeSimplex.resize(mesh.nodes.size(), kNone);
    for (const Index s : affected)
      for (int i = 0; i < N + 1; ++i) {
        const Index t = mesh.neighbors[at(s)][i];
        if (t != kNone && !std::binary_search(affected.begin(), affected.end(), t))
          halves_.push_back({mesh.sortedFace(s, i), t, mesh.mirrorFace(s, i)});
      }
  }

  /// Puts a piece in the place of `parent` (its first piece), or at the end.
  void place(Index parent, bool first, const Piece<N> &piece) {
    Index s = parent;
    if (!first) {
      s = mesh_.simplexCount();
      mesh_.simplices.emplace_back();
      mesh_.tags.emplace_back();
      mesh_.neighbors.emplace_back();
      mesh_.region.push_back(mesh_.region[at(parent)]);
      mesh_.component.push_back(mesh_.component[at(parent)]);
      affected_.push_back(s);
    }
    mesh_.simplices[at(s)] = piece.nodes;
    mesh_.tags[at(s)] = piece.tags;
    mesh_.neighbors[at(s)].fill(kNone);
    for (const Index v : piece.nodes) mesh_.nodeSimplex[at(v)] = s;
  }

  /// Joins the pieces with one another and with what lies behind the rim.
  void relink() {
    for (const Index s : affected_)
      for (int i = 0; i < N + 1; ++i) halves_.push_back({mesh_.sortedFace(s, i), s, i});
    sortItems(halves_, [](const HalfFace &a, const HalfFace &b) {
      return std::tie(a.key, a.simplex) < std::tie(b.key, b.simplex);
    });
    for (std::size_t h = 0; h + 1 < halves_.size(); ++h) {
      if (halves_[h].key != halves_[h + 1].key) continue;
      mesh_.neighbors[at(halves_[h].simplex)][halves_[h].face] = halves_[h + 1].simplex;
      mesh_.neighbors[at(halves_[h + 1].simplex)][halves_[h + 1].face] = halves_[h].simplex;
      ++h;
    }
  }

private:
  struct HalfFace {
    std::array<Index, N> key;
    Index simplex;
    int face;
  };
  ReferenceMesh<N> &mesh_;
  std::vector<Index> &affected_;
  std::vector<HalfFace> halves_;
};

} // namespace

Index splitNode(std::span<const EdgeSplit> edges, Index a, Index b) {
  if (a > b) std::swap(a, b);
  for (std::size_t low = 0, high = edges.size(); low < high;) {
    const std::size_t mid = (low + high) / 2;
    const EdgeSplit &e = edges[mid];
    if (e.a == a && e.b == b) return e.node;
    if (e.a < a || (e.a == a && e.b < b)) low = mid + 1;
    else high = mid;
  }
  return kNone;
}

template <int N>
void subdivide(ReferenceMesh<N> &mesh, std::span<const EdgeSplit> edges, std::vector<Index> &affected) {
  sortItems(affected);
  affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
  Patch<N> patch(mesh, affected);

  // Split each simplex at its first edge, then both pieces, and so on.
  const std::size_t parents = affected.size();
  std::vector<Piece<N>> stack;
  for (std::size_t p = 0; p < parents; ++p) {
    const Index parent = affected[p];
    bool first = true;
    stack.assign(1, {mesh.simplices[at(parent)], mesh.tags[at(parent)]});
    while (!stack.empty()) {
      const Piece<N> piece = stack.back();
      stack.pop_back();
      int ia = 0;
      int ib = 0;
      if (const EdgeSplit *split = firstSplit<N>(edges, piece.nodes, ia, ib)) {
        // The new face between the two pieces is inner; each other face lies in one of the old ones.
        Piece<N> near = piece;
        Piece<N> far = piece;
        near.nodes[ib] = split->node;
        near.tags[ia] = kNone;
        far.nodes[ia] = split->node;
        far.tags[ib] = kNone;
        stack.push_back(far);
        stack.push_back(near);
        continue;
      }
      patch.place(parent, first, piece);
      first = false;
    }
  }
  patch.relink();
}

template <int N> void splitFace(ReferenceMesh<N> &mesh, FaceRef<N> face) {
  const Index node = mesh.nodeCount();
  Vec<N> centre{0.0};
  for (const Index v : mesh.sortedFace(face.simplex, face.face))
    centre += mesh.nodes[at(v)] / static_cast<double>(N);
  mesh.nodes.push_back(centre);
  std::vector<FaceRef<N>> both{face};
  const Index other = mesh.neighbors[at(face.simplex)][face.face];
  if (other != kNone) both.push_back({other, mesh.mirrorFace(face.simplex, face.face)});
  std::vector<Index> affected;
  for (const FaceRef<N> &f : both) affected.push_back(f.simplex);
  sortItems(affected);
  Patch<N> patch(mesh, affected);
  for (const FaceRef<N> &f : both) {
    const Piece<N> whole{mesh.simplices[at(f.simplex)], mesh.tags[at(f.simplex)]};
    bool first = true;
    for (int v = 0; v < N + 1; ++v) {
      if (v == f.face) continue;
      Piece<N> piece = whole; // `node` in the place of v: only the faces opposite to v and to f stay old
      piece.nodes[v] = node;
      for (int k = 0; k < N + 1; ++k)
        if (k != v && k != f.face) piece.tags[k] = kNone;
      patch.place(f.simplex, first, piece);
      first = false;
    }
  }
  patch.relink();
}

template void splitFace(ReferenceMesh<2> &, FaceRef<2>);
template void splitFace(ReferenceMesh<3> &, FaceRef<3>);
template void subdivide(ReferenceMesh<2> &, std::span<const EdgeSplit>, std::vector<Index> &);
template void subdivide(ReferenceMesh<3> &, std::span<const EdgeSplit>, std::vector<Index> &);

} // namespace dualblock
