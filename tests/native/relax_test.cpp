// Relaxation: better shapes, never a worse worst one, nodes within what they lie on.
#include "blocks/relax.h"

#include <random>

#include <gtest/gtest.h>

#include "geometry/jacobian.h"
#include "support/random_domains.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

template <int N> double worstOf(const BlockMesh<N> &mesh) {
  double worst = 1;
  for (const auto &block : mesh.blocks)
    worst = std::min(worst, scaledJacobian<N>(cornersOf<N>(block, mesh.positions)));
  return worst;
}

template <int N> PipelineResult<N> unrelaxed(const Domain<N> &domain) {
  PipelineOptions options;
  options.mode.relax = false;
  return run(domain, options);
}

template <int N> Certificate certifyAlone(const PipelineResult<N> &r, const BlockMesh<N> &mesh) {
  return certifyBlocks<N>({r.domain.domain, r.features, r.featureNodes, r.mesh, mesh, r.domain.deviation});
}

// The same figures as other all-hexahedra methods, or better, on the same shapes.
TEST(Relax, FiguresOfTheExamples) {
  const auto worst = [](const char *name) { return minimumQuality(run(loadExample<3>(name))); };
  EXPECT_GE(worst("tapered_brick"), 0.92);
  EXPECT_GE(worst("extruded_pentagon"), 0.95);
  EXPECT_GE(worst("double_pyramid"), 0.50 - 1e-9);
  EXPECT_GE(worst("hexagonal_pyramid"), 0.22);
  EXPECT_GE(worst("house"), 0.707);
  for (const char *name :
       {"square_ring", "protrusion", "l_shape_extruded", "u_shape_extruded", "notched_cube"})
    EXPECT_NEAR(worst(name), 1, 1e-9) << name;
}

TEST(Relax, BentSidesStayOnTheirSurface) {
  for (const Domain<3> &domain : {torus(24, 12), shaft(24), ball(24)}) {
    SCOPED_TRACE(domain.name);
    const auto before = unrelaxed(domain);
    const auto after = run(domain);
    EXPECT_TRUE(after.certificate.valid) << failuresOf(after.certificate);
    EXPECT_GT(minimumQuality(after), 0.7);
    EXPECT_GT(minimumQuality(after), minimumQuality(before));
  }
}

// The rounds that are kept lead from the first places to the last; none is worse at its worst than the first.
TEST(Relax, KeepsItsHistory) {
  for (const char *name : {"icosahedron", "tapered_brick", "cylinder"}) {
    SCOPED_TRACE(name);
    const Domain<3> domain = loadExample<3>(name);
    PipelineOptions options;
    options.history = true;
    const auto r = run(domain, options);
    const std::size_t nodes = r.primal.positions.size();
    ASSERT_EQ(r.history.size() % nodes, 0U);
    const std::size_t rounds = r.history.size() / nodes;
    ASSERT_GT(rounds, 2U);
    EXPECT_TRUE(std::equal(r.primal.positions.begin(), r.primal.positions.end(), r.history.end() - nodes));
    EXPECT_TRUE(
        std::equal(r.history.begin(), r.history.begin() + nodes, unrelaxed(domain).primal.positions.begin()));
    double first = -1;
    for (std::size_t round = 0; round < rounds; ++round) {
      const std::vector<Vec<3>> then(r.history.begin() + round * nodes,
                                     r.history.begin() + (round + 1) * nodes);
      double worst = 1;
      for (const Block<3> &block : r.primal.blocks)
        worst = std::min(worst, scaledJacobian<3>(cornersOf<3>(block.nodes, then)));
      EXPECT_GE(worst, first - 1e-12) << round;
      if (round == 0) first = worst;
    }
    EXPECT_EQ(run(domain).history.size(), 0U); // only where it is asked for
    EXPECT_EQ(run(domain).primal.positions, r.primal.positions);
  }
}

// An L whose mesh becomes one of three cubes: of an upright edge's two ends either makes the angles worse
// where it moves alone.
TEST(Relax, MovesWhatHasToMoveTogether) {
  const Domain<3> shape = prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0, 1);
  const auto r = run(shape);
  BlockMesh<3> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const Freedom<3> freedom(r.mesh, r.features, r.featureNodes, blocks);
  for (Vec<3> &x : blocks.positions) // leans: what is on the right of the corner, away from it at the outside
    if (x.x == 1 && x.y < 1) x.x += 0.25 * (1 - x.y);
  RelaxOptions options;
  options.sweeps = 300;
  relax(freedom, blocks, options);
  EXPECT_LT(worstOf(blocks), 0.99);
  options.precision = 1e-8;
  options.dip = 0.9;
  relax(freedom, blocks, options);
  EXPECT_GT(worstOf(blocks), 1 - 1e-9);
}

