// The domain's features (paper 2.4): curves by the number of blocks that should meet along them, vertices by
// the feature curves that meet there.
#pragma once

#include "parts/parts.h"

namespace dualblock {

/// By the interior angle: up to 135 degrees, up to 225, up to 315, beyond. The value is the number of blocks
/// that should meet there (figures 2 and 4). In 2D the "curves" are the vertices.
enum class CurveKind : std::uint8_t { end = 1, side = 2, corner = 3, reversal = 4 };

/// By the number of curves other than `side` that meet at a vertex in 3D: none, one, two, more (figure 3). In
/// 2D `vertex` for a feature, `face` for a vertex of type side.
enum class VertexKind : std::uint8_t { face = 0, semiEdge = 1, edge = 2, vertex = 3 };

struct Features {
  std::vector<CurveKind> curves;    // as Parts::curves of the uncut mesh
  std::vector<Index> vertexNodes;   // ascending
  std::vector<VertexKind> vertices; // per vertex node
};

/// Radians: angles that differ by less do so by rounding, which is not the same on every reference mesh. What
/// compares them with round numbers allows for it.
inline constexpr double kAngleSlack = 1e-7;

/// angle: inside the domain, in radians.
CurveKind curveKind(double angle);

/// Drops what is no vertex of the domain from the corners of the uncut parts: nodes of a refined mesh on an
/// edge along which a region of an assembly touches itself, with sides of its own in either wedge.
template <int N> void keepVertices(const ReferenceMesh<N> &mesh, Parts<N> &uncut);

/// uncut: the parts of a mesh without split surfaces.
template <int N> Features classifyFeatures(const Parts<N> &uncut);

/// The most that the smallest scaled Jacobian of any block mesh of the domain can be, by its acute angles:
/// between two sides along a curve, and of a side at a vertex, which blocks have as well. 1 where none is
/// acute.
template <int N> double angleBound(const ReferenceMesh<N> &mesh, const Parts<N> &uncut);

extern template double angleBound(const ReferenceMesh<2> &, const Parts<2> &);
extern template double angleBound(const ReferenceMesh<3> &, const Parts<3> &);
extern template void keepVertices(const ReferenceMesh<2> &, Parts<2> &);
extern template void keepVertices(const ReferenceMesh<3> &, Parts<3> &);
extern template Features classifyFeatures(const Parts<2> &);
extern template Features classifyFeatures(const Parts<3> &);

} // namespace dualblock
