// Random bent solids by kind, each from a seed of its own. The same seed gives the same solid everywhere, up
// to the rounding of sines. All of them are valid: closed, oriented outward, and nowhere touching themselves.
#pragma once

#include "support/bent_sweeps.h"

namespace dualblock::test {

struct BentKind {
  const char *name;
  Domain<3> (*make)(RandomSource &random);
};

inline constexpr std::array<BentKind, 14> kBentKinds{{
    {"spiral", randomSpiral},
    {"wave", randomWave},
    {"helix", [](RandomSource &random) { return randomHelix(random, false); }},
    {"spring", [](RandomSource &random) { return randomHelix(random, true); }},
    {"square ring", [](RandomSource &random) { return randomRing(random, false); }},
    {"round ring", [](RandomSource &random) { return randomRing(random, true); }},
    {"square tube", [](RandomSource &random) { return randomTube(random, false); }},
    {"round tube", [](RandomSource &random) { return randomTube(random, true); }},
    {"bearing", randomBearing},
    {"pins", randomPins},
    {"notch", randomNotch},
    {"flange", randomFlange},
    {"lathe", randomLathe},
    {"bush", randomBush},
}};
inline constexpr int kBentKindCount = static_cast<int>(kBentKinds.size());

/// The solid of a kind and a seed; every other one is turned, and every fifth one is small and far away.
Domain<3> bentSolid(int kind, std::uint32_t seed);

} // namespace dualblock::test
