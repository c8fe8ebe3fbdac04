// The judge must be able to say no: to meshes that are wrong in one way each. And yes, to right ones.
#include "support/mesh_judge.h"

#include <gtest/gtest.h>

#include "support/bent_domains.h"

namespace dualblock::test {
namespace {

/// A grid of unit cubes from `low` on, with nodes of its own.
void addGrid(HexMesh &mesh, const Vec<3> &low, const std::array<Index, 3> &counts) {
  const Index first = toIndex(mesh.positions.size());
  const auto node = [&](Index i, Index j, Index k) {
    return first + (k * (counts[1] + 1) + j) * (counts[0] + 1) + i;
  };
  for (Index k = 0; k <= counts[2]; ++k)
    for (Index j = 0; j <= counts[1]; ++j)
      for (Index i = 0; i <= counts[0]; ++i) mesh.positions.push_back(low + Vec<3>(i, j, k));
  for (Index k = 0; k < counts[2]; ++k)
    for (Index j = 0; j < counts[1]; ++j)
      for (Index i = 0; i < counts[0]; ++i)
        mesh.blocks.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                               node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                               node(i, j + 1, k + 1)});
}

HexMesh grid(const std::array<Index, 3> &counts) {
  HexMesh mesh;
  addGrid(mesh, {0, 0, 0}, counts);
  return mesh;
}

Domain<3> box(double x, double y, double z) { return prism({{0, 0}, {x, 0}, {x, y}, {0, y}}, 0, z); }

TEST(MeshJudge, AcceptsGrids) {
  for (const Index n : {1, 2, 5}) {
    const Verdict v = judge(box(n, n, 2), grid({n, n, 2}));
    EXPECT_EQ(v.complaint, "");
    EXPECT_NEAR(v.meshVolume, v.domainVolume, 1e-12 * v.domainVolume);
    EXPECT_EQ(v.overlap, 0);
    EXPECT_EQ(v.boundaryOverlap, 0);
    EXPECT_EQ(v.lost, 0);
    EXPECT_EQ(v.excess, 0);
    EXPECT_NEAR(v.worstDeterminant, 1, 1e-12);
  }
}

// Nodes moved at random, faces far from plane: blocks still fit together, and none holds what another does.
TEST(MeshJudge, AcceptsCrookedGrids) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    HexMesh mesh = grid({4, 4, 4});
    RandomSource random(seed);
    for (Vec<3> &x : mesh.positions)
      for (int k = 0; k < 3; ++k)
        if (x[k] > 0.5 && x[k] < 3.5) x[k] += random.real(-0.2, 0.2);
    const Verdict v = judge(box(4, 4, 4), mesh);
    EXPECT_EQ(v.complaint, "") << "seed " << seed;
    EXPECT_NEAR(v.meshVolume, 64, 1e-9);
    EXPECT_EQ(v.overlap, 0);
    EXPECT_EQ(v.boundaryOverlap, 0);
    EXPECT_EQ(v.lost, 0);
    EXPECT_LT(v.worstDeterminant, 0.9);
  }
}

TEST(MeshJudge, IsTheSameForSmallSolidsFarAway) {
  Domain<3> domain = box(3, 3, 2);
  HexMesh mesh = grid({3, 3, 2});
  const auto move = [](Vec<3> &x) { x = 1e-3 * x + Vec<3>{100, -50, 20}; };
  for (Vec<3> &x : domain.vertices) move(x);
  for (Vec<3> &x : mesh.positions) move(x);
  EXPECT_EQ(judge(domain, mesh).complaint, "");
  mesh.blocks.resize(9);
  EXPECT_TRUE(judge(domain, mesh).gutted);
}

TEST(MeshJudge, RefusesOverlappingCubes) {
  HexMesh mesh;
  addGrid(mesh, {0, 0, 0}, {1, 1, 1});
  addGrid(mesh, {0.5, 0, 0}, {1, 1, 1});
  const Verdict v = judge(box(1.5, 1, 1), mesh);
  EXPECT_TRUE(v.overlaps);
  EXPECT_NEAR(v.overlap, 1.0 / 3, 0.04);
  EXPECT_NE(v.complaint.find("overlap"), std::string::npos);
  EXPECT_FALSE(v.gutted);
  EXPECT_EQ(v.invertedBlocks, 0);
  EXPECT_EQ(v.incoherentFaces, 0);
}

