#include "reference/raw_fill.h"

#include <cmath>
#include <numbers>

#include "base/sort.h"
#include "domain/polygon.h"
#include "reference/tetgen_adaptor.h"

namespace dualblock {
namespace {

template <int N> void orientPositively(ReferenceMesh<N> &mesh) {
  for (std::size_t s = 0; s < mesh.simplices.size(); ++s) {
    if (orientation<N>(mesh.nodes, mesh.simplices[s]) >= 0) continue;
    std::swap(mesh.simplices[s][0], mesh.simplices[s][1]);
    if (!mesh.neighbors.empty()) std::swap(mesh.neighbors[s][0], mesh.neighbors[s][1]);
  }
}

template <int N> void noteNodeSimplices(ReferenceMesh<N> &mesh) {
  mesh.nodeSimplex.assign(mesh.nodes.size(), kNone);
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (const Index v : mesh.simplices[at(s)]) mesh.nodeSimplex[at(v)] = s;
}

/// The face of simplex s that consists of these nodes, or -1.
template <int N> int findFace(const ReferenceMesh<N> &mesh, Index s, std::array<Index, N> nodes) {
  sortItems(nodes);
  for (int i = 0; i < N + 1; ++i)
    if (mesh.sortedFace(s, i) == nodes) return i;
  return -1;
}

bool onFacet(const std::vector<Vec<2>> &vertices, const Facet &facet, const Plane<2> &, const Vec<2> &x) {
  const Vec<2> a = vertices[at(facet.loops[0][0])];
  const Vec<2> d = vertices[at(facet.loops[0][1])] - a;
  const double t = glm::dot(x - a, d) / glm::dot(d, d);
  return t > 0 && t < 1;
}

bool onFacet(const std::vector<Vec<3>> &vertices, const Facet &facet, const Plane<3> &plane,
             const Vec<3> &x) {
  const PlaneBasis basis(plane.normal);
  bool inside = false;
  for (const auto &loop : facet.loops) {
    std::vector<Vec<2>> polygon;
    for (const Index v : loop) polygon.push_back(basis.project(vertices[at(v)]));
    if (insidePolygon(polygon, basis.project(x))) inside = !inside;
  }
  return inside;
}

/// Moves TetGen's own nodes on facets into their planes: a remedy has altered the coordinates that it had,
/// and what is cut off between such nodes would be as far off.
void putOnFacets(Tetrahedra &mesh, const Domain<3> &domain) {
  constexpr double kParallel = 1e-3;         // of what a normal adds to those before it
  std::vector<std::pair<Index, Index>> uses; // node, facet
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const Index node : mesh.faces[f])
      if (at(node) >= domain.vertices.size()) uses.emplace_back(node, mesh.faceFacet[f]);
  sortItems(uses);
  uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
  std::vector<Plane<3>> planes;
  for (const Facet &facet : domain.facets) planes.push_back(facetPlane<3>(domain.vertices, facet));
  std::vector<Vec<3>> held; // directions in which the node stays in the planes before
  for (std::size_t u = 0; u < uses.size(); ++u) {
    if (u == 0 || uses[u].first != uses[u - 1].first) held.clear();
    const Plane<3> &plane = planes[at(uses[u].second)];
    Vec<3> free = plane.normal;
    for (const Vec<3> &h : held) free -= glm::dot(free, h) * h;
    const double size = glm::length(free);
    if (size < kParallel) continue;
    free /= size;
    Vec<3> &x = mesh.nodes[at(uses[u].first)];
    x -= plane.distance(x) / size * free;
    held.push_back(free);
  }
}

} // namespace

