// Subdivision keeps the mesh conformal, its measure, its facets and its tags, and makes as many simplices as
// it should.
#include <random>

#include "reference/refine.h"
#include "support/dimensions.h"

namespace dualblock::test {
namespace {

template <typename Dimension> class Subdivision : public ::testing::Test {};
TYPED_TEST_SUITE(Subdivision, Dimensions);

/// What subdivision must not change: measure, and the size of each surface.
template <int N> std::vector<double> conserved(const ReferenceMesh<N> &mesh) {
  std::vector<double> values{measureOf(mesh)};
  for (Index f = 0; f < toIndex(mesh.surfaces.size()); ++f) values.push_back(surfaceMeasure(mesh, f));
  return values;
}

template <int N> void expectConserved(const ReferenceMesh<N> &mesh, const std::vector<double> &before) {
  const auto now = conserved(mesh);
  ASSERT_EQ(now.size(), before.size());
  for (std::size_t k = 0; k < now.size(); ++k) EXPECT_NEAR(now[k], before[k], 1e-11);
}

TYPED_TEST(Subdivision, SplitLongEdges) {
  forMeshes<TypeParam::value>([](auto mesh) {
    const auto before = conserved(mesh);
    const double length = mesh.size / 6;
    splitLongEdges(mesh, length);
    expectSound(mesh);
    expectConserved(mesh, before);
    for (const auto &[a, b] : edgesOf(mesh))
      EXPECT_LE(glm::length(mesh.nodes[at(b)] - mesh.nodes[at(a)]), length);
    const Index count = mesh.simplexCount();
    splitLongEdges(mesh, length);
    EXPECT_EQ(mesh.simplexCount(), count);
  });
}

TYPED_TEST(Subdivision, SplitRandomEdges) {
  forMeshes<TypeParam::value>([](const auto &start) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(seed);
      auto mesh = start;
      const std::size_t edges = edgesOf(mesh).size();
      const Index nodes = mesh.nodeCount();
      splitRandomEdges(mesh, seed);
      expectSound(mesh);
      expectConserved(mesh, conserved(start));
      EXPECT_EQ(mesh.nodeCount() - nodes, toIndex(std::min(edges, std::max<std::size_t>(4, edges / 8))));
      auto again = start;
      splitRandomEdges(again, seed);
      EXPECT_EQ(again.simplices, mesh.simplices);
    }
  });
}

// An edge with k simplices around it adds k simplices; several edges at once, one at a time, or in another
// order of the list make equally many nodes.
TYPED_TEST(Subdivision, OneEdgeAddsTheSimplicesAroundIt) {
  constexpr int N = TypeParam::value;
  const auto start = fill(loadExample<N>(meshExamples<N>()[2]), 0.9, 2);
  for (const auto &[a, b] : edgesOf(start)) {
    auto mesh = start;
    const Index around = simplicesAround(start, a, b);
    splitEdges(mesh, {{b, a}});
    EXPECT_EQ(mesh.simplexCount(), start.simplexCount() + around);
    EXPECT_EQ(mesh.nodeCount(), start.nodeCount() + 1);
    EXPECT_EQ(simplicesAround(mesh, a, b), 0);
    EXPECT_EQ(simplicesAround(mesh, a, start.nodeCount()), around);
    EXPECT_EQ(mesh.nodes.back(), start.nodes[at(a)] + 0.5 * (start.nodes[at(b)] - start.nodes[at(a)]));
    expectSound(mesh);
  }
}

TYPED_TEST(Subdivision, AllEdgesOfOneSimplex) {
  constexpr int N = TypeParam::value;
  ReferenceMesh<N> mesh = fill(loadExample<N>(N == 2 ? "end_vertex_1" : "tetrahedron"));
  const auto before = conserved(mesh);
  splitEdges(mesh, edgesOf(mesh));
  expectSound(mesh);
  expectConserved(mesh, before);
  // Every edge bisected: a triangle falls into 4, a tetrahedron into 8.
  EXPECT_EQ(mesh.simplexCount(), N == 2 ? 2 * 4 : 8);
}

TYPED_TEST(Subdivision, RandomSetsOfEdges) {
  constexpr int N = TypeParam::value;
  std::mt19937 random(17);
  const auto start = fill(loadExample<N>(meshExamples<N>()[3]));
  for (int trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE(trial);
    auto mesh = start;
    std::vector<std::pair<Index, Index>> edges;
    for (const auto &edge : edgesOf(mesh))
      if (random() % 4 == 0) edges.push_back(edge);
    std::shuffle(edges.begin(), edges.end(), random);
    splitEdges(mesh, edges);
    expectSound(mesh);
    expectConserved(mesh, conserved(start));
    EXPECT_EQ(mesh.nodeCount() - start.nodeCount(), toIndex(edges.size()));
    for (const auto &[a, b] : edges) EXPECT_EQ(simplicesAround(mesh, a, b), 0);
  }
}

// A face becomes N faces around its centroid: each simplex at it becomes N.
TYPED_TEST(Subdivision, SplitFace) {
  constexpr int N = TypeParam::value;
  const auto start = fill(loadExample<N>(meshExamples<N>()[2]), 0.9);
  for (Index s = 0; s < start.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i) {
      auto mesh = start;
      const bool inner = mesh.neighbors[at(s)][at(i)] != kNone;
      splitFace(mesh, FaceRef<N>{s, i});
      EXPECT_EQ(mesh.simplexCount() - start.simplexCount(), (inner ? 2 : 1) * (N - 1));
      EXPECT_EQ(mesh.nodeCount(), start.nodeCount() + 1);
      expectSound(mesh);
      expectConserved(mesh, conserved(start));
    }
}

// Split surfaces and regions are inherited.
TYPED_TEST(Subdivision, KeepsSplitSurfacesAndRegions) {
  constexpr int N = TypeParam::value;
  const auto result = run(loadExample<N>(N == 2 ? "square_ring_2d" : "l_shape_extruded"));
  ReferenceMesh<N> mesh = result.mesh;
  for (Index s = 0; s < mesh.simplexCount(); ++s) mesh.region[at(s)] = result.parts.partOfSimplex[at(s)];
  const auto before = conserved(mesh);
  splitRandomEdges(mesh, 5);
  expectSound(mesh);
  expectConserved(mesh, before);
  const auto parts = buildParts(mesh, {});
  EXPECT_EQ(parts.parts.size(), result.parts.parts.size());
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    EXPECT_EQ(parts.parts[at(parts.partOfSimplex[at(s)])].region, mesh.region[at(s)]) << "a region leaked";
}

TEST(SplitNode, FindsWhatIsThere) {
  const std::vector<EdgeSplit> splits{{1, 4, 10}, {1, 7, 11}, {3, 4, 12}};
  EXPECT_EQ(splitNode(splits, 1, 4), 10);
  EXPECT_EQ(splitNode(splits, 7, 1), 11);
  EXPECT_EQ(splitNode(splits, 4, 3), 12);
  EXPECT_EQ(splitNode(splits, 1, 3), kNone);
  EXPECT_EQ(splitNode({}, 1, 3), kNone);
}

} // namespace
} // namespace dualblock::test
