#include "primal/primal.h"

#include <tuple>

#include "base/sort.h"

namespace dualblock {
namespace {

/// Two indices in one number, which orders as they do.
std::uint64_t packed(Index a, Index b) { return std::uint64_t{at(a)} << 32 | at(b); }

auto keyOf(const PrimalEdge &e) {
  return std::array{packed(e.nodes[0], e.nodes[1]), std::uint64_t{at(e.surface)}};
}
auto keyOf(const PrimalFace &f) {
  return std::array{packed(f.nodes[0], f.nodes[1]), packed(f.nodes[2], f.nodes[3]),
                    packed(f.surfaces[0], f.surfaces[1])};
}

template <typename T> bool areEqual(const std::vector<T> &a, const std::vector<T> &b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T &x, const T &y) { return keyOf(x) == keyOf(y); });
}

template <typename T> void sortUnique(std::vector<T> &items, Index nodeCount) {
  sortByIndex(
      items, at(nodeCount), [](const T &item) { return item.nodes[0]; },
      [](const T &a, const T &b) { return keyOf(a) < keyOf(b); });
  const auto isSame = [](const T &a, const T &b) { return keyOf(a) == keyOf(b); };
  items.erase(std::unique(items.begin(), items.end(), isSame), items.end());
}

PrimalEdge makeEdge(Index a, Index b, Index surface) { return {{std::min(a, b), std::max(a, b)}, surface}; }

/// The face through four nodes in a cycle, brought into its one form.
PrimalFace makeFace(std::array<Index, 4> cycle, Index surfaceA, Index surfaceB) {
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  if (cycle[3] < cycle[1]) std::swap(cycle[1], cycle[3]);
  return {cycle, {std::min(surfaceA, surfaceB), std::max(surfaceA, surfaceB)}};
}

/// Edges and faces met while walking over the contributions, or over the blocks, noted at the piece with the
/// longer label so that each is kept once, however many simplices or blocks show it.
template <int N> class DualWalk {
public:
  DualWalk(const DualCells<N> &dual, const DualSurfaces &surfaces)
      : dual_(dual), surfaces_(surfaces), edgeTo_(dual.pieces.size()), faceSeen_(dual.pieces.size(), 0) {
    for (auto &row : edgeTo_) row.fill(kNone);
  }

  /// A hard contribution of `side` separates two pieces.
  void meetEdge(Index inner, Index outer, Index side) {
    const int slot = dual_.pieces[at(inner)].slot(side);
    if (slot < 0) return;
    Index &to = edgeTo_[at(inner)][at(slot)];
    if (to == kNone) to = outer;
    if (to != outer) torn = true;
  }

  /// The D-bar-surfaces of two sides cross at the piece inside both.
  void meetFace(Index inner, Index sideA, Index sideB) {
    const int a = dual_.pieces[at(inner)].slot(sideA);
    const int b = dual_.pieces[at(inner)].slot(sideB);
    if (a < 0 || b < 0) return;
    faceSeen_[at(inner)] =
        static_cast<std::uint16_t>(faceSeen_[at(inner)] | 1U << (a * N + b) | 1U << (b * N + a));
  }

  bool hasEdgesOf(const DualWalk &o) const { return edgeTo_ == o.edgeTo_; }
  bool hasFacesOf(const DualWalk &o) const { return faceSeen_ == o.faceSeen_; }

  std::vector<PrimalEdge> edges() const {
    std::vector<PrimalEdge> list;
    list.reserve(N * edgeTo_.size());
    for (std::size_t p = 0; p < edgeTo_.size(); ++p)
      for (std::size_t k = 0; k < N; ++k)
        if (edgeTo_[p][k] != kNone)
          list.push_back(makeEdge(dual_.pieces[p].cell, dual_.pieces[at(edgeTo_[p][k])].cell,
                                  surfaces_.ofSide[at(dual_.pieces[p].sides[k])]));
    sortUnique(list, dual_.cellCount);
    return list;
  }

  std::vector<PrimalFace> faces() {
    std::vector<PrimalFace> list;
    list.reserve(N * faceSeen_.size());
    for (std::size_t p = 0; p < faceSeen_.size(); ++p)
      for (int a = 0; a < N; ++a)
        for (int b = a + 1; b < N; ++b) {
          if (!(faceSeen_[p] >> (a * N + b) & 1)) continue;
          const CellPiece<N> &inner = dual_.pieces[p];
          const Index onA = across(toIndex(p), b);
          const Index onB = across(toIndex(p), a);
          const Index outer = onA == kNone ? kNone : across(onA, a);
          if (onA == kNone || onB == kNone || outer == kNone) {
            torn = true;
            continue;
          }
          list.push_back(makeFace({inner.cell, dual_.pieces[at(onA)].cell, dual_.pieces[at(outer)].cell,
                                   dual_.pieces[at(onB)].cell},
                                  surfaces_.ofSide[at(inner.sides[at(a)])],
                                  surfaces_.ofSide[at(inner.sides[at(b)])]));
        }
    sortUnique(list, dual_.cellCount);
    return list;
  }

  bool torn = false;

private:
  /// The piece whose label lacks a slot of this one's.
  Index across(Index p, int slot) const {
    if (const Index to = edgeTo_[at(p)][at(slot)]; to != kNone) return to;
    const CellPiece<N> &piece = dual_.pieces[at(p)];
    std::array<Index, N> label;
    label.fill(kNone);
    for (int k = 0, m = 0; k < N; ++k)
      if (k != slot) label[at(m++)] = piece.sides[at(k)];
    return dual_.findPiece(piece.part, label);
  }

  const DualCells<N> &dual_;
  const DualSurfaces &surfaces_;
  std::vector<std::array<Index, N>> edgeTo_;
  std::vector<std::uint16_t> faceSeen_;
};

