#include "support/random_domains.h"

namespace dualblock::test {

Domain<3> randomHull(RandomSource &random) {
  std::vector<Vec<3>> points;
  const int count = random.whole(4, 11);
  while (toIndex(points.size()) < count) {
    const Vec<3> p(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    if (glm::length(p) > 0.3 && glm::length(p) <= 1) points.push_back(p);
  }
  Domain<3> domain;
  domain.name = "hull";
  domain.vertices = points;
  const Index n = toIndex(points.size());
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b)
      for (Index c = b + 1; c < n; ++c) {
        const Vec<3> normal = glm::cross(points[at(b)] - points[at(a)], points[at(c)] - points[at(a)]);
        int front = 0;
        int behind = 0;
        for (Index d = 0; d < n; ++d)
          if (d != a && d != b && d != c)
            ++(glm::dot(normal, points[at(d)] - points[at(a)]) > 0 ? front : behind);
        if (front > 0 && behind > 0) continue;
        if (front > 0) domain.facets.push_back({{{a, c, b}}});
        else domain.facets.push_back({{{a, b, c}}});
      }
  return domain;
}

std::vector<Vec<2>> randomStar(RandomSource &random, int corners, double low, double high, const Vec<2> &at) {
  std::vector<Vec<2>> polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k + random.real(-0.3, 0.3)) / corners;
    const double radius = random.real(low, high);
    polygon.push_back(at + radius * Vec<2>(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

std::vector<Vec<2>> regularStar(int points, double inner) {
  std::vector<Vec<2>> polygon;
  for (int k = 0; k < 2 * points; ++k) {
    const double angle = std::numbers::pi * k / points;
    polygon.push_back((k % 2 == 0 ? 2 : 2 * inner) * Vec<2>(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

Domain<2> randomPolygon(std::uint32_t seed) {
  RandomSource random(seed);
  const std::vector<Vec<2>> polygon = seed % 2 == 0 ? randomStar(random, random.whole(4, 14), 0.4, 2, {0, 0})
                                                    : regularStar(random.whole(3, 8), random.real(0.3, 0.9));
  Domain<2> domain;
  domain.name = "polygon";
  domain.vertices = polygon;
  const Index n = toIndex(polygon.size());
  for (Index k = 0; k < n; ++k) domain.facets.push_back({{{k, (k + 1) % n}}});
  return domain;
}

Domain<3> randomFrustum(std::uint32_t seed) {
  RandomSource random(seed);
  const bool isRegular = seed % 2 == 1;
  Domain<3> domain = prism(isRegular ? regularStar(random.whole(3, 6), random.real(0.35, 0.8))
                                     : randomStar(random, random.whole(4, 10), 0.5, 2, {0, 0}),
                           0, random.real(0.4, 2));
  const double scale = isRegular && random.chance(0.5) ? 1 : random.real(0.5, 1.3);
  const double reach = isRegular ? 0 : 0.4;
  const Vec<2> shift(random.real(-reach, reach), random.real(-reach, reach));
  for (Vec<3> &v : domain.vertices)
    if (v.z > 0) v = {scale * v.x + shift.x, scale * v.y + shift.y, v.z};
  domain.name = "frustum";
  return domain;
}

void addHole(Domain<3> &prism, const std::vector<Vec<2>> &polygon, double bottom, double top) {
  const Index first = toIndex(prism.vertices.size());
  const Index n = toIndex(polygon.size());
  for (const double height : {bottom, top})
    for (const Vec<2> &p : polygon) prism.vertices.emplace_back(p.x, p.y, height);
  std::vector<Index> base;
  std::vector<Index> roof;
  for (Index k = 0; k < n; ++k) {
    base.push_back(first + k);
    roof.insert(roof.begin(), first + n + k);
    prism.facets.push_back({{{first + (k + 1) % n, first + k, first + n + k, first + n + (k + 1) % n}}});
  }
  for (Facet &facet : prism.facets) { // the base and the roof have as many corners as the outline
    if (prism.vertices[at(facet.loops[0][0])].z == prism.vertices[at(facet.loops[0][2])].z)
      facet.loops.push_back(prism.vertices[at(facet.loops[0][0])].z == bottom ? base : roof);
  }
}

Domain<3> randomExtrusion(RandomSource &random) {
  const double top = random.real(0.3, 2);
  const int holes = random.whole(0, 2);
  Domain<3> domain = prism(randomStar(random, random.whole(3, 9), holes > 0 ? 1.2 : 0.4, 2, {0, 0}), 0, top);
  if (holes > 0 && domain.vertices.size() < 10)
    return domain; // triangles and squares are too narrow for holes
  for (int h = 0; h < holes; ++h)
    addHole(domain,
            randomStar(random, random.whole(3, 5), 0.1, 0.2, {holes == 1 ? 0.1 : 0.6 * h - 0.3, 0.05}), 0,
            top);
  domain.name = "extrusion";
  return domain;
}

Domain<3> randomBoxes(RandomSource &random, bool connected) {
  constexpr int kGrid = 4;
  std::set<std::array<int, 3>> cells{{1, 1, 1}};
  const std::size_t count = static_cast<std::size_t>(random.whole(2, 9));
  while (cells.size() < count) {
    std::array<int, 3> cell{random.whole(0, kGrid - 1), random.whole(0, kGrid - 1),
                            random.whole(0, kGrid - 1)};
    if (connected) {
      cell = *std::next(cells.begin(), random.whole(0, toIndex(cells.size()) - 1));
      int &x = cell[at(random.whole(0, 2))];
      x = std::clamp(x + (random.chance(0.5) ? 1 : -1), 0, kGrid - 1);
    }
    cells.insert(cell);
  }
  Domain<3> domain = voxelDomain(kGrid, [&](int i, int j, int k) { return cells.count({i, j, k}) > 0; });
  std::array<std::array<double, kGrid + 1>, 3> planes;
  for (auto &axis : planes) {
    axis[0] = 0;
    for (std::size_t k = 1; k <= kGrid; ++k) axis[k] = axis[k - 1] + random.real(0.3, 1.5);
  }
  for (Vec<3> &v : domain.vertices)
    for (int k = 0; k < 3; ++k) v[k] = planes[at(k)][static_cast<std::size_t>(std::lround(v[k]))];
  domain.name = connected ? "boxes" : "scattered boxes";
  return domain;
}

Domain<3> randomAssembly(RandomSource &random) {
  constexpr int kGrid = 3;
  std::map<std::array<int, 3>, int> regions; // of cells, counted from 1
  for (int i = 1; i <= kGrid; ++i)
    for (int j = 1; j <= kGrid; ++j)
      for (int k = 1; k <= kGrid; ++k)
        if (random.chance(0.7)) regions[{i, j, k}] = random.whole(1, 3);
  regions[{2, 2, 2}] = 1;
  Domain<3> domain = voxelDomain(kGrid + 1, [&](int i, int j, int k) {
    const auto found = regions.find({i, j, k});
    return found == regions.end() ? 0 : found->second;
  });
  for (const auto &[cell, region] : regions)
    domain.regions.push_back({Vec<3>(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5), region});
  domain.name = "assembly";
  domain.isSolid = true;
  return domain;
}

Domain<3> randomRound(RandomSource &random) {
  const int n = random.whole(12, 40);
  const auto circle = [&](double radius, const Vec<2> &at) {
    std::vector<Vec<2>> polygon;
    for (int k = 0; k < n; ++k)
      polygon.push_back(at + radius * Vec<2>(std::cos(2 * std::numbers::pi * k / n),
                                             std::sin(2 * std::numbers::pi * k / n)));
    return polygon;
  };
  const double top = random.real(0.3, 3);
  const int kind = random.whole(0, 2);
  Domain<3> domain;
  if (kind < 2) domain = prism(circle(1, {0, 0}), 0, top);
  else domain = prism({{-2, -2}, {random.real(1.5, 3), -2}, {2, random.real(1.5, 3)}, {-2, 2}}, 0, top);
  if (kind > 0)
    addHole(domain, circle(random.real(0.3, 0.7), {random.real(-0.1, 0.1), random.real(-0.1, 0.1)}), 0, top);
  domain.name = kind == 0 ? "cylinder" : kind == 1 ? "pipe" : "plate with a hole";
  return domain;
}

Domain<3> randomGem(RandomSource &random) {
  Domain<3> domain = randomHull(random);
  domain.name = "gem";
  domain.isSolid = true;
  const std::size_t facets = domain.facets.size();
  Index region = 1;
  Vec<3> middle{0.0};
  for (const Vec<3> &v : domain.vertices) middle += v / static_cast<double>(domain.vertices.size());
  domain.regions.push_back({middle, region});
  for (std::size_t f = 0; f < facets; ++f) {
    if (!random.chance(0.6)) continue;
    const std::vector<Index> base = domain.facets[f].loops[0];
    std::array<Vec<3>, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = domain.vertices[at(base[k])];
    const Vec<3> out = glm::normalize(glm::cross(x[1] - x[0], x[2] - x[0])) * random.real(0.3, 1);
    const Index first = toIndex(domain.vertices.size());
    for (const Vec<3> &v : x) domain.vertices.push_back(v + out);
    for (Index k = 0; k < 3; ++k)
      domain.facets.push_back({{{base[at(k)], base[at((k + 1) % 3)], first + (k + 1) % 3, first + k}}});
    domain.facets.push_back({{{first, first + 1, first + 2}}});
    domain.regions.push_back({(x[0] + x[1] + x[2]) / 3.0 + 0.5 * out, ++region});
  }
  return domain;
}

Domain<3> randomSolid(int kind, std::uint32_t seed) {
  RandomSource random(1000 * static_cast<std::uint32_t>(kind) + seed);
  Domain<3> domain = kind == 0   ? randomHull(random)
                     : kind == 1 ? randomExtrusion(random)
                     : kind == 2 ? randomBoxes(random, true)
                     : kind == 3 ? randomBoxes(random, false)
                     : kind == 4 ? randomAssembly(random)
                     : kind == 5 ? randomRound(random)
                                 : randomGem(random);
  const auto apply = [&](const auto &map) {
    for (Vec<3> &v : domain.vertices) v = map(v);
    for (auto &region : domain.regions) region.point = map(region.point);
  };
  if (seed % 3 == 0) {
    const double a = random.real(-0.5, 0.5);
    const double b = random.real(-0.5, 0.5);
    apply([&](const Vec<3> &x) { return Vec<3>{x.x + a * x.y, x.y + b * x.z, x.z}; });
  }
  if (seed % 2 == 0) {
    const double s = random.real(0, 3);
    const double t = random.real(0, 3);
    apply([&](const Vec<3> &x) {
      const Vec<3> y{std::cos(s) * x.x - std::sin(s) * x.y, std::sin(s) * x.x + std::cos(s) * x.y, x.z};
      return Vec<3>{y.x, std::cos(t) * y.y - std::sin(t) * y.z, std::sin(t) * y.y + std::cos(t) * y.z};
    });
  }
  if (seed % 7 == 0) apply([](const Vec<3> &x) { return 1e-6 * x; });
  if (seed % 11 == 0) apply([](const Vec<3> &x) { return 1e6 * x; });
  if (seed % 13 == 0) apply([](const Vec<3> &x) { return x + Vec<3>{1000, -2000, 500}; });
  return domain;
}

} // namespace dualblock::test
