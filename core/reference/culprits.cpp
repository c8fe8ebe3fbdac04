#include "reference/culprits.h"

#include <algorithm>

#include "domain/intersections.h"

namespace dualblock {

template <int N>
Error nameCulprits(const Error &error, const Domain<N> &given, const PreparedDomain<N> &prepared,
                   double tolerance) {
  if (error.code != ErrorCode::selfIntersection && error.code != ErrorCode::tetgenFailed) return error;
  if (const auto found = findIntersection(given, tolerance * domainSize(given.vertices))) {
    std::string where;
    for (int k = 0; k < N; ++k) where += (k ? ", " : "") + std::to_string(found->where[k]);
    return {ErrorCode::selfIntersection,
            "The boundary crosses itself: facets " + std::to_string(found->facetA) + " and " +
                std::to_string(found->facetB) + " meet at (" + where +
                "), where they share no edge. Make them meet only along shared edges.",
            {{"facet", found->facetA}, {"facet", found->facetB}}};
  }
  if (N == 2 || error.entities.empty()) return {error.code, error.message, {}};
  const auto &merged = prepared.facetOfGiven;
  const auto facet = std::find(merged.begin(), merged.end(), static_cast<Index>(error.entities[0].index));
  const std::int64_t number = facet - merged.begin();
  return {ErrorCode::openBoundary,
          "Facet " + std::to_string(number) +
              " has the outside on both of its sides: it encloses nothing. Remove it, or close the surface.",
          {{"facet", number}}};
}

template Error nameCulprits(const Error &, const Domain<2> &, const PreparedDomain<2> &, double);
template Error nameCulprits(const Error &, const Domain<3> &, const PreparedDomain<3> &, double);

} // namespace dualblock
