#include "io/read_off.h"

#include "io/text_scanner.h"

namespace dualblock {
namespace {

/// What stands before "OFF" in the header's keyword, without the groups that announce what is skipped anyway.
std::string_view unknownPrefix(std::string_view prefix) {
  for (;;) {
    if (prefix.substr(0, 2) == "ST") prefix.remove_prefix(2);
    else if (prefix.substr(0, 1) == "C" || prefix.substr(0, 1) == "N") prefix.remove_prefix(1);
    else return prefix;
  }
}

void readHeader(TextScanner &scanner) {
  scanner.needLine("an OFF surface");
  const std::string_view keyword = scanner.token("\"OFF\"");
  if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF") {
    scanner.needText();
    scanner.refuse(ErrorCode::syntax,
                   "the file must begin with \"OFF\". Add that line, or choose another format.");
  }
  const std::string_view unknown = unknownPrefix(keyword.substr(0, keyword.size() - 3));
  if (unknown == "4" || unknown == "n" || unknown == "4n")
    scanner.refuse(ErrorCode::syntax,
                   "this is OFF of more dimensions than three (4OFF, nOFF). Write the surface "
                   "with three coordinates per vertex, as \"OFF\".");
  if (!unknown.empty())
    scanner.refuse(ErrorCode::syntax, "this variant of OFF is unknown. Write the surface as plain \"OFF\".");
}

/// The counts of vertices and faces; that of edges is often wrong, and nothing needs it.
void readCounts(TextScanner &scanner, Index &vertices, Index &faces) {
  if (scanner.lineIsDone()) scanner.needLine("the line with the numbers of vertices and faces");
  const char *ofVertices = "the number of vertices";
  TextScanner ahead = scanner;
  if (ahead.token(ofVertices) == "BINARY")
    scanner.refuse(ErrorCode::syntax,
                   "this is binary OFF, of which only the text form is read. Save it as text.");
  scanner.needText();
  vertices = scanner.count(ofVertices);
  faces = scanner.count("the number of faces");
  if (vertices == 0)
    scanner.refuse(ErrorCode::tooFewVertices,
                   "the file announces no vertices. Give those of a closed surface.");
  if (faces == 0)
    scanner.refuse(ErrorCode::tooFewFacets, "the file announces no faces. Give those of a closed surface.");
}

std::vector<Index> readFace(TextScanner &scanner, std::size_t vertices) {
  const Index corners = scanner.count("the number of a face's corners");
  if (corners < 3)
    scanner.refuse(ErrorCode::degenerateFacet,
                   "the face has " + std::to_string(corners) +
                       " corners; it needs at least 3. Remove it or complete it.");
  std::vector<Index> loop;
  for (Index k = 0; k < corners; ++k) loop.push_back(scanner.vertexIndex(0, vertices));
  return loop;
}

} // namespace

Result<AnyDomain> readOff(std::string_view text) {
  try {
    TextScanner scanner(text);
    Domain<3> domain;
    Index vertices = 0;
    Index faces = 0;
    readHeader(scanner);
    readCounts(scanner, vertices, faces);
    for (Index v = 0; v < vertices; ++v) {
      scanner.needEntry("vertices", v, vertices);
      scanner.begin("vertex", v);
      domain.vertices.push_back(scanner.point("a vertex's coordinate"));
      scanner.end();
    }
    for (Index f = 0; f < faces; ++f) {
      scanner.needEntry("faces", f, faces);
      scanner.begin("facet", f);
      domain.facets.push_back({{readFace(scanner, domain.vertices.size())}});
      scanner.end();
    }
    scanner.needEnd("face");
    return AnyDomain(std::move(domain));
  } catch (const Refusal &refusal) {
    return refusal.error;
  }
}

} // namespace dualblock
