// The certificate's bounds: what is within them by a little passes, what is beyond them by a little does not.
#include <gtest/gtest.h>

#include "certificate/checks.h"
#include "support/block_row.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

const std::vector<Vec<2>> kFlat{{1, 0}, {0, 0}};
const std::vector<Vec<2>> kFlatInFour{{1, 0}, {0.75, 0}, {0.5, 0}, {0.25, 0}, {0, 0}};

int countOf(const std::string &text, const std::string &words) {
  int count = 0;
  for (std::size_t k = text.find(words); k != std::string::npos; k = text.find(words, k + 1)) ++count;
  return count;
}

double sizeOf(const BlockRow &row) { return row.result.mesh.size; }

TEST(CertificateBounds, RowsAreValid) {
  for (const BlockRow &row :
       {BlockRow(kFlat, 1, 2), BlockRow(arcRoof(60, 8), 1, 2), BlockRow(arcRoof(100, 8), 1, 2, {4})})
    EXPECT_TRUE(row.certificate().valid) << failuresOf(row.certificate());
}

TEST(CertificateBounds, VolumesThatDiffer) {
  const BlockRow row(kFlat, 1, 1);
  for (const auto &[moved, isWrong] : {std::pair{1e-7, true}, {3e-9, true}, {1e-12, false}}) {
    BlockRow other = row;
    for (const std::size_t v : {1U, 3U}) other.blocks.positions[v].y += moved; // an edge of the block
    EXPECT_EQ(other.says("add up to"), isWrong) << moved;
    // Where facets are known to lie off their planes, by about that or by less.
    EXPECT_FALSE(other.says("add up to", moved));
    EXPECT_EQ(other.says("add up to", 0.001 * moved), isWrong) << moved;
  }
}

TEST(CertificateBounds, NodesOffTheirFacets) {
  const BlockRow row(kFlat, 1, 1);
  for (const auto &[moved, isWrong] : {std::pair{1e-6, true}, {1e-8, true}, {2e-10, false}}) {
    BlockRow other = row;
    other.blocks.positions[1].y += moved;
    EXPECT_EQ(other.says("is off facet"), isWrong) << moved;
    EXPECT_EQ(other.says("is no primal node"), isWrong) << moved;
    EXPECT_FALSE(other.says("is off facet", moved));
    EXPECT_EQ(other.says("is off facet", 0.01 * moved), isWrong);
  }
}

// Vertices are looked up by their heights along a direction, and by distance where these agree.
TEST(CertificateBounds, VerticesWithoutANodeAtTheirHeight) {
  BlockRow row(kFlat, 1, 1);
  row.blocks.positions[1] += 1e-8 * Vec<3>(0.7320508075688772, -1, 0);
  EXPECT_TRUE(row.says("is no primal node"));
}

TEST(CertificateBounds, FacetsNotCovered) {
  for (const auto &[moved, isWrong] : {std::pair{1e-6, true}, {1e-7, true}, {1e-10, false}}) {
    BlockRow row(kFlat, 1, 1);
    row.blocks.positions[1].x -= moved; // along an edge
    EXPECT_EQ(row.says("is not covered once"), isWrong) << moved;
  }
  BlockRow twice(kFlat, 1, 1);
  twice.addBlock(twice.blocks.blocks[0]);
  EXPECT_TRUE(twice.says("is not covered once"));
}

/// In 2D too.
TEST(CertificateBounds, SegmentsNotCovered) {
  PipelineResult<2> r = run(loadExample<2>("square_2d"));
  BlockMesh<2> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const auto failures = [&] {
    return failuresOf(certifyBlocks<2>({r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, 0}));
  };
  EXPECT_EQ(failures(), "");
  const Vec<2> corner = r.domain.domain.vertices[0];
  const Vec<2> next = r.domain.domain.vertices[1];
  for (Vec<2> &x : blocks.positions)
    if (glm::length(x - corner) < 1e-9) x += 1e-7 * (next - corner);
  EXPECT_NE(failures().find("is not covered once"), std::string::npos) << failures();
}

