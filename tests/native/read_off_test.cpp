#include "io/read_off.h"

#include <gtest/gtest.h>

#include "io/read_domain.h"
#include "support/reader_checks.h"

namespace dualblock::test {
namespace {

const std::string kBody = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string kOffTetrahedron = "OFF\n4 4 6\n" + kBody;

void expectTetrahedron(const std::string &text) {
  SCOPED_TRACE(text);
  const Domain<3> domain = domainOf(readOff(text));
  ASSERT_EQ(domain.vertices.size(), 4U);
  EXPECT_EQ(domain.vertices[1], Vec<3>(1, 0, 0));
  EXPECT_EQ(domain.vertices[3], Vec<3>(0, 0, 1));
  ASSERT_EQ(domain.facets.size(), 4U);
  for (const Facet &facet : domain.facets) EXPECT_EQ(facet.loops.size(), 1U);
  EXPECT_EQ(domain.facets[1].loops[0], (std::vector<Index>{0, 1, 3}));
  EXPECT_EQ(domain.facets[3].loops[0], (std::vector<Index>{0, 3, 2}));
}

std::string replaced(std::string text, const std::string &what, const std::string &by) {
  for (std::size_t k = text.find(what); k != std::string::npos; k = text.find(what, k + by.size()))
    text.replace(k, what.size(), by);
  return text;
}

TEST(ReadOff, ReadsHeadersAndLayouts) {
  expectTetrahedron(kOffTetrahedron);
  expectTetrahedron("OFF 4 4 6\n" + kBody);
  expectTetrahedron("OFF\n4 4\n" + kBody);
  expectTetrahedron("OFF # of a tetrahedron\n# comment\n\n 4 4 6 # counts\n\n" + kBody + "\n# the end");
  expectTetrahedron("# first\n\n" + kOffTetrahedron);
  expectTetrahedron("\xEF\xBB\xBF" + kOffTetrahedron);
  expectTetrahedron(replaced(kOffTetrahedron, "\n", "\r\n"));
  expectTetrahedron(replaced(kOffTetrahedron, "\n", "\r"));
  expectTetrahedron(replaced(kOffTetrahedron, " ", " \t "));
  expectTetrahedron(replaced(kOffTetrahedron, "\n", "#\xC3\xA9\n"));
  expectTetrahedron(kOffTetrahedron.substr(0, kOffTetrahedron.size() - 1));
}

TEST(ReadOff, SkipsNormalsColoursAndTextureCoordinates) {
  const std::string faces = "3 0 2 1 255 0 0\n3 0 1 3 0.5 0.5 0.5 1\n3 1 2 3 7\n3 0 3 2\n";
  for (const char *header : {"OFF", "COFF", "NOFF", "CNOFF", "NCOFF", "STOFF", "STCNOFF", "NCSTOFF"})
    expectTetrahedron(std::string(header) + "\n4 4 6\n0 0 0 .1 .2 .3\n1 0 0 0 0 1 255 255 255 255\n" +
                      "0 1 0 nan\n0 0 1 9\n" + faces);
}

TEST(ReadOff, ReadsPolygonsAndEveryNotationOfNumbers) {
  const Domain<3> domain =
      domainOf(readOff("OFF 5 1 0\n+1 -.5 5.\n1e2 -1.5E-3 1.e+0\n0 0 1e-999\n0 1 0\n0 0 0\n5 0 1 2 3 +4\n"));
  ASSERT_EQ(domain.vertices.size(), 5U);
  EXPECT_EQ(domain.vertices[0], Vec<3>(1, -0.5, 5));
  EXPECT_EQ(domain.vertices[1], Vec<3>(100, -0.0015, 1));
  EXPECT_EQ(domain.facets[0].loops[0], (std::vector<Index>{0, 1, 2, 3, 4}));
}

TEST(ReadOff, RefusesAnEmptyFile) {
  for (const char *text : {"", " \n\r\n\t", "# nothing\n", "\xEF\xBB\xBF"}) {
    const auto result = readOff(text);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::fileEmpty);
  }
}

TEST(ReadOff, RefusesOtherFormatsAndVariants) {
  expectRefusal(readOff("solid box\n"), ErrorCode::syntax, 1);
  expectRefusal(readOff("4 4 6\n" + kBody), ErrorCode::syntax, 1);
  expectRefusal(readOff("# x\nOFF BINARY\n" + std::string("\0\0\0\4", 4)), ErrorCode::syntax, 2);
  expectRefusal(readOff("4OFF\n4 4 6\n" + kBody), ErrorCode::syntax, 1);
  expectRefusal(readOff("nOFF\n3\n4 4 6\n" + kBody), ErrorCode::syntax, 1);
  expectRefusal(readOff("C4nOFF\n3\n4 4 6\n" + kBody), ErrorCode::syntax, 1);
  expectRefusal(readOff("XOFF\n4 4 6\n" + kBody), ErrorCode::syntax, 1);
  for (const char *header : {"OFF BINARY\n", "CNOFF BINARY\n"})
    EXPECT_NE(readOff(header).error().message.find("binary OFF"), std::string::npos);
  for (const char *header : {"4OFF\n1", "nOFF\n1", "4nOFF\n1", "ST4nOFF\n1"})
    EXPECT_NE(readOff(header).error().message.find("more dimensions"), std::string::npos);
}

TEST(ReadOff, RefusesBinaryGarbage) {
  expectRefusal(readOff(std::string("\x7f"
                                    "ELF\2\1\0\0\0\n\0",
                                    11)),
                ErrorCode::syntax, 1);
  expectRefusal(readOff(std::string("\xFF\xFEO\0F\0F\0\n\0", 10)), ErrorCode::syntax, 1); // UTF-16
  expectRefusal(readOff(kOffTetrahedron + std::string("\0\n", 2)), ErrorCode::syntax, 11);
  expectRefusal(readOff(std::string(100000, '\xB7')), ErrorCode::syntax, 1);
}

TEST(ReadOff, RefusesBrokenSyntax) {
  expectRefusal(readOff("OFF\n4 x 6\n" + kBody), ErrorCode::syntax, 2);
  expectRefusal(readOff("OFF\n4\n" + kBody), ErrorCode::syntax, 2);
  expectRefusal(readOff("OFF\n4.0 4 6\n" + kBody), ErrorCode::syntax, 2);
  for (const char *number : {"x", "0,5", "0x1p3", "1e", "--1", "1.2.3", "+", "1_000", "e5"})
    expectRefusal(readOff(replaced(kOffTetrahedron, "0 1 0", std::string("0 ") + number + " 0")),
                  ErrorCode::syntax, 5, "vertex", 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "0 1 0", "0 " + std::string(1000, '1') + " 0")),
                ErrorCode::syntax, 5, "vertex", 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "0 1 0", "0 1")), ErrorCode::syntax, 5, "vertex", 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "3 1 2 3", "3 1 2")), ErrorCode::syntax, 9, "facet", 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "3 1 2 3", "3 1 2 3.5")), ErrorCode::syntax, 9, "facet", 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "3 1 2 3", "-3 1 2 3")), ErrorCode::syntax, 9, "facet", 2);
  expectRefusal(readOff(kOffTetrahedron + "3 0 1 2\n"), ErrorCode::syntax, 11);
}

