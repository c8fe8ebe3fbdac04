#include "reference/fill.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "domain/polygon.h"
#include "reference/patches.h"
#include "reference/raw_fill.h"
#include "reference/refine.h"
#include "reference/unpinch.h"

namespace dualblock {
namespace {

template <int N> struct Crossing {
  Index cell, neighbor; // kNone: the outside
  bool intoFront;       // the neighbour is in front of the facet as given
};

/// Each facet's contacts between cells, one per facet and pair of cells.
template <int N> std::vector<Crossing<N>> crossings(const RawFill<N> &fill, const std::vector<Index> &cell) {
  const ReferenceMesh<N> &mesh = fill.mesh;
  // Per facet face, which side the simplex is on; a flat simplex cannot tell, so the facet's best face does.
  std::vector<double> best(mesh.surfaces.size(), 0);
  std::vector<Crossing<N>> found(mesh.surfaces.size(), {kNone, kNone, false});
  for (std::size_t f = 0; f < fill.facetFaces.size(); ++f) {
    const auto [s, i] = fill.facetFaces[f];
    const Index facet = fill.facetOfFace[f];
    const double d = mesh.surfaces[at(facet)].plane.distance(mesh.nodes[at(mesh.simplices[at(s)][i])]);
    if (std::abs(d) <= best[at(facet)]) continue;
    best[at(facet)] = std::abs(d);
    const Index t = mesh.neighbors[at(s)][i];
    found[at(facet)] = {cell[at(s)], t == kNone ? kNone : cell[at(t)], d < 0};
  }
  return found;
}

/// Facets that hang together over edges (2D: vertices). Where an odd number of them meets, they enclose
/// several regions.
struct Shells {
  std::vector<Index> ofFacet;
  std::vector<bool> isAssembly;
};

template <int N> Shells findShells(const Domain<N> &domain) {
  std::vector<std::pair<std::array<Index, 2>, Index>> uses; // (edge, facet)
  for (std::size_t f = 0; f < domain.facets.size(); ++f)
    for (const auto &loop : domain.facets[f].loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        uses.push_back({N == 2 ? std::array<Index, 2>{loop[k], loop[k]}
                               : sortedPair(loop[k], loop[(k + 1) % loop.size()]),
                        toIndex(f)});
  sortItems(uses);
  DisjointSets sets(domain.facets.size());
  for (std::size_t u = 1; u < uses.size(); ++u)
    if (uses[u].first == uses[u - 1].first) sets.unite(uses[u].second, uses[u - 1].second);
  Shells shells;
  Index count = 0;
  shells.ofFacet = sets.numbering(count);
  shells.isAssembly.assign(at(count), false);
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].first == uses[begin].first) ++end;
    if ((end - begin) % 2 == 1) shells.isAssembly[at(shells.ofFacet[at(uses[begin].second)])] = true;
  }
  return shells;
}

/// Which cells belong to the domain, from the outside in: who crosses a shell from its outer side changes
/// sides, so that shells inside shells are cavities; within an assembly, and across an interface, nothing
/// changes.
template <int N>
std::vector<bool> insideCells(const std::vector<Crossing<N>> &contacts, const Domain<N> &domain,
                              Index cellCount) {
  const Shells shells = findShells(domain);
  const auto number = [&](Index cell) { return cell == kNone ? cellCount : cell; };
  // Facets around each cell, the outside being the last one.
  const Lists<Index> ofCell = collectLists<Index>(at(cellCount) + 1, [&](auto put) {
    for (std::size_t f = 0; f < contacts.size(); ++f)
      for (const Index cell : {contacts[f].cell, contacts[f].neighbor}) put(number(cell), toIndex(f));
  });

  std::vector<bool> inside(at(cellCount) + 1, false);
  std::vector<bool> known(at(cellCount) + 1, false);
  std::vector<Index> outerCell(shells.isAssembly.size(), kNone); // from which a shell was reached first
  std::vector<Index> queue{cellCount};
  known[at(cellCount)] = true;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Index here = queue[head];
    for (const Index *f = ofCell.begin(here); f != ofCell.end(here); ++f) {
      const Index there = number(contacts[at(*f)].cell) + number(contacts[at(*f)].neighbor) - here;
      const std::size_t shell = at(shells.ofFacet[at(*f)]);
      if (outerCell[shell] == kNone) outerCell[shell] = here;
      if (known[at(there)]) continue;
      known[at(there)] = true;
      const bool changes =
          !domain.facets[at(*f)].isInterface && (!shells.isAssembly[shell] || outerCell[shell] == here);
      inside[at(there)] = inside[at(here)] != changes;
      queue.push_back(there);
    }
  }
  inside.pop_back();
  return inside;
}

