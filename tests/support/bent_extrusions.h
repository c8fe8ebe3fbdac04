// Random solids with bent walls and plane ends: strips along spirals and waves, shafts, pins and discs with
// little room around them. Nothing touches itself: polygons are tried until they are simple, and holes are
// wider than what is in them by the room that is asked for, however both are turned.
#pragma once

#include "support/round_solids.h"
#include "support/self_crossing.h"

namespace dualblock::test {

inline constexpr double kPi = std::numbers::pi;

/// The corners of a regular polygon, turned by an angle.
std::vector<Vec<2>> turnedCircle(int n, double radius, double angle, const Vec<2> &middle = {0, 0});

/// The domain with another one that it does not touch.
void addComponent(Domain<3> &domain, const Domain<3> &other);

/// A strip of the plane between two lines of as many points, the second one on the left.
std::vector<Vec<2>> stripBetween(const std::vector<Vec<2>> &right, const std::vector<Vec<2>> &left);

/// A strip along a spiral of half a turn to three turns; every other one is tapered, at either end.
Domain<3> randomSpiral(RandomSource &random);

/// A strip along a sine, of half a period to two and a half.
Domain<3> randomWave(RandomSource &random);

/// The radius of a hole of n sides that leaves `room` around a shaft of radius 1, whichever way both are
/// turned: nowhere less, measured in the middle of the hole's sides.
inline double holeRadius(double room, int n) { return (1 + room) / std::cos(kPi / n); }

/// From 0.002 to 0.1, small ones as often as large ones.
inline double randomRoom(RandomSource &random) { return 0.002 * std::pow(50, random.real(0, 1)); }

/// A shaft in a ring, flush with it or longer.
Domain<3> randomBearing(RandomSource &random);

/// A plate with up to three holes in a row, with a pin in each, turned against its hole.
Domain<3> randomPins(RandomSource &random);

/// A disc in a round notch of a block: half of it or less is in the block, or so much that it is held.
Domain<3> randomNotch(RandomSource &random);

/// A shaft through a plate, of one piece: on both sides of it or on one, also of two diameters.
Domain<3> randomFlange(RandomSource &random);

} // namespace dualblock::test
