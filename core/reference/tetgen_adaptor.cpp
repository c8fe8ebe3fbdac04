#include "reference/tetgen_adaptor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <optional>
#include <random>

#include "base/sort.h"
#include "domain/polygon.h"
#include "toolchain/tetgen_fixed.h"

// core/toolchain/tetgen_unit.cpp
void startTetgen(long long points);
void fillWithTetgen(double maxVolume, double epsilon, bool onGrid, tetgenio *in, tetgenio *out);

namespace dualblock {
namespace {

/// One rung of the ladder of remedies.
struct Attempt {
  double epsilon; // coplanarity tolerance; TetGen's own is 1e-8
  const char *remedy;
  bool snap;
  bool shift;
};

constexpr Attempt kAttempts[] = {
    {1e-8, "", false, false},
    {1e-5, "a coplanarity tolerance of 1e-5", false, false},
    {1e-8, "coordinates snapped to 2^-30 of the size", true, false},
    {1e-5, "coordinates snapped to 2^-30 of the size, and a coplanarity tolerance of 1e-5", true, false},
    {1e-7, "a random shift of 1e-9 of the size", false, true},
    {1e-4, "a random shift of 1e-9 of the size, and a coplanarity tolerance of 1e-4", false, true},
};

std::vector<Vec<3>> altered(const std::vector<Vec<3>> &vertices, const Attempt &attempt, double size) {
  std::vector<Vec<3>> points = vertices;
  const double grid = std::ldexp(1.0, std::ilogb(size) - 30);
  std::mt19937 random(1); // its sequence is fixed by the standard, unlike that of the distributions
  for (Vec<3> &p : points)
    for (int k = 0; k < 3; ++k) {
      if (attempt.snap) p[k] = std::round(p[k] / grid) * grid;
      if (attempt.shift) p[k] += (static_cast<double>(random()) / 4294967296.0 - 0.5) * 2e-9 * size;
    }
  return points;
}

/// Everything handed to tetgenio is new[]-ed: its destructor delete[]s it, after errors too.
void fillInput(tetgenio &in, const std::vector<Vec<3>> &points, const std::vector<Facet> &facets) {
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(points.size());
  in.pointlist = new REAL[points.size() * 3];
  for (std::size_t v = 0; v < points.size(); ++v)
    for (int k = 0; k < 3; ++k) in.pointlist[3 * v + static_cast<std::size_t>(k)] = points[v][k];
  in.numberoffacets = static_cast<int>(facets.size());
  in.facetmarkerlist = new int[facets.size()];
  in.facetlist = new tetgenio::facet[facets.size()];
  for (std::size_t f = 0; f < facets.size(); ++f) tetgenio::init(&in.facetlist[f]);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto &loops = facets[f].loops;
    auto &facet = in.facetlist[f];
    in.facetmarkerlist[f] = static_cast<int>(f) + 1;
    facet.polygonlist = new tetgenio::polygon[loops.size()];
    facet.numberofpolygons = static_cast<int>(loops.size());
    for (std::size_t l = 0; l < loops.size(); ++l) tetgenio::init(&facet.polygonlist[l]);
    for (std::size_t l = 0; l < loops.size(); ++l) {
      facet.polygonlist[l].vertexlist = new int[loops[l].size()];
      facet.polygonlist[l].numberofvertices = static_cast<int>(loops[l].size());
      std::copy(loops[l].begin(), loops[l].end(), facet.polygonlist[l].vertexlist);
    }
    if (loops.size() < 2) continue;
    // Loops that run against the facet are holes; others are pieces beside or within them.
    const Plane<3> plane = facetPlane<3>(points, facets[f]);
    const PlaneBasis basis(plane.normal);
    const std::vector<std::vector<Vec<2>>> polygons = projected(points, facets[f], basis);
    const std::vector<std::vector<std::size_t>> around = nestingOf(polygons);
    std::vector<Vec<3>> holes;
    for (std::size_t l = 1; l < loops.size(); ++l) {
      if (polygonArea2(polygons[l]) > 0) continue;
      std::vector<std::vector<Vec<2>>> gap{polygons[l]}; // and the pieces right within
      for (std::size_t m = 1; m < loops.size(); ++m)
        if (around[m].size() == around[l].size() + 1 &&
            std::find(around[m].begin(), around[m].end(), l) != around[m].end())
          gap.push_back(polygons[m]);
      const Vec<2> inside = pointInside(gap);
      holes.push_back(inside.x * basis.u + inside.y * basis.v + plane.offset * plane.normal);
    }
    facet.holelist = new REAL[3 * holes.size()];
    facet.numberofholes = static_cast<int>(holes.size());
    for (std::size_t h = 0; h < holes.size(); ++h)
      for (int k = 0; k < 3; ++k) facet.holelist[3 * h + static_cast<std::size_t>(k)] = holes[h][k];
  }
}

Tetrahedra readOutput(const tetgenio &out) {
  Tetrahedra mesh;
  mesh.nodes.resize(static_cast<std::size_t>(out.numberofpoints));
  for (std::size_t v = 0; v < mesh.nodes.size(); ++v)
    mesh.nodes[v] = {out.pointlist[3 * v], out.pointlist[3 * v + 1], out.pointlist[3 * v + 2]};
  const std::size_t count = static_cast<std::size_t>(out.numberoftetrahedra);
  mesh.simplices.resize(count);
  for (std::size_t s = 0; s < count; ++s)
    for (std::size_t k = 0; k < 4; ++k) mesh.simplices[s][k] = out.tetrahedronlist[4 * s + k];
  // TetGen orders the neighbours by its own face numbers: find each one's place by the missing vertex.
  mesh.neighbors.assign(count, {kNone, kNone, kNone, kNone});
  for (std::size_t s = 0; s < count; ++s)
    for (std::size_t n = 0; n < 4; ++n) {
      const Index t = out.neighborlist[4 * s + n];
      if (t < 0) continue;
      const auto &other = mesh.simplices[at(t)];
      for (std::size_t k = 0; k < 4; ++k)
        if (std::find(other.begin(), other.end(), mesh.simplices[s][k]) == other.end())
          mesh.neighbors[s][k] = t;
    }
  for (std::size_t f = 0; f < static_cast<std::size_t>(out.numberoftrifaces); ++f) {
    if (out.trifacemarkerlist[f] <= 0) continue;
    mesh.faces.push_back({out.trifacelist[3 * f], out.trifacelist[3 * f + 1], out.trifacelist[3 * f + 2]});
    mesh.faceFacet.push_back(out.trifacemarkerlist[f] - 1);
    mesh.faceSimplices.push_back({out.adjtetlist[2 * f], out.adjtetlist[2 * f + 1]});
  }
  return mesh;
}

/// Gives each face of a facet a simplex that has it: TetGen may name deleted ones. False where it lists a
/// face that no simplex has.
bool locateFaces(Tetrahedra &mesh) {
  const auto has = [&](Index s, const std::array<Index, 3> &face) {
    if (s < 0 || at(s) >= mesh.simplices.size()) return false;
    const auto &v = mesh.simplices[at(s)];
    return std::all_of(face.begin(), face.end(),
                       [&](Index node) { return std::find(v.begin(), v.end(), node) != v.end(); });
  };
  struct Missing {
    std::array<Index, 3> face; // sorted
    std::size_t number;
  };
  const auto less = [](const Missing &a, const Missing &b) { return a.face < b.face; };
  std::vector<Missing> missing;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    auto &[first, second] = mesh.faceSimplices[f];
    if (!has(first, mesh.faces[f])) first = second;
    if (has(first, mesh.faces[f])) continue;
    missing.push_back({mesh.faces[f], f});
    sortItems(missing.back().face);
  }
  if (missing.empty()) return true;
  sortItems(missing, less);
  std::size_t found = 0;
  for (Index s = 0; s < toIndex(mesh.simplices.size()); ++s)
    for (std::size_t i = 0; i < 4; ++i) {
      Missing wanted{{}, 0};
      for (std::size_t v = 0, m = 0; v < 4; ++v)
        if (v != i) wanted.face[m++] = mesh.simplices[at(s)][v];
      sortItems(wanted.face);
      const auto place = std::lower_bound(missing.begin(), missing.end(), wanted, less);
      if (place == missing.end() || place->face != wanted.face) continue;
      Index &simplex = mesh.faceSimplices[place->number][0];
      if (has(simplex, wanted.face)) continue; // from its other side
      simplex = s;
      ++found;
    }
  return found == missing.size();
}

