#include "refinement/spacing.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"

namespace dualblock {
namespace {

constexpr Index kMostIntervals = 1000000; // of an edge

Error refused(std::string what, std::vector<EntityRef> entities = {}) {
  return {ErrorCode::badOption, std::move(what), std::move(entities)};
}

Error badCount(Index intervals) {
  return refused("Edges cannot be divided into " + std::to_string(intervals) + " intervals: give 1 to " +
                 std::to_string(kMostIntervals) + ".");
}

/// How edges run along the surfaces that cross them: opposite edges of a face run alike.
struct Directions {
  std::vector<bool> isReversed; // per edge: the surface runs from its higher node to its lower one
  std::vector<bool> isOneSided; // per surface: it cannot say which way is up, like a Moebius strip
};

template <int N>
Directions directionsOf(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton, std::size_t surfaces) {
  DisjointSets runs(2 * skeleton.edges.size()); // 2 * edge: it runs up, 2 * edge + 1: down
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (int axis = 0; axis < N; ++axis) {
      Index first = kNone; // an edge of the block, as it runs along the axis
      for (unsigned bits = 0; bits < 1U << N; ++bits) {
        if (bits >> axis & 1U) continue;
        const Index edge = skeleton.edgesOf[b][edgeAt<N>(axis, bits)];
        const Index low = blocks.blocks[b][cornerAt<N>(bits)];
        const Index run = 2 * edge + (skeleton.edges[at(edge)][0] == low ? 0 : 1);
        if (first == kNone) first = run;
        runs.unite(first, run);
        runs.unite(first ^ 1, run ^ 1);
      }
    }
  Directions result{std::vector<bool>(skeleton.edges.size()), std::vector<bool>(surfaces, false)};
  for (Index e = 0; e < toIndex(skeleton.edges.size()); ++e) {
    const Index up = runs.find(2 * e);
    const Index down = runs.find(2 * e + 1);
    result.isReversed[at(e)] = down < up;
    if (up == down) result.isOneSided[at(skeleton.surfaceOfEdge[at(e)])] = true;
  }
  return result;
}

/// Growth from the low and from the high end of a surface's edges; 1 where they are even.
using Growth = std::array<double, 2>;

/// An edge is graded from the end that lies on the side, unless the whole edge does.
template <int N>
void addGrading(const Skeleton<N> &skeleton, std::size_t nodeCount, const Directions &directions, Index patch,
                double growth, std::vector<Growth> &growths) {
  const auto liesOn = [&](Index e) {
    return std::binary_search(skeleton.patchesOfEdge.begin(e), skeleton.patchesOfEdge.end(e), patch);
  };
  std::vector<bool> isOnSide(nodeCount, false);
  for (Index e = 0; e < toIndex(skeleton.edges.size()); ++e)
    if (liesOn(e))
      for (const Index v : skeleton.edges[at(e)]) isOnSide[at(v)] = true;
  for (Index e = 0; e < toIndex(skeleton.edges.size()); ++e) {
    if (liesOn(e)) continue;
    Growth &of = growths[at(skeleton.surfaceOfEdge[at(e)])];
    for (std::size_t end = 0; end < 2; ++end)
      if (isOnSide[at(skeleton.edges[at(e)][end])]) {
        double &g = of[directions.isReversed[at(e)] ? 1 - end : end];
        g = std::max(g, growth);
      }
  }
}

void appendPlaces(Index intervals, const Growth &growth, Lists<double> &places) {
  const auto lengthOf = [&](Index k) { // of interval k: grown from each graded end, whichever is nearer
    const double low = std::pow(growth[0], k);
    const double high = std::pow(growth[1], intervals - 1 - k);
    return growth[0] > 1 && growth[1] > 1 ? std::min(low, high) : low * high;
  };
  double total = 0;
  for (Index k = 0; k < intervals; ++k) total += lengthOf(k);
  const bool isEven = growth[0] == 1 && growth[1] == 1;
  double sum = 0;
  for (Index k = 0; k < intervals; ++k) {
    places.items.push_back(isEven ? static_cast<double>(k) / intervals : sum / total);
    sum += lengthOf(k);
  }
  if (intervals > 0) places.items.push_back(1);
  places.closeList();
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
        std::ceil(glm::length(blocks.positions[at(b)] - blocks.positions[at(a)]) / options.size - 1e-9);
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

  const Directions directions = directionsOf(blocks, skeleton, surfaces);
  std::vector<Growth> growths(surfaces, Growth{1, 1});
  for (const Grading &grading : options.gradings) {
    if (grading.facet < 0 || at(grading.facet) >= patchOfSurface.size())
      return refused("There is no facet " + std::to_string(grading.facet) + " to grade elements towards.",
                     {{"facet", grading.facet}});
    if (!(grading.growth >= 1 && grading.growth <= 1000))
      return refused("Elements cannot grow by the factor " + formatNumber(grading.growth) +
                     ": give 1 to 1000, such as 1.2.");
    const Index patch = patchOfSurface[at(grading.facet)];
    addGrading(skeleton, blocks.positions.size(), directions, patch == kNone ? grading.facet : patch,
               grading.growth, growths);
  }
  for (std::size_t s = 0; s < surfaces; ++s) {
    Growth &growth = growths[s];
    if (directions.isOneSided[s]) growth.fill(std::max(growth[0], growth[1]));
    appendPlaces(spacing.intervals[s], growth, spacing.places);
  }
  spacing.isReversed = directions.isReversed;
  return spacing;
}

template Result<Spacing> spacingOf(const BlockMesh<2> &, const Skeleton<2> &, const std::vector<Index> &,
                                   const RefineOptions &);
template Result<Spacing> spacingOf(const BlockMesh<3> &, const Skeleton<3> &, const std::vector<Index> &,
                                   const RefineOptions &);

} // namespace dualblock