// Curves as chains: nodes off them, in another order, at one place, short of their ends.
TEST(CertificateBounds, NodesAlongACurve) {
  const BlockRow row(kFlatInFour, 1, 2,
                     {1, 2, 3}); // nodes 1, 5, 9, 13, 17 along the roof's edge from right to left
  ASSERT_TRUE(row.certificate().valid) << failuresOf(row.certificate());
  const auto says = [&](auto change) {
    BlockRow other = row;
    change(other.blocks.positions);
    return other.says("is no chain of primal edges");
  };
  const double size = sizeOf(row);
  using Nodes = std::vector<Vec<3>>;
  EXPECT_FALSE(says([](Nodes &x) { x[5].x += 0.1; })); // along it
  EXPECT_TRUE(says([](Nodes &x) { x[5].y -= 1e-8; }));
  EXPECT_FALSE(says([](Nodes &x) { x[5].y -= 1e-10; }));
  EXPECT_TRUE(says([](Nodes &x) { std::swap(x[5], x[9]); }));
  EXPECT_TRUE(says([](Nodes &x) { x[5] = x[9]; }));
  EXPECT_TRUE(says([&](Nodes &x) { x[5].x = x[9].x + 0.3e-9 * size; }));
  EXPECT_FALSE(says([&](Nodes &x) { x[5].x = x[9].x + 3e-9 * size; }));
  for (const std::size_t end : {1U, 17U}) { // short of the vertex, or beyond it
    const double inwards = end == 1 ? -1 : 1;
    BlockRow other = row; // the two other curves that end there lose it, too
    other.blocks.positions[end].x += 3e-8 * inwards * size;
    EXPECT_EQ(countOf(failuresOf(other.certificate()), "is no chain of primal edges"), 3) << end;
    EXPECT_FALSE(says([&](Nodes &x) { x[end].x += 0.3e-9 * inwards * size; })) << end;
  }
}

/// What is said of curves alone.
template <int N> std::string ofCurves(const BlockInput<N> &input) {
  Certificate certificate;
  checkCurves(input, findCreases(input, buildBlockComplex(input)), 1e-9 * input.mesh.size, certificate);
  return failuresOf(certificate);
}

TEST(CertificateBounds, CurvesThatTheDomainDoesNotHave) {
  BlockRow row(kFlatInFour, 1, 2, {1, 2, 3});
  EXPECT_EQ(ofCurves(row.input()), "");
  std::swap(row.blocks.tags[1][2], row.blocks.tags[1][3]); // floor and roof of one block
  EXPECT_NE(ofCurves(row.input()).find("blocks meet along a curve"), std::string::npos);
}

TEST(CertificateBounds, VerticesThatTheDomainDoesNotHave) {
  const PipelineResult<2> r = run(loadExample<2>("square_2d"));
  BlockMesh<2> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const BlockInput<2> input{r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, 0};
  EXPECT_EQ(ofCurves(input), "");
  std::vector<Index> used;
  for (Index &tag : blocks.tags[0])
    if (tag != kNone) used.push_back(tag);
  ASSERT_EQ(used.size(), 2U);
  for (const std::array<Index, 4> &tags : blocks.tags)
    for (const Index other : tags)
      if (other != kNone && std::find(used.begin(), used.end(), other) == used.end())
        std::replace(blocks.tags[0].begin(), blocks.tags[0].end(), used[0], other);
  EXPECT_NE(ofCurves(input).find("is no chain of primal edges"), std::string::npos);
}

/// A box with a pocket in the edge between its front and its top, which then meet twice.
Domain<3> pocket() {
  Domain<3> domain;
  domain.name = "pocket";
  domain.vertices = {{0, 0, 0},   {3, 0, 0},   {3, 2, 0},   {0, 2, 0},  {0, 0, 1}, {1, 0, 1},
                     {1, 1, 1},   {2, 1, 1},   {2, 0, 1},   {3, 0, 1},  {3, 2, 1}, {0, 2, 1},
                     {1, 0, 0.5}, {2, 0, 0.5}, {2, 1, 0.5}, {1, 1, 0.5}};
  domain.facets = {{{{0, 3, 2, 1}}},
                   {{{4, 5, 6, 7, 8, 9, 10, 11}}},
                   {{{0, 1, 9, 8, 13, 12, 5, 4}}},
                   {{{1, 2, 10, 9}}},
                   {{{2, 3, 11, 10}}},
                   {{{3, 0, 4, 11}}},
                   {{{12, 13, 14, 15}}},
                   {{{5, 12, 15, 6}}},
                   {{{13, 8, 7, 14}}},
                   {{{6, 15, 14, 7}}}};
  return domain;
}

TEST(CertificateBounds, CurvesInTwoPieces) {
  const PipelineResult<3> r = run(pocket());
  ASSERT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  const BlockMesh<3> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const BlockInput<3> input{r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, 0};
  std::vector<Crease> creases = findCreases(input, buildBlockComplex(input));
  const auto said = [&] {
    Certificate certificate;
    checkCurves(input, creases, 1e-9, certificate);
    return countOf(failuresOf(certificate), "is no chain of primal edges");
  };
  EXPECT_EQ(said(), 0);
  std::erase_if(creases, [&](const Crease &c) { // all of one piece
    const Vec<3> &a = blocks.positions[at(c.nodes[0])];
    const Vec<3> &b = blocks.positions[at(c.nodes[1])];
    return std::max({std::abs(a.y), std::abs(b.y), std::abs(a.z - 1), std::abs(b.z - 1)}) < 1e-9 &&
           a.x + b.x < 3;
  });
  EXPECT_EQ(said(), 1);
}

