// Where a boundary crosses itself: every pair of facets that does is named, wherever on them it is.
#include "domain/intersections.h"

#include <gtest/gtest.h>

#include "support/examples.h"
#include "support/voxels.h"

namespace dualblock::test {
namespace {

/// A cube's facets as triangles, moved and scaled, added to the domain.
void addCube(Domain<3> &domain, const Vec<3> &corner, double size) {
  const Domain<3> cube = voxelDomain(1, [](int, int, int) { return true; });
  const Index first = toIndex(domain.vertices.size());
  for (const Vec<3> &v : cube.vertices) domain.vertices.push_back(corner + size * v);
  for (const Facet &facet : cube.facets) {
    const std::vector<Index> &loop = facet.loops[0];
    for (std::size_t k = 1; k < 3; ++k)
      domain.facets.push_back({{{first + loop[0], first + loop[k], first + loop[k + 1]}}});
  }
}

TEST(Intersections, EdgesThatMeetEdgesOnly) {
  // All twelve places where edges of one cube meet the other's facets are on the diagonals of these.
  Domain<3> domain;
  addCube(domain, {0, 0, 0}, 2);
  addCube(domain, {1, 1, 1}, 2);
  const auto found = findIntersections(domain, 1e-6, 1000);
  EXPECT_FALSE(found.empty());
  for (const auto &[a, b, where] : found) {
    EXPECT_LT(a, 12);
    EXPECT_GE(b, 12);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(where[k], 1 - 1e-9);
      EXPECT_LE(where[k], 2 + 1e-9);
    }
  }
  const auto result = runPipeline<3>(domain, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::selfIntersection);
  EXPECT_NE(result.error().message.find("meet at ("), std::string::npos);
  EXPECT_NE(result.error().message.find(" pairs in all"), std::string::npos);
  EXPECT_GT(result.error().entities.size(), kNamedPlaces); // every facet that crosses another
}

TEST(Intersections, AsManyAsAreWanted) {
  Domain<3> domain;
  addCube(domain, {0, 0, 0}, 2);
  addCube(domain, {1, 0.7, 1.1}, 2);
  const std::size_t all = findIntersections(domain, 1e-6, 1000).size();
  EXPECT_GE(all, 6U);
  EXPECT_EQ(findIntersections(domain, 1e-6, 3).size(), 3U);
}

TEST(Intersections, NoneWhereFacetsShareVerticesOrNothing) {
  Domain<3> domain;
  addCube(domain, {0, 0, 0}, 2);
  addCube(domain, {0.5, 0.5, 0.5}, 1);
  EXPECT_TRUE(findIntersections(domain, 1e-6, 1000).empty());
  // The same with vertices of their own for each facet, as some files have them.
  Domain<3> apart;
  for (const Facet &facet : domain.facets) {
    std::vector<Index> loop;
    for (const Index v : facet.loops[0]) {
      loop.push_back(toIndex(apart.vertices.size()));
      apart.vertices.push_back(domain.vertices[at(v)]);
    }
    apart.facets.push_back({{std::move(loop)}});
  }
  EXPECT_TRUE(findIntersections(apart, 1e-6, 1000).empty());
}

TEST(Intersections, EveryPlaceOfAPolygon) {
  Domain<2> domain; // a zigzag across a square
  domain.vertices = {{0, 0}, {4, 0}, {4, 1}, {0, 1}, {1, 2}, {1, -1}, {3, -1}, {3, 2}};
  domain.facets = {{{{0, 1}}}, {{{1, 2}}}, {{{2, 3}}}, {{{3, 0}}},
                   {{{4, 5}}}, {{{5, 6}}}, {{{6, 7}}}, {{{7, 4}}}};
  EXPECT_EQ(findIntersections(domain, 1e-6, 1000).size(), 4U);
  EXPECT_EQ(describeIntersections("Segments", findIntersections(domain, 1e-6, 1)),
            "Segments 0 and 4 meet at (1, 0)");
}

} // namespace
} // namespace dualblock::test
