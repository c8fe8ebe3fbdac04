// The certificate of elements must be able to say no: a valid refined mesh, damaged in one place at a time.
#include "certificate/elements.h"

#include <functional>

#include <gtest/gtest.h>

#include "support/block_row.h"
#include "support/dimensions.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

/// A run, its blocks in elements, and what certifyElements reads.
template <int N> struct Refined {
  PipelineResult<N> result;
  BlockMesh<N> blocks;
  RefinedMesh<N> mesh;
  BentFacets<N> bent;
  std::vector<Index> patches;
  double domainMeasure;

  explicit Refined(const Domain<N> &domain, Index intervals = 2) : Refined(run(domain), {}, intervals) {}
  explicit Refined(const BlockRow &row, Index intervals = 2) : Refined(row.result, row.blocks, intervals) {}
  Refined(PipelineResult<N> from, BlockMesh<N> own, Index intervals)
      : result(std::move(from)), blocks(std::move(own)) {
    if (blocks.blocks.empty())
      blocks = layeredBlocks(result.mesh, result.parts, result.surfaces, result.primal);
    bent = bentFacetsOf(result.mesh, result.features, result.featureNodes);
    patches = patchOfSurface(result.mesh);
    RefineOptions options;
    options.intervals = intervals;
    auto refined = refineBlocks(blocks, patches, BentShape<N>(bent), options);
    if (!refined.ok()) throw std::runtime_error(refined.error().message);
    mesh = std::move(refined.value());
    domainMeasure = result.certificate.domainMeasure;
  }
  Certificate certificate(bool mayStayStraight = false) const {
    return certifyElements<N>({mesh, blocks, patches, bent, domainMeasure, mayStayStraight});
  }
};

template <int N>
void expectCaught(const Refined<N> &refined, Check check, const std::string &words,
                  const std::function<void(Refined<N> &)> &damage) {
  Refined<N> r = refined;
  ASSERT_TRUE(r.certificate().valid) << failuresOf(r.certificate());
  damage(r);
  const Certificate c = r.certificate();
  EXPECT_FALSE(c.valid);
  EXPECT_FALSE(c.passed[static_cast<std::size_t>(check)]);
  EXPECT_NE(failuresOf(c).find(words), std::string::npos) << "no \"" << words << "\" among:" << failuresOf(c);
}

template <int N> Refined<N> straight() {
  if constexpr (N == 2) return Refined<2>(loadExample<2>("l_shape_2d"));
  else return Refined<3>(loadExample<3>("l_shape_extruded"));
}

template <typename T> struct Elements : ::testing::Test {};
TYPED_TEST_SUITE(Elements, Dimensions);

TYPED_TEST(Elements, AcceptsWhatRefinementMakes) {
  constexpr int N = TypeParam::value;
  const Refined<N> r = straight<N>();
  const Certificate c = r.certificate();
  EXPECT_TRUE(c.valid) << failuresOf(c);
  EXPECT_TRUE(c.isExact);
  EXPECT_NEAR(c.meshMeasure, r.domainMeasure, 1e-12 * r.domainMeasure);
  EXPECT_EQ(c.domainMeasure, r.domainMeasure);
  EXPECT_GT(c.worstCoefficient, 0);
  Refined<N> unknown = r;
  unknown.domainMeasure = 0;
  EXPECT_EQ(unknown.certificate().domainMeasure, c.meshMeasure);
}

TYPED_TEST(Elements, ThreeAtOneFace) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(straight<N>(), Check::topology, "opposite sides",
                  [](auto &r) { r.mesh.elements.push_back(r.mesh.elements[0]); });
}

TYPED_TEST(Elements, TwoOnTheSameSide) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(straight<N>(), Check::topology, "opposite sides", [](auto &r) {
    auto &nodes = r.mesh.elements[0]; // its mirror image, all faces of which have the nodes that they had
    std::swap(nodes[0], nodes[1]);
    std::swap(nodes[2], nodes[3]);
    if constexpr (N == 3) {
      std::swap(nodes[4], nodes[5]);
      std::swap(nodes[6], nodes[7]);
    }
  });
}

TYPED_TEST(Elements, BoundaryCutShort) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(straight<N>(), Check::topology, "handed out as the boundary",
                  [](auto &r) { r.mesh.boundary.faces.pop_back(); });
  expectCaught<N>(straight<N>(), Check::topology, "handed out as the boundary",
                  [](auto &r) { r.mesh.elements.pop_back(); });
}

