// Domains that were once given a wrong mesh, or a wrong verdict, each with what is right. Meshes of bent
// solids are judged by a judge that shares nothing with the core (support/mesh_judge.h), their refinements
// too.
#include <gtest/gtest.h>

#include "certificate/elements.h"
#include "io/read_domain.h"
#include "support/examples.h"
#include "support/mesh_judge.h"

namespace dualblock::test {
namespace {

/// A file in tests/fixtures.
AnyDomain loadFixture(const std::string &path) {
  auto read = readDomain(path.substr(path.rfind('.') + 1), readText("tests/fixtures/" + path));
  if (!read.ok()) throw std::runtime_error(path + ": " + read.error().message);
  return std::move(read.value());
}

template <int N> Domain<N> loadFixture(const std::string &path) {
  return std::get<Domain<N>>(loadFixture(path));
}

/// What a run hands out.
template <int N> BlockMesh<N> meshOf(const PipelineResult<N> &r) {
  return r.finalMesh ? r.finalMesh->blocks : layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
}

void expectRight(const Domain<3> &domain, const PipelineResult<3> &r, const BlockMesh<3> &mesh) {
  ASSERT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_EQ(judge(domain, {mesh.positions, mesh.blocks}, {}).complaint, "");
}

/// Four elements along each edge.
void expectRightElements(const Domain<3> &domain, const PipelineResult<3> &r, const BlockMesh<3> &mesh) {
  RefineOptions options;
  options.intervals = 4;
  const auto refined = refineResult<3>(r, options);
  ASSERT_TRUE(refined.ok()) << refined.error().message;
  const std::vector<Index> patches = patchOfSurface(r.mesh);
  const BentFacets<3> bent = bentFacetsOf(r.mesh, r.features, r.featureNodes);
  const double measure = r.certificate.domainMeasure;
  const Certificate certificate = certifyElements<3>({refined.value(), mesh, patches, bent, measure, false});
  EXPECT_TRUE(certificate.valid) << failuresOf(certificate);
  EXPECT_EQ(judge(domain, {refined.value().positions, refined.value().elements}, {1000}).complaint, "");
}

struct BentSolid {
  const char *name;
  std::size_t blocks; // at most
};

// They were given blocks that overlap, or that miss four fifths of the solid. Right is what follows the
// sides: a chain of blocks along spirals, springs and waves, by cuts and not by simplices.
class BentSolids : public ::testing::TestWithParam<BentSolid> {
protected:
  const Domain<3> domain = loadFixture<3>(std::string("wrong-meshes/") + GetParam().name + ".json");
};

TEST_P(BentSolids, AreCutIntoFewBlocksThatFollowTheirSides) {
  const PipelineResult<3> r = run(domain);
  const BlockMesh<3> mesh = meshOf(r);
  expectRight(domain, r, mesh);
  EXPECT_EQ(r.fallbackComponents + r.pulledComponents, 0) << r.fallbackReason;
  EXPECT_LE(mesh.blocks.size(), GetParam().blocks);
  expectRightElements(domain, r, mesh);
}

std::string nameOf(const ::testing::TestParamInfo<BentSolid> &info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Adversarial, BentSolids,
                         ::testing::Values(BentSolid{"spiral_extruded", 160}, BentSolid{"spiral_720", 160},
                                           BentSolid{"sp_2_1", 160}, BentSolid{"sp_taper", 160},
                                           BentSolid{"sp_1.25_3", 120}, BentSolid{"disc_in_notch", 80},
                                           BentSolid{"bearing", 240}, BentSolid{"helix2", 160},
                                           BentSolid{"spring_2_4", 160}, BentSolid{"s_wave1", 48}),
                         nameOf);

class BentSolidsCoarsest : public BentSolids {};

TEST_P(BentSolidsCoarsest, KeepTheirShape) {
  PipelineOptions options;
  options.mode.mode = Mode::coarsest;
  const PipelineResult<3> r = run(domain, options);
  const BlockMesh<3> mesh = meshOf(r);
  expectRight(domain, r, mesh);
  EXPECT_LE(mesh.blocks.size(), GetParam().blocks);
  expectRightElements(domain, r, mesh);
}

INSTANTIATE_TEST_SUITE_P(Adversarial, BentSolidsCoarsest,
                         ::testing::Values(BentSolid{"spiral_extruded", 60}, BentSolid{"sp_1.25_3", 24},
                                           BentSolid{"disc_in_notch", 32}, BentSolid{"s_wave1", 16}),
                         nameOf);

// A polyhedron of 50 corners on a sphere was taken for a ball of 32 blocks, a quarter of it missing.
TEST(Adversarial, HullOfPointsOnASphere) {
  const Domain<3> domain = loadFixture<3>("adversarial/hull_sphere_50_3.json");
  for (const Mode mode : {Mode::layered, Mode::coarsest}) {
    PipelineOptions options;
    options.mode.mode = mode;
    const PipelineResult<3> r = run(domain, options);
    expectRight(domain, r, meshOf(r));
    expectRightElements(domain, r, meshOf(r));
  }
}

// One ten-thousandth as high as wide, and with a slot of five millionths of its width: boxes.
TEST(Adversarial, FlatAndSlottedBoxes) {
  for (const auto &[name, blocks] : {std::pair{"aniso_1e4", 160U}, {"slot_5e-6", 40U}}) {
    SCOPED_TRACE(name);
    const Domain<3> domain = loadFixture<3>(std::string("adversarial/") + name + ".json");
    const PipelineResult<3> r = run(domain);
    expectRight(domain, r, meshOf(r));
    EXPECT_EQ(r.primal.blocks.size(), blocks);
    EXPECT_GT(*std::min_element(r.quality.begin(), r.quality.end()), 0.999);
  }
}

// Rings in rings, extruded: facets with islands in their holes, which were not filled.
TEST(Adversarial, IslandsInTheHolesOfFacets) {
  const Domain<3> domain = loadFixture<3>("adversarial/nested_rings_extruded.json");
  const PipelineResult<3> r = run(domain);
  expectRight(domain, r, meshOf(r));
  EXPECT_EQ(r.fallbackComponents, 0);
  EXPECT_EQ(r.mesh.componentCount, 3);
}

TEST(Adversarial, PolygonOfManySides) {
  const PipelineResult<2> r = run(loadFixture<2>("adversarial/circle64.json"));
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  EXPECT_LE(r.primal.blocks.size(), 64U);
}

/// What the run says of a domain that is none, and the facets that it names.
Error refusalOf(const std::string &path) {
  const auto result = runPipeline<3>(loadFixture<3>(path), {});
  if (result.ok()) return {ErrorCode::internal, "meshed", {}};
  return result.error();
}

std::vector<std::int64_t> facetsOf(const Error &error) {
  std::vector<std::int64_t> facets;
  for (const EntityRef &e : error.entities)
    if (e.kind == "facet") facets.push_back(e.index);
  std::sort(facets.begin(), facets.end());
  return facets;
}

// A wave so steep that its walls cross.
TEST(Adversarial, WaveThatCrossesItself) {
  const Error error = refusalOf("adversarial/s_wave3.json");
  EXPECT_EQ(error.code, ErrorCode::selfIntersection) << error.message;
  EXPECT_GE(error.entities.size(), 2U);
}

// The tip of a cavity touches the wall: both facets are named, and where.
TEST(Adversarial, CavityThatTouchesTheWall) {
  const Error error = refusalOf("adversarial/cavity_touch_wall_point.json");
  EXPECT_EQ(error.code, ErrorCode::selfIntersection);
  EXPECT_NE(error.message.find("facets 5 and 9 meet at (2, 2, 4)"), std::string::npos) << error.message;
  const std::vector<std::int64_t> facets = facetsOf(error);
  EXPECT_EQ(facets, (std::vector<std::int64_t>{5, 9, 10, 11}));
}

// On these reference meshes there was no valid mesh.
TEST(Adversarial, CylindersInShellsAndPlates) {
  for (const auto &[name, edgeLength] : {std::pair{"a10_cyl_in_shell", 0.988}, {"a13_bolt_plate", 2.0}}) {
    SCOPED_TRACE(name);
    const Domain<3> domain = loadFixture<3>(std::string("adversarial/") + name + ".poly");
    PipelineOptions options;
    options.edgeLength = edgeLength;
    const PipelineResult<3> r = run(domain, options);
    expectRight(domain, r, meshOf(r));
  }
}

// Reference meshes changed the number of blocks: 704 or simplices, and 154, 168 or 336.
TEST(Adversarial, BlocksAreTheSameOnEveryReferenceMesh) {
  const auto blocksOf = [](const Domain<3> &domain, std::uint32_t seed, double edgeLength) {
    PipelineOptions options;
    options.seed = seed;
    options.edgeLength = edgeLength;
    const PipelineResult<3> r = run(domain, options);
    EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
    return r.primal.blocks.size();
  };
  const Domain<3> room = loadFixture<3>("adversarial/h08_room_two_windows.json");
  const Domain<3> star = loadFixture<3>("adversarial/s28_star6.off");
  for (std::uint32_t seed = 0; seed <= 6; ++seed) {
    EXPECT_EQ(blocksOf(room, seed, 0), 704U) << seed;
    EXPECT_EQ(blocksOf(star, seed, 0), 154U) << seed;
  }
  for (const double edgeLength : {0.5, 0.3}) EXPECT_EQ(blocksOf(star, 0, edgeLength), 154U) << edgeLength;
}

} // namespace
} // namespace dualblock::test
