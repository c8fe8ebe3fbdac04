#include "support/bent_sweeps.h"

namespace dualblock::test {

Domain<3> sweep(const std::vector<Section> &sections, Index joint, bool alternate) {
  Domain<3> domain;
  const Index corners = toIndex(sections[0].size());
  const Index count = toIndex(sections.size());
  for (const Section &section : sections)
    domain.vertices.insert(domain.vertices.end(), section.begin(), section.end());
  const auto vertex = [&](Index s, Index k) {
    return s < count ? s * corners + k % corners : (k + joint) % corners;
  };
  for (Index s = 0; s < (joint == kNone ? count - 1 : count); ++s)
    for (Index k = 0; k < corners; ++k) {
      const Index a = vertex(s, k);
      const Index b = vertex(s, k + 1);
      const Index c = vertex(s + 1, k + 1);
      const Index d = vertex(s + 1, k);
      if (alternate && s % 2 == 1) {
        domain.facets.push_back({{{a, b, d}}});
        domain.facets.push_back({{{b, c, d}}});
      } else {
        domain.facets.push_back({{{a, b, c}}});
        domain.facets.push_back({{{a, c, d}}});
      }
    }
  if (joint != kNone) return domain;
  std::vector<Index> first;
  std::vector<Index> last;
  for (Index k = 0; k < corners; ++k) {
    first.insert(first.begin(), k);
    last.push_back(vertex(count - 1, k));
  }
  domain.facets.push_back({{first}});
  domain.facets.push_back({{last}});
  return domain;
}

std::vector<Vec<2>> rectangle(double width, double height) {
  return {
      {-width / 2, -height / 2}, {width / 2, -height / 2}, {width / 2, height / 2}, {-width / 2, height / 2}};
}

Section placed(const std::vector<Vec<2>> &flat, const Vec<3> &middle, const Vec<3> &u, const Vec<3> &v) {
  Section section;
  for (const Vec<2> &p : flat) section.push_back(middle + p.x * u + p.y * v);
  return section;
}

bool runsForwards(const std::vector<Section> &sections, bool isClosed) {
  const auto middleOf = [](const Section &section) {
    Vec<3> sum{0.0};
    for (const Vec<3> &x : section) sum += x / static_cast<double>(section.size());
    return sum;
  };
  const auto normalOf = [](const Section &x) { return glm::normalize(glm::cross(x[1] - x[0], x[2] - x[0])); };
  for (std::size_t s = 0; s + (isClosed ? 0 : 1) < sections.size(); ++s) {
    const Section &near = sections[s];
    const Section &far = sections[(s + 1) % sections.size()];
    const double least = 0.1 * glm::length(middleOf(far) - middleOf(near));
    for (const Vec<3> &x : far)
      if (glm::dot(x - near[0], normalOf(near)) < least) return false;
    for (const Vec<3> &x : near)
      if (glm::dot(far[0] - x, normalOf(far)) < least) return false;
  }
  return true;
}

bool hasRoom(const Sections &sections, Index joint, bool alternate) {
  return runsForwards(sections(1.15), joint != kNone) &&
         !crossesItself(sweep(sections(1.15), joint, alternate)) &&
         !crossesItself(sweep(sections(1), joint, alternate));
}

Domain<3> randomHelix(RandomSource &random, bool tight) {
  for (;;) {
    const double turns = random.chance(0.2) ? random.real(3, 4) : random.real(1, 3);
    const int perTurn = random.whole(12, turns > 2 ? 12 : 18);
    const double radius = random.real(1.2, 3);
    const double width = random.real(0.3, 0.9);
    const double height = random.chance(0.5) ? width : random.real(0.3, 0.9);
    const double pitch = height * (tight ? random.real(1.3, 2) : random.real(1.5, 5));
    const bool isUpright = !tight && random.chance(0.5);
    const bool isLeft = random.chance(0.5);
    const bool alternate = random.chance(0.3);
    const double last = random.chance(0.7) ? 1 : random.real(0.5, 1); // how large the other end is
    const int steps = static_cast<int>(std::lround(turns * perTurn));
    const auto sections = [&](double scale) {
      std::vector<Section> result;
      for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        const double angle = 2 * kPi * turns * t * (isLeft ? -1 : 1);
        const Vec<3> u(std::cos(angle), std::sin(angle), 0);
        const Vec<3> around = (isLeft ? -radius : radius) * Vec<3>(-u.y, u.x, 0);
        const Vec<3> rise(0, 0, isUpright ? 0 : pitch / (2 * kPi));
        const Vec<3> v = glm::cross(glm::normalize(around + rise), u);
        const double size = scale * (1 + (last - 1) * t);
        result.push_back(placed(rectangle(width * size, height * size),
                                radius * u + Vec<3>(0, 0, pitch * turns * t), u, v));
      }
      return result;
    };
    if (hasRoom(sections, kNone, alternate)) return sweep(sections(1), kNone, alternate);
  }
}

Domain<3> randomRing(RandomSource &random, bool isRound) {
  for (;;) {
    const int steps = random.whole(12, isRound ? 14 : 32);
    const double radius = random.real(1.5, 3);
    const double width = random.real(0.5, 1.2);
    const int quarters = isRound ? 0 : random.whole(-4, 4);
    const double oval = random.chance(0.5) ? 1 : random.real(0.7, 1.4); // the ring is an ellipse
    const double start = random.real(0, 2 * kPi);
    const bool alternate = steps % 2 == 0 && random.chance(0.3);
    const auto sections = [&](double scale) {
      std::vector<Section> result;
      for (int k = 0; k < steps; ++k) {
        const double angle = 2 * kPi * k / steps;
        const Vec<3> middle(radius * std::cos(angle), oval * radius * std::sin(angle), 0);
        const Vec<3> along = glm::normalize(Vec<3>(-std::sin(angle), oval * std::cos(angle), 0));
        const Vec<3> out(along.y, -along.x, 0);
        const double turn = start + 0.5 * kPi * quarters * k / steps;
        const Vec<3> up = glm::cross(along, out);
        result.push_back(
            placed(isRound ? circle(12, scale * width / 2) : rectangle(scale * width, scale * width), middle,
                   std::cos(turn) * out + std::sin(turn) * up, std::cos(turn) * up - std::sin(turn) * out));
      }
      return result;
    };
    // After the turn of the last section its corner k is where corner k + quarters of the first one was.
    const Index joint = (quarters + 8) % 4;
    if (hasRoom(sections, joint, alternate)) return sweep(sections(1), joint, alternate);
  }
}