struct Located {
  Index simplex = kNone;   // that holds the point deepest; kNone where it is outside of all
  bool onBoundary = false; // on a facet, within rounding
};

/// By barycentric coordinates. Points given by users often lie on faces of simplices.
template <int N> [[gnu::noinline]] Located locate(const ReferenceMesh<N> &mesh, const Vec<N> &x) {
  constexpr double kOnFace = 1e-9;
  std::vector<Vec<N>> nodes = mesh.nodes;
  nodes.push_back(x);
  Located best;
  double deepest = -kOnFace;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    const double whole = orientation<N>(mesh.nodes, mesh.simplices[at(s)]);
    if (!(whole > 0)) continue;
    double depth = 1;
    bool touches = false;
    for (int i = 0; i < N + 1 && depth > -kOnFace; ++i) {
      auto corner = mesh.simplices[at(s)];
      corner[i] = mesh.nodeCount();
      const double height = orientation<N>(nodes, corner) / whole;
      depth = std::min(depth, height);
      touches = touches || (height < kOnFace && mesh.tags[at(s)][i] != kNone);
    }
    if (depth <= -kOnFace) continue;
    best.onBoundary = best.onBoundary || touches;
    if (depth <= deepest) continue;
    deepest = depth;
    best.simplex = s;
  }
  return best;
}

template <int N> [[gnu::noinline]] bool insideBox(const std::vector<Vec<N>> &vertices, const Vec<N> &x) {
  bool above = true;
  bool below = true;
  for (int k = 0; k < N; ++k) {
    const auto less = [&](const Vec<N> &v) { return v[k] < x[k]; };
    const auto more = [&](const Vec<N> &v) { return v[k] > x[k]; };
    above &= std::any_of(vertices.begin(), vertices.end(), less);
    below &= std::any_of(vertices.begin(), vertices.end(), more);
  }
  return above && below;
}

/// Drops the simplices outside, and tags those that remain.
template <int N>
void keepInside(RawFill<N> &fill, const std::vector<bool> &inside, const std::vector<Index> &cell) {
  ReferenceMesh<N> &mesh = fill.mesh;
  std::vector<Index> moved(mesh.simplices.size(), kNone);
  Index next = 0;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    if (inside[at(cell[at(s)])]) moved[at(s)] = next++;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    if (moved[at(s)] == kNone) continue;
    const std::size_t to = at(moved[at(s)]);
    mesh.simplices[to] = mesh.simplices[at(s)];
    mesh.tags[to] = mesh.tags[at(s)];
    mesh.region[to] = mesh.region[at(s)];
    for (int i = 0; i < N + 1; ++i) {
      const Index t = mesh.neighbors[at(s)][i];
      mesh.neighbors[to][i] = t == kNone ? kNone : moved[at(t)];
    }
  }
  mesh.simplices.resize(at(next));
  mesh.tags.resize(at(next));
  mesh.neighbors.resize(at(next));
  mesh.region.resize(at(next));
  mesh.nodeSimplex.assign(mesh.nodes.size(), kNone);
  for (Index s = 0; s < next; ++s)
    for (const Index v : mesh.simplices[at(s)]) mesh.nodeSimplex[at(v)] = s;
}

/// Numbers the connected pieces by their lowest facet, and where they share it by their lowest vertices, so
/// that two meshes of one domain number them alike.
template <int N> void findComponents(ReferenceMesh<N> &mesh, Index vertexCount) {
  const std::vector<Index> raw = floodPieces(mesh, mesh.componentCount, [](Index, int) { return false; });
  struct Key {
    Index facet;
    std::vector<Index> vertices;
    Index raw;
    bool operator<(const Key &o) const { return std::tie(facet, vertices) < std::tie(o.facet, o.vertices); }
  };
  std::vector<Key> keys;
  for (Index c = 0; c < mesh.componentCount; ++c) keys.push_back({toIndex(mesh.surfaces.size()), {}, c});
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    Key &key = keys[at(raw[at(s)])];
    for (int i = 0; i < N + 1; ++i) {
      if (mesh.tags[at(s)][i] != kNone)
        key.facet = std::min(key.facet, FaceTag::surface(mesh.tags[at(s)][i]));
      if (mesh.componentCount > 1 && mesh.simplices[at(s)][i] < vertexCount)
        key.vertices.push_back(mesh.simplices[at(s)][i]);
    }
  }
  for (Key &key : keys) {
    sortItems(key.vertices);
    key.vertices.erase(std::unique(key.vertices.begin(), key.vertices.end()), key.vertices.end());
  }
  sortItems(keys);
  std::vector<Index> number(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) number[at(keys[k].raw)] = toIndex(k);
  mesh.component.resize(raw.size());
  for (std::size_t s = 0; s < raw.size(); ++s) mesh.component[s] = number[at(raw[s])];
}

