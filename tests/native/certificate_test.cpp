// The certificate must be able to say no (ARCHITECTURE.md 6): a valid result, damaged in one place at a time,
// fails the check that is there for it, with a message that says what is wrong.
#include "certificate/certificate.h"

#include <functional>

#include <gtest/gtest.h>

#include "support/examples.h"

namespace dualblock::test {
namespace {

template <int N> Certificate certified(const PipelineResult<N> &r) {
  return certify<N>({r.domain.domain, r.features, r.featureNodes, r.mesh, r.parts, r.contributions, r.dual,
                     r.surfaces, r.primal, r.domain.deviation});
}

template <int N> using Damage = std::function<void(PipelineResult<N> &)>;

/// Expects that the damage fails the check with a message that contains `words`.
template <int N>
void expectCaught(const std::string &name, Check check, const std::string &words, Damage<N> damage) {
  PipelineResult<N> result = run(loadExample<N>(name));
  ASSERT_TRUE(certified(result).valid) << failuresOf(certified(result));
  damage(result);
  const Certificate certificate = certified(result);
  EXPECT_FALSE(certificate.valid);
  EXPECT_FALSE(certificate.passed[static_cast<std::size_t>(check)]);
  bool said = false;
  for (const CertificateFailure &f : certificate.failures)
    said |= f.check == check && f.message.find(words) != std::string::npos;
  EXPECT_TRUE(said) << "no message with \"" << words << "\" among:" << failuresOf(certificate);
}

/// The primal node of the piece with the fewest sides (0: a part's centre, N: a corner), of the first part.
template <int N> Index nodeWithSides(const PipelineResult<N> &r, int count) {
  for (const CellPiece<N> &piece : r.dual.pieces)
    if (piece.sideCount() == count) return piece.cell;
  throw std::logic_error("no such cell");
}

/// A node of a side that is a facet of the domain: labels hold that side alone.
template <int N> Index nodeOnFacet(const PipelineResult<N> &r) {
  for (const CellPiece<N> &piece : r.dual.pieces)
    if (piece.sideCount() == 1 && r.parts.sides[at(piece.sides[0])].opposite == kNone) return piece.cell;
  throw std::logic_error("no such cell");
}

template <int N> struct Examples;
template <> struct Examples<2> {
  static constexpr const char *kReflex = "l_shape_2d";
  static constexpr const char *kConvex = "square_2d";
  static constexpr const char *kRing = "square_ring_2d";
};
template <> struct Examples<3> {
  static constexpr const char *kReflex = "l_shape_extruded";
  static constexpr const char *kConvex = "tapered_brick";
  static constexpr const char *kRing = "square_ring";
};

template <typename Dimension> class CertificateOf : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CertificateOf, Dimensions);

TYPED_TEST(CertificateOf, AcceptsTheExamples) {
  constexpr int N = TypeParam::value;
  for (const char *name : {Examples<N>::kReflex, Examples<N>::kConvex, Examples<N>::kRing}) {
    const auto result = run(loadExample<N>(name));
    const Certificate certificate = certified(result);
    EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
    EXPECT_TRUE(certificate.failures.empty());
    EXPECT_GT(certificate.worstCoefficient, 0);
    EXPECT_NEAR(certificate.meshMeasure, certificate.domainMeasure, 1e-12 * certificate.domainMeasure);
    // Every curve of these examples gets its ideal number of blocks.
    EXPECT_EQ(certificate.features.size(), result.features.curves.size());
    for (const FeatureCount &f : certificate.features) EXPECT_EQ(Index{f.ideal}, f.actual);
  }
}

TYPED_TEST(CertificateOf, MatchingContributionMask) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::matching, "arrive at a face from both sides", [](auto &r) {
    for (Index s = 0; s < r.mesh.simplexCount(); ++s) // a contribution whose trace a neighbour shares
      for (int i = 0; i < N + 1; ++i) {
        if (r.mesh.neighbors[at(s)][at(i)] == kNone || r.contributions.ofSimplex.size(s) == 0) continue;
        Contribution &c = r.contributions.ofSimplex.items[at(r.contributions.ofSimplex.offsets[at(s)])];
        c.mask = static_cast<std::uint8_t>(RegionTables<N>::kFullMask & ~c.mask);
        return;
      }
  });
}

