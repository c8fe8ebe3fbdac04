// Curved solids as triangles and polygons, for tests: with counts that follow from how they should be cut.
#pragma once

#include <cmath>
#include <numbers>

#include "support/random_domains.h"

namespace dualblock::test {

std::vector<Vec<2>> circle(int n, double radius, const Vec<2> &at = {0, 0});

Domain<3> cylinder(int n);

Domain<3> plateWithHole(int n);

/// A surface of revolution about z: `profile` from pole to pole, (radius, height), both ends on the axis.
Domain<3> revolved(const std::vector<Vec<2>> &profile, int n);

Domain<3> ball(int n);

Domain<3> cone(int n);

/// Two cylinders, the smaller one on the larger.
Domain<3> shaft(int n);

/// A ring, or a piece of it by `sweep` radians that ends in two discs.
Domain<3> torus(int around, int across, double sweep = 2 * std::numbers::pi);

} // namespace dualblock::test
