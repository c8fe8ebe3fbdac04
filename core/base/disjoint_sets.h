// Union-find over 0 .. n-1 with path halving; the smallest member is the representative, so results
// do not depend on the order of the unions.
#pragma once

#include <numeric>

#include "base/types.h"

namespace dualblock {

class DisjointSets {
public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index find(Index i) {
    while (parent_[at(i)] != i) {
      parent_[at(i)] = parent_[at(parent_[at(i)])];
      i = parent_[at(i)];
    }
    return i;
  }

  void unite(Index i, Index j) {
    i = find(i);
    j = find(j);
    if (i < j) parent_[at(j)] = i;
    if (j < i) parent_[at(i)] = j;
  }

  /// Numbers the sets 0, 1, ... in the order of their smallest members. Returns one number per member.
  std::vector<Index> numbering(Index &count) {
    std::vector<Index> number(parent_.size());
    count = 0;
    for (Index i = 0; i < toIndex(parent_.size()); ++i) {
      const Index root = find(i);
      number[at(i)] = root == i ? count++ : number[at(root)];
    }
    return number;
  }

private:
  std::vector<Index> parent_;
};

} // namespace dualblock
