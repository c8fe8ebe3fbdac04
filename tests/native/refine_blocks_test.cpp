// Refinement: counts, places, gradings, and certificates of what comes out.
#include "refinement/refine_blocks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/jacobian.h"
#include "support/dimensions.h"
#include "support/random_domains.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

template <int N> BlockMesh<N> blocksOf(const PipelineResult<N> &r) {
  return r.finalMesh ? r.finalMesh->blocks : layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
}

template <int N> RefinedMesh<N> refined(const PipelineResult<N> &r, const RefineOptions &options) {
  auto mesh = refineResult(r, options);
  if (!mesh.ok()) throw std::runtime_error(mesh.error().message);
  return std::move(mesh.value());
}

RefineOptions intervals(Index n) {
  RefineOptions options;
  options.intervals = n;
  return options;
}

/// The elements as blocks of their own, for the certificate: an element has its block's tag where it is at
/// that end of the block.
template <int N> BlockMesh<N> asBlocks(const BlockMesh<N> &coarse, const RefinedMesh<N> &mesh) {
  BlockMesh<N> fine;
  fine.positions = mesh.positions;
  fine.blocks = mesh.elements;
  Index within = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Index b = mesh.block[e];
    within = e > 0 && mesh.block[e - 1] == b ? within + 1 : 0;
    fine.surfaces.push_back(coarse.surfaces[at(b)]);
    fine.part.push_back(coarse.part[at(b)]);
    auto &tags = fine.tags.emplace_back();
    tags.fill(kNone);
    Index rest = within;
    for (std::size_t a = 0; a < N; ++a) {
      const Index n = mesh.intervals[at(coarse.surfaces[at(b)][a])];
      if (rest % n == 0) tags[2 * a] = coarse.tags[at(b)][2 * a];
      if (rest % n == n - 1) tags[2 * a + 1] = coarse.tags[at(b)][2 * a + 1];
      rest /= n;
    }
  }
  return fine;
}

template <int N> Certificate certificateOf(const PipelineResult<N> &r, const RefinedMesh<N> &mesh) {
  const BlockMesh<N> fine = asBlocks(blocksOf(r), mesh);
  return certifyBlocks<N>({r.domain.domain, r.features, r.featureNodes, r.mesh, fine, r.domain.deviation});
}

PipelineOptions coarsest() {
  PipelineOptions options;
  options.mode.mode = Mode::coarsest;
  return options;
}

template <typename T> struct Refine : ::testing::Test {};
TYPED_TEST_SUITE(Refine, Dimensions);

// The certificate knows nothing of refinement: to it this is a block mesh like any other.
TYPED_TEST(Refine, ExamplesPassTheCertificate) {
  constexpr int N = TypeParam::value;
  for (const std::string &name : computedExampleNames()) {
    if (!std::holds_alternative<Domain<N>>(loadExample(name))) continue;
    SCOPED_TRACE(name);
    for (const PipelineOptions &options : {PipelineOptions{}, coarsest()}) {
      const auto r = run(loadExample<N>(name), options);
      const auto mesh = refined(r, intervals(3));
      EXPECT_EQ(mesh.elements.size(), blocksOf(r).blocks.size() * (N == 2 ? 9 : 27));
      const Certificate certificate = certificateOf(r, mesh);
      EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
      EXPECT_TRUE(mesh.straightened.empty());
      const bool isCloser = std::abs(certificate.meshMeasure - certificate.domainMeasure) <=
                            std::abs(r.certificate.meshMeasure - r.certificate.domainMeasure);
      EXPECT_TRUE(certificate.isExact || isCloser);
    }
  }
}

// One interval changes nothing but the numbers of the nodes, which stay as they are.
TYPED_TEST(Refine, OneIntervalIsTheMeshItself) {
  constexpr int N = TypeParam::value;
  const auto r = run(loadExample<N>(meshExamples<N>().back()));
  const BlockMesh<N> blocks = blocksOf(r);
  const auto mesh = refined(r, intervals(1));
  EXPECT_EQ(mesh.positions, blocks.positions);
  EXPECT_EQ(mesh.elements, blocks.blocks);
  EXPECT_EQ(mesh.quality, r.quality);
  EXPECT_EQ(mesh.boundary.faces.size(), boundaryFaces(r.mesh, r.parts, r.primal).faces.size());
}

