// The native core and the one in WebAssembly make the same meshes, simplex by simplex and block by block:
// both are compared with the digests in tests/fixtures/digests.json (tests/node/same-as-native.test.ts is the
// other half). Coordinates are left out, as the C libraries' sines may differ in the last bit. Where a change
// of the method changes the digests, `npx vitest run same-as-native -u` writes the new ones.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/examples.h"

namespace dualblock {
namespace {

/// FNV-1a over 32-bit integers.
class Digest {
public:
  template <typename Rows> void add(const Rows &rows) {
    for (const auto &row : rows)
      for (const Index i : row) {
        hash_ ^= static_cast<std::uint32_t>(i);
        hash_ *= 16777619U;
      }
  }
  std::uint32_t value() const { return hash_; }

private:
  std::uint32_t hash_ = 2166136261U;
};

template <int N> std::uint32_t digestOf(const Domain<N> &domain) {
  const PipelineResult<N> r = test::run<N>(domain);
  Digest digest;
  digest.add(r.mesh.simplices);
  digest.add(r.mesh.tags);
  std::vector<std::array<Index, 1 << N>> blocks;
  for (const Block<N> &block : r.primal.blocks) blocks.push_back(block.nodes);
  digest.add(blocks);
  return digest.value();
}

TEST(SameAsWasm, DigestsOfAllExamples) {
  const auto digests = nlohmann::json::parse(test::readText("tests/fixtures/digests.json"));
  for (const std::string &name : test::computedExampleNames()) {
    const std::uint32_t digest =
        std::visit([](const auto &domain) { return digestOf(domain); }, test::loadExample(name));
    EXPECT_EQ(digest, digests.at(name).get<std::uint32_t>()) << name;
  }
}

} // namespace
} // namespace dualblock