Result<RawFill<3>> fillByTetgen(const Domain<3> &domain, double edgeLength) {
  TetgenOptions options{domainSize(domain.vertices)};
  // The volume of a regular tetrahedron of this edge length.
  if (edgeLength > 0) options.maxVolume = edgeLength * edgeLength * edgeLength / (6 * std::numbers::sqrt2);
  auto made = runTetgen(domain.vertices, domain.facets, options);
  if (!made.ok()) return made.error();
  Tetrahedra &tetrahedra = made.value();
  if (!tetrahedra.remedy.empty()) putOnFacets(tetrahedra, domain);
  RawFill<3> fill;
  fill.remedy = tetrahedra.remedy;
  fill.tetgenMilliseconds = tetrahedra.milliseconds;
  fill.mesh.nodes = std::move(tetrahedra.nodes);
  fill.mesh.simplices = std::move(tetrahedra.simplices);
  fill.mesh.neighbors = std::move(tetrahedra.neighbors);
  orientPositively(fill.mesh);
  noteNodeSimplices(fill.mesh);
  for (std::size_t f = 0; f < tetrahedra.faces.size(); ++f) {
    const Index s = tetrahedra.faceSimplices[f][0];
    fill.facetFaces.push_back({s, findFace<3>(fill.mesh, s, tetrahedra.faces[f])});
    fill.facetOfFace.push_back(tetrahedra.faceFacet[f]);
  }
  return fill;
}

Result<RawFill<2>> fillByTetgen(const Domain<2> &domain, double) {
  // A cone over the polygon, holes included: its base is one facet, which TetGen triangulates.
  const double size = domainSize(domain.vertices);
  std::vector<Vec<3>> points;
  Vec<2> centre{0.0};
  for (const Vec<2> &v : domain.vertices) {
    points.emplace_back(v.x, v.y, 0.0);
    centre += v / static_cast<double>(domain.vertices.size());
  }
  const Index apex = toIndex(points.size());
  points.emplace_back(centre.x, centre.y, size);
  // Segments follow one another loop by loop; outer loops run counter-clockwise, holes clockwise.
  std::vector<Facet> facets(1);
  std::vector<std::vector<Index>> inner;
  for (std::size_t begin = 0, end = 0; begin < domain.facets.size(); begin = end) {
    std::vector<Index> loop;
    std::vector<Vec<2>> polygon;
    do {
      const Index v = domain.facets[end].loops[0][0];
      loop.push_back(v);
      polygon.push_back(domain.vertices[at(v)]);
      facets.push_back({{{v, domain.facets[end].loops[0][1], apex}}});
      ++end;
    } while (domain.facets[end - 1].loops[0][1] != loop.front());
    (polygonArea2(polygon) > 0 ? facets[0].loops : inner).push_back(std::move(loop));
  }
  // Several outer loops would be taken for holes of the first: give each its own base facet. A hole belongs
  // to the smallest of those around it; the others have more than that between them and it.
  std::vector<Facet> bases;
  std::vector<std::vector<Vec<2>>> outlines;
  for (auto &loop : facets[0].loops) {
    auto &outline = outlines.emplace_back();
    for (const Index v : loop) outline.push_back(domain.vertices[at(v)]);
    bases.push_back({{std::move(loop)}});
  }
  for (auto &hole : inner) {
    std::size_t owner = outlines.size();
    for (std::size_t o = 0; o < outlines.size(); ++o)
      if (insidePolygon(outlines[o], domain.vertices[at(hole[0])]) &&
          (owner == outlines.size() || polygonArea2(outlines[o]) < polygonArea2(outlines[owner])))
        owner = o;
    if (owner < outlines.size()) bases[owner].loops.push_back(std::move(hole));
  }
  facets.erase(facets.begin());
  facets.insert(facets.begin(), bases.begin(), bases.end());
  auto made = runTetgen(points, facets, {size});
  if (!made.ok()) return made.error();
  const Tetrahedra &cone = made.value();
  RawFill<2> fill;
  fill.remedy = cone.remedy;
  fill.tetgenMilliseconds = cone.milliseconds;
  fill.mesh.nodes = domain.vertices;
  for (std::size_t f = 0; f < cone.faces.size(); ++f) {
    if (at(cone.faceFacet[f]) >= bases.size()) continue;
    for (const Index v : cone.faces[f])
      if (v >= apex)
        return Error{
            ErrorCode::tetgenFailed, "TetGen added a point to the plane domain: give a reference mesh.", {}};
    fill.mesh.simplices.push_back(cone.faces[f]);
  }
  orientPositively(fill.mesh);
  connect(fill.mesh);
  std::vector<std::pair<std::array<Index, 2>, Index>> segments;
  for (std::size_t f = 0; f < domain.facets.size(); ++f) {
    const auto &segment = domain.facets[f].loops[0];
    segments.push_back({{std::min(segment[0], segment[1]), std::max(segment[0], segment[1])}, toIndex(f)});
  }
  sortItems(segments);
  for (Index s = 0; s < fill.mesh.simplexCount(); ++s)
    for (int i = 0; i < 3; ++i) {
      const auto edge = fill.mesh.sortedFace(s, i);
      const auto found = std::lower_bound(segments.begin(), segments.end(), std::pair(edge, Index{0}));
      if (found == segments.end() || found->first != edge) continue;
      fill.facetFaces.push_back({s, i});
      fill.facetOfFace.push_back(found->second);
    }
  return fill;
}