// Elements of plane domains are pieces of their block's own (tri)linear map.
TYPED_TEST(Refine, NodesLieWhereTheBlocksMapTakesThem) {
  constexpr int N = TypeParam::value;
  const auto r = run(loadExample<N>(N == 2 ? "two_holes_2d" : "icosahedron"));
  const BlockMesh<N> blocks = blocksOf(r);
  const Index n = 4;
  const auto mesh = refined(r, intervals(n));
  const auto perBlock = static_cast<std::size_t>(std::pow(n, N));
  double worst = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t k = 0; k < 1U << N; ++k) {
      Vec<N> wanted{0.0};
      for (std::size_t c = 0; c < 1U << N; ++c) {
        double weight = 1;
        for (int a = 0; a < N; ++a) {
          const auto cell = static_cast<Index>(e % perBlock / static_cast<std::size_t>(std::pow(n, a))) % n;
          const double t = (cell + (kBlockBits<N>[k] >> a & 1U)) / static_cast<double>(n);
          weight *= kBlockBits<N>[c] >> a & 1U ? t : 1 - t;
        }
        wanted += weight * blocks.positions[at(blocks.blocks[e / perBlock][c])];
      }
      worst = std::max(worst, glm::length(wanted - mesh.positions[at(mesh.elements[e][k])]));
    }
  EXPECT_LT(worst, 1e-14 * r.mesh.size);
}

TEST(RefineCounts, FollowTheSurfaces) {
  // A box of one block: a lattice with as many nodes as counting says.
  const auto r = run(loadExample<3>("tapered_brick"), coarsest());
  const auto surfaces = blocksOf(r).surfaces[0];
  RefineOptions options;
  options.ofSurface = {{surfaces[0], 2}, {surfaces[1], 3}, {surfaces[2], 5}};
  const auto mesh = refined(r, options);
  EXPECT_EQ(mesh.elements.size(), 30U);
  EXPECT_EQ(mesh.positions.size(), 3U * 4U * 6U);
  EXPECT_EQ(mesh.boundary.faces.size(), 2U * (6 + 10 + 15));
  EXPECT_EQ(mesh.interfaces.faces.size(), 0U);
  EXPECT_TRUE(certificateOf(r, mesh).valid);
}

// Straight edges of blocks are one piece of the outline, bent ones as many as they have intervals.
TEST(RefineCounts, OutlineIsTheEdgesOfTheBlocks) {
  const auto box = refined(run(loadExample<3>("tapered_brick"), coarsest()), intervals(4));
  EXPECT_EQ(box.outline.size(), 12U);
  const auto r = run(loadExample<3>("cylinder"));
  const auto mesh = refined(r, intervals(4));
  std::size_t bent = 0;
  for (const PrimalEdge &e : r.primal.edges) {
    const auto radius = [&](Index v) {
      return std::hypot(r.primal.positions[at(v)].x, r.primal.positions[at(v)].y);
    };
    const double chord = glm::length(r.primal.positions[at(e.nodes[0])] - r.primal.positions[at(e.nodes[1])]);
    const double height =
        std::abs(r.primal.positions[at(e.nodes[0])].z - r.primal.positions[at(e.nodes[1])].z);
    const bool around = height < 1e-9 && radius(e.nodes[0]) > 0.97 && radius(e.nodes[1]) > 0.97;
    bent += around && chord > 1e-9 ? 1 : 0;
  }
  ASSERT_GT(bent, 0U);
  EXPECT_GE(mesh.outline.size(), r.primal.edges.size() + 3 * bent); // and those that run along the side
  for (const auto &[a, b, element] : mesh.outline) {
    const auto &nodes = mesh.elements[at(element)];
    EXPECT_EQ(std::count(nodes.begin(), nodes.end(), a), 1);
    EXPECT_NE(a, b);
  }
}

TEST(RefineCounts, SizeKeepsEveryEdgeBelowIt) {
  const auto r = run(loadExample<3>("protrusion"), coarsest());
  RefineOptions options;
  options.size = 0.15;
  const auto mesh = refined(r, options);
  double longest = 0;
  for (const auto &e : mesh.elements)
    for (const auto &[a, b] : {std::pair(0U, 1U), std::pair(1U, 2U), std::pair(0U, 4U), std::pair(2U, 6U)})
      longest = std::max(longest, glm::length(mesh.positions[at(e[a])] - mesh.positions[at(e[b])]));
  EXPECT_LE(longest, options.size * (1 + 1e-9));
  EXPECT_GT(longest, options.size / 2); // and no finer than it has to be
  EXPECT_TRUE(certificateOf(r, mesh).valid);
}