// Of little volume, as where chords of a shaft and of its hole cross.
TEST(MeshJudge, RefusesAThinOverlap) {
  HexMesh mesh;
  addGrid(mesh, {0, 0, 0}, {1, 1, 1});
  addGrid(mesh, {0.9998, 0, 0}, {1, 1, 1});
  const Verdict v = judge(box(1.9998, 1, 1), mesh);
  EXPECT_LT(v.overlap, 0.002);
  EXPECT_GT(v.boundaryOverlap, 0.1);
  EXPECT_TRUE(v.overlaps);
  HexMesh touching;
  addGrid(touching, {0, 0, 0}, {1, 1, 1});
  addGrid(touching, {1, 0, 0}, {1, 1, 1});
  EXPECT_EQ(judge(box(2, 1, 1), touching).complaint, "");
}

// A second block on a face, on the same side of it as the first: positive by itself.
TEST(MeshJudge, RefusesAFoldedPair) {
  HexMesh mesh = grid({1, 1, 1});
  for (const Index v : {0, 1, 2, 3}) mesh.positions.push_back(mesh.positions[at(v)] + Vec<3>(0, 0, 0.7));
  mesh.blocks.push_back({0, 1, 3, 2, 8, 9, 11, 10}); // node = i + 2 j + 4 k
  const Verdict v = judge(box(1, 1, 1), mesh);
  EXPECT_EQ(v.invertedBlocks, 0);
  EXPECT_EQ(v.incoherentFaces, 1);
  EXPECT_TRUE(v.overlaps);
}

