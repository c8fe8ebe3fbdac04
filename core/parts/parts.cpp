#include "parts/parts.h"

#include <cmath>
#include <numbers>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/sort.h"

namespace dualblock {
namespace {

template <int N> struct BoundaryFaces {
  std::vector<FaceRef<N>> faces;
  std::vector<std::array<Index, N + 1>> indexOf; // per simplex and face, or kNone
  std::vector<std::array<Index, N + 1>> mates;   // per boundary face: across the ridge without vertex k
};

/// The vertex of a face that is not on the ridge of simplex s that its faces i and k share.
template <int N> int offRidge(const ReferenceMesh<N> &mesh, Index s, int i, int k, const FaceRef<N> &face) {
  const auto &ridge = mesh.simplices[at(s)];
  for (int v = 0; v < N + 1; ++v) {
    const Index node = mesh.simplices[at(face.simplex)][v];
    if (v == face.face) continue;
    bool onRidge = false;
    for (int r = 0; r < N + 1; ++r) onRidge |= r != i && r != k && ridge[r] == node;
    if (!onRidge) return v;
  }
  return -1; // no simplex has all of a face on one ridge
}

template <int N> BoundaryFaces<N> findBoundaryFaces(const ReferenceMesh<N> &mesh) {
  BoundaryFaces<N> boundary;
  std::array<Index, N + 1> none;
  none.fill(kNone);
  boundary.indexOf.assign(mesh.simplices.size(), none);
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i)
      if (mesh.tags[at(s)][i] != kNone) {
        boundary.indexOf[at(s)][i] = toIndex(boundary.faces.size());
        boundary.faces.push_back({s, i});
      }
  boundary.mates.assign(boundary.faces.size(), none);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    for (int k = 0; k < N + 1; ++k) {
      const auto [s, i] = boundary.faces[f];
      if (k == i || boundary.mates[f][k] != kNone) continue;
      const FaceRef<N> mate = turnAroundRidge(mesh, s, i, k, kCrossNone, [](Index) {});
      const Index g = boundary.indexOf[at(mate.simplex)][mate.face];
      boundary.mates[f][k] = g;
      boundary.mates[at(g)][offRidge(mesh, s, i, k, mate)] = toIndex(f);
    }
  return boundary;
}

template <int N>
std::array<Index, N - 1> ridgeNodes(const ReferenceMesh<N> &mesh, const FaceRef<N> &f, int k) {
  std::array<Index, N - 1> ridge{};
  for (int v = 0, m = 0; v < N + 1; ++v)
    if (v != f.face && v != k) ridge[m++] = mesh.simplices[at(f.simplex)][v];
  sortItems(ridge);
  return ridge;
}

/// How the face f of a part and its mate meet at the ridge of f without vertex k, from the planes of their
/// surfaces; only the sense of turning comes from the simplex.
template <int N>
RidgeFrame<N> frameAt(const ReferenceMesh<N> &mesh, const FaceRef<N> &f, int k, const FaceRef<N> &mate) {
  RidgeFrame<N> frame;
  frame.tags = {mesh.tags[at(f.simplex)][f.face], mesh.tags[at(mate.simplex)][mate.face]};
  frame.outward = mesh.outwardNormal(f.simplex, f.face);
  const Vec<N> mateOutward = mesh.outwardNormal(mate.simplex, mate.face);
  const auto &s = mesh.simplices[at(f.simplex)];
  const std::array<Index, N - 1> ridge = ridgeNodes(mesh, f, k);
  if constexpr (N == 2) {
    frame.into = {-frame.outward.y, frame.outward.x};
  } else {
    frame.into =
        glm::cross(frame.outward, glm::normalize(mesh.nodes[at(ridge[1])] - mesh.nodes[at(ridge[0])]));
  }
  if (glm::dot(frame.into, mesh.nodes[at(s[k])] - mesh.nodes[at(ridge[0])]) < 0) frame.into = -frame.into;
  // Convex: the mate's outward normal leans away from f; reflex: it leans back over f.
  frame.angle =
      std::numbers::pi - std::atan2(-glm::dot(mateOutward, frame.into), glm::dot(frame.outward, mateOutward));
  return frame;
}

template <int N> double ridgeLength(const ReferenceMesh<N> &mesh, const std::array<Index, N - 1> &ridge) {
  if constexpr (N == 2) return 1;
  else return glm::length(mesh.nodes[at(ridge[1])] - mesh.nodes[at(ridge[0])]);
}

template <int N> struct RidgeRecord {
  std::array<Index, 2> sides;
  std::array<Index, N - 1> nodes;
  Index face; // the boundary face on the first side, and its vertex off the ridge
  int off;
};

/// Groups the ridges between different sides into curves and decides which are open chains.
template <int N>
std::vector<Curve<N>> buildCurves(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                                  const BoundaryFaces<N> &boundary, std::vector<RidgeRecord<N>> &records) {
  // Sides are numbered part by part.
  sortByIndex(
      records, parts.sides.size(), [](const RidgeRecord<N> &r) { return r.sides[0]; },
      [](const RidgeRecord<N> &a, const RidgeRecord<N> &b) {
        return std::tie(a.sides, a.nodes) < std::tie(b.sides, b.nodes);
      });
  std::vector<Curve<N>> curves;
  std::vector<Index> ends;
  for (std::size_t begin = 0, end = 0; begin < records.size(); begin = end) {
    const RidgeRecord<N> &first = records[begin];
    while (end < records.size() && records[end].sides == first.sides) ++end;
    Curve<N> curve{parts.sides[at(first.sides[0])].part, first.sides, {}, {}, 0, true};
    curve.ridges.reserve(end - begin);
    curve.frames.reserve(end - begin);
    double longest = -1;
    ends.clear();
    for (std::size_t k = begin; k < end; ++k) {
      const RidgeRecord<N> &r = records[k];
      const Index mate = boundary.mates[at(r.face)][r.off];
      curve.ridges.push_back(r.nodes);
      curve.frames.push_back(frameAt(mesh, boundary.faces[at(r.face)], r.off, boundary.faces[at(mate)]));
      ends.insert(ends.end(), r.nodes.begin(), r.nodes.end());
      const double length = ridgeLength<N>(mesh, r.nodes);
      if (length > longest) { // short ridges have the worst rounding
        longest = length;
        curve.angle = curve.frames.back().angle;
      }
    }
    if constexpr (N == 3) {
      // One open chain: two nodes used once, all others twice, and nodes = ridges + 1.
      sortItems(ends);
      std::size_t single = 0;
      std::size_t distinct = 0;
      bool branched = false;
      for (std::size_t b = 0, e = 0; b < ends.size(); b = e) {
        while (e < ends.size() && ends[e] == ends[b]) ++e;
        ++distinct;
        if (e - b == 1) ++single;
        if (e - b > 2) branched = true;
      }
      curve.open = single == 2 && !branched && distinct == curve.ridges.size() + 1;
    } else {
      curve.open = curve.ridges.size() == 1;
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

template <int N> std::vector<Corner> buildCorners(const Parts<N> &parts, Index nodeCount) {
  std::vector<Corner> corners;
  for (Index node = 0; node < nodeCount; ++node) {
    const Index *list = parts.nodeSides.begin(node);
    const Index *const last = parts.nodeSides.end(node);
    while (list != last) { // sides are numbered part by part, so one part's sides stand together
      const Index part = parts.sides[at(*list)].part;
      const Index *next = list;
      while (next != last && parts.sides[at(*next)].part == part) ++next;
      if (next - list >= N) corners.push_back({part, node, std::vector<Index>(list, next)});
      list = next;
    }
  }
  sortByIndex(
      corners, parts.parts.size(), [](const Corner &c) { return c.part; },
      [](const Corner &a, const Corner &b) { return a.part < b.part; });
  return corners;
}

/// Euler characteristic of each side as a complex of its faces, ridges and nodes.
template <int N>
std::vector<Index> sideEuler(const Parts<N> &parts, const BoundaryFaces<N> &boundary,
                             const std::vector<Index> &sideOf) {
  std::vector<Index> chi(parts.sides.size(), 0);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    Index inner = 0;
    for (int k = 0; k < N + 1; ++k)
      if (k != boundary.faces[f].face && sideOf[at(boundary.mates[f][k])] == sideOf[f]) ++inner;
    // A face counts 1; its ridges: inner ones are halved between two faces, so count in units of 1/2.
    const Index ridges = 2 * N - inner;
    chi[at(sideOf[f])] += N == 3 ? 2 - ridges : 2;
  }
  for (Index &c : chi) c /= 2;
  // In 2D the ridges are the nodes: faces - nodes is -1 for a path. In 3D: nodes - ridges + faces.
  for (Index node = 0; node < parts.nodeSides.count(); ++node)
    for (const Index *s = parts.nodeSides.begin(node); s != parts.nodeSides.end(node); ++s)
      chi[at(*s)] += N == 3 ? 1 : -1;
  if constexpr (N == 2)
    for (Index &c : chi) c = -c;
  return chi;
}

/// Condition (c): a ball whose sides are discs, two sides share at most one curve, N sides meet at a corner.
template <int N>
void judgeParts(Parts<N> &parts, const BoundaryFaces<N> &boundary, const std::vector<Index> &sideOf) {
  const auto blame = [&](Index part, const char *why) {
    PartInfo &info = parts.parts[at(part)];
    if (info.simple) info.why = why;
    info.simple = false;
  };
  DisjointSets shells(boundary.faces.size());
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    for (int k = 0; k < N + 1; ++k)
      if (k != boundary.faces[f].face) shells.unite(toIndex(f), boundary.mates[f][k]);
  std::vector<Index> shellOfPart(parts.parts.size(), kNone);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const Index part = parts.sides[at(sideOf[f])].part;
    const Index shell = shells.find(toIndex(f));
    if (shellOfPart[at(part)] == kNone) shellOfPart[at(part)] = shell;
    if (shellOfPart[at(part)] != shell) blame(part, "its boundary is in several pieces");
  }
  const std::vector<Index> chi = sideEuler(parts, boundary, sideOf);
  for (std::size_t s = 0; s < chi.size(); ++s)
    if (chi[s] != 1) blame(parts.sides[s].part, N == 3 ? "a side is not a disc" : "a side is not a path");
  std::vector<Index> euler(parts.parts.size(), 0); // corners - curves + sides
  for (const Side &side : parts.sides) euler[at(side.part)] += N == 3 ? 1 : -1;
  for (const Curve<N> &curve : parts.curves) {
    if (!curve.open) blame(curve.part, "two sides meet in more than one curve, or in a closed one");
    if constexpr (N == 3) --euler[at(curve.part)];
  }
  for (const Corner &corner : parts.corners) {
    ++euler[at(corner.part)];
    if (corner.sides.size() != N) blame(corner.part, "more sides meet at a corner than there are dimensions");
  }
  for (std::size_t p = 0; p < euler.size(); ++p)
    if (euler[p] != (N == 3 ? 2 : 0)) blame(toIndex(p), "it is not a ball");
  for (std::size_t p = 0; p < euler.size(); ++p)
    if (parts.partSides.size(toIndex(p)) < N + 1) blame(toIndex(p), "it has too few sides");
  for (const Side &side : parts.sides)
    if (side.opposite != kNone && parts.sides[at(side.opposite)].opposite == kNone)
      blame(side.part, "a split surface is not one whole side of both its parts");
}

/// Links each side on a split surface to the side behind it; kNone where there is more than one.
template <int N>
void linkOpposites(const ReferenceMesh<N> &mesh, Parts<N> &parts, const BoundaryFaces<N> &boundary,
                   const std::vector<Index> &sideOf) {
  constexpr Index kUnset = -2;
  for (Side &side : parts.sides) side.opposite = kUnset;
  std::vector<bool> torn(parts.sides.size(), false);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const auto [s, i] = boundary.faces[f];
    const Index t = mesh.neighbors[at(s)][i];
    const Index other = t == kNone ? kNone : sideOf[at(boundary.indexOf[at(t)][mesh.mirrorFace(s, i)])];
    Index &opposite = parts.sides[at(sideOf[f])].opposite;
    if (opposite == kUnset) opposite = other;
    if (opposite != other) torn[at(sideOf[f])] = true;
  }
  for (std::size_t s = 0; s < torn.size(); ++s) {
    if (!torn[s]) continue;
    PartInfo &info = parts.parts[at(parts.sides[s].part)];
    info.simple = false;
    info.why = "a split surface is not one whole side of both its parts";
    parts.sides[s].opposite = kNone;
  }
}

} // namespace

