#include "base/box_tree.h"

#include <numeric>

namespace dualblock {
namespace {

constexpr Index kLeaf = 4; // boxes that are quicker to look at than to divide

} // namespace

bool Box::meetsRay(const Vec<3> &from, const Vec<3> &direction) const {
  double first = 0;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0) {
      if (from[k] < low[k] || from[k] > high[k]) return false;
      continue;
    }
    const double a = (low[k] - from[k]) / direction[k];
    const double b = (high[k] - from[k]) / direction[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

BoxTree::BoxTree(const std::vector<Box> &boxes) : boxes_(boxes), items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  branches_.reserve(boxes.size());
  if (!boxes.empty()) build(0, toIndex(boxes.size()));
}

void BoxTree::build(Index begin, Index end) {
  const std::size_t here = branches_.size();
  branches_.push_back({Box{}, begin, end, kNone});
  Box middles;
  for (Index k = begin; k < end; ++k) {
    const Box &box = boxes_[at(items_[at(k)])];
    branches_[here].box.add(box);
    middles.add(box.low + box.high);
  }
  if (end - begin <= kLeaf) { // the first of equally near ones is found first, with every standard library
    std::sort(items_.begin() + begin, items_.begin() + end);
    return;
  }
  const Vec<3> extent = middles.high - middles.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const Index half = (begin + end) / 2;
  const auto middle = [&](Index item) { return boxes_[at(item)].low[axis] + boxes_[at(item)].high[axis]; };
  // By number where middles are equal: the same tree with every standard library.
  std::nth_element(items_.begin() + begin, items_.begin() + half, items_.begin() + end,
                   [&](Index a, Index b) { return std::pair(middle(a), a) < std::pair(middle(b), b); });
  build(begin, half);
  branches_[here].right = toIndex(branches_.size());
  build(half, end);
}

} // namespace dualblock