// Chords are shorter than what they span: the elements count.
TEST(RefineCounts, SizeKeepsElementsOfBentSidesBelowIt) {
  for (const Domain<3> &domain : {shaft(24), torus(24, 12), ball(24)})
    for (const double size : {0.4, 0.15}) {
      SCOPED_TRACE(domain.name);
      const auto r = run(domain, coarsest());
      RefineOptions options;
      options.size = size;
      options.ofSurface = {{blocksOf(r).surfaces[0][0], 2}}; // a count that is given stays
      const auto mesh = refined(r, options);
      double longest = 0;
      for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        for (int a = 0; a < 3; ++a) {
          if (blocksOf(r).surfaces[at(mesh.block[e])][at(a)] == options.ofSurface[0][0]) continue;
          for (unsigned bits = 0; bits < 8; ++bits)
            longest = std::max(
                longest, glm::length(mesh.positions[at(mesh.elements[e][cornerAt<3>(bits)])] -
                                     mesh.positions[at(mesh.elements[e][cornerAt<3>(bits | 1U << a)])]));
        }
      EXPECT_LE(longest, size * (1 + 1e-6));
      EXPECT_GT(longest, size / 2);
      EXPECT_EQ(mesh.intervals[at(options.ofSurface[0][0])], 2);
    }
}

TEST(RefineCounts, InterfacesOfAssembliesAreListedOnce) {
  const auto r = run(randomSolid(4, 2));
  const auto coarse = refined(r, intervals(1));
  const auto fine = refined(r, intervals(3));
  EXPECT_GT(coarse.interfaces.faces.size(), 0U);
  EXPECT_EQ(fine.interfaces.faces.size(), 9 * coarse.interfaces.faces.size());
  EXPECT_EQ(fine.boundary.faces.size(), 9 * coarse.boundary.faces.size());
}

