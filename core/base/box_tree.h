// Boxes arranged in a tree, to find those that meet another box or a ray, or are near a point, without going
// through all of them (a bounding volume hierarchy).
#pragma once

#include <algorithm>
#include <limits>

#include <glm/common.hpp>

#include "base/types.h"

namespace dualblock {

/// An axis-aligned box in the units of the input; empty until a point is added.
struct Box {
  Vec<3> low{std::numeric_limits<double>::infinity()};
  Vec<3> high{-std::numeric_limits<double>::infinity()};

  void add(const Vec<3> &x) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  void add(const Box &o) {
    low = glm::min(low, o.low);
    high = glm::max(high, o.high);
  }
  bool meets(const Box &o) const {
    for (int k = 0; k < 3; ++k)
      if (!(low[k] <= o.high[k] && o.low[k] <= high[k])) return false;
    return true;
  }
  /// Square of the distance of a point; 0 inside.
  double squareTo(const Vec<3> &x) const {
    const Vec<3> gap = glm::max(glm::max(low - x, x - high), Vec<3>(0.0));
    return glm::dot(gap, gap);
  }
  /// Whether the ray from a point meets it.
  bool meetsRay(const Vec<3> &from, const Vec<3> &direction) const;
};

class BoxTree {
public:
  explicit BoxTree(const std::vector<Box> &boxes);

  /// Calls visit(index) for each box that `enters(box)` says may matter, as may all the boxes around it.
  template <typename Enters, typename Visit> void visit(const Enters &enters, const Visit &visit) const {
    if (branches_.empty()) return;
    std::array<Index, kDepth> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Branch &branch = branches_[at(stack[--top])];
      if (!enters(branch.box)) continue;
      if (branch.right == kNone) {
        for (Index k = branch.begin; k < branch.end; ++k)
          if (enters(boxes_[at(items_[at(k)])])) visit(items_[at(k)]);
        continue;
      }
      stack[top++] = branch.right;
      stack[top++] = toIndex(static_cast<std::size_t>(&branch - branches_.data())) + 1;
    }
  }

  /// The least square of `squareTo(index)` over all boxes; `least`: nothing farther counts. Nearer branches
  /// are looked into first.
  template <typename SquareTo> double nearest(const Vec<3> &x, double least, const SquareTo &squareTo) const {
    if (branches_.empty()) return least;
    std::array<Index, kDepth> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Index here = stack[--top];
      const Branch &branch = branches_[at(here)];
      if (branch.box.squareTo(x) >= least) continue;
      if (branch.right == kNone) {
        for (Index k = branch.begin; k < branch.end; ++k)
          if (boxes_[at(items_[at(k)])].squareTo(x) < least) least = std::min(least, squareTo(items_[at(k)]));
        continue;
      }
      const bool rightFirst =
          branches_[at(branch.right)].box.squareTo(x) < branches_[at(here) + 1].box.squareTo(x);
      stack[top++] = rightFirst ? here + 1 : branch.right;
      stack[top++] = rightFirst ? branch.right : here + 1;
    }
    return least;
  }

private:
  struct Branch {
    Box box;
    Index begin, end; // of items_
    Index right;      // the second half; the first one comes next; kNone: a leaf
  };
  static constexpr std::size_t kDepth = 128; // twice the levels of halves of 2^31 boxes, and more

  void build(Index begin, Index end);

  std::vector<Box> boxes_;
  std::vector<Index> items_; // their numbers, leaf by leaf
  std::vector<Branch> branches_;
};

} // namespace dualblock