template <int N> Parts<N> buildParts(const ReferenceMesh<N> &mesh, const PartOptions &options) {
  Parts<N> parts;
  Index partCount = 0;
  parts.partOfSimplex = floodUntagged(mesh, partCount);
  parts.parts.assign(at(partCount), {true, "", 0});
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    parts.parts[at(parts.partOfSimplex[at(s)])].region = mesh.region[at(s)];

  // Sides: boundary faces of one part joined over ridges where the surface goes on.
  const BoundaryFaces<N> boundary = findBoundaryFaces(mesh);
  DisjointSets joined(boundary.faces.size());
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const auto [s, i] = boundary.faces[f];
    if (options.everyFace && (*options.everyFace)[at(s)]) continue;
    for (int k = 0; k < N + 1; ++k) {
      if (k == i) continue;
      const FaceRef<N> mate = boundary.faces[at(boundary.mates[f][k])];
      if (mesh.sideKey(mesh.tags[at(s)][i]) == mesh.sideKey(mesh.tags[at(mate.simplex)][mate.face]))
        joined.unite(toIndex(f), boundary.mates[f][k]);
    }
  }

  // Number them part by part.
  std::vector<Index> roots;
  for (Index f = 0; f < toIndex(boundary.faces.size()); ++f)
    if (joined.find(f) == f) roots.push_back(f);
  const auto partOfFace = [&](Index f) { return parts.partOfSimplex[at(boundary.faces[at(f)].simplex)]; };
  sortByIndex(roots, at(partCount), partOfFace,
              [&](Index a, Index b) { return partOfFace(a) < partOfFace(b); });
  std::vector<Index> sideOf(boundary.faces.size());
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const auto [s, i] = boundary.faces[at(roots[k])];
    parts.sides.push_back({partOfFace(roots[k]), mesh.tags[at(s)][i], kNone});
    sideOf[at(roots[k])] = toIndex(k);
  }
  std::vector<Index> sizes(roots.size(), 0);
  for (Index f = 0; f < toIndex(sideOf.size()); ++f) {
    sideOf[at(f)] = sideOf[at(joined.find(f))];
    ++sizes[at(sideOf[at(f)])];
  }
  for (const Index n : sizes) parts.sideFaces.offsets.push_back(parts.sideFaces.offsets.back() + n);
  parts.sideFaces.items.resize(boundary.faces.size());
  std::vector<Index> cursor(parts.sideFaces.offsets.begin(), parts.sideFaces.offsets.end() - 1);
  for (std::size_t f = 0; f < sideOf.size(); ++f)
    parts.sideFaces.items[at(cursor[at(sideOf[f])]++)] = boundary.faces[f];
  for (Index p = 0, s = 0; p < partCount; ++p) {
    for (; s < toIndex(parts.sides.size()) && parts.sides[at(s)].part == p; ++s)
      parts.partSides.items.push_back(s);
    parts.partSides.closeList();
  }

  // Node to sides, by a counting sort over the boundary faces of each side in turn.
  std::vector<std::pair<Index, Index>> incidences;
  incidences.reserve(boundary.faces.size() * N);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    for (int v = 0; v < N + 1; ++v)
      if (v != boundary.faces[f].face)
        incidences.emplace_back(mesh.simplices[at(boundary.faces[f].simplex)][v], sideOf[f]);
  sortByIndex(incidences, mesh.nodes.size(), [](const auto &i) { return i.first; });
  incidences.erase(std::unique(incidences.begin(), incidences.end()), incidences.end());
  std::size_t next = 0;
  for (Index node = 0; node < mesh.nodeCount(); ++node) {
    for (; next < incidences.size() && incidences[next].first == node; ++next)
      parts.nodeSides.items.push_back(incidences[next].second);
    parts.nodeSides.closeList();
  }

  // Curves and corners.
  std::vector<RidgeRecord<N>> records;
  records.reserve(boundary.faces.size() / 2);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    for (int k = 0; k < N + 1; ++k) {
      if (k == boundary.faces[f].face) continue;
      const Index mate = boundary.mates[f][k];
      if (sideOf[f] >= sideOf[at(mate)]) continue; // each ridge is met from both of its faces
      records.push_back(
          {{sideOf[f], sideOf[at(mate)]}, ridgeNodes(mesh, boundary.faces[f], k), toIndex(f), k});
    }
  parts.curves = buildCurves(mesh, parts, boundary, records);
  parts.corners = buildCorners(parts, mesh.nodeCount());
  linkOpposites(mesh, parts, boundary, sideOf);
  judgeParts(parts, boundary, sideOf);
  return parts;
}

template Parts<2> buildParts(const ReferenceMesh<2> &, const PartOptions &);
template Parts<3> buildParts(const ReferenceMesh<3> &, const PartOptions &);

} // namespace dualblock
