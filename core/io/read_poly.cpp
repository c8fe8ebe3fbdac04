#include "io/read_poly.h"

#include <cmath>
#include <limits>

#include "io/facet_polygons.h"
#include "io/text_scanner.h"

namespace dualblock {
namespace {

/// Steps that splitting facets may take in one file: under a second, and enough for 10 000 holes in a facet.
constexpr std::int64_t kSplitSteps = 100'000'000;

class PolyReader {
public:
  PolyReader(std::string_view text, bool smesh) : scanner_(text), smesh_(smesh) {}

  Domain<3> read() {
    scanner_.needText();
    readNodes();
    readFacets();
    if (scanner_.nextLine()) readHoles(); // TetGen does without both lists, too
    if (scanner_.nextLine()) readRegions();
    scanner_.needEnd("entry");
    domain_.isSolid = true; // the format's own rule: only its holes take away
    return std::move(domain_);
  }

private:
  void readNodes() {
    scanner_.needLine("the line with the number of nodes");
    const Index count = scanner_.count("the number of nodes");
    if (count == 0)
      scanner_.refuse(
          ErrorCode::tooFewVertices,
          "the file announces 0 nodes, which means that they are in a separate .node file; that is not "
          "read. Put the node list into this file.");
    if (!scanner_.lineIsDone() && scanner_.integer("the dimension") != 3)
      scanner_.refuse(ErrorCode::syntax, "the dimension must be 3. Give planar domains as json.");
    for (Index v = 0; v < count; ++v) {
      scanner_.needEntry("nodes", v, count);
      scanner_.begin("vertex", v);
      const std::int64_t number = scanner_.integer("the number of a node");
      if (v == 0 && (number == 0 || number == 1)) first_ = number;
      if (v == 0 && number != first_)
        scanner_.refuse(ErrorCode::syntax, "the first node has number " + std::to_string(number) +
                                               ", not 0 or 1. Renumber the nodes, or correct the line.");
      if (number != first_ + v)
        scanner_.refuse(ErrorCode::syntax, "node " + std::to_string(first_ + v) + " should follow, not " +
                                               std::to_string(number) +
                                               ". Number the nodes in order, and check their count.");
      domain_.vertices.push_back(scanner_.point("a node's coordinate"));
      scanner_.end();
    }
  }

  void readFacets() {
    scanner_.needLine("the line with the number of facets");
    const Index count = scanner_.count("the number of facets");
    if (count == 0)
      scanner_.refuse(ErrorCode::tooFewFacets,
                      "the file announces no facets. Give those of a closed surface.");
    std::vector<Facet> further; // after the file's own, so that those keep their numbers
    std::int64_t steps = kSplitSteps;
    for (Index f = 0; f < count; ++f) {
      scanner_.needEntry("facets", f, count);
      scanner_.begin("facet", f);
      FacetPolygons polygons;
      if (smesh_) polygons.polygons.push_back(readPolygon());
      else polygons = readFacet();
      auto split = splitFacet(domain_.vertices, std::move(polygons), steps);
      if (!split.ok()) scanner_.refuse(split.error().code, split.error().message);
      domain_.facets.push_back(std::move(split.value()[0]));
      for (std::size_t k = 1; k < split.value().size(); ++k) further.push_back(std::move(split.value()[k]));
      scanner_.end();
    }
    for (Facet &facet : further) domain_.facets.push_back(std::move(facet));
  }

  /// The lines of one facet of a .poly file; its first line is the current one.
  FacetPolygons readFacet() {
    const Index polygons = scanner_.count("the number of a facet's polygons");
    const Index holes = scanner_.lineIsDone() ? 0 : scanner_.count("the number of a facet's holes");
    if (polygons == 0)
      scanner_.refuse(ErrorCode::degenerateFacet, "the facet has no polygon. Give it one, or remove it.");
    FacetPolygons facet;
    for (Index p = 0; p < polygons; ++p) {
      scanner_.needEntry("the facet's polygons", p, polygons);
      facet.polygons.push_back(readPolygon());
    }
    for (Index h = 0; h < holes; ++h) {
      scanner_.needEntry("the facet's holes", h, holes);
      scanner_.integer("the number of a facet's hole");
      facet.holes.push_back(scanner_.point("a hole's coordinate"));
    }
    return facet;
  }

  /// A number of corners and the corners, which may go on over further lines.
  std::vector<Index> readPolygon() {
    const Index corners = scanner_.count("the number of a polygon's corners");
    if (corners < 3)
      scanner_.refuse(ErrorCode::degenerateFacet,
                      corners == 0
                          ? "the polygon has no corners. Remove it, and lower the facet's count of polygons."
                          : "the polygon has " + std::to_string(corners) +
                                (corners == 1 ? " corner: a single vertex" : " corners: a single segment") +
                                " in the facet, which no block mesh can respect. Remove it, and lower the "
                                "facet's count of polygons.");
    std::vector<Index> loop;
    for (Index k = 0; k < corners; ++k) {
      if (scanner_.lineIsDone()) scanner_.needEntry("the polygon's corners", k, corners);
      loop.push_back(scanner_.vertexIndex(first_, domain_.vertices.size()));
    }
    return loop;
  }

  void readHoles() {
    const Index count = scanner_.count("the number of holes");
    for (Index h = 0; h < count; ++h) {
      scanner_.needEntry("holes", h, count);
      scanner_.begin("hole", h);
      scanner_.integer("the number of a hole");
      domain_.holes.push_back(scanner_.point("a hole's coordinate"));
      scanner_.end();
    }
  }

  void readRegions() {
    const Index count = scanner_.count("the number of regions");
    for (Index r = 0; r < count; ++r) {
      scanner_.needEntry("regions", r, count);
      scanner_.begin("region", r);
      scanner_.integer("the number of a region");
      const Vec<3> point = scanner_.point("a region's coordinate");
      Index id = r + 1;
      if (!scanner_.lineIsDone()) {
        const double attribute = scanner_.number("a region's attribute");
        if (attribute == std::nearbyint(attribute) &&
            std::abs(attribute) <= std::numeric_limits<Index>::max())
          id = static_cast<Index>(attribute);
      }
      domain_.regions.push_back({point, id});
      scanner_.end();
    }
  }

  TextScanner scanner_;
  bool smesh_;
  std::int64_t first_ = 0; // the number of the first node
  Domain<3> domain_;
};

} // namespace

Result<AnyDomain> readPoly(std::string_view text, bool smesh) {
  try {
    return AnyDomain(PolyReader(text, smesh).read());
  } catch (const Refusal &refusal) {
    return refusal.error;
  }
}

} // namespace dualblock
