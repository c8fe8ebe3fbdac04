#include "support/bent_extrusions.h"

namespace dualblock::test {

std::vector<Vec<2>> turnedCircle(int n, double radius, double angle, const Vec<2> &middle) {
  std::vector<Vec<2>> polygon;
  for (int k = 0; k < n; ++k) {
    const double a = angle + 2 * kPi * k / n;
    polygon.push_back(middle + radius * Vec<2>(std::cos(a), std::sin(a)));
  }
  return polygon;
}

void addComponent(Domain<3> &domain, const Domain<3> &other) {
  const Index first = toIndex(domain.vertices.size());
  domain.vertices.insert(domain.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Facet facet : other.facets) {
    for (auto &loop : facet.loops)
      for (Index &v : loop) v += first;
    domain.facets.push_back(facet);
  }
}

std::vector<Vec<2>> stripBetween(const std::vector<Vec<2>> &right, const std::vector<Vec<2>> &left) {
  std::vector<Vec<2>> polygon = right;
  polygon.insert(polygon.end(), left.rbegin(), left.rend());
  return polygon;
}

Domain<3> randomSpiral(RandomSource &random) {
  for (;;) {
    const double turns = random.real(0.5, 3);
    const int perTurn = random.whole(12, turns > 2 ? 20 : 28);
    const double inner = random.real(0.6, 3);
    const double pitch = random.real(0.5, 1.5);
    const double width = random.real(0.25, turns > 1 ? 0.75 : 1.2) * pitch;
    const double atEnd = random.chance(0.5) ? width : width * random.real(0.3, 1);
    const bool mirrored = random.chance(0.5); // the taper at the other end
    const double start = random.real(0, 2 * kPi);
    const int steps = static_cast<int>(std::lround(turns * perTurn));
    std::vector<Vec<2>> outside;
    std::vector<Vec<2>> inside;
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const double radius = inner + width / 2 + pitch * turns * t;
      const double half = (mirrored ? atEnd + (width - atEnd) * t : width + (atEnd - width) * t) / 2;
      const double angle = start + 2 * kPi * turns * t;
      outside.push_back((radius + half) * Vec<2>(std::cos(angle), std::sin(angle)));
      inside.push_back((radius - half) * Vec<2>(std::cos(angle), std::sin(angle)));
    }
    const std::vector<Vec<2>> polygon = stripBetween(outside, inside);
    if (!isSimplePolygon(polygon, 0.08 * pitch)) continue;
    return prism(polygon, 0, width * random.real(0.5, 2.5));
  }
}

Domain<3> randomWave(RandomSource &random) {
  for (;;) {
    const double periods = random.real(0.5, 2.5);
    const int steps = static_cast<int>(periods * random.whole(16, 28));
    const double height = random.real(0.3, 1.6);
    const double length = random.real(2, 4); // of a period
    const double half = random.real(0.1, 0.45);
    const double start = random.real(0, 2 * kPi);
    std::vector<Vec<2>> right;
    std::vector<Vec<2>> left;
    for (int k = 0; k <= steps; ++k) {
      const double angle = start + 2 * kPi * periods * k / steps;
      const Vec<2> x((angle - start) * length / (2 * kPi), height * std::sin(angle));
      const Vec<2> along = glm::normalize(Vec<2>(length / (2 * kPi), height * std::cos(angle)));
      right.push_back(x + half * Vec<2>(along.y, -along.x));
      left.push_back(x - half * Vec<2>(along.y, -along.x));
    }
    // Where the inner line of a bend runs backwards the strip is too wide for it.
    bool forwards = true;
    for (std::size_t k = 1; k < right.size(); ++k) {
      const Vec<2> along = right[k] + left[k] - right[k - 1] - left[k - 1];
      const double least = 0.25 * glm::dot(along, along) / 2;
      forwards = forwards && glm::dot(right[k] - right[k - 1], along) > least &&
                 glm::dot(left[k] - left[k - 1], along) > least;
    }
    const std::vector<Vec<2>> polygon = stripBetween(right, left);
    if (!forwards || !isSimplePolygon(polygon, 0.3 * half)) continue;
    return prism(polygon, 0, half * random.real(0.8, 4));
  }
}