// A curve's edge that turns by slightly less than the bound, and by slightly more.
TEST(CertificateBounds, EdgesThatTurn) {
  for (const auto &[degrees, isWrong] : {std::pair{119.0, false}, {121.0, true}}) {
    const BlockRow row(arcRoof(degrees * 16 / 15, 32), 10, 10);
    EXPECT_EQ(row.says("degrees along it"), isWrong) << degrees << failuresOf(row.certificate());
    EXPECT_FALSE(row.says("of its length away"));
    EXPECT_EQ(row.certificate().valid, !isWrong);
    EXPECT_NEAR(row.certificate().fidelity.largestTurning, degrees, 1e-6);
  }
}

/// Up, a little round at the ridge, and down again.
std::vector<Vec<2>> gable(double height) {
  std::vector<Vec<2>> roof{{1, 0}};
  for (int k = 0; k <= 8; ++k) {
    const double x = 0.02 * (4 - k);
    roof.emplace_back(0.5 + x, height - 1.5 * height * (0.08 / 2 + x * x / 0.16));
  }
  roof.emplace_back(0, 0);
  return roof;
}

TEST(CertificateBounds, EdgesFarFromTheirCurve) {
  for (const auto &[height, isWrong] : {std::pair{0.34, false}, {0.37, true}}) {
    const BlockRow row(gable(height), 10, 10, {}, 25);
    EXPECT_EQ(row.says("of its length away"), isWrong) << height << failuresOf(row.certificate());
    EXPECT_FALSE(row.says("degrees"));
  }
}

TEST(CertificateBounds, FacesThatTurn) {
  for (const auto &[degrees, isWrong] : {std::pair{119.0, false}, {121.0, true}})
    EXPECT_EQ(BlockRow(arcRoof(degrees * 8 / 7, 8), 10, 10).says("degrees in its face"), isWrong) << degrees;
}

// Through a thin wall the side has to be followed as closely as the wall is thin: where it is not, but by no
// more than is allowed, blocks are named that would better be cut.
TEST(CertificateBounds, FacesFarFromTheirSide) {
  for (const auto &[wall, isWrong] : {std::pair{0.21, false}, {0.19, true}}) // 0.64 and 0.71 of it
    EXPECT_EQ(BlockRow(arcRoof(60, 8), wall, 1).says("of the thickness"), isWrong);
  for (const auto &[wall, isCoarse] : {std::pair{0.42, false}, {0.38, true}}) { // 0.32 and 0.35 of it
    const Certificate c = BlockRow(arcRoof(60, 8), wall, 1).certificate();
    EXPECT_TRUE(c.valid) << failuresOf(c);
    EXPECT_EQ(!c.fidelity.coarse.empty(), isCoarse) << c.fidelity.largestDepth;
  }
  // Two blocks behind one another are as thick as one.
  BlockRow two(arcRoof(60, 8), 0.42, 1);
  two.split();
  EXPECT_TRUE(two.certificate().valid) << failuresOf(two.certificate());
  EXPECT_TRUE(two.certificate().fidelity.coarse.empty());
  // What is on the side by its tag alone is far from it.
  BlockRow floor(arcRoof(60, 8), 0.42, 1);
  floor.blocks.tags[0][2] = floor.blocks.tags[0][3];
  EXPECT_TRUE(floor.says("of its face's size"));
}

TEST(CertificateBounds, VolumesFarApart) {
  for (const auto &[wall, isWrong] :
       {std::pair{0.5, false}, {0.33, true}}) { // 0.27 and 0.36 of it are in the roof
    const BlockRow row(arcRoof(110, 16), wall, 1);
    const Certificate c = row.certificate();
    EXPECT_EQ(row.says("between its bent sides and the blocks"), isWrong) << c.fidelity.strayed;
    EXPECT_NEAR(c.fidelity.volumeDifference, wall / c.domainMeasure - 1, 1e-12);
  }
  // As much is gained under one half of the roof as is lost under the other: 0.26 and 0.46, in all.
  std::vector<Vec<2>> wave;
  for (const Vec<2> &x : arcRoof(110, 8)) wave.push_back(Vec<2>(0.5, 0) + x / 2.0);
  for (const Vec<2> &x : arcRoof(110, 8))
    if (x.x < 1) wave.emplace_back(x.x / 2, -x.y / 2);
  for (const auto &[wall, isWrong] : {std::pair{0.35, false}, {0.2, true}}) {
    const BlockRow row(wave, wall, 1);
    const Certificate c = row.certificate();
    EXPECT_EQ(row.says("between its bent sides and the blocks"), isWrong) << c.fidelity.strayed;
    EXPECT_NEAR(c.fidelity.volumeDifference, 0, 1e-9);
  }
  // Blocks elsewhere: near their sides, and far too many.
  BlockRow twice(arcRoof(60, 8), 1, 2);
  std::array<Index, 8> nodes = twice.blocks.blocks[0];
  for (Index &n : nodes) {
    twice.blocks.positions.push_back(twice.blocks.positions[at(n)] + Vec<3>(3, 0, 0));
    n = toIndex(twice.blocks.positions.size()) - 1;
  }
  twice.addBlock(nodes);
  twice.blocks.tags.back().fill(kNone);
  EXPECT_DOUBLE_EQ(twice.certificate().fidelity.strayed, twice.certificate().fidelity.volumeDifference);
  EXPECT_TRUE(twice.says("between its bent sides and the blocks"));
}

