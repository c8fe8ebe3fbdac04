// What the preparation of a domain shares between 2D and 3D. Internal to domain/.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "domain/prepare.h"

namespace dualblock {

/// Sizes of domains: products of six lengths have to be doubles.
inline constexpr double kLargestDomain = 1e40;
inline constexpr double kSmallestDomain = 1e-40;

/// Enough vertices, all coordinates finite, of a size to reckon with, and all references in range.
template <int N> std::optional<Error> checkNumbers(const Domain<N> &domain) {
  const std::size_t count = domain.vertices.size();
  if (count < N + 1)
    return Error{ErrorCode::tooFewVertices,
                 "The domain has " + std::to_string(count) + " vertices; it needs at least " +
                     std::to_string(N + 1) + ".",
                 {}};
  for (std::size_t v = 0; v < count; ++v)
    for (int k = 0; k < N; ++k)
      if (!std::isfinite(domain.vertices[v][k]))
        return Error{ErrorCode::notFinite,
                     "Vertex " + std::to_string(v) + " has a coordinate that is not a finite number.",
                     {{"vertex", static_cast<std::int64_t>(v)}}};
  const double size = domainSize(domain.vertices);
  if (!(size <= kLargestDomain) || (size > 0 && size < kSmallestDomain))
    return Error{ErrorCode::scaleExtreme,
                 "The domain has a size of " + formatNumber(size) + ", which is too " +
                     (size < 1 ? "small" : "large") +
                     " to reckon with: give its coordinates in another unit.",
                 {}};
  for (std::size_t f = 0; f < domain.facets.size(); ++f)
    for (const auto &loop : domain.facets[f].loops)
      for (const Index v : loop)
        if (v < 0 || at(v) >= count)
          return Error{ErrorCode::indexOutOfRange,
                       "Facet " + std::to_string(f) + " names vertex " + std::to_string(v) + " of " +
                           std::to_string(count) + ".",
                       {{"facet", static_cast<std::int64_t>(f)}}};
  return std::nullopt;
}

/// How well a place can be told at all in coordinates of this size: far from the origin, less well.
template <int N> double coordinateRounding(const Domain<N> &domain) {
  double largest = 0;
  for (const Vec<N> &v : domain.vertices)
    for (int k = 0; k < N; ++k) largest = std::max(largest, std::abs(v[k]));
  return 4 * std::numeric_limits<double>::epsilon() * largest;
}

/// Drops vertices that no facet uses (they would become nodes of the reference mesh) and renumbers; a given
/// reference mesh keeps its own numbering, so then all vertices stay.
template <int N> void compactVertices(PreparedDomain<N> &prepared) {
  Domain<N> &domain = prepared.domain;
  std::vector<Index> number(domain.vertices.size(), domain.reference ? 0 : kNone);
  for (const Facet &facet : domain.facets)
    for (const auto &loop : facet.loops)
      for (const Index v : loop) number[at(v)] = 0;
  std::vector<Vec<N>> kept;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = toIndex(kept.size());
    kept.push_back(domain.vertices[v]);
    prepared.givenVertex.push_back(toIndex(v));
  }
  for (Facet &facet : domain.facets)
    for (auto &loop : facet.loops)
      for (Index &v : loop) v = number[at(v)];
  domain.vertices = std::move(kept);
}

} // namespace dualblock
