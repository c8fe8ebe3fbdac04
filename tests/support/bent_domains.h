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
inline Domain<3> bentSolid(int kind, std::uint32_t seed) {
  RandomSource random(100000 * static_cast<std::uint32_t>(kind + 1) + seed);
  Domain<3> domain = kBentKinds[at(kind)].make(random);
  domain.name = kBentKinds[at(kind)].name;
  if (seed % 2 == 0) {
    const double s = random.real(0, 3);
    const double t = random.real(0, 3);
    for (Vec<3> &v : domain.vertices) {
      const Vec<3> y{std::cos(s) * v.x - std::sin(s) * v.y, std::sin(s) * v.x + std::cos(s) * v.y, v.z};
      v = {y.x, std::cos(t) * y.y - std::sin(t) * y.z, std::sin(t) * y.y + std::cos(t) * y.z};
    }
  }
  if (seed % 5 == 0)
    for (Vec<3> &v : domain.vertices) v = 0.01 * v + Vec<3>{1, -2, 0.5};
  return domain;
}

} // namespace dualblock::test
