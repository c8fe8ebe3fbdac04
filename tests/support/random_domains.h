// Random solids by kind, each from a seed of its own. The same seed gives the same domain everywhere.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "support/examples.h"
#include "support/random_source.h"
#include "support/transforms.h"
#include "support/voxels.h"

namespace dualblock::test {

/// The hull of random points in a ball, by brute force over triples; all facets are triangles.
Domain<3> randomHull(RandomSource &random);

std::vector<Vec<2>> randomStar(RandomSource &random, int corners, double low, double high, const Vec<2> &at);

/// A star with equal points, full of places that only rounding tells apart.
std::vector<Vec<2>> regularStar(int points, double inner);

/// A plane domain with reflex corners, every other one regular.
Domain<2> randomPolygon(std::uint32_t seed);

/// A prism over such a polygon that narrows or widens, and leans, so that its reflex curves have no direction
/// in common; every other one regular, and some of these upright.
Domain<3> randomFrustum(std::uint32_t seed);

/// Adds the walls of a hole, given counter-clockwise, to a prism, and its loops to the prism's base and roof.
void addHole(Domain<3> &prism, const std::vector<Vec<2>> &polygon, double bottom, double top);

/// A prism over a star-shaped polygon with up to two polygonal holes.
Domain<3> randomExtrusion(RandomSource &random);

/// A union of boxes: cells of a grid whose planes stand at random distances. Contacts along edges and at
/// vertices are left in.
Domain<3> randomBoxes(RandomSource &random, bool connected);

/// Cells of a grid in up to three regions; a facet between two regions is given once.
Domain<3> randomAssembly(RandomSource &random);

/// A cylinder, a pipe, or a plate with a round hole off its middle.
Domain<3> randomRound(RandomSource &random);

/// A hull with prisms of their own regions on some of its facets: parts that need no cut around one that
/// does.
Domain<3> randomGem(RandomSource &random);

/// Kinds of random solids, for tests that go through all of them.
inline constexpr int kRandomKinds = 7;

/// The solid of a kind and a seed; every third one sheared, every other one turned, some of them tiny, huge
/// or far away.
Domain<3> randomSolid(int kind, std::uint32_t seed);

} // namespace dualblock::test