TYPED_TEST(Elements, AnElementTurnedInsideOut) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(straight<N>(), Check::geometry, "positive everywhere", [](auto &r) {
    for (std::size_t n = r.blocks.positions.size(); n < r.mesh.positions.size(); ++n)
      r.mesh.positions[n] += Vec<N>(0.6 * r.result.mesh.size);
  });
}

// By more than rounding explains, and by less.
TYPED_TEST(Elements, ElementsThatDoNotFillTheBlocks) {
  constexpr int N = TypeParam::value;
  const Refined<N> r = straight<N>();
  expectCaught<N>(r, Check::geometry, "add up to", [](auto &m) {
    for (Vec<N> &x : m.mesh.positions) x[0] *= 1 + 3e-9;
  });
  Refined<N> near = r;
  for (Vec<N> &x : near.mesh.positions) x[0] *= 1 + 1e-12;
  EXPECT_TRUE(near.certificate().valid);
}

TYPED_TEST(Elements, BlocksThatStayStraight) {
  constexpr int N = TypeParam::value;
  expectCaught<N>(straight<N>(), Check::features, "keep straight elements",
                  [](auto &r) { r.mesh.straightened = {0}; });
  Refined<N> r = straight<N>();
  r.mesh.straightened = {0};
  EXPECT_TRUE(r.certificate(true).valid);
}

TEST(ElementsOfBentSides, AcceptsWhatRefinementMakes) {
  for (const Index intervals : {1, 2, 3}) {
    const Refined<3> r(cylinder(24), intervals);
    const Certificate c = r.certificate();
    EXPECT_TRUE(c.valid) << failuresOf(c);
    EXPECT_FALSE(c.isExact);
    ASSERT_EQ(c.fidelity.sides.size(), 1U);
    EXPECT_GT(c.fidelity.largestDistance, 0);
    EXPECT_EQ(c.fidelity.largestDistance, c.fidelity.sides[0].distance);
    EXPECT_GT(c.fidelity.largestTurning, 10);
    EXPECT_EQ(c.fidelity.largestTurning, c.fidelity.sides[0].turning);
    EXPECT_LT(c.fidelity.volumeDifference, 0);
    EXPECT_NEAR(c.fidelity.volumeDifference, c.meshMeasure / r.domainMeasure - 1, 1e-12);
  }
}

// The roof of one block, as coarse as it can be: faces of elements as far from it as a share of what is
// behind them.
TEST(ElementsOfBentSides, FarFromTheirSide) {
  for (const auto &[wall, isWrong] : {std::pair{0.21, false}, {0.19, true}}) { // 0.64 and 0.71 of it
    Refined<3> r(BlockRow(arcRoof(60, 8), wall, 1), 1);
    const Certificate c = r.certificate();
    EXPECT_EQ(failuresOf(c).find("of the thickness") != std::string::npos, isWrong) << failuresOf(c);
    EXPECT_EQ(c.fidelity.largestDepth, c.fidelity.sides[0].depth);
    EXPECT_EQ(r.certificate(true).valid, !isWrong); // asked for or not: no block stays straight
    r.mesh.straightened = {0};
    EXPECT_TRUE(r.certificate(true).valid);
  }
  EXPECT_TRUE(Refined<3>(BlockRow(arcRoof(60, 8), 0.3, 1), 1).certificate().valid);
  for (const auto &[degrees, isWrong] : {std::pair{119.0, false}, {121.0, true}}) {
    const Refined<3> r(BlockRow(arcRoof(degrees * 8 / 7, 8), 10, 10), 1);
    EXPECT_EQ(failuresOf(r.certificate()).find("degrees in its face") != std::string::npos, isWrong);
  }
  // The block's thickness counts, not the element's, and that of all blocks up to the next facet.
  EXPECT_TRUE(Refined<3>(BlockRow(arcRoof(60, 8), 0.3, 1), 3).certificate().valid);
  BlockRow two(arcRoof(60, 8), 0.3, 1);
  two.split();
  EXPECT_TRUE(Refined<3>(two, 1).certificate().valid);
  // What is on the side by its facet alone is far from it.
  Refined<3> floor(BlockRow(arcRoof(60, 8), 0.42, 1), 1);
  for (std::size_t f = 0; f < floor.mesh.boundary.faces.size(); ++f)
    if (floor.patches[at(floor.mesh.boundary.facet[f])] == floor.bent.patchOfFace[0])
      floor.mesh.boundary.facet.assign(floor.mesh.boundary.facet.size(), floor.mesh.boundary.facet[f]);
  EXPECT_NE(failuresOf(floor.certificate()).find("of its face's size"), std::string::npos);
}

