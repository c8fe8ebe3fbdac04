// One sort for everything: stable, so equal items end in the same order with every standard library, and a
// tenth of std::sort's and std::stable_sort's code for each type and order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace dualblock {
namespace detail {

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

/// The buffer holds half of the items.
template <typename T, typename Less> void mergeSort(T *items, std::size_t count, T *buffer, Less &less) {
  if (count <= 12) return insertionSort(items, count, less);
  const std::size_t half = count / 2;
  mergeSort(items, half, buffer, less);
  mergeSort(items + half, count - half, buffer, less);
  if (!less(items[half], items[half - 1])) return;
  for (std::size_t i = 0; i < half; ++i) buffer[i] = std::move(items[i]);
  const T *const end = items + count;
  T *left = buffer;
  T *right = items + half;
  for (T *to = items; to != right; ++to)
    *to = right != end && less(*right, *left) ? std::move(*right++) : std::move(*left++);
}

} // namespace detail

template <typename T, typename Less = std::less<>> void sortItems(std::vector<T> &items, Less less = {}) {
  const std::unique_ptr<T[]> buffer(items.size() > 12 ? new T[items.size() / 2] : nullptr);
  detail::mergeSort(items.data(), items.size(), buffer.get(), less);
}

/// The same order as `sortItems`, in linear time where few items share an index: `index(item)` is in
/// 0 .. count - 1, and `less` has to order by it first.
template <typename T, typename IndexOf, typename Less = std::less<>>
void sortByIndex(std::vector<T> &items, std::size_t count, IndexOf index, Less less = {}) {
  std::vector<std::size_t> place(count + 1, 0);
  for (const T &item : items) ++place[static_cast<std::size_t>(index(item)) + 1];
  std::size_t longest = 0;
  for (std::size_t k = 1; k <= count; ++k) {
    longest = std::max(longest, place[k]);
    place[k] += place[k - 1];
  }
  std::vector<T> sorted(items.size());
  for (T &item : items) sorted[place[static_cast<std::size_t>(index(item))]++] = std::move(item);
  const std::unique_ptr<T[]> buffer(longest > 12 ? new T[longest / 2] : nullptr);
  for (std::size_t k = 0, begin = 0; k < count; begin = place[k++])
    if (place[k] > begin + 1) detail::mergeSort(sorted.data() + begin, place[k] - begin, buffer.get(), less);
  items.swap(sorted);
}

template <typename T, std::size_t N, typename Less = std::less<>>
void sortItems(std::array<T, N> &few, Less less = {}) {
  detail::insertionSort(few.data(), N, less);
}

} // namespace dualblock