/// Turns each outer facet's plane so that its normal points out, and tags every facet face by its side.
template <int N>
void orientFacets(RawFill<N> &fill, const std::vector<Crossing<N>> &contacts,
                  const std::vector<bool> &inside) {
  ReferenceMesh<N> &mesh = fill.mesh;
  std::vector<bool> cellIsBehind(mesh.surfaces.size(), true);
  for (std::size_t f = 0; f < contacts.size(); ++f) {
    if (contacts[f].cell == kNone) continue;
    const auto isIn = [&](Index c) { return c != kNone && inside[at(c)]; };
    bool behind = contacts[f].intoFront;
    // Outer facets: the one side that is in the domain must be behind. Interfaces stay as they are given, for
    // another mesh numbers the cells otherwise.
    const bool outer = isIn(contacts[f].cell) != isIn(contacts[f].neighbor);
    const bool wanted = outer ? isIn(contacts[f].cell) : behind;
    if (behind != wanted && contacts[f].cell != contacts[f].neighbor) {
      mesh.surfaces[f].plane = {-mesh.surfaces[f].plane.normal, -mesh.surfaces[f].plane.offset};
      behind = !behind;
    }
    cellIsBehind[f] = behind;
  }
  Index cellCount = 0;
  const std::vector<Index> cell = floodUntagged(mesh, cellCount);
  for (std::size_t f = 0; f < fill.facetFaces.size(); ++f) {
    const auto [s, i] = fill.facetFaces[f];
    const std::size_t facet = at(fill.facetOfFace[f]);
    bool behind = (cell[at(s)] == contacts[facet].cell) == cellIsBehind[facet];
    // A wall inside one cell, or another piece of the facet, between other cells: only the plane can tell.
    const bool isKnown = cell[at(s)] == contacts[facet].cell || cell[at(s)] == contacts[facet].neighbor;
    if (contacts[facet].cell == contacts[facet].neighbor || !isKnown)
      behind = mesh.surfaces[facet].plane.distance(mesh.nodes[at(mesh.simplices[at(s)][i])]) < 0;
    mesh.tags[at(s)][i] = behind ? FaceTag::back(toIndex(facet)) : FaceTag::front(toIndex(facet));
    const Index t = mesh.neighbors[at(s)][i];
    if (t != kNone) mesh.tags[at(t)][mesh.mirrorFace(s, i)] = FaceTag::flipped(mesh.tags[at(s)][i]);
  }
}

/// What is wrong with where a hole or a region is.
[[gnu::noinline]] Error pointError(ErrorCode code, const char *kind, std::size_t number, const char *name,
                                   const std::string &where) {
  return {
      code, name + std::to_string(number) + " lies " + where, {{kind, static_cast<std::int64_t>(number)}}};
}

/// Far too fine a mesh is refused before anybody waits for it.
[[gnu::noinline]] std::optional<Error> checkEdgeLength(double edgeLength, double simplices) {
  constexpr double kMost = 5e7; // ten times what 4 GB hold
  if (simplices <= kMost) return std::nullopt;
  return Error{ErrorCode::badOption,
               "Edges of " + formatNumber(edgeLength) + " would take about " + formatNumber(simplices) +
                   " simplices, and " + formatNumber(kMost) + " are the most: give a longer edge length.",
               {}};
}

/// How many regular simplices of an edge length have the measure of the domain.
template <int N> [[gnu::noinline]] double simplicesOf(const Domain<N> &domain, double edgeLength) {
  if (!(edgeLength > 0)) return 0;
  double measure = 0; // by the divergence theorem
  for (const Facet &facet : domain.facets)
    measure += glm::dot(domain.vertices[at(facet.loops[0][0])] - domain.vertices[0],
                        areaVector(domain.vertices, facet));
  // N! times the measure; that of a simplex is 0.866 and 0.707.
  double simplex = N == 2 ? 0.866 : 0.707;
  for (int k = 0; k < N; ++k) simplex *= edgeLength;
  return std::abs(measure) / simplex;
}

} // namespace