// Four blocks in a row, of which the last one strays: it may where it stays straight, or its neighbour does.
TEST(ElementsOfBentSides, WhatIsNotBesideAStraightBlock) {
  Refined<3> r(BlockRow(arcRoof(60, 8), 0.01, 1, {1, 2, 3}), 1);
  for (const auto &[block, isWrong] : {std::pair{0, true}, {1, true}, {2, false}, {3, false}}) {
    r.mesh.straightened = {block};
    const Certificate c = r.certificate(true);
    EXPECT_EQ(failuresOf(c).find("element 3 strays from the bent side") != std::string::npos, isWrong)
        << block;
    EXPECT_EQ(c.valid, !isWrong) << failuresOf(c);
  }
}

TEST(ElementsOfBentSides, VolumesFarApart) {
  for (const auto &[wall, isWrong] :
       {std::pair{0.5, false}, {0.33, true}}) { // 0.27 and 0.36 of it are in the roof
    Refined<3> r(BlockRow(arcRoof(110, 16), wall, 1), 1);
    const Certificate c = r.certificate();
    EXPECT_EQ(failuresOf(c).find("between its bent sides and the elements") != std::string::npos, isWrong)
        << c.fidelity.strayed;
    EXPECT_EQ(r.certificate(true).valid, !isWrong);
    r.mesh.straightened = {0};
    EXPECT_TRUE(r.certificate(true).valid);
  }
}

TEST(ElementsOfBentSides, BoundaryThatCrossesItself) {
  const Refined<3> r(cylinder(24));
  expectCaught<3>(r, Check::features, "not to cross itself", [](auto &m) {
    std::size_t lowest = 0;
    for (std::size_t n = 0; n < m.mesh.positions.size(); ++n)
      if (glm::length(m.mesh.positions[n]) < glm::length(m.mesh.positions[lowest])) lowest = n;
    m.mesh.positions[lowest].z = 2.5; // through the other end
  });
}

/// Adds copies of all elements, moved and shrunk about (0, 0, 1).
void addCopy(Refined<3> &r, const Vec<3> &move, double scale) {
  RefinedMesh<3> &m = r.mesh;
  const Index nodes = toIndex(m.positions.size());
  const Index elements = toIndex(m.elements.size());
  const std::size_t faces = m.boundary.faces.size();
  for (Index n = 0; n < nodes; ++n)
    m.positions.push_back(Vec<3>(0, 0, 1) + move + scale * (m.positions[at(n)] - Vec<3>(0, 0, 1)));
  for (Index e = 0; e < elements; ++e) {
    auto copy = m.elements[at(e)];
    for (Index &n : copy) n += nodes;
    m.elements.push_back(copy);
    m.block.push_back(m.block[at(e)]);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    auto copy = m.boundary.faces[f];
    for (Index &n : copy) n += nodes;
    m.boundary.faces.push_back(copy);
    m.boundary.facet.push_back(m.boundary.facet[f]);
    m.boundaryElement.push_back(m.boundaryElement[f] + elements);
  }
}

TEST(ElementsOfBentSides, ElementsThatOverlap) {
  const Refined<3> r(cylinder(24));
  expectCaught<3>(r, Check::features, "not to cross itself", [](auto &m) { addCopy(m, {0.5, 0.1, 0.1}, 1); });
  expectCaught<3>(r, Check::features, "there are elements already", [](auto &m) {
    addCopy(m, {0, 0, 0}, 0.5);
  });
  Refined<3> overlapping = r; // of many pairs, the first eight
  addCopy(overlapping, {0.5, 0.1, 0.1}, 1);
  for (Index b = 0; b < overlapping.blocks.blockCount(); ++b) overlapping.mesh.straightened.push_back(b);
  EXPECT_EQ(overlapping.certificate(true).culprits.size(), 16U);
  // Side by side by more than a rounding.
  const auto says = [&](double gap, const std::string &words) {
    Refined<3> two = r;
    addCopy(two, {0, 0, 2 + gap}, 1);
    return failuresOf(two.certificate()).find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(0, "not to cross itself"));
  EXPECT_FALSE(says(1e-10, "not to cross itself"));
}

} // namespace
} // namespace dualblock::test
