// Extraction of D-bar-surfaces: single ones, and as many as can go.
#include "blocks/extract.h"

#include <gtest/gtest.h>

#include "base/disjoint_sets.h"
#include "blocks/modes.h"
#include "support/random_domains.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

template <int N> PipelineResult<N> coarsest(const Domain<N> &domain) {
  PipelineOptions options;
  options.mode.mode = Mode::coarsest;
  return run(domain, options);
}

template <int N> std::size_t coarsestBlocks(const Domain<N> &domain) {
  const auto r = coarsest(domain);
  EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
  return r.finalMesh->blocks.blocks.size();
}

// Where all parts are boxes, the coarsest mesh has a block for each.
TEST(Coarsest, OneBlockPerBox) {
  EXPECT_EQ(coarsestBlocks(loadExample<3>("tapered_brick")), 1U);
  EXPECT_EQ(coarsestBlocks(loadExample<3>("square_ring")), 8U);
  EXPECT_EQ(coarsestBlocks(loadExample<3>("protrusion")), 10U);
  EXPECT_EQ(coarsestBlocks(loadExample<3>("l_shape_extruded")), 3U);
  EXPECT_EQ(coarsestBlocks(loadExample<3>("notched_cube")), 7U);
  EXPECT_EQ(coarsestBlocks(loadExample<3>("u_shape_extruded")), 5U);
  EXPECT_EQ(coarsestBlocks(loadExample<3>("box_on_box")), 10U);
  EXPECT_EQ(coarsestBlocks(loadExample<2>("square_2d")), 1U);
  EXPECT_EQ(coarsestBlocks(loadExample<2>("l_shape_2d")), 3U);
  EXPECT_EQ(coarsestBlocks(loadExample<2>("two_holes_2d")), 13U);
  const auto plus = voxelDomain(3, [](int i, int j, int k) { return k == 0 && (i == 1 || j == 1); });
  EXPECT_EQ(coarsestBlocks(plus), 5U);
  for (const char *name : {"square_ring", "protrusion", "l_shape_extruded", "notched_cube"}) {
    const auto r = coarsest(loadExample<3>(name));
    EXPECT_NEAR(*std::min_element(r.finalMesh->quality.begin(), r.finalMesh->quality.end()), 1, 1e-4) << name;
  }
}

// Unions of boxes: never fewer blocks than a certificate could hold, hardly ever more than parts.
TEST(Coarsest, RandomBoxes) {
  std::size_t parts = 0;
  std::size_t blocks = 0;
  std::size_t layered = 0;
  for (const int kind : {2, 3, 4})
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      const auto r = coarsest(randomSolid(kind, seed));
      ASSERT_TRUE(r.certificate.valid) << kind << " " << seed << failuresOf(r.certificate);
      parts += r.parts.parts.size();
      layered += r.primal.blocks.size();
      blocks += r.finalMesh->blocks.blocks.size();
    }
  std::cout << "60 unions of boxes: " << layered << " blocks layered, " << blocks << " at the coarsest, "
            << parts << " parts\n";
  EXPECT_LE(static_cast<double>(blocks), 1.05 * static_cast<double>(parts));
}

// Rounder solids keep the volume that their layered mesh has.
TEST(Coarsest, RoundSolidsKeepTheirShape) {
  for (const Domain<3> &domain : {shaft(24), torus(24, 12), plateWithHole(24)}) {
    SCOPED_TRACE(domain.name);
    const auto layered = run(domain);
    const auto r = coarsest(domain);
    ASSERT_TRUE(r.certificate.valid);
    const auto error = [](const Certificate &c) { return std::abs(c.meshMeasure - c.domainMeasure); };
    EXPECT_LE(error(r.certificate), 1.1 * error(layered.certificate));
    EXPECT_LE(r.finalMesh->blocks.blocks.size(), layered.primal.blocks.size());
  }
}

