// One sort for everything: stable, so equal items end in the same order with every standard library, and a
// tenth of std::sort's and std::stable_sort's code for each type and order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace dualblock {
namespace detail {

inline constexpr std::size_t kFew = 40; // up to which insertion is quicker than merging

template <typename T, typename Less> void insertionSort(T *items, std::size_t count, Less &less) {
  for (std::size_t i = 1; i < count; ++i) {
    if (!less(items[i], items[i - 1])) continue;
    T item = std::move(items[i]);
    std::size_t to = i;
    do {
      items[to] = std::move(items[to - 1]);
      --to;
    } while (to > 0 && less(item, items[to - 1]));
    items[to] = std::move(item);
  }
}

/// The order of `count` things, stable. Merging goes by number and not by item, so that its code is there
/// once and not for every type and order.
std::vector<std::int32_t> orderOf(std::size_t count, const void *context,
                                  bool (*less)(const void *context, std::int32_t a, std::int32_t b));

template <typename T, typename Less> void mergeSort(T *items, std::size_t count, Less &less) {
  if (count <= kFew) return insertionSort(items, count, less);
  struct Context {
    T *items;
    Less *less;
  };
  const Context context{items, &less};
  const auto lessAt = [](const void *c, std::int32_t a, std::int32_t b) {
    const Context &all = *static_cast<const Context *>(c);
    return bool{(*all.less)(all.items[a], all.items[b])};
  };
  const std::vector<std::int32_t> order = orderOf(count, &context, lessAt);
  const std::unique_ptr<T[]> sorted(new T[count]);
  for (std::size_t i = 0; i < count; ++i) sorted[i] = std::move(items[order[i]]);
  for (std::size_t i = 0; i < count; ++i) items[i] = std::move(sorted[i]);
}

} // namespace detail

template <typename T, typename Less = std::less<>> void sortRange(T *begin, T *end, Less less = {}) {
  detail::mergeSort(begin, static_cast<std::size_t>(end - begin), less);
}

template <typename T, typename Less = std::less<>> void sortItems(std::vector<T> &items, Less less = {}) {
  detail::mergeSort(items.data(), items.size(), less);
}

/// The same order as `sortItems`, in linear time where few items share an index: `index(item)` is in
/// 0 .. count - 1, and `less` has to order by it first.
template <typename T, typename IndexOf, typename Less = std::less<>>
void sortByIndex(std::vector<T> &items, std::size_t count, IndexOf index, Less less = {}) {
  std::vector<std::size_t> place(count + 1, 0);
  for (const T &item : items) ++place[static_cast<std::size_t>(index(item)) + 1];
  for (std::size_t k = 1; k <= count; ++k) place[k] += place[k - 1];
  std::vector<T> sorted(items.size());
  for (T &item : items) sorted[place[static_cast<std::size_t>(index(item))]++] = std::move(item);
  for (std::size_t k = 0, begin = 0; k < count; begin = place[k++])
    if (place[k] > begin + 1) detail::mergeSort(sorted.data() + begin, place[k] - begin, less);
  items.swap(sorted);
}

template <typename T, std::size_t N, typename Less = std::less<>>
void sortItems(std::array<T, N> &few, Less less = {}) {
  detail::insertionSort(few.data(), N, less);
}

} // namespace dualblock
