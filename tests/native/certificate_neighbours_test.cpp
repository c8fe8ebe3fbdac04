// The certificate's checks of how blocks meet: what crosses, is doubled, touches only or lies apart.
#include <gtest/gtest.h>

#include "certificate/checks.h"
#include "support/block_row.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

TEST(CertificateNeighbours, BlocksThatCross) {
  BlockRow row(arcRoof(60, 8), 1, 2, {4});
  const auto addCopy = [&](const Vec<3> &move, double scale) {
    BlockRow other = row;
    std::array<Index, 8> nodes = other.blocks.blocks[0];
    Vec<3> middle{0.0};
    for (const Index n : nodes) middle += other.blocks.positions[at(n)] / 8.0;
    for (Index &n : nodes) {
      other.blocks.positions.push_back(middle + move + scale * (other.blocks.positions[at(n)] - middle));
      n = toIndex(other.blocks.positions.size()) - 1;
    }
    other.addBlock(nodes);
    other.blocks.tags.back().fill(kNone);
    return other;
  };
  EXPECT_TRUE(addCopy({0.1, 0.1, 0.1}, 1).says("not to cross itself"));
  EXPECT_FALSE(addCopy({3, 0, 0}, 1).says("not to cross itself"));
  EXPECT_FALSE(addCopy({0, 0, 0}, 0.5).says("not to cross itself"));
  // A gap of more than 1e-12 of the size, and what is none.
  EXPECT_FALSE(addCopy({0.5 + 1e-10, -0.2, 0}, 1).says("not to cross itself"));
  EXPECT_TRUE(addCopy({0.5, -0.2, 0}, 1).says("not to cross itself"));
}

// Where blocks lie inside of one another, and nothing else is wrong with them.
TEST(CertificateNeighbours, BlocksInsideOfOneAnother) {
  const BlockRow row(arcRoof(60, 8), 1, 2);
  BlockComplex<3> complex = buildBlockComplex(row.input());
  BlockRow inside = row;
  std::array<Index, 8> nodes = row.blocks.blocks[0];
  for (Index &n : nodes) {
    inside.blocks.positions.push_back(Vec<3>(0.5, -0.5, 1) +
                                      0.5 * (row.blocks.positions[at(n)] - Vec<3>(0.5, -0.5, 1)));
    n = toIndex(inside.blocks.positions.size()) - 1;
  }
  inside.blocks.blocks.push_back(nodes);
  inside.blocks.tags.emplace_back().fill(kNone);
  complex = buildBlockComplex(inside.input());
  Certificate certificate;
  checkBentSides(inside.input(), complex, 1e-9, certificate);
  EXPECT_NE(failuresOf(certificate).find("there are blocks already"), std::string::npos)
      << failuresOf(certificate);
  Certificate before;
  checkBentSides(row.input(), buildBlockComplex(row.input()), 1e-9, before);
  EXPECT_TRUE(before.valid) << failuresOf(before);
}

// Conformity, by blocks of a brick that are taken away or doubled.
template <int N>
void expectTopology(const std::string &name, const std::string &words, const std::vector<std::size_t> &kept) {
  const PipelineResult<N> r = run(loadExample<N>(name));
  const BlockMesh<N> whole = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  BlockMesh<N> blocks = whole;
  blocks.blocks.clear();
  blocks.tags.clear();
  for (const std::size_t b : kept) {
    blocks.blocks.push_back(whole.blocks[b]);
    blocks.tags.push_back(whole.tags[b]);
  }
  const Certificate c = certifyBlocks<N>({r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, 0});
  EXPECT_NE(failuresOf(c).find(words), std::string::npos) << name << failuresOf(c);
}

TEST(CertificateNeighbours, BlocksThatShareTooMuch) {
  expectTopology<2>("square_2d", "three blocks share a face", {0, 1, 2, 3, 0, 0});
  expectTopology<3>("tapered_brick", "three blocks share a face", {0, 1, 2, 3, 4, 5, 6, 7, 0, 0});
  expectTopology<2>("square_2d", "two blocks share more than one face", {0, 1, 2, 3, 0});
  expectTopology<3>("tapered_brick", "two blocks share more than one face", {0, 1, 2, 3, 4, 5, 6, 7, 0});
}

/// Two blocks that have `shared` nodes in common: 1 in 2D and 2 in 3D are not enough for a face.
template <int N> std::vector<std::size_t> twoThatShare(const std::string &name, std::size_t shared) {
  const PipelineResult<N> r = run(loadExample<N>(name));
  const auto blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal).blocks;
  for (std::size_t b = 1; b < blocks.size(); ++b) {
    std::size_t count = 0;
    for (const Index n : blocks[b])
      count += std::find(blocks[0].begin(), blocks[0].end(), n) != blocks[0].end() ? 1 : 0;
    if (count == shared) return {0, b};
  }
  return {};
}

TEST(CertificateNeighbours, BlocksThatTouchOnly) {
  expectTopology<2>("square_2d", "not a closed manifold", twoThatShare<2>("square_2d", 1));
  expectTopology<3>("tapered_brick", "not a closed manifold", twoThatShare<3>("tapered_brick", 2));
}

// As many nodes, edges and faces, added with their signs, as the domain has; but in two pieces.
TEST(CertificateNeighbours, AnotherRingBeside) {
  const PipelineResult<3> r = run(loadExample<3>("square_ring"));
  BlockMesh<3> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const Index nodes = blocks.nodeCount();
  for (Index n = 0; n < nodes; ++n)
    blocks.positions.push_back(blocks.positions[at(n)] + Vec<3>(10 * r.mesh.size, 0, 0));
  for (Index b = 0, count = blocks.blockCount(); b < count; ++b) {
    std::array<Index, 8> copy = blocks.blocks[at(b)];
    for (Index &n : copy) n += nodes;
    blocks.blocks.push_back(copy);
    blocks.tags.push_back(std::array<Index, 6>(blocks.tags[at(b)]));
  }
  const BlockInput<3> input{r.domain.domain, r.features, r.featureNodes, r.mesh, blocks, 0};
  Certificate certificate;
  checkTopology(input, buildBlockComplex(input), certificate);
  EXPECT_NE(failuresOf(certificate).find("2 component(s), 2 boundary component(s)"), std::string::npos);
}

} // namespace
} // namespace dualblock::test