template <int N>
void walkContributions(const Contributions<N> &contributions, const DualCells<N> &dual, ClassCache<N> &cache,
                       DualWalk<N> &walk) {
  struct Sides {
    int count;
    Index first, second;
  };
  std::array<Sides, std::size_t{1} << (N + 1)> sidesOf; // per mask
  for (Index s = 0; s < contributions.ofSimplex.count(); ++s) {
    const ContributionSet present = contributions.present[at(s)];
    if (present == 0) continue;
    sidesOf.fill({0, kNone, kNone});
    for (const Contribution *c = contributions.ofSimplex.begin(s); c != contributions.ofSimplex.end(s); ++c)
      if (Sides &sides = sidesOf[c->mask]; sides.count++ == 0) sides.first = c->side;
      else sides.second = c->side;
    const auto &classes = cache[present];
    const Index offset = dual.classOffset[at(s)];
    for (const auto &step : classes.steps) {
      const Index inner = dual.pieceOf[at(offset + step.inner)];
      const Index outer = dual.pieceOf[at(offset + step.outer)];
      const Sides &sides = sidesOf[step.mask];
      if (sides.count == 1) walk.meetEdge(inner, outer, sides.first);
      if (sides.count == 2) walk.meetFace(inner, sides.first, sides.second); // soft: two surfaces cross here
    }
    for (const auto &crossing : classes.crossings) { // of two hard contributions
      const Sides &a = sidesOf[crossing.maskA];
      const Sides &b = sidesOf[crossing.maskB];
      if (a.count == 1 && b.count == 1)
        walk.meetFace(dual.pieceOf[at(offset + crossing.inner)], a.first, b.first);
    }
  }
}

/// Two D-bar-surfaces may also cross on a face of the reference mesh: their traces there are one (paper 4.3,
/// case iii), and of the two the one inside on the left is the one outside on the right. That shows from
/// either side of the face.
template <int N>
void walkCommonTraces(const ReferenceMesh<N> &mesh, const Contributions<N> &contributions,
                      const DualCells<N> &dual, ClassCache<N> &cache, DualWalk<N> &walk) {
  const auto &tables = RegionTables<N>::get();
  const auto maskIn = [&](Index s, Index side) -> unsigned {
    for (const Contribution *c = contributions.ofSimplex.begin(s); c != contributions.ofSimplex.end(s); ++c)
      if (c->side == side) return c->mask;
    return 0;
  };
  const auto crossAt = [&](Index s, int i, const Contribution &in, const Contribution &out) {
    // `in` misses the vertex opposite to the face, `out` has it: `in` lies inside of `out` in s.
    const ContributionSet both =
        static_cast<ContributionSet>(contributionBit(in.mask) | contributionBit(in.mask | 1U << i));
    const auto &row = tables.onFace(i, 0);
    for (const std::uint8_t a : row) {
      const ContributionSet inside = tables.regions()[a];
      if ((inside & both) != both) continue;
      const bool hasNeighbour = std::any_of(row.begin(), row.end(), [&](std::uint8_t b) {
        return tables.regions()[b] == static_cast<ContributionSet>(inside & ~both);
      });
      if (!hasNeighbour) continue;
      const std::uint8_t c = cache[contributions.present[at(s)]].ofRegion[a];
      walk.meetFace(dual.pieceOf[at(dual.classOffset[at(s)] + c)], in.side, out.side);
    }
  };
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    if (contributions.ofSimplex.size(s) < 2) continue;
    const Contribution *const end = contributions.ofSimplex.end(s);
    for (int i = 0; i < N + 1; ++i) {
      const Index t = mesh.neighbors[at(s)][i];
      if (t < s || mesh.tags[at(s)][i] != kNone || contributions.ofSimplex.size(t) < 2) continue;
      const unsigned apex = 1U << i;
      const unsigned face = RegionTables<N>::kFullMask & ~apex;
      for (const Contribution *in = contributions.ofSimplex.begin(s); in != end; ++in) {
        if ((in->mask & apex) || (in->mask & face) == face ||
            !(contributions.present[at(s)] & contributionBit(in->mask | apex)))
          continue;
        for (const Contribution *out = contributions.ofSimplex.begin(s); out != end; ++out) {
          if (out->mask != (in->mask | apex)) continue;
          const unsigned apexThere = 1U << mesh.mirrorFace(s, i);
          if ((maskIn(t, in->side) & apexThere) && !(maskIn(t, out->side) & apexThere))
            crossAt(s, i, *in, *out);
        }
      }
    }
  }
}

} // namespace