template <int N> Result<Filled<N>> fillDomain(const Domain<N> &domain, const FillOptions &options) {
  if (!domain.reference)
    if (auto error = checkEdgeLength(options.edgeLength, simplicesOf(domain, options.edgeLength)))
      return *error;
  auto made = domain.reference ? fillByGiven(domain, options.planarTolerance)
                               : fillByTetgen(domain, options.edgeLength);
  if (!made.ok()) return made.error();
  RawFill<N> &fill = made.value();
  ReferenceMesh<N> &mesh = fill.mesh;
  mesh.size = domainSize(domain.vertices);
  mesh.region.assign(mesh.simplices.size(), 0);
  typename ReferenceMesh<N>::Simplex none;
  none.fill(kNone);
  mesh.tags.assign(mesh.simplices.size(), none);
  for (std::size_t f = 0; f < domain.facets.size(); ++f)
    mesh.surfaces.push_back(
        {SurfaceKind::facet, toIndex(f), facetPlane<N>(domain.vertices, domain.facets[f])});
  for (std::size_t f = 0; f < fill.facetFaces.size(); ++f) { // provisional: only that there is a facet
    const auto [s, i] = fill.facetFaces[f];
    const Index t = mesh.neighbors[at(s)][i];
    mesh.tags[at(s)][i] = FaceTag::back(fill.facetOfFace[f]);
    if (t != kNone) mesh.tags[at(t)][mesh.mirrorFace(s, i)] = FaceTag::back(fill.facetOfFace[f]);
  }

  Index cellCount = 0;
  const std::vector<Index> cell = floodUntagged(mesh, cellCount);
  const std::vector<Crossing<N>> contacts = crossings(fill, cell);
  std::vector<bool> inside(at(cellCount), true);
  if (!domain.isSolid && !domain.reference) inside = insideCells(contacts, domain, cellCount);
  std::vector<Index> regionOfCell(at(cellCount), 0);
  std::vector<std::size_t> namedBy(at(cellCount), domain.regions.size());
  for (std::size_t r = 0; r < domain.regions.size(); ++r) {
    const auto refused = [&](const std::string &what) {
      return pointError(ErrorCode::regionOutside, "region", r, "The point of region ", what);
    };
    const Located place = locate(mesh, domain.regions[r].point);
    if (place.simplex == kNone) return refused("outside the domain: move it inside.");
    if (place.onBoundary) return refused("on a facet, between two regions: move it inside its own.");
    const std::size_t c = at(cell[at(place.simplex)]);
    if (namedBy[c] < r && domain.regions[namedBy[c]].id != domain.regions[r].id)
      return refused("in the same region as that of region " + std::to_string(namedBy[c]) +
                     ", which has another id: no facet is between them. Move or remove one of them.");
    namedBy[c] = r;
    regionOfCell[c] = domain.regions[r].id;
    inside[c] = true; // who names a region means it to be meshed
  }
  for (std::size_t s = 0; s < cell.size(); ++s) mesh.region[s] = regionOfCell[at(cell[s])];
  for (std::size_t h = 0; h < domain.holes.size(); ++h) {
    const auto refused = [&](const char *where) {
      return pointError(ErrorCode::holeOutside, "hole", h, "Hole ",
                        std::string(where) + ": move its point into the cavity, or remove it.");
    };
    const Located place = locate(mesh, domain.holes[h]);
    if (place.simplex == kNone && !insideBox(domain.vertices, domain.holes[h]))
      return refused("outside the domain");
    if (place.simplex == kNone) continue; // a pocket that is open to the outside is empty anyway
    if (place.onBoundary) return refused("on a facet");
    inside[at(cell[at(place.simplex)])] = false;
  }
  orientFacets(fill, contacts, inside);
  keepInside(fill, inside, cell);
  if (mesh.simplices.empty())
    return Error{ErrorCode::emptyDomain,
                 "Nothing is left of the domain: its holes take away all that it encloses.",
                 {}};
  findComponents(mesh, toIndex(domain.vertices.size()));
  unpinch(mesh);
  if constexpr (N == 3) joinSmoothFacets(mesh, options.featureAngle);
  if (N == 2 && options.edgeLength > 0 && !domain.reference) splitLongEdges(mesh, options.edgeLength);
  if (options.seed > 0) splitRandomEdges(mesh, options.seed);
  return Filled<N>{std::move(mesh), std::move(fill.remedy), fill.tetgenMilliseconds, fill.deviation};
}

template Result<Filled<2>> fillDomain(const Domain<2> &, const FillOptions &);
template Result<Filled<3>> fillDomain(const Domain<3> &, const FillOptions &);

} // namespace dualblock
