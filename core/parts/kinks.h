// Where a curve of a bent side turns so sharply that a vertex of the domain is there, though only two sides
// meet. Internal to parts/.
#pragma once

#include <tuple>

#include "parts/parts.h"

namespace dualblock {

/// A node inside a curve, and the curve's part.
struct Kink {
  Index node, part;
  bool operator<(const Kink &o) const { return std::tie(node, part) < std::tie(o.node, o.part); }
};

/// Ascending. Only curves between given sides have kinks, and only at bent ones: planes meet in straight
/// lines, and cuts of bent parts are ragged.
template <int N> std::vector<Kink> findKinks(const ReferenceMesh<N> &mesh, const Parts<N> &parts);

} // namespace dualblock
