// Typed tests over the dimension, and the examples of each that reference meshes are tried on.
#pragma once

#include <type_traits>

#include <gtest/gtest.h>

#include "support/examples.h"
#include "support/mesh_invariants.h"

namespace dualblock::test {

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

template <int N> std::vector<std::string> meshExamples() {
  if constexpr (N == 2)
    return {"square_2d",    "l_shape_2d",      "square_ring_2d",
            "two_holes_2d", "vertex_reversal", "square_2d_second"};
  else
    return {"tetrahedron", "tapered_brick", "l_shape_extruded", "square_ring", "protrusion", "icosahedron"};
}

/// Calls visit(mesh, label) for coarse, refined and random reference meshes of several examples.
template <int N, typename Visit> void forMeshes(Visit visit) {
  for (const std::string &name : meshExamples<N>()) {
    const Domain<N> domain = loadExample<N>(name);
    for (const auto &[edgeLength, seed] :
         {std::pair(0.0, 0U), std::pair(0.6, 0U), std::pair(0.0, 9U), std::pair(0.7, 8U)}) {
      SCOPED_TRACE(name + ", edge length " + std::to_string(edgeLength) + ", seed " + std::to_string(seed));
      visit(fill(domain, edgeLength, seed));
    }
  }
}

template <int N> void expectSound(const ReferenceMesh<N> &mesh) {
  EXPECT_EQ(brokenInvariants(mesh), std::vector<std::string>{});
}

} // namespace dualblock::test
