// Where a boundary crosses or touches itself: found by brute force over pairs that may meet, to name the
// culprits. In 2D it runs before the reference mesh is made, in 3D after TetGen has refused the domain.
#pragma once

#include <string>
#include <vector>

#include "domain/domain.h"

namespace dualblock {

/// Two facets that meet where they share no vertex or edge, at a point where they do.
template <int N> struct Intersection {
  Index facetA, facetB;
  Vec<N> where;
};

/// The places, one for each pair of facets, `most` of them and no more. Of 3D facets also edges may meet, or
/// a vertex and an edge. tolerance: absolute; features nearer than this touch.
std::vector<Intersection<2>> findIntersections(const Domain<2> &domain, double tolerance, std::size_t most);
std::vector<Intersection<3>> findIntersections(const Domain<3> &domain, double tolerance, std::size_t most);

/// Pairs of facets whose places a message gives, and those that are looked for: their facets are an error's
/// entities.
constexpr std::size_t kNamedPlaces = 8;
constexpr std::size_t kFoundPlaces = 1000;

/// What is said of them: "<Facets> 3 and 17 meet at (0, 1, 2), 4 and 18 at (0, 1, 3), and others: 12 pairs in
/// all".
template <int N>
std::string describeIntersections(const std::string &facets, const std::vector<Intersection<N>> &found);

/// The facets of the places that are named, as entities of a `kind`.
template <int N>
std::vector<EntityRef> culpritsOf(const std::string &kind, const std::vector<Intersection<N>> &found);

} // namespace dualblock
