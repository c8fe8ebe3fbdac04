#include "geometry/placement.h"

#include <map>
#include <numeric>

#include "geometry/bent_placement.h"
#include "geometry/jacobian.h"
#include "geometry/orientation.h"
#include "geometry/untangle.h"

namespace dualblock {
namespace {

template <int N> class Placer {
public:
  Placer(const ReferenceMesh<N> &mesh, const Parts<N> &parts)
      : mesh_(mesh), parts_(parts), firstCorner_(parts.parts.size() + 1, 0) {
    for (const Corner &corner : parts.corners) ++firstCorner_[at(corner.part) + 1];
    std::partial_sum(firstCorner_.begin(), firstCorner_.end(), firstCorner_.begin());
  }

  Vec<N> place(const CellPiece<N> &piece) const {
    const int count = piece.sideCount();
    if (count == 0) return mean(piece, [](const Corner &) { return true; });
    if (count == N) return mean(piece, [&](const Corner &c) { return holdsAll(c, piece); });
    if (count == N - 1) return curveMidpoint(piece);
    return mean(piece, [&](const Corner &c) { return holdsAll(c, piece); });
  }

private:
  static bool holdsAll(const Corner &corner, const CellPiece<N> &piece) {
    return std::includes(corner.sides.begin(), corner.sides.end(), piece.sides.begin(),
                         piece.sides.begin() + piece.sideCount());
  }

  /// The mean of the part's corners that `wanted` accepts.
  template <typename Wanted> Vec<N> mean(const CellPiece<N> &piece, Wanted wanted) const {
    Vec<N> sum{0.0};
    double count = 0;
    for (std::size_t c = firstCorner_[at(piece.part)]; c < firstCorner_[at(piece.part) + 1]; ++c) {
      if (!wanted(parts_.corners[c])) continue;
      sum += mesh_.nodes[at(parts_.corners[c].node)];
      count += 1;
    }
    return count > 0 ? sum / count : sum;
  }

  Vec<N> curveMidpoint(const CellPiece<N> &piece) const {
    if constexpr (N == 2) {
      std::vector<std::array<Index, 2>> segments;
      for (const FaceRef<2> *f = parts_.sideFaces.begin(piece.sides[0]);
           f != parts_.sideFaces.end(piece.sides[0]); ++f)
        segments.push_back(mesh_.sortedFace(f->simplex, f->face));
      return chainMidpoint<N>(mesh_.nodes, segments);
    } else {
      const std::array<Index, 2> sides{piece.sides[0], piece.sides[1]};
      const auto curve = std::lower_bound(parts_.curves.begin(), parts_.curves.end(), sides,
                                          [&](const Curve<3> &c, const std::array<Index, 2> &s) {
                                            return c.part != piece.part ? c.part < piece.part : c.sides < s;
                                          });
      if (curve == parts_.curves.end() || curve->part != piece.part || curve->sides != sides)
        return mean(piece, [&](const Corner &c) { return holdsAll(c, piece); });
      return chainMidpoint<N>(mesh_.nodes, curve->ridges);
    }
  }

  const ReferenceMesh<N> &mesh_;
  const Parts<N> &parts_;
  std::vector<std::size_t> firstCorner_; // per part, and one more
};

} // namespace

template <int N>
Vec<N> chainMidpoint(const std::vector<Vec<N>> &nodes, std::span<const std::array<Index, 2>> segments) {
  if (segments.size() == 1) {
    const auto [a, b] = sortedPair(segments[0][0], segments[0][1]);
    const Vec<N> whole = nodes[at(b)] - nodes[at(a)];
    const double length = glm::length(whole);
    return nodes[at(a)] + (length > 0 ? length / 2 / length : 0) * whole;
  }
  std::map<Index, std::vector<Index>> next;
  double total = 0;
  for (const auto &[a, b] : segments) {
    next[a].push_back(b);
    next[b].push_back(a);
    total += glm::length(nodes[at(b)] - nodes[at(a)]);
  }
  Index here = next.begin()->first;
  for (const auto &[node, list] : next)
    if (list.size() == 1) {
      here = node;
      break;
    }
  double rest = total / 2;
  Index previous = kNone;
  for (std::size_t step = 0; step < segments.size(); ++step) {
    const std::vector<Index> &list = next[here];
    const Index ahead = list[0] != previous ? list[0] : list.back();
    const double length = glm::length(nodes[at(ahead)] - nodes[at(here)]);
    if (rest <= length || step + 1 == segments.size())
      return nodes[at(here)] + (length > 0 ? rest / length : 0) * (nodes[at(ahead)] - nodes[at(here)]);
    rest -= length;
    previous = here;
    here = ahead;
  }
  return nodes[at(here)];
}

template <int N>
void placeNodes(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualCells<N> &dual,
                Primal<N> &primal) {
  const Placer<N> placer(mesh, parts);
  primal.positions.clear();
  for (const Index piece : primal.nodePiece) primal.positions.push_back(placer.place(dual.pieces[at(piece)]));
  if constexpr (N == 3) followBentSides(mesh, parts, dual, primal);
  orientBlocks(primal);
  std::vector<Index> bad;
  for (std::size_t b = 0; b < primal.blocks.size(); ++b) {
    const auto c = jacobianCoefficients<N>(cornersOf<N>(primal.blocks[b].nodes, primal.positions));
    if (*std::min_element(c.begin(), c.end()) <= 0) bad.push_back(toIndex(b));
  }
  untangle(mesh, parts, dual, std::move(bad), primal);
}

template Vec<2> chainMidpoint<2>(const std::vector<Vec<2>> &, std::span<const std::array<Index, 2>>);
template Vec<3> chainMidpoint<3>(const std::vector<Vec<3>> &, std::span<const std::array<Index, 2>>);
template void placeNodes(const ReferenceMesh<2> &, const Parts<2> &, const DualCells<2> &, Primal<2> &);
template void placeNodes(const ReferenceMesh<3> &, const Parts<3> &, const DualCells<3> &, Primal<3> &);

} // namespace dualblock
