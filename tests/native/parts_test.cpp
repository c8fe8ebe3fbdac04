// Parts, sides, curves and corners of the examples (ARCHITECTURE.md 2 and 3): counts, angles, and whether
// they are simple.
#include "parts/parts.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "partition/heuristics.h"
#include "partition/sources/sectors.h"
#include "support/examples.h"

namespace dualblock::test {
namespace {

struct Shape {
  const char *name;
  std::size_t parts, sides, curves, corners;
  bool simple;
};

class Features : public ::testing::TestWithParam<Shape> {};

/// The uncut domain as one part, on a coarse, a refined and a random reference mesh.
TEST_P(Features, Counts) {
  const Shape &shape = GetParam();
  for (const double edgeLength : {0.0, 0.6})
    for (const std::uint32_t seed : {0U, 3U})
      std::visit(
          [&](const auto &domain) {
            const auto parts = buildParts(fill(domain, edgeLength, seed), {});
            EXPECT_EQ(parts.parts.size(), shape.parts);
            EXPECT_EQ(parts.sides.size(), shape.sides);
            EXPECT_EQ(parts.curves.size(), shape.curves);
            EXPECT_EQ(parts.corners.size(), shape.corners);
            EXPECT_EQ(parts.parts[0].isSimple(), shape.simple) << describe(parts.parts[0].defect, 3);
          },
          loadExample(shape.name));
}

INSTANTIATE_TEST_SUITE_P(
    Examples, Features,
    ::testing::Values(
        Shape{"tetrahedron", 1, 4, 6, 4, true}, Shape{"tapered_brick", 1, 6, 12, 8, true},
        Shape{"extruded_pentagon", 1, 7, 15, 10, true}, Shape{"house", 1, 7, 15, 10, true},
        Shape{"double_pyramid", 1, 8, 12, 6, false}, Shape{"icosahedron", 1, 20, 30, 12, false},
        Shape{"hexagonal_pyramid", 1, 7, 12, 7, false}, Shape{"l_shape_extruded", 1, 8, 18, 12, true},
        Shape{"u_shape_extruded", 1, 10, 24, 16, true},
        // The ring's top and bottom are annuli; the protrusion's foot runs around a hole in its slab.
        Shape{"square_ring", 1, 10, 24, 16, false}, Shape{"protrusion", 1, 11, 24, 16, false},
        Shape{"notched_cube", 1, 9, 21, 14, true}, Shape{"square_2d", 1, 4, 4, 4, true},
        Shape{"pentagon_2d", 1, 5, 5, 5, true}, Shape{"l_shape_2d", 1, 6, 6, 6, true},
        Shape{"square_ring_2d", 1, 8, 8, 8, false}, Shape{"two_holes_2d", 1, 12, 12, 12, false}),
    [](const auto &info) { return std::string(info.param.name); });

template <int N> std::vector<double> sortedAngles(const Parts<N> &parts) {
  std::vector<double> angles;
  for (const Curve<N> &curve : parts.curves) angles.push_back(curve.angle / kDegree);
  std::sort(angles.begin(), angles.end());
  return angles;
}

void expectAngles(const std::vector<double> &angles, const std::vector<double> &wanted) {
  ASSERT_EQ(angles.size(), wanted.size());
  for (std::size_t k = 0; k < angles.size(); ++k) EXPECT_NEAR(angles[k], wanted[k], 1e-9);
}

TEST(Angles, OfTheExamples) {
  expectAngles(sortedAngles(buildParts(fill(loadExample<2>("l_shape_2d")), {})), {90, 90, 90, 90, 90, 270});
  std::vector<double> brick(17, 90);
  brick.push_back(270);
  expectAngles(sortedAngles(buildParts(fill(loadExample<3>("l_shape_extruded"), 0.5), {})), brick);
  const double dihedral = std::acos(-1.0 / 3) / kDegree; // of the octahedron
  expectAngles(sortedAngles(buildParts(fill(loadExample<3>("double_pyramid")), {})),
               std::vector<double>(12, dihedral));
  expectAngles(sortedAngles(buildParts(fill(loadExample<2>("pentagon_2d")), {})),
               std::vector<double>(5, 108));
}

// Figure 2: the interior angle of vertex 0 in the four vertex examples.
TEST(Angles, OfTheVertexTypes) {
  for (const auto &[name, angle] : {std::pair{"vertex_end", 90.0}, std::pair{"vertex_side", 200.0},
                                    std::pair{"vertex_corner", 270.0}, std::pair{"vertex_reversal", 350.0}}) {
    SCOPED_TRACE(name);
    const auto parts = buildParts(fill(loadExample<2>(name), 0.3, 2), {});
    bool found = false;
    for (const Curve<2> &curve : parts.curves) found |= std::abs(curve.angle / kDegree - angle) < 1e-6;
    EXPECT_TRUE(found);
  }
}

TEST(Angles, SidesOfACurveAndItsChainAgree) {
  const auto mesh = fill(loadExample<3>("protrusion"), 0.7);
  const auto parts = buildParts(mesh, {});
  for (const Curve<3> &curve : parts.curves) {
    EXPECT_LT(curve.sides[0], curve.sides[1]);
    EXPECT_TRUE(curve.open);
    for (const auto &ridge : curve.ridges)
      for (const Index node : ridge)
        for (const Index side : curve.sides)
          EXPECT_TRUE(std::binary_search(parts.nodeSides.begin(node), parts.nodeSides.end(node), side));
  }
}

// Paper 2.4: 2, 3 and 4 sectors, and the planes that make them.
TEST(SectorPlanes, CountAndSectors) {
  using std::numbers::pi;
  for (int degrees = 181; degrees < 360; ++degrees) {
    SCOPED_TRACE(degrees);
    const double angle = degrees * kDegree;
    const std::vector<double> planes = sectorPlanes(curveKind(angle), angle);
    // A plane through the curve is met inside at its direction and, where that is inside too, opposite to it.
    std::vector<double> rays{0, angle};
    for (const double direction : planes)
      for (const double ray : {direction - pi, direction, direction + pi})
        if (ray > 1e-9 && ray < angle - 1e-9) rays.push_back(ray);
    std::sort(rays.begin(), rays.end());
    const std::size_t ideal = degrees <= 225 ? 2 : degrees <= 315 ? 3 : 4;
    EXPECT_EQ(rays.size() - 1, ideal);
    for (std::size_t k = 0; k + 1 < rays.size(); ++k) EXPECT_LT(rays[k + 1] - rays[k], 135.5 * kDegree);
  }
}

TEST(Decompose, PartsBecomeConvexAndSimple) {
  for (const char *name : {"l_shape_extruded", "u_shape_extruded", "square_ring", "protrusion",
                           "notched_cube", "double_pyramid", "hexagonal_pyramid"}) {
    SCOPED_TRACE(name);
    const auto result = run(loadExample<3>(name));
    for (const PartInfo &part : result.parts.parts) EXPECT_TRUE(part.isSimple()) << describe(part.defect, 3);
    for (const Curve<3> &curve : result.parts.curves) EXPECT_LE(curve.angle, std::numbers::pi + 1e-6);
    for (const Corner &corner : result.parts.corners) EXPECT_EQ(corner.sides.size(), 3U);
    for (const Side &side : result.parts.sides) {
      if (side.opposite == kNone) continue;
      EXPECT_EQ(&result.parts.sides[at(result.parts.sides[at(side.opposite)].opposite)], &side);
      EXPECT_EQ(result.parts.sides[at(side.opposite)].tag, FaceTag::flipped(side.tag));
    }
  }
}

TEST(Parts, NotSimpleForAReason) {
  const auto defect = [](const char *name) {
    return buildParts(fill(loadExample<3>(name)), {}).parts[0].defect;
  };
  EXPECT_EQ(defect("double_pyramid"), Defect::crowdedCorner);
  EXPECT_EQ(defect("square_ring"), Defect::closedSide);
}

// A 24-gon for a circle, 15 degrees from facet to facet: facets that are not coplanar stay sides of their
// own.
TEST(Parts, FacetsOfACylinderAreSides) {
  std::vector<Vec<2>> circle;
  for (int k = 0; k < 24; ++k) circle.emplace_back(std::cos(15 * k * kDegree), std::sin(15 * k * kDegree));
  const auto parts = buildParts(fill(prism(circle, 0, 1), 0, 0, 0), {});
  EXPECT_EQ(parts.sides.size(), 26U);
  EXPECT_EQ(parts.curves.size(), 72U);
  EXPECT_TRUE(parts.parts[0].isSimple()) << describe(parts.parts[0].defect, 3);
  const auto round = buildParts(fill(prism(circle, 0, 1)), {});
  EXPECT_EQ(round.sides.size(), 3U);
  EXPECT_EQ(round.curves.size(), 2U); // closed ones
  EXPECT_EQ(round.corners.size(), 0U);
  EXPECT_FALSE(round.parts[0].isSimple());
}

TEST(Parts, EveryFaceMakesEachSimplexAPart) {
  auto mesh = fill(loadExample<3>("tapered_brick"), 0.8);
  const Index inner = toIndex(mesh.surfaces.size());
  mesh.surfaces.push_back({SurfaceKind::simplexFace, kNone, {}});
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i)
      if (mesh.tags[at(s)][i] == kNone)
        mesh.tags[at(s)][i] = s < mesh.neighbors[at(s)][i] ? FaceTag::back(inner) : FaceTag::front(inner);
  const std::vector<bool> everyFace(mesh.simplices.size(), true);
  PartOptions options;
  options.everyFace = &everyFace;
  const auto parts = buildParts(mesh, options);
  EXPECT_EQ(parts.parts.size(), mesh.simplices.size());
  EXPECT_EQ(parts.sides.size(), 4 * mesh.simplices.size());
  EXPECT_EQ(parts.curves.size(), 6 * mesh.simplices.size());
  EXPECT_EQ(parts.corners.size(), 4 * mesh.simplices.size());
  for (const PartInfo &part : parts.parts) EXPECT_TRUE(part.isSimple()) << describe(part.defect, 3);
}

} // namespace
} // namespace dualblock::test
