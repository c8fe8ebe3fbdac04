// Random domains: polygons that are star-shaped, and prisms over them, turned at random. Whatever they look
// like, the certificate holds, the primal is the midpoint subdivision of the parts, and another reference
// mesh gives the same blocks (algorithm.md 2 and 4). Each trial prints its seed where it fails.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/examples.h"
#include "support/midpoint_subdivision.h"
#include "support/transforms.h"

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

template <int N> void tryDomain(std::uint32_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Domain<N> domain = randomDomain<N>(seed);
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
  for (std::uint32_t seed = 1; seed <= 40; ++seed) tryDomain<2>(seed);
}

TEST(RandomDomains, Prisms) {
  for (std::uint32_t seed = 1; seed <= 25; ++seed) tryDomain<3>(seed);
}

} // namespace
} // namespace dualblock::test