TYPED_TEST(CertificateOf, MatchingMissingContribution) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::matching, "arrive at a face from both sides", [](auto &r) {
    auto &lists = r.contributions.ofSimplex;
    for (Index s = 0; s < lists.count(); ++s) {
      if (lists.size(s) == 0) continue;
      lists.items.erase(lists.items.begin() + lists.offsets[at(s)]);
      for (std::size_t t = at(s) + 1; t < lists.offsets.size(); ++t) --lists.offsets[t];
      return;
    }
  });
}

TYPED_TEST(CertificateOf, MatchingTornDualSurface) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::matching, "arrive at a face from both sides", [](auto &r) {
    for (std::size_t side = 0; side < r.surfaces.ofSide.size(); ++side)
      if (std::count(r.surfaces.ofSide.begin(), r.surfaces.ofSide.end(), r.surfaces.ofSide[side]) > 1) {
        r.surfaces.ofSide[side] = r.surfaces.count++; // it continues across a split surface: no longer
        return;
      }
  });
}

TYPED_TEST(CertificateOf, MatchingSideThatIsNotFull) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::matching, "share a face with", [](auto &r) {
    r.contributions.notFull.push_back({0, {0, 1}});
  });
}

/// Gives each of `copies` the contributions of `original` in place of its own: they run along it everywhere.
template <int N> void runAlong(PipelineResult<N> &r, Index original, const std::vector<Index> &copies) {
  Lists<Contribution> lists;
  for (Index s = 0; s < r.mesh.simplexCount(); ++s) {
    const Contribution *const end = r.contributions.ofSimplex.end(s);
    for (const Contribution *c = r.contributions.ofSimplex.begin(s); c != end; ++c) {
      if (std::find(copies.begin(), copies.end(), c->side) == copies.end()) lists.items.push_back(*c);
      if (c->side != original) continue;
      for (const Index side : copies) lists.items.push_back({side, c->mask});
    }
    lists.offsets.push_back(toIndex(lists.items.size()));
  }
  r.contributions.ofSimplex = lists;
}

/// Only the rule for the boundary may fail: the traces on inner faces agree.
template <int N> void expectBoundaryRule(const PipelineResult<N> &r, const std::string &words) {
  const Certificate certificate = certified(r);
  EXPECT_FALSE(certificate.passed[static_cast<std::size_t>(Check::matching)]);
  const std::string failures = failuresOf(certificate);
  EXPECT_NE(failures.find(words), std::string::npos) << failures;
  EXPECT_EQ(failures.find("from both sides"), std::string::npos) << failures;
}

// At a segment of the boundary one contribution arrives, or two of sides that meet the face's own at a
// corner.
TYPED_TEST(CertificateOf, MatchingSurfacesThatLeaveTheBoundaryTogether) {
  constexpr int N = TypeParam::value;
  PipelineResult<N> r = run(loadExample<N>(Examples<N>::kConvex));
  runAlong(r, Index{0}, {1});
  expectBoundaryRule(r, N == 2 ? "too many D-bar-surfaces arrive together" : "and at no corner");
}

TEST(Certificate, MatchingTooManySurfacesAtACorner) {
  PipelineResult<3> r = run(loadExample<3>("tapered_brick"));
  const Corner &corner = r.parts.corners.front();
  Index other = 0; // a side that does not meet this corner
  while (std::find(corner.sides.begin(), corner.sides.end(), other) != corner.sides.end()) ++other;
  runAlong(r, corner.sides[0], {corner.sides[1], other});
  expectBoundaryRule(r, "too many D-bar-surfaces arrive together");
}

TYPED_TEST(CertificateOf, MatchingBareBoundary) {
  constexpr int N = TypeParam::value;
  PipelineResult<N> r = run(loadExample<N>(Examples<N>::kConvex));
  r.contributions.ofSimplex.items.clear();
  r.contributions.ofSimplex.offsets.assign(r.mesh.simplices.size() + 1, 0);
  expectBoundaryRule(r, "no D-bar-surface runs along a face of the boundary");
}

