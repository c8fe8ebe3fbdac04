#include "base/sort.h"

#include <numeric>

namespace dualblock::detail {
namespace {

using Item = std::int32_t;

struct Merger {
  const void *context;
  bool (*less)(const void *, Item, Item);
  std::vector<Item> buffer; // holds half of the items

  void sort(Item *items, std::size_t count) {
    if (count <= 8) {
      const auto order = [&](Item a, Item b) { return less(context, a, b); };
      return insertionSort(items, count, order);
    }
    const std::size_t half = count / 2;
    sort(items, half);
    sort(items + half, count - half);
    if (!less(context, items[half], items[half - 1])) return;
    for (std::size_t i = 0; i < half; ++i) buffer[i] = items[i];
    const Item *const end = items + count;
    const Item *left = buffer.data();
    const Item *right = items + half;
    for (Item *to = items; to != right; ++to)
      *to = right != end && less(context, *right, *left) ? *right++ : *left++;
  }
};

} // namespace

std::vector<Item> orderOf(std::size_t count, const void *context, bool (*less)(const void *, Item, Item)) {
  std::vector<Item> order(count);
  std::iota(order.begin(), order.end(), 0);
  Merger{context, less, std::vector<Item>(count / 2)}.sort(order.data(), count);
  return order;
}

} // namespace dualblock::detail
