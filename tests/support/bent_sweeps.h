// Random solids that follow a curve: helices, springs, rings that are twisted, tubes; and surfaces of
// revolution. Sweeps are tried until their surface does not cross itself.
#pragma once

#include <functional>

#include "support/bent_extrusions.h"

namespace dualblock::test {

/// The corners of a section, counter-clockwise, where the curve comes towards the eye.
using Section = std::vector<Vec<3>>;

/// Sections joined by triangles; `joint`: the corners by which the last one is turned where it is joined with
/// the first one, or kNone for two plane ends. The diagonals are turned every other time where `alternate`.
Domain<3> sweep(const std::vector<Section> &sections, Index joint, bool alternate);

/// A section's corners around (0, 0): a rectangle, or a circle of twelve.
std::vector<Vec<2>> rectangle(double width, double height);

Section placed(const std::vector<Vec<2>> &flat, const Vec<3> &middle, const Vec<3> &u, const Vec<3> &v);

/// How `scale` times the sections of a solid look; asked for larger ones than those that are used, so that
/// there is room between the turns.
using Sections = std::function<std::vector<Section>(double scale)>;

/// Each section is in front of the plane of the one before it, and that one behind its own: nothing folds
/// where the curve bends.
bool runsForwards(const std::vector<Section> &sections, bool isClosed);

bool hasRoom(const Sections &sections, Index joint, bool alternate);

/// A rectangle along a helix of one to four turns. `tight`: flat springs with square ends and little between
/// the turns; else the sections stand upright or square to the curve.
Domain<3> randomHelix(RandomSource &random, bool tight);

/// A closed ring of square section, twisted by up to four quarter turns either way, or of round section.
Domain<3> randomRing(RandomSource &random, bool isRound);

/// A smooth curve: a graph over a line, or an arc of up to 300 degrees, with waves across.
std::vector<Vec<3>> randomCurve(RandomSource &random, int steps);

/// A square or round section along such a curve, also tapered, and turned by up to 120 degrees on its way.
Domain<3> randomTube(RandomSource &random, bool isRound);

/// A solid of revolution with up to five cones between its ends, some of them plane.
Domain<3> randomLathe(RandomSource &random);

/// A ring with a bore, of a slanted or a bulging wall: a closed profile, rotated.
Domain<3> randomBush(RandomSource &random);

} // namespace dualblock::test
