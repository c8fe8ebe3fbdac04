#include "reference/culprits.h"

#include <algorithm>

#include "domain/intersections.h"

namespace dualblock {

template <int N>
Error nameCulprits(const Error &error, const Domain<N> &given, const PreparedDomain<N> &prepared,
                   double tolerance) {
  if (error.code != ErrorCode::selfIntersection && error.code != ErrorCode::tetgenFailed) return error;
  const auto &merged = prepared.facetOfGiven;
  const auto givenFacet = [&](std::int64_t facet) {
    return std::find(merged.begin(), merged.end(), static_cast<Index>(facet)) - merged.begin();
  };
  const double touch = tolerance * domainSize(given.vertices);
  auto found = findIntersections(given, touch, kFoundPlaces);
  if (found.empty()) { // a vertex that coplanar facets share with others may be inside of what they became
    found = findIntersections(prepared.domain, touch, kFoundPlaces);
    for (Intersection<N> &place : found) {
      place.facetA = static_cast<Index>(givenFacet(place.facetA));
      place.facetB = static_cast<Index>(givenFacet(place.facetB));
    }
  }
  if (!found.empty())
    return {ErrorCode::selfIntersection,
            "The boundary crosses or touches itself: " + describeIntersections("facets", found) +
                ", where they share no edge. Make them meet only along shared edges.",
            culpritsOf("facet", found)};
  if (N == 2 || error.entities.empty()) return {error.code, error.message, {}};
  const std::int64_t number = givenFacet(error.entities[0].index);
  return {ErrorCode::openBoundary,
          "Facet " + std::to_string(number) +
              " has the outside on both of its sides: it encloses nothing. Remove it, or close the surface.",
          {{"facet", number}}};
}

template Error nameCulprits(const Error &, const Domain<2> &, const PreparedDomain<2> &, double);
template Error nameCulprits(const Error &, const Domain<3> &, const PreparedDomain<3> &, double);

} // namespace dualblock
