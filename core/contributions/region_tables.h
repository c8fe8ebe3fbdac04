// Local dual contributions on the reference simplex (paper 4.1; ARCHITECTURE.md 1), and the regions that all
// of them together cut it into. A contribution is named by the bit mask of a proper, non-empty subset of the
// simplex's vertices and is the piece of hyperplane where the barycentric coordinates of that subset add up
// to 1 - 1 / (N + 2):
//
//   2D   edge 011   node 001                 3D   face 0111   edge 0011   node 0001
//
// A region is named by the set of contributions it lies inside of, i.e. on whose subset's side it lies.
#pragma once

#include <memory>

#include "base/types.h"

namespace dualblock {

/// A set of contributions, or a region: bit m stands for the contribution of vertex mask m.
using ContributionSet = std::uint16_t;

constexpr ContributionSet contributionBit(unsigned mask) { return static_cast<ContributionSet>(1U << mask); }

template <int N> class RegionTables {
public:
  static constexpr unsigned kFullMask = (1U << (N + 1)) - 1;
  static constexpr int kRegions = N == 2 ? 10 : 53;
  static constexpr int kFaceRegions = N == 2 ? 3 : 10;
  static constexpr int kFaceOrders = N == 2 ? 2 : 6; // orders of the vertices of a face

  /// The tables, computed once, in exact integer arithmetic, from points of a lattice.
  static const RegionTables &get();

  /// Regions, ascending; the first is inside of no contribution: the simplex's middle.
  const std::vector<ContributionSet> &regions() const { return regions_; }

  /// The regions that touch face i, for the face's regions in an order fixed by `order`, the rank of the
  /// face's vertices: two simplices that order a shared face alike list its regions alike.
  const std::array<std::uint8_t, kFaceRegions> &onFace(int i, int order) const { return onFace_[i][order]; }

  /// How the regions merge where only some contributions are present: a class per convex piece.
  struct Classes {
    std::array<std::uint8_t, kRegions> ofRegion;
    std::vector<ContributionSet> inside; // per class: the present contributions it is inside of
    struct Step {
      std::uint8_t inner, outer; // classes that one contribution alone separates
      std::uint8_t mask;
    };
    std::vector<Step> steps;
    struct Crossing {
      std::uint8_t inner;        // the class inside of both contributions
      std::uint8_t maskA, maskB; // ascending
    };
    std::vector<Crossing> crossings; // where all four classes around two contributions exist
  };

  /// The classes for a set of present contributions.
  Classes classes(ContributionSet present) const;

private:
  RegionTables();

  std::vector<ContributionSet> regions_;
  std::array<std::array<std::array<std::uint8_t, kFaceRegions>, kFaceOrders>, N + 1> onFace_;
};

/// The classes of every set of contributions that occurs, each computed once. Not shared between threads.
template <int N> class ClassCache {
public:
  ClassCache() : slots_(std::size_t{1} << 15) {}
  const typename RegionTables<N>::Classes &operator[](ContributionSet present) {
    auto &slot = slots_[present >> 1]; // no contribution has mask 0
    if (!slot)
      slot = std::make_unique<typename RegionTables<N>::Classes>(RegionTables<N>::get().classes(present));
    return *slot;
  }

private:
  std::vector<std::unique_ptr<typename RegionTables<N>::Classes>> slots_;
};

/// Rank, among the orders of a face's vertices, of the order of their node numbers.
template <int N> int faceOrder(const std::array<Index, N + 1> &simplex, int i) {
  std::array<Index, N> v;
  for (int k = 0, m = 0; k < N + 1; ++k)
    if (k != i) v[m++] = simplex[k];
  if constexpr (N == 2) {
    return v[0] < v[1] ? 0 : 1;
  } else {
    const int smallest = v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2);
    const Index a = v[smallest == 0 ? 1 : 0];
    const Index b = v[smallest == 2 ? 1 : 2];
    return 2 * smallest + (a < b ? 0 : 1);
  }
}

extern template class RegionTables<2>;
extern template class RegionTables<3>;

} // namespace dualblock
