#include "dual/dual_cells.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace dualblock {
namespace {

/// Calls unite(a, b) for the classes a of s and b of its neighbour that touch across face i.
template <int N, typename Unite>
void uniteAcross(const ReferenceMesh<N> &mesh, const Contributions<N> &contributions,
                 const std::vector<Index> &offset, ClassCache<N> &cache, Index s, int i, Unite unite) {
  const Index t = mesh.neighbors[at(s)][i];
  const ContributionSet here = contributions.present[at(s)];
  const ContributionSet there = contributions.present[at(t)];
  if (here == 0 && there == 0) {
    unite(offset[at(s)], offset[at(t)]);
    return;
  }
  const int k = mesh.mirrorFace(s, i);
  const auto &tables = RegionTables<N>::get();
  const auto &mine = tables.onFace(i, faceOrder<N>(mesh.simplices[at(s)], i));
  const auto &theirs = tables.onFace(k, faceOrder<N>(mesh.simplices[at(t)], k));
  const auto &myClass = cache[here].ofRegion;
  const auto &theirClass = cache[there].ofRegion;
  std::array<std::uint8_t, RegionTables<N>::kRegions> partner; // several regions lie in one pair of classes
  partner.fill(0xff);
  for (std::size_t r = 0; r < mine.size(); ++r) {
    std::uint8_t &known = partner[myClass[mine[r]]];
    if (known == theirClass[theirs[r]]) continue;
    known = theirClass[theirs[r]];
    unite(offset[at(s)] + myClass[mine[r]], offset[at(t)] + theirClass[theirs[r]]);
  }
}

/// The sides whose D-bar-surfaces this class of simplex s lies inside of. False if there are more than N.
template <int N>
bool labelOf(const Contributions<N> &contributions, Index s, ContributionSet inside,
             std::array<Index, N> &label) {
  label.fill(kNone);
  std::size_t n = 0;
  for (const Contribution *c = contributions.ofSimplex.begin(s); c != contributions.ofSimplex.end(s); ++c) {
    if (!(inside & contributionBit(c->mask))) continue;
    if (n == N) return false;
    label[n++] = c->side; // a simplex lists its sides in ascending order
  }
  return true;
}

template <int N> bool labelLess(const CellPiece<N> &a, const CellPiece<N> &b) {
  if (a.part != b.part) return a.part < b.part;
  for (std::size_t k = 0; k + 1 < N; ++k)
    if (a.sides[k] != b.sides[k]) return a.sides[k] < b.sides[k];
  return a.sides[N - 1] < b.sides[N - 1];
}

} // namespace

template <int N> Index DualCells<N>::findPiece(Index part, const std::array<Index, N> &sides) const {
  const CellPiece<N> wanted{part, sides, kNone};
  const auto end = pieces.begin() + partOffset[at(part) + 1];
  const auto found = std::lower_bound(pieces.begin() + partOffset[at(part)], end, wanted, labelLess<N>);
  if (found == end || labelLess(wanted, *found)) return kNone;
  return toIndex(static_cast<std::size_t>(found - pieces.begin()));
}