// Two sides share a face: their surfaces run along it together.
TYPED_TEST(CertificateOf, MatchingBoundaryOfTwoSides) {
  constexpr int N = TypeParam::value;
  PipelineResult<N> r = run(loadExample<N>(Examples<N>::kConvex));
  runAlong(r, Index{0}, {1});
  expectBoundaryRule(r, "two D-bar-surfaces run along one face");
}

// Coarse meshes have segments of the boundary where two contributions end, which the paper does not have.
TEST(Certificate, MatchingTwoHardContributionsAtACorner) {
  for (const char *name : {"square_ring", "protrusion", "box_on_box"}) {
    const PipelineResult<3> r = run(loadExample<3>(name));
    int found = 0;
    for (Index s = 0; s < r.mesh.simplexCount(); ++s)
      for (int i = 0; i < 4; ++i) {
        if (r.mesh.neighbors[at(s)][at(i)] != kNone) continue;
        const unsigned face = 15U & ~(1U << i);
        const Contribution *const end = r.contributions.ofSimplex.end(s);
        for (const Contribution *c = r.contributions.ofSimplex.begin(s); c != end; ++c)
          for (const Contribution *d = c + 1; d != end; ++d)
            found += c->mask != d->mask && (c->mask & face) == (d->mask & face) && (c->mask & face) != 0;
      }
    EXPECT_GT(found, 0) << name;
    EXPECT_TRUE(certified(r).valid) << name << failuresOf(certified(r));
  }
}

TYPED_TEST(CertificateOf, MatchingSideTwiceOnTheBoundary) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::matching, "a side has two contributions", [](auto &r) {
    auto &lists = r.contributions.ofSimplex;
    for (Index s = 0; s < lists.count(); ++s) {
      const auto &neighbors = r.mesh.neighbors[at(s)];
      if (lists.size(s) == 0 || std::find(neighbors.begin(), neighbors.end(), kNone) == neighbors.end())
        continue;
      lists.items.insert(lists.items.begin() + lists.offsets[at(s)], Contribution(*lists.begin(s)));
      for (std::size_t t = at(s) + 1; t < lists.offsets.size(); ++t) ++lists.offsets[t];
      return;
    }
  });
}

TYPED_TEST(CertificateOf, CellsMergedIntoOne) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::cells, "not a ball", [](auto &r) {
    for (Index &piece : r.dual.pieceOf)
      if (piece == 1) piece = 0;
  });
}

TYPED_TEST(CertificateOf, CellsOfTwoPartsMerged) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::cells, "not a ball",
                  [](auto &r) { r.dual.pieces.back().cell = r.dual.pieces.front().cell; });
}

TYPED_TEST(CertificateOf, CellsWithOneLabel) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::cells, "share the label",
                  [](auto &r) { r.dual.pieces[2].sides = r.dual.pieces[1].sides; });
}

TYPED_TEST(CertificateOf, CellsInsideTooManySurfaces) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::cells, "more D-bar-surfaces",
                  [](auto &r) { r.dual.overfull = true; });
}

TYPED_TEST(CertificateOf, CellsAcrossAMissingSplitTag) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::cells, "not a ball", [](auto &r) {
    for (Index s = 0; s < r.mesh.simplexCount(); ++s)
      for (int i = 0; i < N + 1; ++i) {
        const Index t = r.mesh.neighbors[at(s)][at(i)];
        if (t == kNone || r.mesh.tags[at(s)][at(i)] == kNone) continue;
        r.mesh.tags[at(t)][at(r.mesh.mirrorFace(s, i))] = kNone;
        r.mesh.tags[at(s)][at(i)] = kNone;
        return;
      }
  });
}

TYPED_TEST(CertificateOf, TopologySwappedNodes) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::topology, "",
                  [](auto &r) { std::swap(r.primal.blocks[3].nodes[0], r.primal.blocks[3].nodes[1]); });
}

// Faces of two blocks may then have the same nodes in another order, and are not the same face.
TEST(Certificate, TopologyAnyTwoNodesSwapped) {
  PipelineResult<3> r = run(loadExample<3>("l_shape_extruded"));
  bool isOtherOrder = false;
  for (Block<3> &block : r.primal.blocks)
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = a + 1; b < 8; ++b) {
        std::swap(block.nodes[a], block.nodes[b]);
        const Certificate certificate = certified(r);
        EXPECT_FALSE(certificate.valid) << a << " " << b;
        isOtherOrder |= failuresOf(certificate).find("not in the same order") != std::string::npos;
        std::swap(block.nodes[a], block.nodes[b]);
      }
  EXPECT_TRUE(isOtherOrder);
  EXPECT_TRUE(certified(r).valid);
}

