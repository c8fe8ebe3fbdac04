#include "base/sort.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace dualblock {
namespace {

TEST(Sort, SortsStablyAsTheStandardLibraryDoes) {
  std::mt19937 random(1);
  for (const std::size_t size : {0u, 1u, 2u, 12u, 13u, 14u, 100u, 1000u, 4097u})
    for (const unsigned range : {1u, 3u, 50u, 100000u}) {
      std::vector<std::pair<unsigned, std::size_t>> items;
      for (std::size_t i = 0; i < size; ++i) items.emplace_back(random() % range, i);
      auto expected = items;
      const auto byFirst = [](const auto &a, const auto &b) { return a.first < b.first; };
      std::stable_sort(expected.begin(), expected.end(), byFirst);
      sortItems(items, byFirst);
      EXPECT_EQ(items, expected) << size << " items of " << range << " values";
    }
}

TEST(Sort, SortsWhatOnlyMovesAndArrays) {
  std::vector<std::unique_ptr<int>> items;
  for (int i = 0; i < 50; ++i) items.push_back(std::make_unique<int>(i * 7 % 50));
  sortItems(items, [](const auto &a, const auto &b) { return *a < *b; });
  for (int i = 0; i < 50; ++i) EXPECT_EQ(*items[static_cast<std::size_t>(i)], i);
  std::array<int, 4> few{3, 1, 2, 0};
  sortItems(few, std::greater<>());
  EXPECT_EQ(few, (std::array<int, 4>{3, 2, 1, 0}));
}

} // namespace
} // namespace dualblock
