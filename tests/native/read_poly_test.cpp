#include "io/read_poly.h"

#include <gtest/gtest.h>

#include "io/read_domain.h"
#include "support/reader_checks.h"

namespace dualblock::test {
namespace {

const std::string kNodes = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const std::string kFacets = "4 1\n1 0 1\n3 1 3 2\n1 0 1\n3 1 2 4\n1\n3 2 3 4\n1 0 1\n3 1 4 3\n";
const std::string kLists = "1\n1 0.5 0.5 0.5\n1\n1 0.1 0.2 0.3 7 0.01\n";
const std::string kPolyTetrahedron = kNodes + kFacets + kLists;
const std::string kSmesh = kNodes + "4 1\n3 1 3 2 5\n3 1 2 4\n3 2 3 4 -1\n3 1 4 3\n" + kLists;

Result<AnyDomain> readPolyText(std::string_view text) { return readPoly(text, false); }
Result<AnyDomain> readSmeshText(std::string_view text) { return readPoly(text, true); }

using Loops = std::vector<std::vector<Index>>;

std::string replacedFirst(std::string text, const std::string &what, const std::string &by) {
  const std::size_t k = text.find(what);
  EXPECT_NE(k, std::string::npos) << what;
  return k == std::string::npos ? text : text.replace(k, what.size(), by);
}

void expectTetrahedron(const Result<AnyDomain> &result) {
  const Domain<3> domain = domainOf(result);
  ASSERT_EQ(domain.vertices.size(), 4U);
  EXPECT_EQ(domain.vertices[1], Vec<3>(1, 0, 0));
  EXPECT_EQ(domain.vertices[3], Vec<3>(0, 0, 1));
  ASSERT_EQ(domain.facets.size(), 4U);
  EXPECT_EQ(domain.facets[0].loops, (Loops{{0, 2, 1}}));
  EXPECT_EQ(domain.facets[2].loops, (Loops{{1, 2, 3}}));
  EXPECT_EQ(domain.facets[3].loops, (Loops{{0, 3, 2}}));
}

/// Two nested squares of side 6 and 2 around (0,0), one of side 1 in the inner one, one of side 2 beside all,
/// and one of side 0.8 in the outer one, in the plane z = x: four vertices each, from 0, 4, 8, 12 and 16.
std::string squares(const std::string &facet) {
  std::string nodes;
  int count = 0;
  const double boxes[][3] = {{0, 0, 3}, {0, 0, 1}, {0, 0, 0.5}, {9, 0, 1}, {2, 2, 0.4}};
  for (const auto &[x, y, half] : boxes)
    for (const auto &[u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      nodes += std::to_string(count++) + " " + std::to_string(x + u * half) + " " +
               std::to_string(y + v * half) + " " + std::to_string(x + u * half) + "\n";
  return std::to_string(count) + " 3 0 0\n" + nodes + "2 0\n" + facet + "1\n3 0 1 2\n0\n0\n";
}

constexpr int kFirstOfFacet = 24; // line of the facet that squares() is given

TEST(ReadPoly, ReadsNodesFacetsHolesAndRegions) {
  expectTetrahedron(readPolyText(kPolyTetrahedron));
  expectTetrahedron(readSmeshText(kSmesh));
  for (const auto &result : {readPolyText(kPolyTetrahedron), readSmeshText(kSmesh)}) {
    const Domain<3> domain = domainOf(result);
    ASSERT_EQ(domain.holes.size(), 1U);
    EXPECT_EQ(domain.holes[0], Vec<3>(0.5, 0.5, 0.5));
    ASSERT_EQ(domain.regions.size(), 1U);
    EXPECT_EQ(domain.regions[0].point, Vec<3>(0.1, 0.2, 0.3));
    EXPECT_EQ(domain.regions[0].id, 7);
  }
}

TEST(ReadPoly, ReadsEveryLayout) {
  expectTetrahedron(readPolyText("# head\n\n" + replacedFirst(kPolyTetrahedron, "4 3 0 0", "4 # nodes")));
  expectTetrahedron(
      readPolyText(replacedFirst(kPolyTetrahedron, "4 0 0 1", "4 0 0 1 0.25 7 # attribute, marker")));
  expectTetrahedron(readPolyText(replacedFirst(kPolyTetrahedron, "3 2 3 4", "3\n2\n\n# more\n3 4")));
  expectTetrahedron(readSmeshText(replacedFirst(kSmesh, "3 2 3 4 -1", "3 2\n3 4 -1")));
  expectTetrahedron(readPolyText(kNodes + kFacets + "0\n0\n"));
  expectTetrahedron(readPolyText(kNodes + kFacets + "0\n"));
  expectTetrahedron(readPolyText(kNodes + kFacets));
  expectTetrahedron(
      readPolyText("4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0\n1\n3 0 2 1\n1\n3 0 1 3\n1\n3 1 2 3\n"
                   "1\n3 0 3 2\n0\n")); // numbered from 0
  std::string windows;
  for (const char c : kPolyTetrahedron) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expectTetrahedron(readPolyText(windows));
}

TEST(ReadPoly, TakesRegionIdsFromWholeAttributes) {
  const Domain<3> domain = domainOf(readPolyText(kNodes + kFacets +
                                                 "0\n6\n1 0 0 0 10.0\n2 0 0 0 2.5 1\n3 0 0 0\n4 0 0 0 1e300\n"
                                                 "5 0 0 0 -3\n6 0 0 0 1e1 -1\n"));
  std::vector<Index> ids;
  for (const auto &region : domain.regions) ids.push_back(region.id);
  EXPECT_EQ(ids, (std::vector<Index>{10, 2, 3, 4, -3, 10}));
}

TEST(ReadPoly, MakesPolygonsAroundHolePointsHoles) {
  for (const char *order :
       {"2 1 9\n4 0 1 2 3\n4 4 5 6 7\n1 0 0 0\n", "2 1 9\n4 4 5 6 7\n4 0 1 2 3\n1 0 0 0\n",
        "2 2 9\n4 0 1 2 3\n4 4 5 6 7\n1 0 0 0\n2 .5 .5 .5\n"}) {
    const Domain<3> domain = domainOf(readPolyText(squares(order)));
    ASSERT_EQ(domain.facets.size(), 2U);
    EXPECT_EQ(domain.facets[0].loops, (Loops{{0, 1, 2, 3}, {4, 5, 6, 7}}));
    EXPECT_EQ(domain.facets[1].loops, (Loops{{0, 1, 2}}));
  }
}

TEST(ReadPoly, DividesAFacetByUnmarkedPolygons) {
  const Domain<3> domain = domainOf(readPolyText(squares("2\n4 4 5 6 7\n4 0 1 2 3\n")));
  ASSERT_EQ(domain.facets.size(), 3U);
  EXPECT_EQ(domain.facets[0].loops, (Loops{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(domain.facets[1].loops, (Loops{{0, 1, 2}})); // the file's second facet keeps its number
  EXPECT_EQ(domain.facets[2].loops, (Loops{{4, 5, 6, 7}}));
}

TEST(ReadPoly, SortsHolesIslandsAndNeighbours) {
  // The ring around the island 8..11 is a hole, 16..19 divides, and 12..15 lies beside.
  const Domain<3> domain = domainOf(readPolyText(
      squares("5 1\n4 8 9 10 11\n4 12 13 14 15\n4 16 19 18 17\n4 4 5 6 7\n4 0 1 2 3\n1 0.75 0 0.75\n")));
  ASSERT_EQ(domain.facets.size(), 5U);
  EXPECT_EQ(domain.facets[0].loops, (Loops{{0, 1, 2, 3}, {4, 5, 6, 7}, {16, 19, 18, 17}}));
  EXPECT_EQ(domain.facets[1].loops, (Loops{{0, 1, 2}}));
  EXPECT_EQ(domain.facets[2].loops, (Loops{{12, 13, 14, 15}}));
  EXPECT_EQ(domain.facets[3].loops, (Loops{{8, 9, 10, 11}}));
  EXPECT_EQ(domain.facets[4].loops, (Loops{{16, 19, 18, 17}}));
}

TEST(ReadPoly, KeepsPolygonsThatShareAnEdgeApart) {
  const Domain<3> domain = domainOf(readPolyText(squares("2\n3 0 1 2\n3 0 2 3\n")));
  ASSERT_EQ(domain.facets.size(), 3U);
  EXPECT_EQ(domain.facets[0].loops, (Loops{{0, 1, 2}}));
  EXPECT_EQ(domain.facets[2].loops, (Loops{{0, 2, 3}}));
}

TEST(ReadPoly, RefusesHolePointsThatMarkNoInnerPolygon) {
  const auto refused = [](const char *facet, ErrorCode code, int line) {
    expectRefusal(readPolyText(squares(facet)), code, kFirstOfFacet - 1 + line, "facet", 0);
  };
  refused("1 1\n4 0 1 2 3\n1 0 0 0\n", ErrorCode::degenerateFacet, 2);
  refused("2 1\n4 0 1 2 3\n4 4 5 6 7\n1 2.5 2 2.5\n", ErrorCode::degenerateFacet, 3);
  refused("2 1\n4 0 1 2 3\n4 4 5 6 7\n1 20 0 20\n", ErrorCode::holeOutside, 3);
}

TEST(ReadPoly, RefusesDanglingVerticesAndSegments) {
  for (const char *polygon : {"1 4", "2 4 5", "0"})
    expectRefusal(readPolyText(squares("2\n4 0 1 2 3\n" + std::string(polygon) + "\n")),
                  ErrorCode::degenerateFacet, kFirstOfFacet + 1, "facet", 0);
  expectRefusal(readPolyText(squares("0\n")), ErrorCode::degenerateFacet, kFirstOfFacet - 1, "facet", 0);
  expectRefusal(readSmeshText(replacedFirst(kSmesh, "3 2 3 4 -1", "2 2 3 4")), ErrorCode::degenerateFacet, 9,
                "facet", 2);
}

TEST(ReadPoly, RefusesAnEmptyFile) {
  for (const char *text : {"", "\n \t\r\n", "# nothing"})
    for (const bool smesh : {false, true}) {
      const auto result = readPoly(text, smesh);
      ASSERT_FALSE(result.ok());
      EXPECT_EQ(result.error().code, ErrorCode::fileEmpty);
    }
}

TEST(ReadPoly, RefusesTooLittle) {
  const auto result = readPolyText("# nodes elsewhere\n0 3 0 0\n" + kFacets);
  expectRefusal(result, ErrorCode::tooFewVertices, 2);
  EXPECT_NE(result.error().message.find(".node"), std::string::npos);
  expectRefusal(readPolyText(kNodes + "0 0\n0\n"), ErrorCode::tooFewFacets, 6);
}

TEST(ReadPoly, RefusesBrokenSyntax) {
  const auto refused = [](const char *what, const char *by, int line, const char *kind = "line",
                          int index = -1) {
    SCOPED_TRACE(by);
    expectRefusal(readPolyText(replacedFirst(kPolyTetrahedron, what, by)), ErrorCode::syntax, line, kind,
                  index);
  };
  refused("4 3 0 0", "4 2 0 0", 1);
  refused("4 3 0 0", "OFF", 1);
  refused("4 3 0 0", "-4 3 0 0", 1);
  refused("4 3 0 0", "4000000000 3", 1);
  refused("4 3 0 0", "5 3 0 0", 6, "vertex", 4);
  refused("1 0 0 0", "2 0 0 0", 2, "vertex", 0);
  refused("3 0 1 0", "4 0 1 0", 4, "vertex", 2);
  refused("3 0 1 0", "3 0 1", 4, "vertex", 2);
  refused("3 0 1 0", "3 0 1 zero", 4, "vertex", 2);
  refused("4 1\n1", "1000 1\n1", 6);
  refused("1 0 1\n3 1 3 2", "-1 0 1\n3 1 3 2", 7, "facet", 0);
  refused("1 0 1\n3 1 3 2", "1 -1 1\n3 1 3 2", 7, "facet", 0);
  refused("3 1 3 2", "900 1 3 2", 8, "facet", 0);
  refused("3 1 3 2", "3 1 a 2", 8, "facet", 0);
  refused("1 0.5 0.5 0.5", "1 0.5 0.5", 16, "hole", 0);
  refused("1 0.5 0.5 0.5", "0.5 0.5 0.5", 16, "hole", 0);
  refused("1 0.1 0.2 0.3 7", "1 0.1 0.2 0.3 left", 18, "region", 0);
  refused("7 0.01\n", "7 0.01\n2 0 0 0 1\n", 19);
  expectRefusal(readPolyText(kPolyTetrahedron + std::string("\0\1\n", 3)), ErrorCode::syntax, 19);
  expectRefusal(readPolyText(std::string("\x89PNG\r\n\x1a\n\0\0", 10)), ErrorCode::syntax, 2);
}

TEST(ReadPoly, RefusesTruncatedFiles) {
  expectRefusal(readPolyText("4 3 0 0"), ErrorCode::fileTruncated, 1);
  expectRefusal(readPolyText("4 3 0 0\n1 0 0 0\n2 1 0 0\n"), ErrorCode::fileTruncated, 3);
  expectRefusal(readPolyText(kNodes), ErrorCode::fileTruncated, 5);
  expectRefusal(readPolyText(kNodes + "4 1\n1 0 1\n"), ErrorCode::fileTruncated, 7, "facet", 0);
  expectRefusal(readPolyText(kNodes + "4 1\n1 0 1\n3 1 3\n"), ErrorCode::fileTruncated, 8, "facet", 0);
  expectRefusal(readPolyText(kNodes + "4 1\n1 1 1\n3 1 3 2\n"), ErrorCode::fileTruncated, 8, "facet", 0);
  expectRefusal(readPolyText(kNodes + "4 1\n1 0 1\n3 1 3 2\n"), ErrorCode::fileTruncated, 8);
  expectRefusal(readPolyText(kNodes + kFacets + "2\n1 0 0 0\n"), ErrorCode::fileTruncated, 16);
  expectRefusal(readPolyText(kNodes + kFacets + "0\n2\n1 0 0 0 1\n"), ErrorCode::fileTruncated, 17);
  expectRefusal(readSmeshText(kNodes + "4 1\n3 1 3"), ErrorCode::fileTruncated, 7, "facet", 0);
}

TEST(ReadPoly, RefusesNumbersThatAreNotFinite) {
  for (const std::string number : {"nan", "-inf", "1e999"}) {
    expectRefusal(readPolyText(replacedFirst(kPolyTetrahedron, "3 0 1 0", "3 0 " + number + " 0")),
                  ErrorCode::notFinite, 4, "vertex", 2);
    expectRefusal(readPolyText(replacedFirst(kPolyTetrahedron, "1 0.5 ", "1 " + number + " ")),
                  ErrorCode::notFinite, 16, "hole", 0);
    expectRefusal(readPolyText(replacedFirst(kPolyTetrahedron, "0.3 7", "0.3 " + number)),
                  ErrorCode::notFinite, 18, "region", 0);
  }
  // Finite themselves, but not their products, on which the order of polygons depends.
  const std::string large =
      "6 3\n1 0 0 0\n2 1e300 0 0\n3 0 1e300 0\n4 0 0 1\n5 1e299 1e298 0\n6 1e298 1e299 0\n"
      "1 0\n2\n3 1 2 3\n3 1 5 6\n";
  expectRefusal(readPolyText(large), ErrorCode::notFinite, 11, "facet", 0);
}

TEST(ReadPoly, RefusesReferencesOutOfRange) {
  for (const char *polygon : {"3 1 3 5", "3 0 3 2", "3 -1 3 2", "3 1 3 99999999999999999999"})
    expectRefusal(readPolyText(replacedFirst(kPolyTetrahedron, "3 1 3 2", polygon)),
                  ErrorCode::indexOutOfRange, 8, "facet", 0);
}

TEST(ReadPoly, SortsManyHolesAndRefusesTooMany) {
  const auto plate = [](int side) { // with side * side triangular holes
    const std::string end = std::to_string(2 * side);
    std::string nodes = "0 -1 -1 0\n1 " + end + " -1 0\n2 " + end + " " + end + " 0\n3 -1 " + end + " 0\n";
    std::string polygons = "4 0 1 2 3\n";
    int count = 4;
    for (int k = 0; k < side * side; ++k) {
      polygons += "3";
      for (const auto &[x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}}) {
        polygons += " " + std::to_string(count);
        nodes += std::to_string(count++) + " " + std::to_string(2 * (k % side) + x) + " " +
                 std::to_string(2 * (k / side) + y) + " 0\n";
      }
      polygons += "\n";
    }
    return std::to_string(count) + " 3\n" + nodes + "1 0\n" + std::to_string(side * side + 1) + "\n" +
           polygons;
  };
  const Domain<3> domain = domainOf(readPolyText(plate(40)));
  ASSERT_EQ(domain.facets.size(), 1601U);
  EXPECT_EQ(domain.facets[0].loops.size(), 1601U);
  // 62 500 holes would take minutes.
  expectRefusal(readPolyText(plate(250)), ErrorCode::syntax, 250008, "facet", 0);
}

TEST(ReadPoly, SurvivesDamage) {
  expectToSurviveDamage(kPolyTetrahedron, readPolyText);
  expectToSurviveDamage(kSmesh, readSmeshText);
  expectToSurviveDamage(
      squares("5 1\n4 8 9 10 11\n4 12 13 14 15\n4 16 19 18 17\n4 4 5 6 7\n4 0 1 2 3\n1 0.75 0 0.75\n"),
      readPolyText);
}

TEST(ReadPoly, ReadsTheSharedFiles) { // those under ../shared/data
  const auto folder = sharedData();
  if (folder.empty()) return;
  for (const std::string &file : sharedFiles(folder, ".poly")) {
    SCOPED_TRACE(file);
    // Files made from .geo are listed under that name.
    const std::string name = file.substr(0, file.size() - 5);
    Counts counts = countsInProvenance(folder, file);
    if (counts == Counts{}) counts = countsInProvenance(folder, name + ".geo");
    if (name == "assembly/example") counts.faces = 23; // the table counts facet 3's two polygons
    EXPECT_EQ(countsOf(domainOf(readPolyText(readFile(folder / file)))), counts);
  }
}

TEST(ReadPoly, ReadsTetGensExample) { // under ../shared/data
  const auto folder = sharedData();
  if (folder.empty()) return;
  const Domain<3> domain = domainOf(readDomain("poly", readFile(folder / "assembly/example.poly")));
  ASSERT_EQ(domain.facets.size(), 23U);
  EXPECT_EQ(domain.facets[2].loops, (Loops{{0, 1, 5, 4}, {20, 21, 25, 24}}));
  EXPECT_EQ(domain.holes, (std::vector<Vec<3>>{{1, 0.4, 2.25}, {1, 0.4, 0.75}}));
  ASSERT_EQ(domain.regions.size(), 2U);
  EXPECT_EQ(domain.regions[0].id, 10);
  EXPECT_EQ(domain.regions[1].id, 20);
}

} // namespace
} // namespace dualblock::test