TYPED_TEST(CertificateOf, TopologyNodeTwice) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::topology, "same node twice",
                  [](auto &r) { r.primal.blocks[0].nodes[1] = r.primal.blocks[0].nodes[0]; });
}

TYPED_TEST(CertificateOf, TopologyDuplicatedBlock) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::topology, "share",
                  [](auto &r) { r.primal.blocks.push_back(r.primal.blocks[2]); });
  expectCaught<N>(Examples<N>::kReflex, Check::geometry, "add up",
                  [](auto &r) { r.primal.blocks.push_back(r.primal.blocks[2]); });
}

TYPED_TEST(CertificateOf, TopologyRingBroken) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kRing, Check::topology, "the domain has", [](auto &r) {
    // A part between two others, its split surfaces across from each other. (Around a part in a corner of
    // the ring the two others touch still, and the ring is only pinched.)
    std::vector<bool> inCorner(r.parts.parts.size(), false);
    for (const Corner &corner : r.parts.corners) {
      int split = 0;
      for (const Index side : corner.sides) split += r.parts.sides[at(side)].opposite != kNone ? 1 : 0;
      if (split > 1) inCorner[at(corner.part)] = true;
    }
    const auto part = std::find(inCorner.begin(), inCorner.end(), false) - inCorner.begin();
    std::erase_if(r.primal.blocks, [&](const Block<N> &b) { return b.part == part; });
  });
}

TYPED_TEST(CertificateOf, TopologyNoBlocks) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::topology, "no blocks",
                  [](auto &r) { r.primal.blocks.clear(); });
}

TYPED_TEST(CertificateOf, TopologyTwoDerivationsDiffer) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::topology, "of the blocks are not", [](auto &r) {
    r.primal.faults.push_back("the edges of the blocks are not those of the dual");
  });
}

TYPED_TEST(CertificateOf, GeometryCentreOutside) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::geometry, "inverted",
                  [](auto &r) { r.primal.positions[at(nodeWithSides(r, 0))] += Vec<N>(10 * r.mesh.size); });
}

TYPED_TEST(CertificateOf, GeometryFlatBlock) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::geometry, "inverted or flat", [](auto &r) {
    const auto &nodes = r.primal.blocks[0].nodes; // node 0 of a block is the centre, node 1 on a side
    r.primal.positions[at(nodes[0])] = r.primal.positions[at(nodes[1])];
  });
}

TYPED_TEST(CertificateOf, GeometryMirroredBlock) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::geometry, "inverted", [](auto &r) {
    auto &nodes = r.primal.blocks[1].nodes;
    std::swap(nodes[1], nodes[3]);
    if constexpr (N == 3) std::swap(nodes[5], nodes[7]);
  });
}

TYPED_TEST(CertificateOf, GeometryDroppedBlock) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::geometry, "add up",
                  [](auto &r) { r.primal.blocks.pop_back(); });
  expectCaught<N>(Examples<N>::kConvex, Check::features, "", [](auto &r) { r.primal.blocks.pop_back(); });
}

TYPED_TEST(CertificateOf, GeometryAnotherDomain) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::geometry, "add up",
                  [](auto &r) { r.domain.domain.vertices[0] -= Vec<N>(1e-6 * r.mesh.size); });
}

TYPED_TEST(CertificateOf, FeaturesNodeOffItsFacet) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::features, "is off facet", [](auto &r) {
    const Index node = nodeOnFacet(r);
    Vec<N> centre{0.0};
    for (const Vec<N> &x : r.primal.positions) centre += x / static_cast<double>(r.primal.positions.size());
    r.primal.positions[at(node)] += 1e-6 * (centre - r.primal.positions[at(node)]);
  });
}

