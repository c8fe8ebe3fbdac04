#include "contributions/region_tables.h"

#include "base/sort.h"
#include <algorithm>
#include <set>

namespace dualblock {
namespace {

/// Lattice points have coordinates k / kDenominator. As N + 2 does not divide it, no point lies on a
/// contribution; it is fine enough to meet every region (the tests count them).
constexpr int kDenominator = 21; // divisible by neither 4 nor 5

/// The contributions that a point, in units of 1 / denominator, lies inside of.
template <int N> ContributionSet insideOf(const std::array<int, N + 1> &point) {
  ContributionSet set = 0;
  for (unsigned mask = 1; mask < RegionTables<N>::kFullMask; ++mask) {
    int sum = 0;
    for (int v = 0; v < N + 1; ++v)
      if (mask >> v & 1) sum += point[v];
    // sum / d > 1 - 1 / (N + 2)
    if (sum * (N + 2) > kDenominator * (N + 1)) set |= contributionBit(mask);
  }
  return set;
}

template <int N, typename Visit>
void forLattice(std::array<int, N + 1> &point, int coordinate, int rest, Visit visit) {
  if (coordinate == N) {
    point[N] = rest;
    visit(point);
    return;
  }
  for (int k = 0; k <= rest; ++k) {
    point[coordinate] = k;
    forLattice<N>(point, coordinate + 1, rest - k, visit);
  }
}

} // namespace

template <int N> RegionTables<N>::RegionTables() {
  std::set<ContributionSet> found;
  // Per face region, one point on face 0 with its first coordinate left out: sorted by the region's name.
  std::vector<std::pair<ContributionSet, std::array<int, N + 1>>> facePoints;
  std::array<int, N + 1> start{};
  forLattice<N>(start, 0, kDenominator, [&](const std::array<int, N + 1> &point) {
    const ContributionSet set = insideOf<N>(point);
    found.insert(set);
    if (point[0] != 0) return;
    const bool isNew =
        std::none_of(facePoints.begin(), facePoints.end(), [&](const auto &p) { return p.first == set; });
    if (isNew) facePoints.emplace_back(set, point);
  });
  regions_.assign(found.begin(), found.end());
  sortItems(facePoints);
  for (int i = 0; i < N + 1; ++i) {
    // Vertex numbers stand for node numbers: `order` lists the face's vertices from the lowest node up.
    std::array<Index, N + 1> numbers;
    std::array<int, N> order;
    for (int k = 0, m = 0; k < N + 1; ++k)
      if (k != i) order[m++] = k;
    do {
      numbers[i] = 0;
      for (int m = 0; m < N; ++m) numbers[order[m]] = m + 1;
      auto &row = onFace_[i][faceOrder<N>(numbers, i)];
      for (std::size_t r = 0; r < facePoints.size() && r < row.size(); ++r) {
        std::array<int, N + 1> point;
        point[i] = 0;
        for (int m = 0; m < N; ++m) point[order[m]] = facePoints[r].second[m + 1];
        const auto at = std::lower_bound(regions_.begin(), regions_.end(), insideOf<N>(point));
        row[r] = static_cast<std::uint8_t>(at - regions_.begin());
      }
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

template <int N> const RegionTables<N> &RegionTables<N>::get() {
  static const RegionTables tables;
  return tables;
}

template <int N> typename RegionTables<N>::Classes RegionTables<N>::classes(ContributionSet present) const {
  Classes result;
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const ContributionSet inside = regions_[r] & present;
    auto at = std::find(result.inside.begin(), result.inside.end(), inside);
    if (at == result.inside.end()) at = result.inside.insert(at, inside);
    result.ofRegion[r] = static_cast<std::uint8_t>(at - result.inside.begin());
  }
  for (std::size_t a = 0; a < result.inside.size(); ++a)
    for (std::size_t b = 0; b < result.inside.size(); ++b) {
      const unsigned extra = result.inside[a] & ~result.inside[b];
      const bool single =
          extra != 0 && (extra & (extra - 1)) == 0 && (result.inside[b] & ~result.inside[a]) == 0;
      if (!single) continue;
      unsigned mask = 0;
      while (extra >> mask != 1) ++mask;
      result.steps.push_back(
          {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(mask)});
    }
  for (const auto &a : result.steps)
    for (const auto &b : result.steps) {
      if (a.inner != b.inner || a.mask >= b.mask) continue;
      const unsigned far = result.inside[a.outer] & ~unsigned{contributionBit(b.mask)};
      if (std::find(result.inside.begin(), result.inside.end(), far) != result.inside.end())
        result.crossings.push_back({a.inner, a.mask, b.mask});
    }
  return result;
}

template class RegionTables<2>;
template class RegionTables<3>;

} // namespace dualblock