// Twice around an axis, and so onto itself: every face is coherent, every block positive.
TEST(MeshJudge, RefusesARingThatGoesAroundTwice) {
  const auto ring = [](int turns) {
    const Index steps = 16;
    HexMesh mesh;
    for (Index s = 0; s < steps; ++s)
      for (const auto &[r, z] : {std::pair(1, 0), std::pair(2, 0), std::pair(2, 1), std::pair(1, 1)}) {
        const double angle = -2 * kPi * turns * s / steps;
        mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    for (Index s = 0; s < steps; ++s) {
      const Index a = 4 * s;
      const Index b = 4 * ((s + 1) % steps);
      mesh.blocks.push_back({a, a + 1, a + 2, a + 3, b, b + 1, b + 2, b + 3});
    }
    return mesh;
  };
  Domain<3> domain = prism(circle(16, 2), 0, 1);
  addHole(domain, circle(16, 1), 0, 1);
  EXPECT_EQ(judge(domain, ring(1)).complaint, "");
  const Verdict v = judge(domain, ring(2));
  EXPECT_EQ(v.invertedBlocks, 0);
  EXPECT_EQ(v.incoherentFaces, 0);
  EXPECT_GT(v.overlap, 0.9);
}

TEST(MeshJudge, RefusesHalfAMesh) {
  const Verdict v = judge(box(2, 2, 2), grid({2, 2, 1}));
  EXPECT_TRUE(v.gutted);
  EXPECT_NEAR(v.lost, 0.5, 0.05);
  EXPECT_EQ(v.excess, 0);
  EXPECT_FALSE(v.overlaps);
  const Verdict larger = judge(box(2, 2, 1), grid({2, 2, 2}));
  EXPECT_TRUE(larger.gutted);
  EXPECT_NEAR(larger.excess, 1, 0.1);
  EXPECT_EQ(larger.lost, 0);
  EXPECT_TRUE(judge(box(2, 2, 1), HexMesh{}).gutted);
}

TEST(MeshJudge, RefusesAMirroredBlock) {
  HexMesh mesh = grid({2, 1, 1});
  auto &nodes = mesh.blocks[1];
  for (const std::size_t k : {0U, 1U, 2U, 3U}) std::swap(nodes[k], nodes[k + 4]);
  const Verdict v = judge(box(2, 1, 1), mesh);
  EXPECT_EQ(v.invertedBlocks, 1);
  EXPECT_EQ(v.incoherentFaces, 1);
  EXPECT_FALSE(v.overlaps);
  EXPECT_FALSE(v.gutted);
}

TEST(MeshJudge, RefusesANodeThatIsPushedThrough) {
  HexMesh mesh = grid({2, 2, 2});
  mesh.positions[13] += Vec<3>(0.99, 0.4, 0); // the middle: no corner is inverted by much
  mesh.positions[13] += Vec<3>(0.1, 0, 0);
  EXPECT_GT(judge(box(2, 2, 2), mesh).invertedBlocks, 0);
}

TEST(MeshJudge, RefusesNodesThatAreNotThere) {
  HexMesh mesh = grid({1, 1, 1});
  mesh.blocks[0][3] = 8;
  EXPECT_EQ(judge(box(1, 1, 1), mesh).brokenBlocks, 1);
  mesh.blocks[0][3] = mesh.blocks[0][2];
  EXPECT_EQ(judge(box(1, 1, 1), mesh).brokenBlocks, 1);
}

TEST(MeshJudge, RefusesThreeBlocksAtAFace) {
  HexMesh mesh = grid({2, 1, 1});
  mesh.blocks.push_back(mesh.blocks[1]);
  EXPECT_GT(judge(box(2, 1, 1), mesh).incoherentFaces, 0);
}

// Every point of a block is held once by it, whatever its faces are like, and is found by the grid.
TEST(MeshJudge, BlocksHoldTheirPoints) {
  RandomSource random(7);
  for (int trial = 0; trial < 200; ++trial) {
    HexMesh mesh = grid({1, 1, 1});
    for (Vec<3> &x : mesh.positions)
      for (int k = 0; k < 3; ++k) x[k] += random.real(-0.25, 0.25);
    const BlockMembership blocks(mesh);
    for (int k = 0; k < 50; ++k) {
      // Beyond the block's faces, but not so far that the map might fold.
      const Vec<3> place{random.real(-0.15, 1.15), random.real(-0.15, 1.15), random.real(-0.15, 1.15)};
      bool isInside = true;
      for (int a = 0; a < 3; ++a) isInside = isInside && place[a] > 0 && place[a] < 1;
      const TrilinearPoint p = trilinear(mesh, 0, place);
      EXPECT_EQ(blocks.count(p.x), isInside ? 1 : 0) << "trial " << trial << ", point " << k;
    }
  }
}

// The solid angles against what is known: a plate with a hole, and a cavity.
TEST(MeshJudge, SolidsHoldTheirPoints) {
  Domain<3> plate = prism({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, 0, 1);
  addHole(plate, circle(24, 0.8), 0, 1);
  const SolidMembership solid(plate);
  EXPECT_NEAR(solid.volume(), 16 - 12 * 0.64 * std::sin(kPi / 12), 1e-12);
  RandomSource random(3);
  for (int k = 0; k < 1000; ++k) {
    const Vec<3> p{random.real(-3, 3), random.real(-3, 3), random.real(-1, 2)};
    const double radius = std::hypot(p.x, p.y);
    if (radius > 0.75 && radius < 0.81) continue; // between the circle and its chords
    const bool isInside = std::abs(p.x) < 2 && std::abs(p.y) < 2 && p.z > 0 && p.z < 1 && radius > 0.8;
    EXPECT_NEAR(solid.windingNumber(p), isInside ? 1 : 0, 1e-9);
    EXPECT_EQ(solid.holds(p), isInside);
  }
  // A pin in the hole, whose ends are islands in the plate's facets.
  addHole(plate, circle(12, 0.5), 0, 1);
  for (std::size_t f = plate.facets.size() - 12; f < plate.facets.size(); ++f)
    std::reverse(plate.facets[f].loops[0].begin(), plate.facets[f].loops[0].end());
  const SolidMembership pinned(plate);
  EXPECT_NEAR(pinned.volume(), solid.volume() + 6 * 0.25 * std::sin(kPi / 6), 1e-12);
  EXPECT_TRUE(pinned.holds({0.1, 0.2, 0.5}));
  EXPECT_FALSE(pinned.holds({0.5, 0.4, 0.5}));
  EXPECT_TRUE(pinned.holds({1.5, 0.2, 0.5}));
  for (int kind = 0; kind < kBentKindCount; ++kind) { // by cells, and without them
    const SolidMembership bent(bentSolid(kind, 4));
    for (int k = 0; k < 500; ++k) {
      Vec<3> p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = random.real(bent.low()[axis], bent.high()[axis]);
      EXPECT_EQ(bent.holds(p), bent.windingNumber(p) > 0.5);
    }
  }
  Domain<3> shell = box(3, 3, 3);
  Domain<3> cavity = prism({{1, 1}, {2, 1}, {2, 2}, {1, 2}}, 1, 2);
  for (Facet &facet : cavity.facets) std::reverse(facet.loops[0].begin(), facet.loops[0].end());
  addComponent(shell, cavity);
  EXPECT_NEAR(SolidMembership(shell).volume(), 26, 1e-12);
  EXPECT_FALSE(SolidMembership(shell).holds({1.5, 1.4, 1.3}));
  EXPECT_TRUE(SolidMembership(shell).holds({0.5, 1.4, 1.3}));
}

} // namespace
} // namespace dualblock::test
