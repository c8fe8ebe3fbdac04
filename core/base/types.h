// The few types that every stage shares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace dualblock {

/// Index of a node, simplex, facet, side, ... ; kNone where there is none.
using Index = std::int32_t;
inline constexpr Index kNone = -1;

/// A point or vector of dimension N, in the units of the input.
template <int N> using Vec = glm::vec<N, double>;

/// std::size_t of a non-negative Index, for subscripts.
constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Index of a size that is known to fit.
constexpr Index toIndex(std::size_t n) { return static_cast<Index>(n); }

/// The ends of an edge, the lower node first.
constexpr std::array<Index, 2> sortedPair(Index a, Index b) {
  return a < b ? std::array<Index, 2>{a, b} : std::array<Index, 2>{b, a};
}

/// Variable-length lists in one flat array: list i is items[offsets[i] .. offsets[i + 1]).
template <typename T> struct Lists {
  std::vector<Index> offsets{0};
  std::vector<T> items;

  Index count() const { return toIndex(offsets.size()) - 1; }
  const T *begin(Index i) const { return items.data() + offsets[at(i)]; }
  const T *end(Index i) const { return items.data() + offsets[at(i) + 1]; }
  Index size(Index i) const { return offsets[at(i) + 1] - offsets[at(i)]; }
  void closeList() { offsets.push_back(toIndex(items.size())); }
};

/// `count` lists of the items that come in any order. `forItems(put)` calls put(list, item) for each; it runs
/// twice, to count and to store, and must give the same both times.
template <typename T, typename ForItems> Lists<T> collectLists(std::size_t count, const ForItems &forItems) {
  Lists<T> lists;
  lists.offsets.assign(count + 1, 0);
  forItems([&](Index list, const T &) { ++lists.offsets[at(list) + 1]; });
  for (std::size_t i = 0; i < count; ++i) lists.offsets[i + 1] += lists.offsets[i];
  lists.items.resize(at(lists.offsets.back()));
  std::vector<Index> place(lists.offsets.begin(), lists.offsets.end() - 1);
  forItems([&](Index list, const T &item) { lists.items[at(place[at(list)]++)] = item; });
  return lists;
}

} // namespace dualblock
