// Random domains: polygons that are star-shaped, and prisms over them, turned at random. Whatever they look
// like, the certificate holds, the primal is the midpoint subdivision of the parts, and another reference
// mesh gives the same blocks (ARCHITECTURE.md 2 and 4). Each trial prints its seed where it fails.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/examples.h"
#include "support/midpoint_subdivision.h"
#include "support/transforms.h"
#include "support/voxels.h"

namespace dualblock::test {
namespace {

std::vector<Vec<2>> starPolygon(std::mt19937 &random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const int corners = 3 + static_cast<int>(random() % 8);
  std::vector<Vec<2>> polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k + uniform(-0.3, 0.3)) / corners;
    const double radius = uniform(0.4, 1.6);
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

template <int N> Domain<N> randomDomain(std::uint32_t seed) {
  std::mt19937 random(seed);
  const std::vector<Vec<2>> polygon = starPolygon(random);
  if constexpr (N == 3) return rotated(prism(polygon, 0, 0.3 + static_cast<double>(random() % 100) / 50));
  else {
    Domain<2> domain;
    domain.name = "star";
    domain.vertices = polygon;
    const Index n = toIndex(polygon.size());
    for (Index k = 0; k < n; ++k) domain.facets.push_back({{{k, (k + 1) % n}}});
    return domain;
  }
}

/// A random union of unit cubes, grown cube by cube over faces, as its unit squares: preparing the domain
/// merges them into facets with holes. Every other one is sheared, so that angles are other than right ones.
/// Empty where cubes touch in an edge or a node only, which is no manifold.
std::optional<Domain<3>> polycube(std::uint32_t seed) {
  constexpr int kGrid = 5;
  std::mt19937 random(seed);
  std::set<std::array<int, 3>> cells{{2, 2, 2}};
  const std::size_t count = 2 + random() % 7;
  while (cells.size() < count) {
    auto cell = *std::next(cells.begin(), static_cast<std::ptrdiff_t>(random() % cells.size()));
    int &x = cell[random() % 3];
    x = std::clamp(x + (random() % 2 ? 1 : -1), 0, kGrid - 1);
    cells.insert(cell);
  }
  const auto isFilled = [&](int i, int j, int k) { return cells.count({i, j, k}) > 0; };
  Domain<3> domain = test::voxelDomain(kGrid, isFilled);
  std::map<std::array<Index, 2>, int> facetsAtEdge;
  std::vector<std::vector<const std::vector<Index> *>> facetsAt(domain.vertices.size());
  for (const Facet &facet : domain.facets)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::vector<Index> &loop = facet.loops[0];
      ++facetsAtEdge[sortedPair(loop[k], loop[(k + 1) % 4])];
      facetsAt[at(loop[k])].push_back(&loop);
    }
  for (const auto &[edge, n] : facetsAtEdge)
    if (n != 2) return std::nullopt;
  for (const auto &around : facetsAt) { // one fan of squares around each vertex
    std::set<Index> reached(around[0]->begin(), around[0]->end());
    for (std::size_t round = 0; round < around.size(); ++round)
      for (const auto *loop : around)
        if (std::count_if(loop->begin(), loop->end(), [&](Index v) { return reached.count(v) > 0; }) >= 2)
          reached.insert(loop->begin(), loop->end());
    for (const auto *loop : around)
      for (const Index v : *loop)
        if (!reached.count(v)) return std::nullopt;
  }
  domain.name = "polycube";
  if (seed % 2 == 0) return domain;
  return moved(domain, [](const Vec<3> &x) { return Vec<3>{x.x + 0.3 * x.y, x.y, x.z - 0.2 * x.x}; });
}

template <int N> void tryDomain(std::uint32_t seed, const Domain<N> &domain) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::optional<std::vector<std::vector<Index>>> form;
  for (const double relative : {0.0, 0.2}) {
    for (const std::uint32_t shuffle : {0U, 1U}) {
      SCOPED_TRACE("refined to " + std::to_string(relative) + " of the size, mesh seed " +
                   std::to_string(shuffle));
      PipelineOptions options;
      options.edgeLength = relative * domainSize(domain.vertices);
      options.seed = shuffle;
      const auto result = run(domain, options);
      EXPECT_TRUE(result.certificate.valid) << failuresOf(result.certificate);
      if (!result.certificate.valid) continue;
      const auto here = canonicalForm<N>(blocksOf(result.primal));
      EXPECT_TRUE(here == canonicalForm<N>(midpointSubdivision(result.mesh, result.parts).blocks));
      if (result.fallbackComponents > 0) continue;
      if (!form) form = here;
      EXPECT_TRUE(*form == here) << "another block mesh on another reference mesh: "
                                 << result.primal.blocks.size() << " blocks";
    }
  }
}

TEST(RandomDomains, Polygons) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) tryDomain<2>(seed, randomDomain<2>(seed));
}

TEST(RandomDomains, Prisms) {
  for (std::uint32_t seed = 1; seed <= 25; ++seed) tryDomain<3>(seed, randomDomain<3>(seed));
}

// A facet that touches itself at a vertex: a cube stands on an L-shaped slab, one corner in the L's crook, so
// that the hole of the slab's top touches its outline.
TEST(RandomDomains, FacetThatTouchesItself) {
  const auto tower = voxelDomain(4, [](int i, int j, int k) {
    const bool inL = i < 3 && j < 3 && !(i == 2 && j == 2);
    return k == 0 ? inL : k == 1 && i == 1 && j == 1;
  });
  tryDomain<3>(0, tower);
  tryDomain<3>(1, rotated(tower));
}

TEST(RandomDomains, Polycubes) {
  int tried = 0;
  for (std::uint32_t seed = 1; seed <= 30; ++seed)
    if (const auto domain = polycube(seed)) {
      ++tried;
      tryDomain<3>(seed, rotated(*domain));
    }
  EXPECT_GT(tried, 15);
}

} // namespace
} // namespace dualblock::test
