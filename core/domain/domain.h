// What a user gives: a domain bounded by straight segments (2D) or planar facets (3D).
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "base/error.h"
#include "base/types.h"

namespace dualblock {

/// A planar facet as loops of vertex indices: the outer loop first, then holes (3D); in 2D one "loop"
/// of two vertices, a segment with the domain on its left.
struct Facet {
  std::vector<std::vector<Index>> loops;
  bool isInterface = false; // two solids share it: the domain lies on both of its sides
};

template <int N> struct Region {
  Vec<N> point;
  Index id;
};

/// A reference mesh given by the user instead of TetGen's. Node i < vertices.size() is vertex i.
template <int N> struct GivenReference {
  std::vector<Vec<N>> nodes;
  std::vector<std::array<Index, N + 1>> simplices;
};

/// One contribution given by the user: a subset of the nodes of a simplex (paper 4.1), hard or soft.
struct GivenContribution {
  Index simplex;
  std::vector<Index> nodes;
  bool hard;
};

template <int N> struct Domain {
  std::string name;
  std::string title;
  std::string figure; // of the paper, where the domain is one of its examples
  std::vector<Vec<N>> vertices;
  std::vector<Facet> facets;
  std::vector<Vec<N>> holes;
  std::vector<Region<N>> regions;
  bool isSolid = false; // all that the facets enclose belongs to the domain but what holes take away; else
                        // shells inside shells are cavities
  std::optional<GivenReference<N>> reference;
  std::vector<GivenContribution> contributions;
};

using AnyDomain = std::variant<Domain<2>, Domain<3>>;

/// Length of the diagonal of the vertices' bounding box; 0 for no vertices.
template <int N> double domainSize(const std::vector<Vec<N>> &vertices) {
  if (vertices.empty()) return 0;
  Vec<N> low = vertices[0];
  Vec<N> high = vertices[0];
  for (const Vec<N> &v : vertices)
    for (int k = 0; k < N; ++k) {
      low[k] = v[k] < low[k] ? v[k] : low[k];
      high[k] = v[k] > high[k] ? v[k] : high[k];
    }
  return glm::length(high - low);
}

} // namespace dualblock