/// Whether the faces cover each facet: TetGen has been seen to lose whole cells of an assembly. `lost`
/// becomes a facet without any face.
bool coversFacets(const Tetrahedra &mesh, const std::vector<Facet> &facets, Index &lost) {
  std::vector<double> covered(facets.size(), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto &[a, b, c] = mesh.faces[f];
    covered[at(mesh.faceFacet[f])] +=
        glm::length(glm::cross(mesh.nodes[at(b)] - mesh.nodes[at(a)], mesh.nodes[at(c)] - mesh.nodes[at(a)]));
  }
  bool all = true;
  lost = kNone;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const double area = glm::length(areaVector(mesh.nodes, facets[f]));
    all = all && std::abs(covered[f] - area) <= 1e-4 * area;
    if (covered[f] == 0 && lost == kNone) lost = toIndex(f);
  }
  return all;
}

/// Whether a tetrahedron has no volume beyond rounding, as TetGen leaves some between coplanar vertices.
bool hasFlat(const Tetrahedra &mesh) {
  constexpr double kFlat = 1e-14; // of the cube of the longest edge
  return std::any_of(mesh.simplices.begin(), mesh.simplices.end(), [&](const std::array<Index, 4> &s) {
    std::array<Vec<3>, 3> e;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = mesh.nodes[at(s[k + 1])] - mesh.nodes[at(s[0])];
      longest = std::max(longest, glm::length(e[k]));
    }
    return std::abs(glm::dot(e[0], glm::cross(e[1], e[2]))) <= kFlat * longest * longest * longest;
  });
}

