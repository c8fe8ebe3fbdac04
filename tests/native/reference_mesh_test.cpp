// The reference mesh as the fill makes it: sound, of the domain's measure, and the same from the same input.
#include <set>

#include "support/dimensions.h"

namespace dualblock::test {
namespace {

template <typename Dimension> class ReferenceMeshOf : public ::testing::Test {};
TYPED_TEST_SUITE(ReferenceMeshOf, Dimensions);

TYPED_TEST(ReferenceMeshOf, IsSound) {
  forMeshes<TypeParam::value>([](const auto &mesh) { expectSound(mesh); });
}

TYPED_TEST(ReferenceMeshOf, FillsTheDomain) {
  constexpr int N = TypeParam::value;
  // Measures by hand.
  const std::vector<std::pair<const char *, double>> known =
      N == 2 ? std::vector<std::pair<const char *, double>>{{"l_shape_2d", 3},
                                                            {"two_holes_2d", 13},
                                                            {"square_2d_first", 2}}
             : std::vector<std::pair<const char *, double>>{{"l_shape_extruded", 3},
                                                            {"u_shape_extruded", 5},
                                                            {"notched_cube", 7},
                                                            {"double_pyramid", 4.0 / 3}};
  for (const auto &[name, measure] : known)
    for (const double edgeLength : {0.0, 0.5})
      for (const std::uint32_t seed : {0U, 1U}) {
        SCOPED_TRACE(name);
        EXPECT_NEAR(measureOf(fill(loadExample<N>(name), edgeLength, seed)), measure, 1e-12 * measure);
      }
}

// Facets are covered: the outer faces on each add up to its size.
TYPED_TEST(ReferenceMeshOf, CoversItsFacets) {
  constexpr int N = TypeParam::value;
  for (const std::string &name : meshExamples<N>()) {
    SCOPED_TRACE(name);
    const Domain<N> domain = loadExample<N>(name);
    const auto mesh = fill(domain, 0.6, 2);
    Vec<N> closed{0.0};
    for (Index f = 0; f < toIndex(mesh.surfaces.size()); ++f) {
      EXPECT_GT(surfaceMeasure(mesh, f), 0) << "facet " << f;
      closed += surfaceMeasure(mesh, f) * mesh.surfaces[at(f)].plane.normal;
      EXPECT_NEAR(glm::length(mesh.surfaces[at(f)].plane.normal), 1, 1e-14);
    }
    EXPECT_LT(glm::length(closed), 1e-10); // the outward vector areas of a closed surface cancel
  }
}

TYPED_TEST(ReferenceMeshOf, IsReproducible) {
  constexpr int N = TypeParam::value;
  const Domain<N> domain = loadExample<N>(meshExamples<N>().back());
  const auto first = fill(domain, 0.5, 4);
  const auto again = fill(domain, 0.5, 4);
  EXPECT_EQ(first.simplices, again.simplices);
  EXPECT_EQ(first.nodes, again.nodes);
  const auto other = fill(domain, 0.5, 5);
  EXPECT_NE(first.nodes, other.nodes);
}

TYPED_TEST(ReferenceMeshOf, RefinementMakesMore) {
  constexpr int N = TypeParam::value;
  const Domain<N> domain = loadExample<N>(meshExamples<N>()[1]);
  const Index coarse = fill(domain).simplexCount();
  const Index fine = fill(domain, 0.5).simplexCount();
  const Index finer = fill(domain, 0.25).simplexCount();
  EXPECT_LT(coarse, fine);
  EXPECT_LT(2 * fine, finer);
}

// A turn around a ridge sees each simplex once: from one boundary face to the other, or full circle.
TYPED_TEST(ReferenceMeshOf, TurnsAroundRidges) {
  constexpr int N = TypeParam::value;
  const auto mesh = fill(loadExample<N>(meshExamples<N>()[2]), 0.7, 3);
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int from = 0; from < N + 1; ++from)
      for (int to = 0; to < N + 1; ++to) {
        if (from == to) continue;
        std::set<Index> seen;
        std::size_t visits = 0;
        const auto visit = [&](Index t) {
          seen.insert(t);
          ++visits;
          for (int v = 0; v < N + 1; ++v)
            if (v != from && v != to) {
              ASSERT_GE(mesh.localVertex(t, mesh.simplices[at(s)][at(v)]), 0);
            }
        };
        const FaceRef<N> end = turnAroundRidge(mesh, s, from, to, kCrossAll, visit);
        ASSERT_EQ(seen.size(), visits);
        if (mesh.neighbors[at(end.simplex)][at(end.face)] != kNone) {
          EXPECT_EQ(end.simplex, s);
          EXPECT_EQ(end.face, from);
          EXPECT_GE(visits, 3U);
        }
      }
}

TYPED_TEST(ReferenceMeshOf, StarsAreComplete) {
  constexpr int N = TypeParam::value;
  const auto mesh = fill(loadExample<N>(meshExamples<N>()[3]), 0.8);
  std::vector<Index> star;
  for (Index node = 0; node < mesh.nodeCount(); ++node) {
    collectStar(mesh, node, star);
    std::set<Index> expected;
    for (Index s = 0; s < mesh.simplexCount(); ++s)
      if (mesh.localVertex(s, node) >= 0) expected.insert(s);
    EXPECT_EQ(std::set<Index>(star.begin(), star.end()), expected);
    EXPECT_EQ(star.size(), expected.size());
  }
}

TYPED_TEST(ReferenceMeshOf, ConnectFindsTheSameNeighbours) {
  forMeshes<TypeParam::value>([](auto mesh) {
    const auto neighbors = mesh.neighbors;
    mesh.neighbors.clear();
    mesh.nodeSimplex.clear();
    connect(mesh);
    EXPECT_EQ(mesh.neighbors, neighbors);
  });
}

// The invariants must be able to fail.
TYPED_TEST(ReferenceMeshOf, InvariantsNoticeDamage) {
  constexpr int N = TypeParam::value;
  const auto sound = fill(loadExample<N>(meshExamples<N>()[2]), 0.8);
  const auto broken = [&](auto damage) {
    auto mesh = sound;
    damage(mesh);
    return !brokenInvariants(mesh).empty();
  };
  EXPECT_FALSE(broken([](auto &) {}));
  EXPECT_TRUE(broken([](auto &m) { std::swap(m.simplices[0][0], m.simplices[0][1]); }));
  EXPECT_TRUE(broken([](auto &m) { m.nodeSimplex[0] = m.nodeSimplex[1] == 0 ? 1 : m.nodeSimplex.back(); }));
  EXPECT_TRUE(broken([](auto &m) {
    for (Index &t : m.neighbors[0])
      if (t != kNone) t = t == 1 ? 2 : 1;
  }));
  EXPECT_TRUE(broken([](auto &m) {
    for (std::size_t i = 0; i < m.tags[0].size(); ++i)
      if (m.neighbors[0][i] != kNone) m.tags[0][i] = FaceTag::back(0);
  }));
  EXPECT_TRUE(broken([](auto &m) {
    for (auto &row : m.tags)
      for (Index &tag : row)
        if (tag != kNone) tag = FaceTag::flipped(tag);
  }));
  EXPECT_TRUE(broken([](auto &m) { m.nodes[0][0] += 0.01; }));
  EXPECT_TRUE(broken([](auto &m) { m.region.pop_back(); }));
}

} // namespace
} // namespace dualblock::test