Domain<3> randomBearing(RandomSource &random) {
  const int n = random.whole(12, 32);
  const int m = random.chance(0.5) ? n : random.whole(12, 32);
  const double room = randomRoom(random);
  const double height = random.real(0.4, 2);
  const double hole = holeRadius(room, n);
  Domain<3> domain = random.chance(0.5) ? prism({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, 0, height)
                                        : prism(turnedCircle(random.chance(0.5) ? n : random.whole(16, 32),
                                                             hole + random.real(0.4, 1.2), random.real(0, 1)),
                                                0, height);
  const double angle = random.real(0, 1);
  addHole(domain, turnedCircle(n, hole, angle), 0, height);
  const double out = random.chance(0.5) ? 0 : random.real(0.1, 1);
  const double turn = random.chance(0.3) ? 0 : random.real(0, 2 * kPi / m);
  addComponent(domain, prism(turnedCircle(m, 1, angle + turn), -out, height + out));
  return domain;
}

Domain<3> randomPins(RandomSource &random) {
  const int count = random.whole(1, 3);
  const int n = random.whole(12, 20);
  const double height = random.real(0.5, 2);
  const double step = random.real(2.6, 3.5);
  const double side = random.real(1.4, 2.2);
  const double end = (count - 1) * step + side;
  Domain<3> domain = prism({{-side, -side}, {end, -side}, {end, side}, {-side, side}}, 0, height);
  std::vector<Domain<3>> pins;
  for (int k = 0; k < count; ++k) {
    const Vec<2> middle(k * step, 0);
    const double radius = random.real(0.6, 1);
    addHole(domain, turnedCircle(n, radius * holeRadius(randomRoom(random), n), random.real(0, 1), middle), 0,
            height);
    const double out = random.chance(0.4) ? 0 : random.real(0.1, 0.8);
    pins.push_back(
        prism(turnedCircle(random.whole(12, 20), radius, random.real(0, 1), middle), -out, height + out));
  }
  for (const Domain<3> &pin : pins) addComponent(domain, pin);
  return domain;
}

Domain<3> randomNotch(RandomSource &random) {
  const double room = randomRoom(random);
  const double depth = random.real(-0.4, 0.5); // of the middle, below the block's upper side
  const int steps = random.whole(8, 18);
  const double guess = 1 + room;
  // The longest step that may come of it: the radius will be up to 1.2 times as large.
  const double step =
      (kPi + 2 * std::max(std::asin(depth / guess), std::asin(depth / (1.2 * guess)))) / steps;
  const double radius = guess / std::cos(step / 2);
  const double begin = std::asin(depth / radius); // the arc ends on the upper side
  const double wide = radius + random.real(0.3, 1.5);
  const double low = -depth - radius - random.real(0.3, 1.5);
  std::vector<Vec<2>> outline{{-wide, low}, {wide, low}, {wide, 0}};
  for (int k = 0; k <= steps; ++k) {
    const double angle = begin - (kPi + 2 * begin) * k / steps;
    Vec<2> x(radius * std::cos(angle), radius * std::sin(angle) - depth);
    if (k == 0 || k == steps) x.y = 0;
    outline.push_back(x);
  }
  outline.emplace_back(-wide, 0);
  const double height = random.real(0.3, 1.5);
  Domain<3> domain = prism(outline, 0, height);
  const double out = random.chance(0.5) ? 0 : random.real(-0.1, 0.4);
  addComponent(domain, prism(turnedCircle(random.whole(14, 36), 1, random.real(0, 2 * kPi), {0, -depth}),
                             -out, height + out));
  return domain;
}

Domain<3> randomFlange(RandomSource &random) {
  const double height = random.real(0.2, 1);
  const double wide = random.real(1.3, 2.5);
  Domain<3> domain =
      random.chance(0.5)
          ? prism({{-wide, -wide}, {wide, -wide}, {wide * random.real(0.9, 1.3), wide}, {-wide, wide}}, 0,
                  height)
          : prism(turnedCircle(random.whole(14, 32), wide, random.real(0, 1)), 0, height);
  const Index outline = toIndex(domain.vertices.size()) / 2;
  const bool onBoth = random.chance(0.7);
  for (const bool above : {true, false}) {
    if (!above && !onBoth) continue;
    const std::vector<Vec<2>> polygon =
        turnedCircle(random.whole(12, 24), random.real(0.5, 1), random.real(0, 1),
                     {random.real(-0.1, 0.1), random.real(-0.1, 0.1)});
    const double near = above ? height : 0;
    const double far = above ? height + random.real(0.3, 2) : -random.real(0.3, 2);
    const Domain<3> shaft = above ? prism(polygon, near, far) : prism(polygon, far, near);
    const Index first = toIndex(domain.vertices.size());
    addComponent(domain, shaft);
    // The end at the plate is no facet but a hole in the plate's.
    const auto cap = domain.facets.end() - (above ? 2 : 1);
    const std::vector<Index> loop = cap->loops[0];
    domain.facets.erase(cap);
    for (Facet &facet : domain.facets) {
      const auto &outer = facet.loops[0];
      if (outer[0] < first && toIndex(outer.size()) == outline && facet.loops.size() == 1 &&
          std::all_of(outer.begin(), outer.end(), [&](Index v) { return domain.vertices[at(v)].z == near; }))
        facet.loops.push_back(loop);
    }
  }
  return domain;
}

} // namespace dualblock::test