template <int N>
DualCells<N> buildDualCells(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                            const Contributions<N> &contributions, const Earlier<DualCells<N>> &earlier) {
  DualCells<N> dual;
  ClassCache<N> cache;
  dual.classOffset.reserve(mesh.simplices.size() + 1);
  dual.classOffset.push_back(0);
  for (const ContributionSet present : contributions.present)
    dual.classOffset.push_back(dual.classOffset.back() +
                               (present == 0 ? 1 : toIndex(cache[present].inside.size())));
  const std::vector<Index> &offset = dual.classOffset;

  // Inside the parts first: pieces, in the order of their first places.
  const Index knownCount = toIndex(std::max(earlier.found.classOffset.size(), std::size_t{1})) - 1;
  const auto isKnown = [&](Index s) {
    return N == 3 && s < knownCount && earlier.holds[at(parts.partOfSimplex[at(s)])];
  };
  DisjointSets sets(at(offset.back()));
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i)
      if (mesh.neighbors[at(s)][i] > s && mesh.tags[at(s)][i] == kNone && !isKnown(s))
        uniteAcross(mesh, contributions, offset, cache, s, i, [&](Index a, Index b) { sets.unite(a, b); });
  dual.pieceOf.resize(at(offset.back()));
  std::vector<CellPiece<N>> made;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    if (isKnown(s)) continue;
    for (Index c = offset[at(s)]; c < offset[at(s) + 1]; ++c) {
      const Index root = sets.find(c);
      if (root == c) {
        dual.pieceOf[at(c)] = toIndex(made.size());
        made.push_back({parts.partOfSimplex[at(s)], {}, dual.pieceOf[at(c)]}); // until it has a cell
        const ContributionSet inside = cache[contributions.present[at(s)]].inside[at(c - offset[at(s)])];
        if (!labelOf<N>(contributions, s, inside, made.back().sides)) dual.overfull = true;
      }
      dual.pieceOf[at(c)] = dual.pieceOf[at(root)];
    }
  }

  // Their order by part and label.
  sortByIndex(
      made, parts.parts.size(), [](const CellPiece<N> &piece) { return piece.part; }, labelLess<N>);
  dual.partOffset.assign(1, 0);
  std::vector<Index> rank(made.size());
  for (Index part = 0, next = 0; part < toIndex(parts.parts.size()); ++part) {
    if (N == 3 && at(part) < earlier.holds.size() && earlier.holds[at(part)])
      for (Index p = earlier.found.partOffset[at(part)]; p < earlier.found.partOffset[at(part) + 1]; ++p)
        dual.pieces.push_back(earlier.found.pieces[at(p)]);
    for (; at(next) < made.size() && made[at(next)].part == part; ++next) {
      rank[at(made[at(next)].cell)] = toIndex(dual.pieces.size());
      dual.pieces.push_back(made[at(next)]);
    }
    dual.partOffset.push_back(toIndex(dual.pieces.size()));
  }
  for (std::size_t k = 1; k < dual.pieces.size(); ++k)
    if (!labelLess(dual.pieces[k - 1], dual.pieces[k])) dual.surplus.push_back(toIndex(k));
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    const std::size_t part = at(parts.partOfSimplex[at(s)]);
    const bool known = isKnown(s);
    const Index *before = known ? earlier.found.pieceOf.data() + earlier.found.classOffset[at(s)] : nullptr;
    const Index moved = known ? dual.partOffset[part] - earlier.found.partOffset[part] : 0;
    for (Index c = offset[at(s)]; c < offset[at(s) + 1]; ++c) {
      Index &piece = dual.pieceOf[at(c)];
      piece = known ? *before++ + moved : rank[at(piece)];
    }
  }

  // Across the split surfaces: cells.
  if (!dual.surplus.empty()) return dual;
  DisjointSets cells(dual.pieces.size());
  for (Index side = 0; side < toIndex(parts.sides.size()); ++side) {
    for (const FaceRef<N> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f) {
      if (mesh.neighbors[at(f->simplex)][f->face] <= f->simplex) continue;
      uniteAcross(mesh, contributions, offset, cache, f->simplex, f->face,
                  [&](Index a, Index b) { cells.unite(dual.pieceOf[at(a)], dual.pieceOf[at(b)]); });
    }
  }
  const std::vector<Index> number = cells.numbering(dual.cellCount);
  for (std::size_t p = 0; p < dual.pieces.size(); ++p) dual.pieces[p].cell = number[p];
  return dual;
}

template <int N> DualSurfaces buildDualSurfaces(const Parts<N> &parts) {
  // Each curve, seen from each of its two sides that lies on a split surface: (side, first ridge) -> other.
  struct Contact {
    Index side; // the lower one of the split surface's two sides
    std::array<Index, N - 1> ridge;
    Index continues; // the side that arrives at the split surface there
    bool operator<(const Contact &o) const { return side != o.side ? side < o.side : ridge < o.ridge; }
  };
  std::vector<Contact> contacts;
  for (const Curve<N> &curve : parts.curves)
    for (int k = 0; k < 2; ++k) {
      const Index side = curve.sides[at(k)];
      const Index opposite = parts.sides[at(side)].opposite;
      if (opposite == kNone) continue;
      const auto first = *std::min_element(curve.ridges.begin(), curve.ridges.end());
      contacts.push_back({std::min(side, opposite), first, curve.sides[at(1 - k)]});
    }
  sortItems(contacts);
  DisjointSets sets(parts.sides.size());
  for (std::size_t c = 0; c + 1 < contacts.size(); ++c)
    if (contacts[c].side == contacts[c + 1].side && contacts[c].ridge == contacts[c + 1].ridge)
      sets.unite(contacts[c].continues, contacts[c + 1].continues);
  DualSurfaces surfaces;
  surfaces.ofSide = sets.numbering(surfaces.count);
  return surfaces;
}

template struct DualCells<2>;
template struct DualCells<3>;
template DualCells<2> buildDualCells(const ReferenceMesh<2> &, const Parts<2> &, const Contributions<2> &,
                                     const Earlier<DualCells<2>> &);
template DualCells<3> buildDualCells(const ReferenceMesh<3> &, const Parts<3> &, const Contributions<3> &,
                                     const Earlier<DualCells<3>> &);
template DualSurfaces buildDualSurfaces<2>(const Parts<2> &);
template DualSurfaces buildDualSurfaces<3>(const Parts<3> &);

} // namespace dualblock
