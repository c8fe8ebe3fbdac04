// The regions that the contributions cut a simplex into (ARCHITECTURE.md 1), against an enumeration of all
// sign vectors that exact elimination finds feasible.
#include "contributions/region_tables.h"

#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "support/fourier_motzkin.h"

namespace dualblock::test {
namespace {

/// The sign vectors of the open cells that contributions cut the face with these vertices into. Barycentric
/// coordinates: the face's vertices but the last are the variables; sum > 1 - 1 / (N + 2) is inside.
template <int N> std::set<ContributionSet> feasibleRegions(unsigned face) {
  std::vector<int> vertices;
  for (int v = 0; v < N + 1; ++v)
    if (face >> v & 1) vertices.push_back(v);
  const std::size_t n = vertices.size() - 1;
  std::vector<Strict> simplex;
  Strict last(n + 1, -1);
  last[n] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    Strict row(n + 1, 0);
    row[k] = 1;
    simplex.push_back(row);
  }
  simplex.push_back(last);
  const auto insideRow = [&](unsigned mask) { // (N + 2) sum - (N + 1) > 0
    Strict row(n + 1, 0);
    row[n] = -(N + 1);
    for (std::size_t k = 0; k < n; ++k)
      if (mask >> vertices[k] & 1) row[k] += N + 2;
    if (mask >> vertices[n] & 1) {
      for (std::size_t k = 0; k < n; ++k) row[k] -= N + 2;
      row[n] += N + 2;
    }
    return row;
  };
  // One contribution after the other: each cell so far is cut in two where both sides are feasible.
  struct Cell {
    ContributionSet set;
    std::vector<Strict> rows;
  };
  std::vector<Cell> cells{{0, simplex}};
  for (unsigned mask = 1; mask < RegionTables<N>::kFullMask; ++mask) {
    std::vector<Cell> next;
    Strict inside = insideRow(mask);
    Strict outside = inside;
    for (std::int64_t &c : outside) c = -c;
    for (const Cell &cell : cells) {
      Cell in{static_cast<ContributionSet>(cell.set | contributionBit(mask)), cell.rows};
      Cell out = cell;
      in.rows.push_back(inside);
      out.rows.push_back(outside);
      if (feasible(in.rows)) next.push_back(std::move(in));
      if (feasible(out.rows)) next.push_back(std::move(out));
    }
    cells = std::move(next);
  }
  std::set<ContributionSet> result;
  for (const Cell &cell : cells) result.insert(cell.set);
  EXPECT_EQ(result.size(), cells.size());
  return result;
}

template <int N> std::set<ContributionSet> tableRegions() {
  const auto &regions = RegionTables<N>::get().regions();
  return {regions.begin(), regions.end()};
}

TEST(FourierMotzkin, DecidesSmallSystems) {
  EXPECT_TRUE(feasible({{1, 0}, {-1, 1}}));   // 0 < x < 1
  EXPECT_FALSE(feasible({{1, 0}, {-1, 0}}));  // 0 < x < 0
  EXPECT_FALSE(feasible({{2, -1}, {-2, 1}})); // x > 1/2 and x < 1/2
  EXPECT_TRUE(feasible({{1, 0, 0}, {0, 1, 0}, {-1, -1, 1}}));
  EXPECT_FALSE(feasible({{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}));
  EXPECT_TRUE(feasible({{1, 1, 0}, {1, -1, 0}, {-3, 1, 1}}));
}

TEST(Regions, OfATetrahedron) {
  const auto regions = feasibleRegions<3>(0b1111);
  EXPECT_EQ(regions.size(), 53U);
  EXPECT_EQ(tableRegions<3>(), regions);
  EXPECT_EQ(RegionTables<3>::get().regions().size(), 53U);
}

TEST(Regions, OfATriangle) {
  const auto regions = feasibleRegions<2>(0b111);
  EXPECT_EQ(regions.size(), 10U);
  EXPECT_EQ(tableRegions<2>(), regions);
  EXPECT_EQ(RegionTables<2>::get().regions().size(), 10U);
}

template <int N> void expectFaceRegions() {
  for (int i = 0; i < N + 1; ++i) {
    const auto expected = feasibleRegions<N>(RegionTables<N>::kFullMask & ~(1U << i));
    EXPECT_EQ(expected.size(), std::size_t{RegionTables<N>::kFaceRegions});
    for (int order = 0; order < RegionTables<N>::kFaceOrders; ++order) {
      std::set<ContributionSet> found;
      for (const std::uint8_t r : RegionTables<N>::get().onFace(i, order))
        found.insert(RegionTables<N>::get().regions()[r]);
      EXPECT_EQ(found, expected) << "face " << i << ", order " << order;
    }
  }
}

TEST(Regions, TenOnEachFaceOfATetrahedron) { expectFaceRegions<3>(); }
TEST(Regions, ThreeOnEachEdgeOfATriangle) { expectFaceRegions<2>(); }

TEST(Regions, ThreeOnEachEdgeOfATetrahedron) {
  for (unsigned edge = 1; edge < 15; ++edge) {
    if (std::popcount(edge) != 2) continue;
    EXPECT_EQ(feasibleRegions<3>(edge).size(), 3U) << edge;
  }
}

/// What a region on face i lies inside of, seen on the face alone: sets of the face's nodes by their numbers.
template <int N>
std::set<std::vector<Index>> traces(ContributionSet region, int i, const std::array<Index, N + 1> &simplex) {
  std::set<std::vector<Index>> result;
  for (unsigned mask = 1; mask < RegionTables<N>::kFullMask; ++mask) {
    if (!(region & contributionBit(mask))) continue;
    std::vector<Index> nodes;
    for (int v = 0; v < N + 1; ++v)
      if (v != i && (mask >> v & 1)) nodes.push_back(simplex[at(v)]);
    std::sort(nodes.begin(), nodes.end());
    if (!nodes.empty()) result.insert(nodes);
  }
  return result;
}

// Two simplices that share a face list its regions in the same order, however their vertices stand.
template <int N> void expectFacesAgree() {
  const auto &tables = RegionTables<N>::get();
  std::array<Index, N + 1> left;
  for (int v = 0; v < N + 1; ++v) left[at(v)] = 10 + 7 * v;
  int compared = 0;
  do {
    for (int i = 0; i < N + 1; ++i) {
      std::array<Index, N> face;
      for (int v = 0, m = 0; v < N + 1; ++v)
        if (v != i) face[at(m++)] = left[at(v)];
      std::sort(face.begin(), face.end());
      do {
        for (int k = 0; k < N + 1; ++k) {
          std::array<Index, N + 1> right;
          right[at(k)] = 5;
          for (int v = 0, m = 0; v < N + 1; ++v)
            if (v != k) right[at(v)] = face[at(m++)];
          const auto &mine = tables.onFace(i, faceOrder<N>(left, i));
          const auto &theirs = tables.onFace(k, faceOrder<N>(right, k));
          for (std::size_t r = 0; r < mine.size(); ++r)
            EXPECT_EQ((traces<N>(tables.regions()[mine[r]], i, left)),
                      (traces<N>(tables.regions()[theirs[r]], k, right)));
          ++compared;
        }
      } while (std::next_permutation(face.begin(), face.end()));
    }
  } while (std::next_permutation(left.begin(), left.end()));
  EXPECT_EQ(compared, N == 3 ? 24 * 4 * 6 * 4 : 6 * 3 * 2 * 3);
}

TEST(Regions, NeighboursAgreeOnTheirFace2) { expectFacesAgree<2>(); }
TEST(Regions, NeighboursAgreeOnTheirFace3) { expectFacesAgree<3>(); }

template <typename Dimension> class Regions2And3 : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Regions2And3, Dimensions);

// Inside of a subset's contribution is inside of every larger one's; never inside of a set's and its
// complement's, whose sums would exceed 1; renaming the vertices maps regions to regions.
TYPED_TEST(Regions2And3, MonotoneExclusiveAndSymmetric) {
  constexpr int N = TypeParam::value;
  constexpr unsigned full = RegionTables<N>::kFullMask;
  const auto all = tableRegions<N>();
  const auto has = [](ContributionSet set, unsigned mask) { return (set & contributionBit(mask)) != 0; };
  for (const ContributionSet region : all) {
    EXPECT_FALSE(has(region, 0) || has(region, full));
    for (unsigned a = 1; a < full; ++a) {
      EXPECT_FALSE(has(region, a) && has(region, full & ~a));
      for (unsigned b = 1; b < full; ++b) {
        if ((a & b) == a) {
          EXPECT_TRUE(!has(region, a) || has(region, b));
        }
        if (has(region, a) && has(region, b)) {
          EXPECT_NE(a & b, 0U);
        }
      }
    }
    std::array<unsigned, N + 1> to;
    std::iota(to.begin(), to.end(), 0U);
    do {
      ContributionSet image = 0;
      for (unsigned mask = 1; mask < full; ++mask) {
        unsigned renamed = 0;
        for (unsigned v = 0; v < N + 1; ++v)
          if (mask >> v & 1) renamed |= 1U << to[v];
        if (has(region, mask)) image = static_cast<ContributionSet>(image | contributionBit(renamed));
      }
      EXPECT_TRUE(all.count(image));
    } while (std::next_permutation(to.begin(), to.end()));
  }
  EXPECT_EQ(RegionTables<N>::get().regions().front(), 0) << "the middle";
}

// Regions merge exactly where no present contribution separates them; a step leads between two classes that
// differ in one contribution, which are neighbours because the classes are convex.
TYPED_TEST(Regions2And3, ClassesAgainstBruteForce) {
  constexpr int N = TypeParam::value;
  constexpr unsigned full = RegionTables<N>::kFullMask;
  const auto regions = feasibleRegions<N>(full);
  const auto &tables = RegionTables<N>::get();
  std::mt19937 random(3);
  std::vector<ContributionSet> sets{0, static_cast<ContributionSet>((1U << full) - 2)};
  for (unsigned mask = 1; mask < full; ++mask) sets.push_back(contributionBit(mask));
  for (int k = 0; k < 200; ++k) sets.push_back(static_cast<ContributionSet>(random() & ((1U << full) - 2)));
  for (const ContributionSet present : sets) {
    std::set<ContributionSet> expected;
    for (const ContributionSet region : regions)
      expected.insert(static_cast<ContributionSet>(region & present));
    const auto classes = tables.classes(present);
    EXPECT_EQ(std::set<ContributionSet>(classes.inside.begin(), classes.inside.end()), expected);
    EXPECT_EQ(classes.inside.size(), expected.size()) << "a class occurs twice";
    for (std::size_t r = 0; r < tables.regions().size(); ++r)
      EXPECT_EQ(classes.inside[classes.ofRegion[r]], tables.regions()[r] & present);
    std::set<std::array<unsigned, 3>> steps;
    for (const auto &step : classes.steps) {
      EXPECT_EQ(classes.inside[step.inner], classes.inside[step.outer] | contributionBit(step.mask));
      EXPECT_FALSE(classes.inside[step.outer] & contributionBit(step.mask));
      steps.insert({step.inner, step.outer, step.mask});
    }
    EXPECT_EQ(steps.size(), classes.steps.size());
    std::size_t expectedSteps = 0;
    for (const ContributionSet a : expected)
      for (const ContributionSet b : expected)
        expectedSteps += (a & b) == b && std::popcount(static_cast<unsigned>(a ^ b)) == 1 ? 1 : 0;
    EXPECT_EQ(steps.size(), expectedSteps);
  }
}

TYPED_TEST(Regions2And3, CacheReturnsTheClasses) {
  constexpr int N = TypeParam::value;
  ClassCache<N> cache;
  for (const unsigned mask : {1U, 3U, 5U}) {
    const ContributionSet present = contributionBit(mask);
    const auto *first = &cache[present];
    EXPECT_EQ(first->inside, RegionTables<N>::get().classes(present).inside);
    EXPECT_EQ(first, &cache[present]) << "computed once";
  }
}

} // namespace
} // namespace dualblock::test