TYPED_TEST(CertificateOf, FeaturesVertexLost) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kConvex, Check::features, "is no primal node", [](auto &r) {
    const Index node = nodeWithSides(r, N);
    r.primal.positions[at(node)] +=
        1e-6 * (r.primal.positions[at(nodeWithSides(r, 0))] - r.primal.positions[at(node)]);
  });
}

TYPED_TEST(CertificateOf, FeaturesFaceOnNoFacet) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(Examples<N>::kReflex, Check::features, "lies on no facet", [](auto &r) {
    for (const Block<N> &b : r.primal.blocks) // without the block behind it, a split surface is bare
      for (const Index side : b.sides)
        if (r.parts.sides[at(side)].opposite != kNone) {
          const Index opposite = r.parts.sides[at(side)].opposite;
          std::erase_if(r.primal.blocks,
                        [&](const Block<N> &x) { return x.part == r.parts.sides[at(opposite)].part; });
          return;
        }
  });
}

TYPED_TEST(CertificateOf, ListsAFewFailuresOfEachCheckOnly) {
  constexpr int N = TypeParam::value;
  auto result = run(loadExample<N>(Examples<N>::kRing));
  for (Vec<N> &x : result.primal.positions) x *= -2.0;
  const Certificate certificate = certified(result);
  EXPECT_FALSE(certificate.valid);
  EXPECT_LE(certificate.failures.size(), 5U * 8);
  for (const CertificateFailure &f : certificate.failures) EXPECT_FALSE(f.message.empty());
}

// A node in the middle of a curve moved sideways on its facet: the curve is no chain of primal edges.
TEST(Certificate, FeaturesCurveLost) {
  expectCaught<3>("tapered_brick", Check::features, "is no chain of primal edges", [](auto &r) {
    const Index node = nodeWithSides(r, 2);
    const Index side = nodeOnFacet(r);
    r.primal.positions[at(node)] += 1e-3 * (r.primal.positions[at(side)] - r.primal.positions[at(node)]);
  });
}

// Counts of blocks around features, where they are not the ideal: an octahedron's curves lie at 109 degrees
// and get one block; a pyramid's cut curves get two where one is ideal.
TEST(Certificate, DomainHardlyThickerThanFacetsArePlanar) {
  // Walls so oblique that they lie in the bottom's plane within the tolerance: merged, they would leave a
  // domain of another volume, which agrees with its blocks within what the facets are off their planes.
  Domain<3> domain = prism({{0.000000, 0.000000},
                            {0.246704, 1.186728},
                            {-0.310951, 1.891194},
                            {-0.434303, 1.297830},
                            {-0.991958, 2.002296},
                            {-1.115310, 1.408933}},
                           0, 0);
  const std::vector<double> heights{0.0000000000, 0.0015908535,  0.0011518226,
                                    0.0003563959, -0.0000826350, -0.0008780617};
  for (std::size_t v = 0; v < 12; ++v) {
    domain.vertices[v].z = heights[v % 6];
    if (v >= 6) domain.vertices[v] += Vec<3>{-0.00082086, -0.00038942, 4.1779e-07};
  }
  const PipelineResult<3> merged = run(domain);
  EXPECT_FALSE(merged.certificate.valid);
  EXPECT_NE(failuresOf(merged.certificate).find("too much for so thin a domain"), std::string::npos)
      << failuresOf(merged.certificate);
  PipelineOptions finer;
  finer.tolerance = 1e-9;
  const PipelineResult<3> exact = run(domain, finer);
  EXPECT_TRUE(exact.certificate.valid) << failuresOf(exact.certificate);
  EXPECT_NEAR(exact.certificate.meshMeasure, 3e-6, 1e-10); // six digits of the heights
}

TEST(Certificate, ReportsTheBlocksAroundCurves) {
  const auto octahedron = run(loadExample<3>("double_pyramid"));
  for (const FeatureCount &f : octahedron.certificate.features) EXPECT_EQ(f.ideal, 1);
  const auto corner = run(loadExample<2>("l_shape_2d"));
  std::array<int, 5> counts{};
  for (const FeatureCount &f : corner.certificate.features) ++counts[f.ideal];
  EXPECT_EQ(counts, (std::array<int, 5>{0, 5, 0, 1, 0}));
}

} // namespace
} // namespace dualblock::test
