// One part, as sources of cuts see it.
#pragma once

#include "partition/cut.h"
#include "parts/chains.h"

namespace dualblock {

struct PartView {
  const ReferenceMesh<3> &mesh;
  const Parts<3> &parts;
  Index part;
  std::vector<const Curve<3> *> curves;
  std::vector<const Corner *> corners;
  const std::vector<Axis> &axes; // of the domain's own curves
  bool cutsHollows = false;      // CutPolicy::isLast

  const Vec<3> &node(Index n) const { return mesh.nodes[at(n)]; }
  /// On the domain's boundary or an interface: bent cuts are ragged on coarse meshes, and their turns mean
  /// little.
  bool isGiven(Index side) const { return kindOf(side) == SurfaceKind::facet; }
  SurfaceKind kindOf(Index side) const { return surfaceOf(side).kind; }
  bool isBent(Index side) const { return surfaceOf(side).bent; }
  const Index *firstSide() const { return parts.partSides.begin(part); }
  const Index *lastSide() const { return parts.partSides.end(part); }
  bool hasBentSide() const {
    return std::any_of(firstSide(), lastSide(), [&](Index side) { return isBent(side); });
  }

private:
  const Surface<3> &surfaceOf(Index side) const {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))];
  }
};

/// Calls `visit` for each part, in their order; its curves and corners are looked up once.
template <typename Visit>
void visitParts(const ReferenceMesh<3> &mesh, const Parts<3> &parts, const std::vector<Axis> &axes,
                const Visit &visit) {
  PartView v{mesh, parts, 0, {}, {}, axes};
  std::size_t curve = 0;
  std::size_t corner = 0;
  for (; v.part < toIndex(parts.parts.size()); ++v.part) {
    v.curves.clear();
    v.corners.clear();
    for (; curve < parts.curves.size() && parts.curves[curve].part == v.part; ++curve)
      v.curves.push_back(&parts.curves[curve]);
    for (; corner < parts.corners.size() && parts.corners[corner].part == v.part; ++corner)
      v.corners.push_back(&parts.corners[corner]);
    if (visit(v)) return;
  }
}

} // namespace dualblock