TEST(ReadOff, RefusesAbsurdCounts) {
  for (const char *counts :
       {"-4 4 6", "4 -4 6", "4000000000 4 6", "4 2147483647 6", "99999999999999999999999 4 6"})
    expectRefusal(readOff("OFF\n" + std::string(counts) + "\n" + kBody), ErrorCode::syntax, 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "3 1 2 3", "2000000000 1 2 3")), ErrorCode::syntax, 9,
                "facet", 2);
}

TEST(ReadOff, RefusesTruncatedFiles) {
  expectRefusal(readOff("OFF\n"), ErrorCode::fileTruncated, 1);
  expectRefusal(readOff("OFF\n4"), ErrorCode::fileTruncated, 2);
  expectRefusal(readOff("OFF\n4 4 6\n0 0 0\n1 0 0\n"), ErrorCode::fileTruncated, 4);
  expectRefusal(readOff("OFF\n4 4 6\n0 0 0\n1 0"), ErrorCode::fileTruncated, 4, "vertex", 1);
  expectRefusal(readOff(kOffTetrahedron.substr(0, kOffTetrahedron.size() - 8)), ErrorCode::fileTruncated, 9);
  expectRefusal(readOff(kOffTetrahedron.substr(0, kOffTetrahedron.size() - 2)), ErrorCode::fileTruncated, 10,
                "facet", 3);
}