std::vector<Vec<3>> randomCurve(RandomSource &random, int steps) {
  const bool isArc = random.chance(0.5);
  const double length = isArc ? random.real(1.5, 5.2) : random.real(4, 8);
  const double radius = random.real(1.5, 3);
  double height[2];
  double waves[2];
  double phase[2];
  for (int k = 0; k < 2; ++k) {
    height[k] = random.real(0, isArc ? 0.5 : 1);
    waves[k] = random.real(0.3, 1.3);
    phase[k] = random.real(0, 2 * kPi);
  }
  std::vector<Vec<3>> curve;
  for (int k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const double y = height[0] * std::sin(2 * kPi * waves[0] * t + phase[0]);
    const double z = height[1] * std::sin(2 * kPi * waves[1] * t + phase[1]);
    if (isArc)
      curve.emplace_back((radius + y) * std::cos(length * t), (radius + y) * std::sin(length * t), z);
    else curve.emplace_back(length * t, y, z);
  }
  return curve;
}

Domain<3> randomTube(RandomSource &random, bool isRound) {
  for (;;) {
    const int steps = isRound ? random.whole(8, 12) : random.whole(10, 30);
    const std::vector<Vec<3>> curve = randomCurve(random, steps);
    const double width = random.real(0.4, 1.2);
    const double height = isRound || random.chance(0.5) ? width : random.real(0.4, 1.2);
    const double last = random.chance(0.5) ? 1 : random.real(0.5, 1);
    const double twist = isRound || random.chance(0.5) ? 0 : random.real(-2, 2);
    const bool alternate = random.chance(0.3);
    const auto sections = [&](double scale) {
      std::vector<Section> result;
      Vec<3> u(0.1, 0.2, 1);
      for (int k = 0; k <= steps; ++k) {
        const Vec<3> along =
            glm::normalize(curve[at(std::min(k + 1, steps))] - curve[at(std::max(k - 1, 0))]);
        u = glm::normalize(u - glm::dot(u, along) * along); // turns as little as it can
        const Vec<3> v = glm::cross(along, u);
        const double t = static_cast<double>(k) / steps;
        const double size = scale * (1 + (last - 1) * t);
        const auto flat = isRound ? circle(12, size * width / 2) : rectangle(size * width, size * height);
        result.push_back(placed(flat, curve[at(k)], std::cos(twist * t) * u + std::sin(twist * t) * v,
                                std::cos(twist * t) * v - std::sin(twist * t) * u));
      }
      return result;
    };
    if (hasRoom(sections, kNone, alternate)) return sweep(sections(1), kNone, alternate);
  }
}

Domain<3> randomLathe(RandomSource &random) {
  const int rings = random.whole(2, 6);
  std::vector<Vec<2>> profile;
  double z = 0;
  double radius = random.real(0.4, 1.2);
  bool isStep = true; // the ring before has the same height: not twice, and not at an end
  profile.emplace_back(0, random.chance(0.7) ? 0 : -random.real(0.2, 0.8));
  for (int k = 0; k < rings; ++k) {
    profile.emplace_back(radius, z);
    if (k + 1 == rings) break;
    const double last = radius;
    radius = random.real(0.4, 1.4);
    if (random.chance(0.3)) radius = last; // a cylinder
    isStep = !isStep && std::abs(radius - last) > 0.1 && k + 2 < rings && random.chance(0.4);
    if (!isStep) z += random.real(0.25, 1);
  }
  profile.emplace_back(0, random.chance(0.7) ? z : z + random.real(0.2, 0.8));
  return revolved(profile, random.whole(12, rings > 4 ? 20 : 28));
}

Domain<3> randomBush(RandomSource &random) {
  const int steps = random.whole(12, 28);
  const int levels = random.whole(1, 3);
  const double bore = random.real(0.6, 1.5);
  const double height = random.real(0.5, 2.5);
  const double taper = random.chance(0.5) ? 0 : random.real(-0.2, 0.2);
  std::vector<Vec<2>> profile{{bore, 0}}; // (radius, height), counter-clockwise
  for (int k = 0; k <= levels; ++k) profile.emplace_back(bore + random.real(0.5, 1.2), height * k / levels);
  profile.emplace_back(bore + taper, height);
  std::vector<Section> sections;
  for (int k = 0; k < steps; ++k) {
    const double angle = -2 * kPi * k / steps; // so that the profile is seen counter-clockwise
    sections.push_back(placed(profile, {0, 0, 0}, {std::cos(angle), std::sin(angle), 0}, {0, 0, 1}));
  }
  Domain<3> domain = sweep(sections, 0, false);
  Domain<3> quads = domain; // plane ones
  quads.facets.clear();
  for (std::size_t f = 0; f + 1 < domain.facets.size(); f += 2) {
    const auto &first = domain.facets[f].loops[0];
    quads.facets.push_back({{{first[0], first[1], first[2], domain.facets[f + 1].loops[0][2]}}});
  }
  return quads;
}

} // namespace dualblock::test
