// What bent cuts are proposed from, and how they are. Internal to parts/.
#pragma once

#include <optional>

#include "parts/chains.h"
#include "reference/cut.h"

namespace dualblock {

/// A proposal: where to cut, and the nodes from which the cut spreads (none: from anywhere in the part).
struct Proposal {
  Surface<3> surface;
  std::vector<Index> from;
};

/// A closed curve and the sides that meet in it.
struct Loop {
  Chain chain;
  std::array<Index, 2> sides;
};

/// What one part consists of.
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
  SurfaceKind kindOf(Index side) const {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))].kind;
  }
  bool isBent(Index side) const {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))].bent;
  }
};

inline Surface<3> planeSurface(const Vec<3> &point, const Vec<3> &normal) {
  return {SurfaceKind::bentCut, kNone, planeThrough(point, normal)};
}

/// Curves that bent cuts have left are ragged: those of the domain itself know their axis better, and those
/// on a given side and a plane cut hardly less so.
int raggedness(const PartView &part, const Loop &loop);

/// The nodes of a chain on the side of its axis that `towards` points to.
std::vector<Index> halfOf(const PartView &part, const Chain &chain, const Axis &axis, const Vec<3> &towards);

/// The part's closed curves, and the axes of the domain's that its open ones are arcs of.
struct Turns {
  std::vector<Loop> loops;
  std::vector<const Axis *> arcs; // each once
};

/// Planes through the axis of a closed curve, best first: by axes of other curves that they hold, then
/// corners of the part, then nodes of the curve, then how near they are to a coordinate plane. Where all
/// corners are on one side of the axis, the half plane there is enough.
std::vector<Proposal> alongAxis(const PartView &part, const Loop &loop, const Turns &turns);

/// Along the longest reflex crease inside a bent side that lies in a plane: one that fades out, as where two
/// pipes of one width meet, is no curve of the part.
std::optional<Proposal> throughCrease(const PartView &part, Index side);

/// What would make a part's shape better: planes across sides that turn too far.
std::vector<Proposal> shaping(const PartView &part);

/// What a part needs for its blocks to follow it: planes square to curves that turn further than the two
/// edges that stand for them may, the furthest first.
std::vector<Proposal> following(const PartView &part);

/// What would halve a part whose blocks do not serve: across whichever of its curves and bent sides turns
/// most, at nodes of the domain, so that in the end there is an edge for each of its facets.
std::vector<Proposal> halving(const PartView &part);

/// Where a plane nearly holds or halves axes of the domain, or is square to one where another meets it, the
/// one that does: nodes near which surfaces touch are inexact, and planes by them would leave slivers.
Plane<3> plainPlane(const PartView &part, const Plane<3> &plane);

} // namespace dualblock