TEST(ReadOff, RefusesNumbersThatAreNotFinite) {
  for (const char *number : {"nan", "-NaN", "nan(0x7)", "inf", "-Inf", "INFINITY", "1e999", "-1e999",
                             "1.#INF", "-1.#IND", "1.#QNAN"}) {
    expectRefusal(readOff(replaced(kOffTetrahedron, "0 1 0", std::string("0 ") + number + " 0")),
                  ErrorCode::notFinite, 5, "vertex", 2);
    expectRefusal(readOff(replaced(kOffTetrahedron, "0 1 0", std::string("0 1 ") + number)),
                  ErrorCode::notFinite, 5, "vertex", 2);
  }
}

TEST(ReadOff, RefusesReferencesOutOfRange) {
  for (const char *face : {"3 1 2 4", "3 1 -1 2", "3 99999999999 1 2", "3 1 2 -99999999999999999999999999"})
    expectRefusal(readOff(replaced(kOffTetrahedron, "3 1 2 3", face)), ErrorCode::indexOutOfRange, 9, "facet",
                  2);
}

TEST(ReadOff, RefusesTooLittle) {
  expectRefusal(readOff("OFF\n0 4 6\n" + kBody), ErrorCode::tooFewVertices, 2);
  expectRefusal(readOff("OFF\n4 0 6\n" + kBody), ErrorCode::tooFewFacets, 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "3 1 2 3", "2 1 2")), ErrorCode::degenerateFacet, 9,
                "facet", 2);
  expectRefusal(readOff(replaced(kOffTetrahedron, "3 1 2 3", "0")), ErrorCode::degenerateFacet, 9, "facet",
                2);
}

TEST(ReadOff, SurvivesDamage) {
  expectToSurviveDamage(kOffTetrahedron, readOff);
  expectToSurviveDamage("CNOFF 4 4 6 # a comment\r\n" + kBody, readOff);
}

TEST(ReadOff, ReadsTheSharedFiles) { // those under ../shared/data
  const auto folder = sharedData();
  if (folder.empty()) return;
  for (const std::string &file : sharedFiles(folder, ".off")) {
    SCOPED_TRACE(file);
    EXPECT_EQ(countsOf(domainOf(readOff(readFile(folder / file)))), countsInProvenance(folder, file));
  }
}

TEST(ReadDomain, ChoosesTheReader) {
  EXPECT_TRUE(readDomain("off", kOffTetrahedron).ok());
  EXPECT_FALSE(readDomain("poly", kOffTetrahedron).ok());
  EXPECT_FALSE(readDomain("smesh", kOffTetrahedron).ok());
  const auto square = readDomain("json", R"({"format": "dualblock-domain/1", "dimension": 2,
    "vertices": [[0, 0], [1, 0], [1, 1]], "loops": [[0, 1, 2]]})");
  ASSERT_TRUE(square.ok()) << square.error().message;
  EXPECT_TRUE(std::holds_alternative<Domain<2>>(square.value()));
  for (const char *format : {"", "OFF", ".off", "stl", "a name that is long enough to be cut off"}) {
    const auto result = readDomain(format, kOffTetrahedron);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::formatUnknown);
  }
}

} // namespace
} // namespace dualblock::test