// The surfaces that the dual gives are those of parallel edges, found from the blocks alone.
TEST(BlockMesh, SurfacesAreClassesOfParallelEdges) {
  for (const char *name : {"square_ring", "double_pyramid", "protrusion", "plate_with_hole", "icosahedron"}) {
    SCOPED_TRACE(name);
    const auto r = run(loadExample<3>(name));
    const BlockMesh<3> mesh = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
    std::map<std::array<Index, 2>, Index> slotOf; // an edge's first block and axis
    DisjointSets sets(3 * mesh.blocks.size());
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
      for (std::size_t low = 0; low < 8; ++low)
        for (std::size_t high = 0; high < 8; ++high) {
          const unsigned bits = kBlockBits<3>[low] ^ kBlockBits<3>[high];
          if (low >= high || (bits != 1 && bits != 2 && bits != 4)) continue;
          const Index slot = toIndex(3 * b + (bits == 1 ? 0 : bits == 2 ? 1 : 2));
          const auto [known, isNew] =
              slotOf.emplace(sortedPair(mesh.blocks[b][low], mesh.blocks[b][high]), slot);
          sets.unite(known->second, slot);
        }
    std::map<Index, Index> surfaceOf;
    for (Index slot = 0; slot < toIndex(3 * mesh.blocks.size()); ++slot) {
      const Index surface = mesh.surfaces[at(slot / 3)][at(slot % 3)];
      EXPECT_EQ(surfaceOf.emplace(sets.find(slot), surface).first->second, surface);
    }
    EXPECT_EQ(toIndex(surfaceOf.size()), r.surfaces.count);
  }
}

// Of a cube's six surfaces each can go; the one across from it can then not.
TEST(Extract, OneOfTwoParallelSurfaces) {
  const auto r = run(loadExample<3>("tapered_brick"));
  const BlockMesh<3> mesh = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const Freedom<3> freedom(r.mesh, r.features, r.featureNodes, mesh);
  for (Index surface = 0; surface < 6; ++surface) {
    const auto once = extract(r.mesh, freedom, mesh, surface);
    ASSERT_TRUE(once.why.empty()) << once.why;
    EXPECT_EQ(once.blocks.blocks.size(), 4U);
    EXPECT_EQ(once.blocks.nodeCount(), 18);
    const Freedom<3> after(r.mesh, r.features, r.featureNodes, once.blocks);
    int refused = 0;
    for (Index other = 0; other < 6; ++other)
      if (other != surface) refused += extract(r.mesh, after, once.blocks, other).why.empty() ? 0 : 1;
    EXPECT_EQ(refused, 1);
    EXPECT_EQ(extract(r.mesh, after, once.blocks, surface).why, "there is no such surface");
  }
}

TEST(Extract, NamedOnes) {
  PipelineOptions options;
  options.mode.extract = coarsest(loadExample<3>("square_ring")).finalMesh->extracted;
  options.mode.extract.resize(2);
  const auto r = run(loadExample<3>("square_ring"), options);
  ASSERT_TRUE(r.finalMesh);
  EXPECT_TRUE(r.certificate.valid);
  EXPECT_EQ(r.finalMesh->extracted, options.mode.extract);
  EXPECT_LT(r.finalMesh->blocks.blocks.size(), r.primal.blocks.size());

  options.mode.extract = {99};
  const auto unknown = runPipeline<3>(loadExample<3>("square_ring"), options);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::badOption);
  EXPECT_NE(unknown.error().message.find("99"), std::string::npos);

  // A tetrahedron's are all needed: a block of what is left would be flat.
  options.mode.extract = {0};
  const auto needed = runPipeline<3>(loadExample<3>("tetrahedron"), options);
  ASSERT_FALSE(needed.ok());
  EXPECT_EQ(needed.error().entities.at(0).kind, "surface");
}

// Against the writer of the primal's boundary, on a layered mesh.
TEST(BlockMesh, BoundaryIsThePrimals) {
  const auto r = run(loadExample<3>("box_on_box"));
  const auto faces = boundaryOf(layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal), patchOfSurface(r.mesh));
  const auto wanted = boundaryFaces(r.mesh, r.parts, r.primal);
  EXPECT_EQ(faces.facet, wanted.facet);
  EXPECT_EQ(faces.faces, wanted.faces);
}

} // namespace
} // namespace dualblock::test
