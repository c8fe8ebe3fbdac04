#include "contributions/contributions.h"

#include "base/sort.h"
#include <bit>

namespace dualblock {
namespace {

/// Whether the face of s spanned by `mask` lies on the side.
template <int N>
bool faceIsOnSide(const ReferenceMesh<N> &mesh, const Parts<N> &parts, Index s, Contribution c) {
  const int i = std::countr_one(unsigned{c.mask});
  if (mesh.tags[at(s)][i] == kNone) return false;
  const FaceRef<N> *const begin = parts.sideFaces.begin(c.side);
  const FaceRef<N> *const end = parts.sideFaces.end(c.side);
  // A side lists its faces by simplex, then by face.
  const FaceRef<N> *const found = std::lower_bound(begin, end, s, [i](const FaceRef<N> &f, Index simplex) {
    return f.simplex != simplex ? f.simplex < simplex : f.face < i;
  });
  return found != end && found->simplex == s && found->face == i;
}

/// Whether an edge between two nodes of the side, within `mask`, is none of the side's: only bent sides have
/// those.
template <int N>
bool hasForeignEdge(const ReferenceMesh<N> &mesh, const SideEdges &edges, Index s, Contribution c) {
  const auto &v = mesh.simplices[at(s)];
  for (int i = 0; i < N + 1; ++i)
    for (int k = i + 1; k < N + 1; ++k)
      if ((c.mask >> i & 1) && (c.mask >> k & 1) && !edges.has(c.side, v[i], v[k])) return true;
  return false;
}

/// The sides of its part that simplex s touches, ascending, and where.
template <int N>
void findSides(const ReferenceMesh<N> &mesh, const Parts<N> &parts, Index s,
               std::vector<Contribution> &here) {
  here.clear();
  const Index part = parts.partOfSimplex[at(s)];
  const Index firstSide = parts.partSides.offsets[at(part)]; // a part's sides are numbered in a row
  const Index endSide = parts.partSides.offsets[at(part) + 1];
  for (int v = 0; v < N + 1; ++v) {
    const Index node = mesh.simplices[at(s)][v];
    const Index *const end = parts.nodeSides.end(node);
    const Index *side = parts.nodeSides.begin(node);
    if (side == end) continue;
    for (side = std::lower_bound(side, end, firstSide); side != end && *side < endSide; ++side) {
      auto known =
          std::find_if(here.begin(), here.end(), [&](const Contribution &c) { return c.side == *side; });
      if (known == here.end()) known = here.insert(known, {*side, 0});
      known->mask = static_cast<std::uint8_t>(known->mask | 1U << v);
    }
  }
  sortItems(here, [](const Contribution &a, const Contribution &b) { return a.side < b.side; });
}

} // namespace

template <int N>
SideEdges::SideEdges(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const std::vector<bool> &wanted) {
  for (Index side = 0; side < toIndex(parts.sides.size()); ++side) {
    if (!wanted[at(side)]) continue;
    for (const FaceRef<N> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f) {
      const auto face = mesh.sortedFace(f->simplex, f->face);
      for (std::size_t a = 0; a < N; ++a)
        for (std::size_t b = a + 1; b < N; ++b) edges_.push_back({side, face[a], face[b]});
    }
  }
  sortItems(edges_);
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

bool SideEdges::has(Index side, Index a, Index b) const {
  return std::binary_search(edges_.begin(), edges_.end(),
                            std::array<Index, 3>{side, std::min(a, b), std::max(a, b)});
}

template SideEdges::SideEdges(const ReferenceMesh<2> &, const Parts<2> &, const std::vector<bool> &);
template SideEdges::SideEdges(const ReferenceMesh<3> &, const Parts<3> &, const std::vector<bool> &);

template <int N>
Contributions<N> assignContributions(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                                     const Earlier<Contributions<N>> &earlier) {
  std::vector<bool> bent(parts.sides.size(), false);
  for (std::size_t side = 0; side < bent.size(); ++side)
    bent[side] = mesh.surfaces[at(FaceTag::surface(parts.sides[side].tag))].bent &&
                 parts.sideFaces.size(toIndex(side)) > 1;
  const SideEdges bentEdges(mesh, parts, bent);
  Contributions<N> result;
  const std::size_t count = mesh.simplices.size();
  result.ofSimplex.offsets.reserve(count + 1);
  result.ofSimplex.items.reserve(4 * count);
  result.present.assign(count, 0);
  result.soft.assign(count, 0);
  std::vector<Contribution> here;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    const bool isKnown =
        N == 3 && s < earlier.found.ofSimplex.count() && earlier.holds[at(parts.partOfSimplex[at(s)])];
    if (isKnown) here.assign(earlier.found.ofSimplex.begin(s), earlier.found.ofSimplex.end(s));
    else findSides(mesh, parts, s, here);
    for (const Contribution &c : here) {
      const int size = std::popcount(unsigned{c.mask});
      if (isKnown) {
        // Had it not been full, the earlier run would not have been taken further.
      } else if (size > N || (size == N && !faceIsOnSide(mesh, parts, s, c))) {
        result.notFull.push_back({s, c});
        if (size > N) continue;
      } else if (bent[at(c.side)] && size > 1 && hasForeignEdge(mesh, bentEdges, s, c)) {
        result.notFull.push_back({s, c});
      }
      const ContributionSet bit = contributionBit(c.mask);
      result.soft[at(s)] = result.soft[at(s)] | (result.present[at(s)] & bit);
      result.present[at(s)] = result.present[at(s)] | bit;
      result.ofSimplex.items.push_back(c);
    }
    result.ofSimplex.closeList();
    result.softCount += std::popcount(unsigned{result.soft[at(s)]});
    result.hardCount += std::popcount(unsigned{result.present[at(s)]} & ~unsigned{result.soft[at(s)]});
  }
  return result;
}

template Contributions<2> assignContributions(const ReferenceMesh<2> &, const Parts<2> &,
                                              const Earlier<Contributions<2>> &);
template Contributions<3> assignContributions(const ReferenceMesh<3> &, const Parts<3> &,
                                              const Earlier<Contributions<3>> &);

} // namespace dualblock
