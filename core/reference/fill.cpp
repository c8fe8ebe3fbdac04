#include "reference/fill.h"

#include <cmath>

#include "domain/polygon.h"
#include "reference/raw_fill.h"
#include "reference/refine.h"

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

/// Which cells belong to the domain: between closed shells by parity, else by the facets' orientation where
/// that is consistent, else all.
template <int N>
std::vector<bool> insideCells(const std::vector<Crossing<N>> &contacts, Index cellCount,
                              bool shellsAreClosed) {
  constexpr int kUnset = -1000;
  std::vector<int> depth(at(cellCount), kUnset);
  std::vector<int> winding(at(cellCount), kUnset);
  bool consistent = true;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Crossing<N> &c : contacts) {
      if (c.cell == kNone) continue;
      const auto visit = [&](Index from, Index to, bool toFront) {
        const int d = from == kNone ? 0 : depth[at(from)];
        const int w = from == kNone ? 0 : winding[at(from)];
        if (to == kNone || d == kUnset) return;
        const int next = toFront ? w - 1 : w + 1;
        if (depth[at(to)] == kUnset) {
          depth[at(to)] = d + 1;
          winding[at(to)] = next;
          changed = true;
        }
        if (winding[at(to)] != next) consistent = false;
      };
      visit(c.neighbor, c.cell, !c.intoFront);
      visit(c.cell, c.neighbor, c.intoFront);
    }
  }
  for (const int w : winding) consistent &= w == 0 || w == 1;
  std::vector<bool> inside(at(cellCount), true);
  for (std::size_t c = 0; c < inside.size(); ++c) {
    if (shellsAreClosed) inside[c] = depth[c] % 2 == 1;
    else if (consistent) inside[c] = winding[c] == 1;
  }
  return inside;
}

template <int N> Index locate(const ReferenceMesh<N> &mesh, const Vec<N> &x) {
  std::vector<Vec<N>> nodes = mesh.nodes;
  nodes.push_back(x);
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    bool inside = true;
    for (int i = 0; i < N + 1 && inside; ++i) {
      auto corner = mesh.simplices[at(s)];
      corner[i] = mesh.nodeCount();
      inside = orientation<N>(nodes, corner) >= 0; // on a face counts
    }
    if (inside) return s;
  }
  return kNone;
}

template <int N> bool insideBox(const std::vector<Vec<N>> &vertices, const Vec<N> &x) {
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
    // Outer facets: the one side that is in the domain must be behind. Interfaces stay as given.
    if (isIn(contacts[f].cell) != isIn(contacts[f].neighbor) && behind != isIn(contacts[f].cell)) {
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
    const bool behind = (cell[at(s)] == contacts[facet].cell) == cellIsBehind[facet];
    mesh.tags[at(s)][i] = behind ? FaceTag::back(toIndex(facet)) : FaceTag::front(toIndex(facet));
    const Index t = mesh.neighbors[at(s)][i];
    if (t != kNone) mesh.tags[at(t)][mesh.mirrorFace(s, i)] = FaceTag::flipped(mesh.tags[at(s)][i]);
  }
}

} // namespace

template <int N> Result<Filled<N>> fillDomain(const Domain<N> &domain, const FillOptions &options) {
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
  std::vector<bool> inside = insideCells(contacts, cellCount, options.shellsAreClosed && !domain.reference);
  for (std::size_t h = 0; h < domain.holes.size(); ++h) {
    const Index s = locate(mesh, domain.holes[h]);
    if (s == kNone && !insideBox(domain.vertices, domain.holes[h]))
      return Error{ErrorCode::holeOutside,
                   "Hole " + std::to_string(h) +
                       " lies outside the domain: move its point into the cavity, or "
                       "remove it.",
                   {{"hole", static_cast<std::int64_t>(h)}}};
    if (s == kNone) continue; // a pocket that is open to the outside is empty anyway
    inside[at(cell[at(s)])] = false;
  }
  for (std::size_t r = 0; r < domain.regions.size(); ++r) {
    const Index s = locate(mesh, domain.regions[r].point);
    if (s == kNone)
      return Error{ErrorCode::regionOutside,
                   "The point of region " + std::to_string(r) + " lies outside the domain: move it inside.",
                   {{"region", static_cast<std::int64_t>(r)}}};
    for (Index t = 0; t < mesh.simplexCount(); ++t)
      if (cell[at(t)] == cell[at(s)]) mesh.region[at(t)] = domain.regions[r].id;
  }
  orientFacets(fill, contacts, inside);
  keepInside(fill, inside, cell);
  if (mesh.simplices.empty())
    return Error{ErrorCode::emptyDomain,
                 "Nothing is left of the domain: its holes take away all that it encloses.",
                 {}};
  if (N == 2 && options.edgeLength > 0 && !domain.reference) splitLongEdges(mesh, options.edgeLength);
  if (options.seed > 0) splitRandomEdges(mesh, options.seed);
  return Filled<N>{std::move(mesh), std::move(fill.remedy), fill.tetgenMilliseconds, fill.deviation};
}

template Result<Filled<2>> fillDomain(const Domain<2> &, const FillOptions &);
template Result<Filled<3>> fillDomain(const Domain<3> &, const FillOptions &);

} // namespace dualblock
