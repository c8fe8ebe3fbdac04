// Where cuts of parts with bent sides come from, and what each source answers (ARCHITECTURE.md 3, rule 3).
#pragma once

#include <array>
#include <optional>

#include "partition/part_view.h"

namespace dualblock {

/// What could be cut to answer one finding about a part, best first; nothing where the part has none.
using Source = std::vector<Cut> (*)(const PartView &part);

/// Along the longest reflex crease inside each bent side that lies in a plane: one that fades out, as where
/// two pipes of one width meet, is no curve of the part.
std::vector<Cut> throughCreases(const PartView &part);

/// A part without curves: through its middle, across the direction in which it extends least.
std::vector<Cut> acrossMiddle(const PartView &part);

/// Bent sides that are closed in themselves: through their middle.
std::vector<Cut> throughVoids(const PartView &part);

/// Two sides that meet in several curves: between the first of them and the others.
std::vector<Cut> betweenCurves(const PartView &part);

/// Planes through the axes of closed curves, best first: by axes of other curves that they hold, then corners
/// of the part, then nodes of the curve, then how near they are to a coordinate plane. Where all corners are
/// on one side of the axis, the half plane there is enough.
std::vector<Cut> alongAxes(const PartView &part);

/// Square to curves where they turn sharply between two sides, so that a third one meets them there.
std::vector<Cut> throughKinks(const PartView &part);

/// Half way between two corners where the same sides meet.
std::vector<Cut> betweenCorners(const PartView &part);

/// Through a corner where more than three sides meet, or a place where the side behind one of the part's has
/// a corner: along what already meets there. The first by its place.
std::vector<Cut> throughJoints(const PartView &part);

/// Square to curves that turn further than the two edges that stand for them may, the furthest first.
std::vector<Cut> acrossCurves(const PartView &part);

/// For the shape: across bent sides that turn too far.
std::vector<Cut> acrossTurns(const PartView &part);

/// What would halve a part whose blocks do not serve: across whichever of its curves and bent sides turns
/// most, at nodes of the domain, so that in the end there is an edge for each of its facets.
std::vector<Cut> halving(const PartView &part);

/// The findings in the order in which they are answered, each for all parts before the next.
inline constexpr std::array<Source, 1> kSmoothing{throughCreases};
inline constexpr std::array<Source, 6> kSimplifying{
    acrossMiddle,   // no curve
    throughVoids,   // a closed side
    betweenCurves,  // several curves between two sides
    alongAxes,      // a closed curve
    throughKinks,   // a kink
    betweenCorners, // corners of the same sides
};
inline constexpr std::array<Source, 1> kJoining{throughJoints}; // crowded corners, unlike sides
inline constexpr std::array<Source, 1> kFollowing{acrossCurves};
inline constexpr std::array<Source, 1> kShaping{acrossTurns};

/// Where a plane nearly holds or halves axes of the domain, or is square to one where another meets it, the
/// one that does: nodes near which surfaces touch are inexact, and planes by them would leave slivers.
Plane<3> plainPlane(const PartView &part, const Plane<3> &plane);

} // namespace dualblock
