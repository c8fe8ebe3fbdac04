#include "refinement/spacing.h"

#include <algorithm>
#include <cmath>

#include "blocks/directions.h"

namespace dualblock {
namespace {

constexpr Index kMostIntervals = 1000000; // of an edge
constexpr double kLeastInterval = 1e-7;   // of an edge: less, and rounding decides on the shape of elements

Error refused(std::string what, std::vector<EntityRef> entities = {}) {
  return {ErrorCode::badOption, std::move(what), std::move(entities)};
}

Error badCount(Index intervals) {
  return refused("Edges cannot be divided into " + std::to_string(intervals) + " intervals: give 1 to " +
                 std::to_string(kMostIntervals) + ".");
}

/// Growth from the low and from the high end of a surface's edges; 1 where they are even.
using Growth = std::array<double, 2>;

/// Returns the share of an edge that its shortest interval has.
double appendPlaces(Index intervals, const Growth &growth, Lists<double> &places) {
  const auto lengthOf = [&](Index k) { // of interval k: grown from each graded end, whichever is nearer
    const double low = std::pow(growth[0], k);
    const double high = std::pow(growth[1], intervals - 1 - k);
    return growth[0] > 1 && growth[1] > 1 ? std::min(low, high) : low * high;
  };
  double total = 0;
  double least = 1;
  for (Index k = 0; k < intervals; ++k) {
    total += lengthOf(k);
    least = std::min(least, lengthOf(k));
  }
  const bool isEven = growth[0] == 1 && growth[1] == 1;
  double sum = 0;
  for (Index k = 0; k < intervals; ++k) {
    places.items.push_back(isEven ? static_cast<double>(k) / intervals : sum / total);
    sum += lengthOf(k);
  }
  if (intervals > 0) places.items.push_back(1);
  places.closeList();
  return least / total;
}

} // namespace

template <int N>
Result<Spacing> spacingOf(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton,
                          const std::vector<Index> &patchOfSurface, const RefineOptions &options) {
  if (options.intervals < 1 || options.intervals > kMostIntervals) return badCount(options.intervals);
  if (!(options.size >= 0)) return refused("The size of elements is no length: give a number over 0.");
  std::size_t surfaces = 0;
  for (const Index s : skeleton.surfaceOfEdge) surfaces = std::max(surfaces, at(s) + 1);
  Spacing spacing;
  spacing.intervals.assign(surfaces, 0);
  for (std::size_t e = 0; e < skeleton.edges.size(); ++e) {
    Index &count = spacing.intervals[at(skeleton.surfaceOfEdge[e])];
    if (options.size <= 0) {
      count = options.intervals;
      continue;
    }
    const auto &[a, b] = skeleton.edges[e];
    const double wanted =
        std::ceil(glm::length(blocks.positions[at(b)] - blocks.positions[at(a)]) / options.size - 1e-6);
    if (!(wanted <= kMostIntervals))
      return refused("Elements of the size " + formatNumber(options.size) +
                     " are too many for an edge of the blocks: give a larger size.");
    count = std::max({count, static_cast<Index>(wanted), 1});
  }
  for (const auto &[surface, intervals] : options.ofSurface) {
    if (surface < 0 || at(surface) >= surfaces || spacing.intervals[at(surface)] == 0)
      return refused("The mesh has no D\u0304-surface " + std::to_string(surface) +
                         ": name one that crosses its blocks.",
                     {{"surface", surface}});
    if (intervals < 1 || intervals > kMostIntervals) return badCount(intervals);
    spacing.intervals[at(surface)] = intervals;
  }

  const Directions directions = directionsOf(blocks, skeleton);
  std::vector<Growth> growths(surfaces, Growth{1, 1});
  for (const Grading &grading : options.gradings) {
    if (grading.facet < 0 || at(grading.facet) >= patchOfSurface.size())
      return refused("There is no facet " + std::to_string(grading.facet) + " to grade elements towards.",
                     {{"facet", grading.facet}});
    if (!(grading.growth >= 1 && grading.growth <= 1000))
      return refused("Elements cannot grow by the factor " + formatNumber(grading.growth) +
                     ": give 1 to 1000, such as 1.2.");
    const std::vector<unsigned> ends =
        endsOnSide(blocks, skeleton, directions, patchOfSurface, patchOf(patchOfSurface, grading.facet));
    for (std::size_t s = 0; s < surfaces; ++s)
      for (std::size_t end = 0; end < 2; ++end)
        if (ends[s] >> end & 1U) growths[s][end] = std::max(growths[s][end], grading.growth);
  }
  for (std::size_t s = 0; s < surfaces; ++s) {
    Growth &growth = growths[s];
    if (directions.isOneSided[s]) growth.fill(std::max(growth[0], growth[1]));
    const double least = appendPlaces(spacing.intervals[s], growth, spacing.places);
    if (growth != Growth{1, 1} && least < kLeastInterval)
      return refused("Elements that grow by the factor " + formatNumber(std::max(growth[0], growth[1])) +
                         " over " + std::to_string(spacing.intervals[s]) + " intervals would begin with " +
                         formatNumber(least) + " of an edge, and " + formatNumber(kLeastInterval) +
                         " is the least: give fewer intervals, or a smaller factor.",
                     {{"surface", toIndex(s)}});
  }
  spacing.isReversed = directions.isReversed;
  return spacing;
}

template Result<Spacing> spacingOf(const BlockMesh<2> &, const Skeleton<2> &, const std::vector<Index> &,
                                   const RefineOptions &);
template Result<Spacing> spacingOf(const BlockMesh<3> &, const Skeleton<3> &, const std::vector<Index> &,
                                   const RefineOptions &);

} // namespace dualblock
