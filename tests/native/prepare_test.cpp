// The preparation of domains: what is refused, what is repaired, what is merged.
#include "domain/prepare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "domain/polygon.h"
#include "support/examples.h"
#include "support/voxels.h"

namespace dualblock {
namespace {

Domain<2> plane(std::vector<Vec<2>> vertices, const std::vector<std::vector<Index>> &loops) {
  Domain<2> domain;
  domain.vertices = std::move(vertices);
  for (const auto &loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      domain.facets.push_back({{{loop[k], loop[(k + 1) % loop.size()]}}});
  return domain;
}

Domain<3> cube() {
  return test::voxelDomain(1, [](int, int, int) { return true; });
}

template <typename D> ErrorCode refusal(const D &domain, double tolerance = 1e-6) {
  const auto prepared = prepareDomain(domain, tolerance);
  if (prepared.ok()) return ErrorCode::internal;
  EXPECT_FALSE(prepared.error().message.empty());
  return prepared.error().code;
}

TEST(Prepare2d, RefusesLoopsThatTouchAtAVertex) {
  // Two triangles that meet at vertex 0: one might be taken for a hole of the other.
  const auto domain = plane({{0, 0}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(refusal(domain), ErrorCode::selfIntersection);
}

TEST(Prepare2d, RefusesCrossingLoopsAndHolesOutside) {
  EXPECT_EQ(refusal(plane({{0, 0}, {2, 2}, {2, 0}, {0, 1}}, {{0, 1, 2, 3}})), ErrorCode::selfIntersection);
  const std::vector<Vec<2>> twoSquares{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {5, 0}, {6, 0}, {6, 1}, {5, 1}};
  EXPECT_EQ(refusal(plane(twoSquares, {{0, 1, 2, 3}, {7, 6, 5, 4}})), ErrorCode::holeOutside);
  EXPECT_TRUE(prepareDomain(plane(twoSquares, {{0, 1, 2, 3}, {4, 5, 6, 7}}), 1e-6).ok()); // two components
}

TEST(Prepare2d, DropsVerticesOnStraightLinesAndTurnsLoops) {
  const auto prepared =
      prepareDomain(plane({{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0.5, 0}}, {{0, 1, 2, 3, 4}}), 1e-6);
  ASSERT_TRUE(prepared.ok());
  EXPECT_EQ(prepared.value().domain.facets.size(), 4U);
  EXPECT_EQ(prepared.value().repairs.size(), 1U);
  // The two halves of the bottom went into one segment.
  EXPECT_EQ(prepared.value().facetOfGiven[3], prepared.value().facetOfGiven[4]);
  EXPECT_NE(prepared.value().facetOfGiven[0], prepared.value().facetOfGiven[1]);
}

// A given reference mesh may be off the facets by rounding: its nodes on facets, not the facets, then carry
// the blocks, and the certificate's tolerances must know.
TEST(Prepare2d, HolesBelongToTheNearestLoopAround) {
  // Squares of 10, 8, 6, 4 and 2 in one another, each turned a little: islands in holes in islands.
  std::vector<Vec<2>> vertices;
  std::vector<std::vector<Index>> loops;
  for (int k = 0; k < 5; ++k) {
    const double side = 10 - 2 * k;
    auto &loop = loops.emplace_back();
    for (const auto &[x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      loop.push_back(toIndex(vertices.size()));
      vertices.push_back(side / 2 * Vec<2>{x - 0.05 * k * y, y + 0.05 * k * x});
    }
  }
  const PipelineResult<2> result = test::run(plane(vertices, loops));
  EXPECT_TRUE(result.certificate.valid) << test::failuresOf(result.certificate);
  double area = 0;
  for (int k = 0; k < 5; ++k) area += (k % 2 ? -1 : 1) * (10 - 2 * k) * (10 - 2 * k) * (1 + 0.0025 * k * k);
  EXPECT_NEAR(result.certificate.meshMeasure, area, 1e-12);
}

TEST(Prepare2d, MayBeFarFromTheOrigin) {
  std::vector<Vec<2>> vertices;
  std::vector<Index> loop;
  for (int k = 0; k < 9; ++k) {
    loop.push_back(toIndex(vertices.size()));
    vertices.emplace_back(1e7 + std::cos(2 * std::numbers::pi * k / 9),
                          -1e7 + std::sin(2 * std::numbers::pi * k / 9));
  }
  const PipelineResult<2> result = test::run(plane(vertices, {loop}));
  EXPECT_TRUE(result.certificate.valid) << test::failuresOf(result.certificate);
  EXPECT_EQ(result.primal.blocks.size(), 9U);
}

TEST(GivenReference, MayBeOffTheFacetsByRounding) {
  auto domain = test::loadExample<2>("square_2d_second");
  for (std::size_t v = 0; v < domain.vertices.size(); ++v) {
    domain.vertices[v] += Vec<2>(v % 2 ? 1e-9 : -1e-9, v % 3 ? 1e-9 : -2e-9);
    domain.reference->nodes[v] = domain.vertices[v];
  }
  const auto result = test::run(domain);
  EXPECT_TRUE(result.certificate.valid) << test::failuresOf(result.certificate);
  EXPECT_EQ(result.primal.blocks.size(), 4U);
}

TEST(Prepare3d, MergesCoplanarFacetsAndKeepsTrackOfThem) {
  const auto two = test::voxelDomain(2, [](int i, int j, int k) { return j == 0 && k == 0 && i >= 0; });
  ASSERT_EQ(two.facets.size(), 10U);
  const auto prepared = prepareDomain(two, 1e-6);
  ASSERT_TRUE(prepared.ok());
  EXPECT_EQ(prepared.value().domain.facets.size(), 6U);
  EXPECT_EQ(prepared.value().domain.vertices.size(), 8U); // those in the middle of edges are gone
  for (const Index facet : prepared.value().facetOfGiven) EXPECT_GE(facet, 0);
}

TEST(Prepare3d, TurnsFacetsAndHoleLoopsThatRunTheWrongWay) {
  Domain<3> domain = cube();
  std::reverse(domain.facets[2].loops[0].begin(), domain.facets[2].loops[0].end());
  const auto prepared = prepareDomain(domain, 1e-6);
  ASSERT_TRUE(prepared.ok());
  ASSERT_EQ(prepared.value().repairs.size(), 1U);
  EXPECT_EQ(prepared.value().repairs[0], "1 facets were turned round");
}

TEST(Prepare3d, MergesVerticesWithEqualCoordinates) {
  Domain<3> domain = cube();
  Domain<3> soup;
  for (const Facet &facet : domain.facets) {
    Facet own{{{}}};
    for (const Index v : facet.loops[0]) {
      own.loops[0].push_back(toIndex(soup.vertices.size()));
      soup.vertices.push_back(domain.vertices[at(v)]);
    }
    soup.facets.push_back(own);
  }
  const auto prepared = prepareDomain(soup, 1e-6);
  ASSERT_TRUE(prepared.ok());
  EXPECT_EQ(prepared.value().domain.vertices.size(), 8U);
}

TEST(Prepare3d, RefusesWhatIsNoSolid) {
  Domain<3> open = cube();
  open.facets.pop_back();
  EXPECT_EQ(refusal(open), ErrorCode::openBoundary);

  Domain<3> twice = cube();
  twice.facets.push_back(twice.facets[0]);
  EXPECT_EQ(refusal(twice), ErrorCode::duplicateFacet);

  Domain<3> flat = cube();
  flat.facets.push_back({{{0, 1, 0}}});
  EXPECT_EQ(refusal(flat), ErrorCode::degenerateFacet);

  Domain<3> bent = cube();
  bent.vertices[0] += Vec<3>(0.01);
  EXPECT_EQ(refusal(bent), ErrorCode::nonPlanarFacet);
  EXPECT_NE(refusal(bent, 1e-2), ErrorCode::nonPlanarFacet); // the tolerance is the caller's

  Domain<3> infinite = cube();
  infinite.vertices[3].y = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(infinite), ErrorCode::notFinite);

  Domain<3> wild = cube();
  wild.facets[1].loops[0][2] = 99;
  EXPECT_EQ(refusal(wild), ErrorCode::indexOutOfRange);

  Domain<3> poor = cube();
  poor.facets.resize(3);
  EXPECT_EQ(refusal(poor), ErrorCode::tooFewFacets);
}

// Rings within rings: base and roof have islands in their holes, all loops given as the outermost runs.
TEST(Prepare3d, IslandsInHolesArePiecesOfTheFacet) {
  Domain<3> domain;
  std::vector<std::vector<Index>> base;
  std::vector<std::vector<Index>> roof;
  for (const double r : {5.0, 4.0, 3.0, 2.0, 1.0}) {
    const Index first = toIndex(domain.vertices.size());
    for (const double z : {0.0, 1.0})
      for (const auto &[x, y] : {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)})
        domain.vertices.emplace_back(x, y, z);
    base.push_back({first + 3, first + 2, first + 1, first});
    roof.push_back({first + 4, first + 5, first + 6, first + 7});
    for (Index k = 0; k < 4; ++k) {
      const Index next = first + (k + 1) % 4;
      domain.facets.push_back({{{first + k, next, next + 4, first + k + 4}}});
    }
  }
  domain.facets.push_back({base});
  domain.facets.push_back({roof});
  const auto prepared = prepareDomain(domain, 1e-6);
  ASSERT_TRUE(prepared.ok());
  const Facet &facet = prepared.value().domain.facets.back();
  ASSERT_EQ(facet.loops.size(), 5U);
  const double inside = 4 * (25 - 16 + 9 - 4 + 1);
  EXPECT_NEAR(glm::length(areaVector(prepared.value().domain.vertices, facet)) / 2, inside, 1e-12);
  for (const std::uint32_t seed : {0U, 1U, 2U}) {
    PipelineOptions options;
    options.seed = seed;
    const auto result = test::run(domain, options);
    EXPECT_TRUE(result.certificate.valid) << test::failuresOf(result.certificate);
    EXPECT_EQ(result.mesh.componentCount, 3);
    EXPECT_EQ(result.fallbackComponents, 0);
    EXPECT_EQ(result.primal.blocks.size(), 136U); // two rings of eight parts and a box, eight blocks each
  }
}

// The tip of a cavity touches the roof in its middle, where four triangles of it meet: they become one facet
// without a vertex there.
TEST(Prepare3d, NamesAVertexThatTouchesAFacet) {
  Domain<3> domain = cube();
  const auto roof = std::find_if(domain.facets.begin(), domain.facets.end(), [&](const Facet &facet) {
    return std::all_of(facet.loops[0].begin(), facet.loops[0].end(),
                       [&](Index v) { return domain.vertices[at(v)].z == 1; });
  });
  const std::vector<Index> corners = roof->loops[0];
  domain.facets.erase(roof);
  const Index tip = toIndex(domain.vertices.size());
  for (const Vec<3> &v :
       {Vec<3>{0.5, 0.5, 1}, Vec<3>{0.75, 0.25, 0.3}, Vec<3>{0.25, 0.25, 0.25}, Vec<3>{0.5, 0.75, 0.28}})
    domain.vertices.push_back(v);
  for (std::size_t k = 0; k < 4; ++k) domain.facets.push_back({{{corners[k], corners[(k + 1) % 4], tip}}});
  for (Index k = 0; k < 3; ++k) domain.facets.push_back({{{tip + 1 + (k + 1) % 3, tip + 1 + k, tip}}});
  domain.facets.push_back({{{tip + 1, tip + 2, tip + 3}}});
  const auto result = runPipeline<3>(domain, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::selfIntersection);
  EXPECT_NE(result.error().message.find("meet at (0.5, 0.5, 1)"), std::string::npos)
      << result.error().message;
}

} // namespace
} // namespace dualblock