// A roof whose planes are nearly one, of a ridge that leads out of where its facets' fitted planes cross:
// what is tolerated in a plane is much along their line.
TEST(Relax, SlidesAlongTheDomainsOwnCurves) {
  Domain<3> house = prism({{0, 0}, {2, 0}, {2, 1}, {1, 1.02}, {0, 1}}, 0, 3);
  for (Vec<3> &x : house.vertices) {
    if (x.z == 3) x.z += 0.8 * x.x; // one end is slanted: there is somewhere to go
    if (x.y == 1.02) x.y += x.z > 1 ? 4e-7 : -4e-7;
    if (x.y == 1) x.y += (x.z > 1) == (x.x > 1) ? 4e-7 : -4e-7;
  }
  PipelineOptions options;
  options.featureAngle = 0;
  const auto r = run(house, options);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  options.mode.relax = false;
  const auto before = run(house, options);
  ASSERT_EQ(r.primal.positions.size(), before.primal.positions.size());
  double farthest = 0; // of nodes on the ridge
  for (std::size_t n = 0; n < r.primal.positions.size(); ++n)
    if (before.primal.positions[n].y > 1.019)
      farthest = std::max(farthest, glm::length(r.primal.positions[n] - before.primal.positions[n]));
  EXPECT_GT(farthest, 0.01); // places as they were first would be taken were the others not certified
}

// Nodes thrown about on a mesh of boxes come back: every angle is right again, and features are where they
// were.
TEST(Relax, BoxesComeBack) {
  const auto r = unrelaxed(loadExample<3>("protrusion"));
  BlockMesh<3> mesh = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const Freedom<3> freedom(r.mesh, r.features, r.featureNodes, mesh);
  std::mt19937 random(7);
  double shortest = r.mesh.size;
  for (const PrimalEdge &e : r.primal.edges)
    shortest =
        std::min(shortest, glm::length(mesh.positions[at(e.nodes[1])] - mesh.positions[at(e.nodes[0])]));
  Index fixed = 0;
  for (Index v = 0; v < mesh.nodeCount(); ++v) {
    fixed += freedom.isFixed(v) ? 1 : 0;
    for (const Vec<3> &d : freedom.directions(v, mesh.positions[at(v)]))
      mesh.positions[at(v)] += 0.25 * shortest * (static_cast<double>(random()) / 2147483648.0 - 1) * d;
  }
  EXPECT_EQ(at(fixed), r.domain.domain.vertices.size());
  EXPECT_LT(worstOf(mesh), 0.9);
  EXPECT_TRUE(certifyAlone(r, mesh).valid);
  RelaxOptions many;
  many.sweeps = 60;
  relax(freedom, mesh, many);
  EXPECT_GT(worstOf(mesh), 0.999);
  EXPECT_TRUE(certifyAlone(r, mesh).valid);
}

TEST(Relax, NeverWorseAtItsWorst) {
  double before = 0;
  double after = 0;
  for (const int kind : {0, 1, 5, 6})
    for (std::uint32_t seed = 1; seed <= 25; ++seed) {
      const auto r = unrelaxed(randomSolid(kind, seed));
      if (!r.certificate.valid) continue; // not without relaxation
      BlockMesh<3> mesh = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
      const double first = worstOf(mesh);
      relax(Freedom<3>(r.mesh, r.features, r.featureNodes, mesh), mesh, {});
      EXPECT_GE(worstOf(mesh), first - 1e-12) << kind << " " << seed;
      EXPECT_TRUE(certifyAlone(r, mesh).valid) << kind << " " << seed;
      before += first;
      after += worstOf(mesh);
    }
  std::cout << "100 solids: mean of the smallest scaled Jacobians " << before / 100 << " before, "
            << after / 100 << " after\n";
  EXPECT_GT(after, 1.1 * before);
}

TEST(Relax, InTwoDimensions) {
  const auto r = unrelaxed(loadExample<2>("pentagon_2d"));
  BlockMesh<2> mesh = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const Freedom<2> freedom(r.mesh, r.features, r.featureNodes, mesh);
  for (Index v = 0; v < mesh.nodeCount(); ++v)
    if (freedom.directions(v, mesh.positions[at(v)]).size() == 2) mesh.positions[at(v)] += Vec<2>(0.2, 0.1);
  const double moved = worstOf(mesh);
  relax(freedom, mesh, {});
  EXPECT_GT(worstOf(mesh), moved);
  EXPECT_GE(worstOf(mesh), 0.94);
  EXPECT_TRUE(certifyAlone(r, mesh).valid);
}

} // namespace
} // namespace dualblock::test