/// The distinct heights of a mesh's nodes, ascending.
std::vector<double> heightsOf(const RefinedMesh<3> &mesh) {
  std::vector<double> heights;
  for (const Vec<3> &x : mesh.positions) heights.push_back(x.z);
  std::sort(heights.begin(), heights.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  heights.erase(std::unique(heights.begin(), heights.end(), same), heights.end());
  return heights;
}

TEST(RefineGrading, GrowsFromTheSide) {
  const Domain<3> box = prism({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 0, 15);
  const Index bottom = 4;
  const Index top = 5;
  const auto r = run(box, coarsest());
  RefineOptions options = intervals(4);
  options.gradings = {{bottom, 2}};
  const auto near = [](const std::vector<double> &a, const std::vector<double> &b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12);
  };
  near(heightsOf(refined(r, options)), {0, 1, 3, 7, 15});
  options.gradings = {{top, 2}};
  near(heightsOf(refined(r, options)), {0, 8, 12, 14, 15});
  options.gradings = {{top, 2}, {bottom, 2}};
  near(heightsOf(refined(r, options)), {0, 2.5, 7.5, 12.5, 15});
  options.gradings = {{top, 1}};
  near(heightsOf(refined(r, options)), {0, 3.75, 7.5, 11.25, 15});
}

// A layered mesh has a layer along each side: only that one is graded, whichever way its edges run.
TEST(RefineGrading, ReachesNoFurtherThanTheLayer) {
  const auto r = run(prism({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 0, 6));
  RefineOptions options = intervals(2);
  options.gradings = {{4, 2}};
  const std::vector<double> heights = heightsOf(refined(r, options));
  ASSERT_EQ(heights.size(), 5U);
  EXPECT_NEAR(heights[1] / heights[2], 1. / 3, 1e-9);
  EXPECT_NEAR((heights[3] - heights[2]) / (6 - heights[2]), 0.5, 1e-9);
}

/// A strip of quads that is closed with a twist: its long D-bar-surface does not know which end is up.
BlockMesh<2> twisted() {
  BlockMesh<2> strip;
  strip.blocks = {{0, 2, 3, 1}, {2, 4, 5, 3}, {4, 1, 0, 5}};
  strip.positions = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
  strip.tags.resize(3, {kNone, kNone, 0, kNone});
  strip.surfaces = {{1, 0}, {2, 0}, {3, 0}};
  strip.part = {0, 0, 0};
  return strip;
}

TEST(RefineGrading, OneSidedSurfacesAreGradedFromBothEnds) {
  const BlockMesh<2> strip = twisted();
  const std::vector<Index> patches{kNone};
  RefineOptions options = intervals(4);
  options.gradings = {{0, 2}};
  const auto spacing = spacingOf(strip, skeletonOf(strip, patches), patches, options);
  ASSERT_TRUE(spacing.ok());
  const double *const p = spacing.value().places.begin(0);
  for (const auto &[k, place] : {std::pair(1, 1. / 6), std::pair(2, 0.5), std::pair(3, 5. / 6)})
    EXPECT_NEAR(p[k], place, 1e-12);
}

TEST(RefineErrors, NameWhatIsWrong) {
  const auto r = run(loadExample<3>("tapered_brick"));
  const auto error = [&](const RefineOptions &options) {
    const auto mesh = refineResult(r, options);
    EXPECT_FALSE(mesh.ok());
    if (mesh.ok()) return std::string();
    EXPECT_EQ(mesh.error().code, ErrorCode::badOption);
    return mesh.error().message;
  };
  EXPECT_NE(error(intervals(0)).find("0 intervals"), std::string::npos);
  EXPECT_NE(error(intervals(1000)).find("8000000000 elements"), std::string::npos);
  RefineOptions options;
  options.ofSurface = {{99, 2}};
  EXPECT_NE(error(options).find("99"), std::string::npos);
  options.ofSurface = {{0, -1}};
  EXPECT_NE(error(options).find("-1 intervals"), std::string::npos);
  options.ofSurface.clear();
  options.gradings = {{77, 1.5}};
  EXPECT_NE(error(options).find("facet 77"), std::string::npos);
  options.gradings = {{0, 0.5}};
  EXPECT_NE(error(options).find("0.5"), std::string::npos);
  options.gradings = {{0, 2}};
  options.intervals = 60;
  EXPECT_NE(error(options).find("over 60 intervals would begin with 8.67362e-19"), std::string::npos);
  options.intervals = 20;
  EXPECT_TRUE(refineResult(r, options).ok());
  options.gradings.clear();
  options.size = 1e-300;
  EXPECT_NE(error(options).find("larger size"), std::string::npos);
}

// Nodes of bent sides lie on the domain's own facets, and the volume comes closer with every round.
TEST(RefineBent, ComesCloserToTheDomain) {
  for (const Domain<3> &domain : {shaft(48), torus(48, 24), ball(24), plateWithHole(48)}) {
    SCOPED_TRACE(domain.name);
    for (const PipelineOptions &options : {PipelineOptions{}, coarsest()}) {
      const auto r = run(domain, options);
      double before = std::abs(r.certificate.meshMeasure / r.certificate.domainMeasure - 1);
      for (const Index n : {2, 4}) {
        const auto mesh = refined(r, intervals(n));
        const Certificate certificate = certificateOf(r, mesh);
        EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
        EXPECT_TRUE(mesh.straightened.empty());
        const double error = std::abs(certificate.meshMeasure / certificate.domainMeasure - 1);
        EXPECT_LT(error, 0.45 * before) << n; // a quarter, were the facets finer
        before = error;
      }
    }
  }
}

// A wall thinner than the bend of its blocks: what is inside of it has to bend as well. And a ring of eight
// bent bands, each of which is far from the chords of its blocks.
TEST(RefineBent, WhatIsInsideOfThinWallsFollows) {
  Domain<3> pipe = prism(circle(64, 1), 0, 2);
  addHole(pipe, circle(64, 0.96), 0, 2);
  for (const Domain<3> &domain : {pipe, torus(16, 8)})
    for (const PipelineOptions &options : {PipelineOptions{}, coarsest()}) {
      const auto r = run(domain, options);
      for (const Index n : {2, 5}) {
        const auto mesh = refined(r, intervals(n));
        const Certificate certificate = certificateOf(r, mesh);
        EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
        EXPECT_TRUE(mesh.straightened.empty());
      }
    }
}

// Elements that the interpolation would slant, or turn inside out, beside the tip of a cone.
TEST(RefineBent, NodesInsideOfBlocksAreEvenedOut) {
  const auto r = run(cone(24), coarsest());
  for (const Index n : {6, 10}) {
    const auto mesh = refined(r, intervals(n));
    EXPECT_TRUE(mesh.straightened.empty());
    EXPECT_GT(*std::min_element(mesh.quality.begin(), mesh.quality.end()), 0.1);
  }
}

// Random domains of every kind, refined unevenly.
TEST(RefineProperty, RandomDomainsStayValid) {
  std::size_t elements = 0;
  Index straightened = 0;
  for (int kind = 0; kind < kRandomKinds; ++kind)
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE("kind " + std::to_string(kind) + ", seed " + std::to_string(seed));
      const auto r = run(randomSolid(kind, seed));
      if (!r.certificate.valid) continue; // other tests see to that
      RefineOptions options = intervals(2);
      options.ofSurface = {{0, 3}};
      options.gradings = {{0, 1.5}};
      const auto mesh = refined(r, options);
      const Certificate certificate = certificateOf(r, mesh);
      EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
      elements += mesh.elements.size();
      straightened += toIndex(mesh.straightened.size());
    }
  std::cout << elements << " elements of random domains, " << straightened << " blocks straightened\n";
}

} // namespace
} // namespace dualblock::test