template <int N> Result<RawFill<N>> fillByGiven(const Domain<N> &domain, double planarTolerance) {
  const auto invalid = [](const std::string &what, Index simplex) {
    return Error{ErrorCode::referenceInvalid,
                 "The given reference mesh " + what + ". It must fill the domain, simplex to simplex.",
                 {{"simplex", simplex}}};
  };
  RawFill<N> fill;
  fill.mesh.nodes = domain.reference->nodes;
  fill.mesh.simplices = domain.reference->simplices;
  const double size = domainSize(domain.vertices);
  orientPositively(fill.mesh);
  connect(fill.mesh);
  for (Index s = 0; s < fill.mesh.simplexCount(); ++s)
    if (orientation<N>(fill.mesh.nodes, fill.mesh.simplices[at(s)]) <= 0)
      return invalid("has a simplex " + std::to_string(s) + " of no volume", s);
  if (fill.mesh.simplices.empty()) return invalid("has no simplices", 0);
  std::vector<std::array<Index, N>> faces;
  for (Index s = 0; s < fill.mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i) faces.push_back(fill.mesh.sortedFace(s, i));
  sortItems(faces);
  for (std::size_t f = 0; f + 2 < faces.size(); ++f)
    if (faces[f] == faces[f + 2]) return invalid("has three simplices on one face", 0);
  double filled = 0;
  double enclosed = 0;
  const double factorial = N == 2 ? 2 : 6;
  for (const auto &simplex : fill.mesh.simplices)
    filled += orientation<N>(fill.mesh.nodes, simplex) / factorial;
  for (const Facet &facet : domain.facets) // by the divergence theorem, from facets that point outwards
    enclosed += glm::dot(domain.vertices[at(facet.loops[0][0])] - domain.vertices[0],
                         areaVector(domain.vertices, facet)) /
                factorial;
  if (std::abs(filled - std::abs(enclosed)) > 1e-6 * std::abs(enclosed))
    return invalid("fills a measure of " + std::to_string(filled) + " instead of the domain's " +
                       std::to_string(std::abs(enclosed)),
                   0);
  std::vector<Plane<N>> planes;
  for (const Facet &facet : domain.facets) planes.push_back(facetPlane<N>(domain.vertices, facet));
  for (Index s = 0; s < fill.mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i) {
      if (fill.mesh.neighbors[at(s)][i] != kNone) continue;
      Vec<N> centre{0.0};
      for (const Index v : fill.mesh.sortedFace(s, i))
        centre += fill.mesh.nodes[at(v)] / static_cast<double>(N);
      Index found = kNone;
      for (std::size_t f = 0; f < planes.size() && found == kNone; ++f) {
        bool flat = true;
        for (const Index v : fill.mesh.sortedFace(s, i))
          flat &= std::abs(planes[f].distance(fill.mesh.nodes[at(v)])) <= planarTolerance * size;
        if (flat && onFacet(domain.vertices, domain.facets[f], planes[f], centre)) found = toIndex(f);
      }
      if (found == kNone)
        return invalid("has an outer face, of simplex " + std::to_string(s) + ", on no facet", s);
      for (const Index v : fill.mesh.sortedFace(s, i))
        fill.deviation =
            std::max(fill.deviation, std::abs(planes[at(found)].distance(fill.mesh.nodes[at(v)])));
      fill.facetFaces.push_back({s, i});
      fill.facetOfFace.push_back(found);
    }
  return fill;
}

template Result<RawFill<2>> fillByGiven(const Domain<2> &, double);
template Result<RawFill<3>> fillByGiven(const Domain<3> &, double);

} // namespace dualblock