Error explain(int code) {
  switch (code) {
  case 1:
    return {ErrorCode::outOfMemory, "TetGen ran out of memory: refine less, or simplify the domain.", {}};
  case 3:
    return {
        ErrorCode::selfIntersection,
        "TetGen found that the boundary crosses itself: repair the surface so that facets meet only along "
        "shared edges.",
        {}};
  default:
    return {
        ErrorCode::tetgenFailed,
        "TetGen could not fill the domain, although its input was also tried with a wider tolerance, snapped "
        "and shifted: look for facets that nearly touch, or give a reference mesh of your own.",
        {}};
  }
}

} // namespace

Result<Tetrahedra> runTetgen(const std::vector<Vec<3>> &vertices, const std::vector<Facet> &facets,
                             const TetgenOptions &options) {
  int lastCode = 2;
  Index lost = kNone;               // a facet that the first result had no face of
  std::optional<Tetrahedra> flawed; // what has flat tetrahedra may still serve, if there is no other
  const auto start = std::chrono::steady_clock::now();
  for (const Attempt &attempt : kAttempts) {
    const bool plain = !attempt.snap && !attempt.shift;
    const std::vector<Vec<3>> points = plain ? vertices : altered(vertices, attempt, options.size);
    tetgenio in;
    tetgenio out;
    try {
      fillInput(in, points, facets);
      startTetgen(static_cast<long long>(points.size()));
      fillWithTetgen(options.maxVolume, attempt.epsilon, options.onGrid, &in, &out);
    } catch (int code) {
      lastCode = code;
      if (code == 1) break;
      continue;
    } catch (const std::bad_alloc &) {
      lastCode = 1;
      break;
    }
    if (out.numberoftetrahedra == 0) continue;
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    Tetrahedra mesh = readOutput(out);
    if (mesh.nodes.size() < vertices.size()) continue;
    std::copy(vertices.begin(), vertices.end(), mesh.nodes.begin());
    Index lostHere = kNone;
    const bool covers = coversFacets(mesh, facets, lostHere);
    if (lost == kNone) lost = lostHere;
    if (!locateFaces(mesh) || !covers) continue;
    mesh.remedy = attempt.remedy;
    mesh.milliseconds = spent.count();
    if (!hasFlat(mesh)) return mesh;
    if (!flawed) flawed = std::move(mesh);
  }
  if (flawed) return *flawed;
  Error error = explain(lastCode);
  if (lost != kNone) error.entities.push_back({"facet", lost});
  return error;
}

} // namespace dualblock
