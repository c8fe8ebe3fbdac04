// How bends of a block mesh's boundary go on inside: without that, the straight edges inside a thin wall
// would stand out of its bent sides.
#pragma once

#include "base/types.h"

namespace dualblock {

/// Makes the shift of everything that follows others their mean, by Gauss and Seidel; what follows none keeps
/// its own. So shifts fade from bent sides to straight ones, and are nowhere larger than there. `followed`:
/// per shift those that it follows.
template <int N> void carryShifts(const Lists<Index> &followed, std::vector<Vec<N>> &shifts) {
  constexpr int kRounds = 100;
  constexpr double kSettled = 1e-4; // of the largest shift
  double largest = 0;
  for (const Vec<N> &s : shifts) largest = std::max(largest, glm::length(s));
  bool again = largest > 0;
  const auto follow = [&](Index k) {
    if (followed.size(k) == 0) return;
    Vec<N> mean{0.0};
    for (const Index *f = followed.begin(k); f != followed.end(k); ++f) mean += shifts[at(*f)];
    mean /= static_cast<double>(followed.size(k));
    again = again || glm::length(mean - shifts[at(k)]) > kSettled * largest;
    shifts[at(k)] = mean;
  };
  for (int round = 0; round < kRounds && again; ++round) { // there and back: chains settle sooner
    again = false;
    for (Index k = 0; k < toIndex(shifts.size()); ++k) follow(k);
    for (Index k = toIndex(shifts.size()); k-- > 0;) follow(k);
  }
}

} // namespace dualblock
