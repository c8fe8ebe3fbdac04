// Several regions, solids that share facets, and solids that touch along edges or at vertices only.
#include <gtest/gtest.h>

#include "support/round_solids.h"
#include "support/signed_measure.h"

namespace dualblock::test {
namespace {

std::vector<Facet> boxFacets(Index first) {
  std::vector<Facet> facets{{{{first + 3, first + 2, first + 1, first}}}};
  for (Index k = 0; k < 4; ++k)
    facets.push_back({{{first + k, first + (k + 1) % 4, first + 4 + (k + 1) % 4, first + 4 + k}}});
  facets.push_back({{{first + 4, first + 5, first + 6, first + 7}}});
  return facets;
}

void addBoxVertices(Domain<3> &domain, double low, double high, double bottom, double top) {
  for (const double z : {bottom, top})
    for (const auto &[x, y] :
         {std::pair(low, low), std::pair(high, low), std::pair(high, high), std::pair(low, high)})
      domain.vertices.emplace_back(x, y, z);
}

std::map<Index, double> volumes(const PipelineResult<3> &r) {
  std::map<Index, double> volume;
  for (const Block<3> &b : r.primal.blocks)
    volume[r.parts.parts[at(b.part)].region] += signedMeasure<3>(cornersOf<3>(b.nodes, r.primal.positions));
  return volume;
}

/// A box inside a box, with or without what fills it.
Domain<3> boxInBox() {
  Domain<3> domain;
  domain.name = "box in a box";
  addBoxVertices(domain, 0, 3, 0, 3);
  addBoxVertices(domain, 1, 2, 1, 2);
  domain.facets = boxFacets(0);
  for (Facet &f : boxFacets(8)) domain.facets.push_back(f);
  return domain;
}

TEST(Assembly, AShellInsideIsACavityUnlessARegionIsNamedThere) {
  Domain<3> domain = boxInBox();
  EXPECT_NEAR(run(domain).certificate.domainMeasure, 26, 1e-9);
  domain.regions = {{{0.5, 0.5, 0.5}, 1}, {{1.5, 1.5, 1.5}, 2}};
  const auto r = run(domain);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.primal.blocks.size(), 27U * 8U);
  EXPECT_NEAR(volumes(r).at(1), 26, 1e-9);
  EXPECT_NEAR(volumes(r).at(2), 1, 1e-9);
}

// The smaller box's base is part of the larger one's roof: the cuts go on in the planes of its walls.
TEST(Assembly, ABoxOnABox) {
  Domain<3> domain;
  domain.name = "box on a box";
  addBoxVertices(domain, 0, 3, 0, 1);
  addBoxVertices(domain, 1, 2, 1, 2);
  domain.facets = boxFacets(0);
  domain.facets.back().loops.push_back({11, 10, 9, 8});
  for (Facet &f : boxFacets(8)) domain.facets.push_back(f);
  domain.regions = {{{0.5, 0.5, 0.5}, 7}, {{1.5, 1.5, 1.5}, 9}};
  const auto r = run(domain);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.primal.blocks.size(), 80U);
  EXPECT_DOUBLE_EQ(minimumQuality(r), 1);
  EXPECT_NEAR(volumes(r).at(7), 9, 1e-9);
  EXPECT_NEAR(volumes(r).at(9), 1, 1e-9);
}

// As above, sheared: the cuts follow the slanting walls instead of bisecting.
TEST(Assembly, AShearedBoxOnABox) {
  Domain<3> domain;
  addBoxVertices(domain, 0, 3, 0, 1);
  addBoxVertices(domain, 1, 2, 1, 2);
  domain.facets = boxFacets(0);
  domain.facets.back().loops.push_back({11, 10, 9, 8});
  for (Facet &f : boxFacets(8)) domain.facets.push_back(f);
  domain.name = "sheared";
  const auto r = run(moved(domain, [](const Vec<3> &x) {
    return Vec<3>{x.x + 0.4 * x.z, x.y - 0.3 * x.z, x.z};
  }));
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.fallbackComponents, 0) << r.fallbackReason;
  EXPECT_EQ(r.primal.blocks.size(), 80U);
}

// Two solids that each give the facet they share, turned against one another, as CAD programs write them.
TEST(Assembly, ASharedFacetGivenTwice) {
  Domain<3> domain;
  domain.name = "stack";
  addBoxVertices(domain, 0, 1, 0, 1);
  addBoxVertices(domain, 0, 1, 1, 2); // its base repeats the lower box's roof
  domain.facets = boxFacets(0);
  for (Facet &f : boxFacets(8)) domain.facets.push_back(f);
  const auto r = run(domain);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(r.parts.parts.size(), 2U);
  EXPECT_EQ(r.primal.blocks.size(), 16U);
  EXPECT_EQ(r.primal.nodeCount, 45);
  EXPECT_EQ(r.domain.repairs.size(), 2U); // points merged, facets taken once
}

TEST(Assembly, ContactsAlongEdgesAndAtVerticesAreNoConnection) {
  const auto edge = run(voxelDomain(2, [](int i, int j, int k) { return k == 0 && i == j; }));
  EXPECT_TRUE(edge.certificate.valid) << failuresOf(edge.certificate);
  EXPECT_EQ(edge.primal.nodeCount, 54);
  const auto vertex = run(voxelDomain(2, [](int i, int j, int k) { return i == j && j == k; }));
  EXPECT_TRUE(vertex.certificate.valid) << failuresOf(vertex.certificate);
  EXPECT_EQ(vertex.primal.nodeCount, 54);
  // A solid that touches itself: a checkerboard layer between two full ones.
  const auto self =
      run(voxelDomain(3, [](int i, int j, int k) { return i < 2 && j < 2 && (k != 1 || i == j); }));
  EXPECT_TRUE(self.certificate.valid) << failuresOf(self.certificate);
  EXPECT_NEAR(self.certificate.meshMeasure, 10, 1e-9);
  // Two missing cubes that touch at a vertex: the boundary comes back to a vertex of the solid.
  const auto pinch = run(voxelDomain(2, [](int i, int j, int k) { return !(i == j && j == k); }));
  EXPECT_TRUE(pinch.certificate.valid) << failuresOf(pinch.certificate);
  EXPECT_NEAR(pinch.certificate.meshMeasure, 6, 1e-9);
}

} // namespace
} // namespace dualblock::test