TEST(CertificateBounds, NodesOffABentSide) {
  for (const double moved : {1e-6, 1e-8, -1e-8, 1e-10}) {
    BlockRow row(arcRoof(60, 8), 1, 1, {4});
    const bool isWrong = std::abs(moved) > 1e-9;
    EXPECT_FALSE(row.says("off the bent side"));
    row.blocks.positions[5].y += moved;
    EXPECT_EQ(row.says("off the bent side"), isWrong) << moved;
    EXPECT_FALSE(row.says("off the bent side", std::abs(moved)));
  }
  BlockRow row(arcRoof(60, 8), 1, 1, {4});
  row.blocks.positions[5].z -= 1e-6; // in the facet's plane, and beyond its edge
  EXPECT_TRUE(row.says("off the bent side"));
}

// The rim of a cylinder: closed, and from its first point an edge goes both ways.
TEST(CertificateBounds, EdgesAcrossTheBeginningOfAClosedCurve) {
  const PipelineResult<3> r = run([] {
    Domain<3> domain = prism(circle(48, 1), 0, 2);
    domain.name = "cylinder";
    return domain;
  }());
  BlockMesh<3> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const BlockInput<3> input{r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, 0};
  const std::vector<Crease> creases = findCreases(input, buildBlockComplex(input));
  std::vector<std::pair<double, std::size_t>> rim;
  for (std::size_t n = 0; n < blocks.positions.size(); ++n)
    if (const Vec<3> &x = blocks.positions[n]; x.z < 1e-9 && std::hypot(x.x, x.y) > 0.9)
      rim.emplace_back(std::atan2(x.y, x.x), n);
  std::sort(rim.begin(), rim.end());
  ASSERT_EQ(rim.size(), 8U);
  const auto put = [&](std::size_t k, int step) {
    blocks.positions[rim[k].second] = {std::cos(std::numbers::pi * step / 24),
                                       std::sin(std::numbers::pi * step / 24), 0};
  };
  for (std::size_t turn = 0; turn < 4;
       ++turn) { // 20 of 48 chords on one edge, 8 or 12 of them beyond the first point
    const int steps[] = {10, 14, 18, 22, 26, 30, 34, 38};
    for (std::size_t k = 0; k < 8; ++k) put(k, steps[k] + 3 * static_cast<int>(turn) - 4);
    Certificate certificate;
    checkCurves(input, creases, 1e-9, certificate);
    EXPECT_NE(failuresOf(certificate).find("which turns by 135 degrees along it"), std::string::npos) << turn;
    EXPECT_NEAR(certificate.fidelity.largestTurning, 135, 1e-6) << turn;
  }
}

// Two edges that go there and back are no closed curve.
TEST(CertificateBounds, ClosedCurvesOfTwoEdges) {
  const PipelineResult<3> r = run(revolved({{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 24));
  const BlockMesh<3> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const BlockInput<3> input{r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, 0};
  const std::vector<Crease> creases = findCreases(input, buildBlockComplex(input));
  Certificate whole;
  checkCurves(input, creases, 1e-9, whole);
  EXPECT_TRUE(whole.valid) << failuresOf(whole);
  Certificate certificate;
  checkCurves(input, {creases[0], creases[0]}, 1e-9, certificate);
  EXPECT_EQ(countOf(failuresOf(certificate), "is no chain of primal edges"), 2) << failuresOf(certificate);
}

TEST(CertificateBounds, IdealBlocks) {
  Domain<2> domain; // 200 degrees at one vertex, 340 at another
  domain.vertices = {{0, 0}, {4, 0}, {4, 4}, {2, 3.3}, {0, 4}, {0, 2.1}, {3, 1.8}, {0, 1.5}};
  for (Index k = 0; k < 8; ++k) domain.facets.push_back({{{k, (k + 1) % 8}}});
  domain.name = "notched";
  const PipelineResult<2> r = run(domain);
  ASSERT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  std::array<int, 5> counts{};
  for (const FeatureCount &f : r.certificate.features) ++counts[f.ideal];
  EXPECT_EQ(counts, (std::array<int, 5>{0, 6, 1, 0, 1}));
}

} // namespace
} // namespace dualblock::test
