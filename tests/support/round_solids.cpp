#include "support/round_solids.h"

namespace dualblock::test {

std::vector<Vec<2>> circle(int n, double radius, const Vec<2> &at) {
  std::vector<Vec<2>> polygon;
  for (int k = 0; k < n; ++k)
    polygon.push_back(
        at + radius * Vec<2>(std::cos(2 * std::numbers::pi * k / n), std::sin(2 * std::numbers::pi * k / n)));
  return polygon;
}

Domain<3> cylinder(int n) {
  Domain<3> domain = prism(circle(n, 1), 0, 2);
  domain.name = "cylinder";
  return domain;
}

Domain<3> plateWithHole(int n) {
  Domain<3> domain = prism({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, 0, 1);
  addHole(domain, circle(n, 0.8), 0, 1);
  domain.name = "plate with a hole";
  return domain;
}

Domain<3> revolved(const std::vector<Vec<2>> &profile, int n) {
  Domain<3> domain;
  const Index rings = toIndex(profile.size()) - 2;
  domain.vertices.emplace_back(0, 0, profile.front().y);
  for (Index r = 1; r <= rings; ++r)
    for (const Vec<2> &p : circle(n, profile[at(r)].x))
      domain.vertices.emplace_back(p.x, p.y, profile[at(r)].y);
  domain.vertices.emplace_back(0, 0, profile.back().y);
  const Index last = toIndex(domain.vertices.size()) - 1;
  const auto vertex = [&](Index ring, Index k) { return 1 + (ring - 1) * n + k % n; };
  for (Index k = 0; k < n; ++k) {
    domain.facets.push_back({{{0, vertex(1, k + 1), vertex(1, k)}}});
    for (Index r = 1; r < rings; ++r) {
      domain.facets.push_back({{{vertex(r, k), vertex(r, k + 1), vertex(r + 1, k + 1)}}});
      domain.facets.push_back({{{vertex(r, k), vertex(r + 1, k + 1), vertex(r + 1, k)}}});
    }
    domain.facets.push_back({{{vertex(rings, k), vertex(rings, k + 1), last}}});
  }
  return domain;
}

Domain<3> ball(int n) {
  std::vector<Vec<2>> profile;
  for (int k = 0; k <= n / 2; ++k) {
    const double angle = std::numbers::pi * (2.0 * k / n - 0.5);
    profile.emplace_back(std::cos(angle), std::sin(angle));
  }
  Domain<3> domain = revolved(profile, n);
  domain.name = "ball";
  return domain;
}

Domain<3> cone(int n) {
  Domain<3> domain = revolved({{0, 0}, {1, 0}, {0, 1.5}}, n);
  domain.name = "cone";
  return domain;
}

Domain<3> shaft(int n) {
  Domain<3> domain = revolved({{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.5, 2}, {0, 2}}, n);
  domain.name = "shaft";
  return domain;
}

Domain<3> torus(int around, int across, double sweep) {
  const bool whole = sweep > 6.28;
  Domain<3> domain;
  domain.name = whole ? "torus" : "elbow";
  const Index sections = whole ? around : around + 1;
  for (Index s = 0; s < sections; ++s)
    for (const Vec<2> &p : circle(across, 0.7)) {
      const double angle = sweep * s / around;
      domain.vertices.emplace_back((2 + p.x) * std::cos(angle), (2 + p.x) * std::sin(angle), p.y);
    }
  const auto vertex = [&](Index s, Index k) { return (s % sections) * across + k % across; };
  for (Index s = 0; s < around; ++s)
    for (Index k = 0; k < across; ++k) {
      domain.facets.push_back({{{vertex(s, k), vertex(s + 1, k), vertex(s + 1, k + 1)}}});
      domain.facets.push_back({{{vertex(s, k), vertex(s + 1, k + 1), vertex(s, k + 1)}}});
    }
  if (whole) return domain;
  std::vector<Index> first;
  std::vector<Index> last;
  for (Index k = 0; k < across; ++k) {
    first.push_back(vertex(0, k));
    last.insert(last.begin(), vertex(around, k));
  }
  domain.facets.push_back({{first}});
  domain.facets.push_back({{last}});
  return domain;
}

} // namespace dualblock::test