template <int N>
Primal<N> buildPrimal(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                      const Contributions<N> &contributions, const DualCells<N> &dual,
                      const DualSurfaces &surfaces) {
  Primal<N> primal;
  primal.nodeCount = dual.cellCount;
  primal.nodePiece.assign(at(dual.cellCount), kNone);
  for (std::size_t p = 0; p < dual.pieces.size(); ++p)
    if (primal.nodePiece[at(dual.pieces[p].cell)] == kNone)
      primal.nodePiece[at(dual.pieces[p].cell)] = toIndex(p);

  // From the blocks.
  DualWalk<N> blockWalk(dual, surfaces);
  primal.blocks.reserve(parts.corners.size());
  for (const Corner &corner : parts.corners) {
    if (corner.sides.size() != N) continue;
    Block<N> block{corner.part, {}, {}};
    std::copy(corner.sides.begin(), corner.sides.end(), block.sides.begin());
    std::array<Index, 1 << N> byBits; // pieces
    bool complete = true;
    for (unsigned bits = 0; bits < 1U << N; ++bits) {
      std::array<Index, N> label;
      label.fill(kNone);
      for (int k = 0, m = 0; k < N; ++k)
        if (bits >> k & 1) label[at(m++)] = block.sides[at(k)];
      byBits[bits] = dual.findPiece(corner.part, label);
      complete &= byBits[bits] != kNone;
    }
    if (!complete) {
      primal.faults.push_back("the corner of part " + std::to_string(corner.part) + " at node " +
                              std::to_string(corner.node) + " has no D-bar-node");
      continue;
    }
    for (std::size_t k = 0; k < block.nodes.size(); ++k)
      block.nodes[k] = dual.pieces[at(byBits[kBlockBits<N>[k]])].cell;
    primal.blocks.push_back(block);
    for (unsigned bits = 0; bits < 1U << N; ++bits)
      for (int i = 0; i < N; ++i) {
        if (bits >> i & 1) continue;
        blockWalk.meetEdge(byBits[bits | 1U << i], byBits[bits], block.sides[at(i)]);
        for (int k = i + 1; k < N; ++k)
          if (!(bits >> k & 1))
            blockWalk.meetFace(byBits[bits | 1U << i | 1U << k], block.sides[at(i)], block.sides[at(k)]);
      }
  }

  // From the dual.
  DualWalk<N> walk(dual, surfaces);
  ClassCache<N> cache;
  walkContributions(contributions, dual, cache, walk);
  walkCommonTraces(mesh, contributions, dual, cache, walk);
  primal.edges = walk.edges();
  primal.faces = walk.faces();
  if (walk.torn) primal.faults.push_back("two D-bar-cells stand on one side of the same D-bar-face");
  // Piece by piece they mostly are the same; if not, one part may still show what another one does not.
  if (!walk.hasEdgesOf(blockWalk) && !areEqual(primal.edges, blockWalk.edges()))
    primal.faults.push_back("the edges of the blocks are not those that hard contributions give");
  if (!walk.hasFacesOf(blockWalk) && !areEqual(primal.faces, blockWalk.faces()))
    primal.faults.push_back("the faces of the blocks are not those that crossing D-bar-surfaces give");
  return primal;
}

template Primal<2> buildPrimal(const ReferenceMesh<2> &, const Parts<2> &, const Contributions<2> &,
                               const DualCells<2> &, const DualSurfaces &);
template Primal<3> buildPrimal(const ReferenceMesh<3> &, const Parts<3> &, const Contributions<3> &,
                               const DualCells<3> &, const DualSurfaces &);

} // namespace dualblock
