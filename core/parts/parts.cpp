#include "parts/parts.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "parts/kinks.h"

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

/// `holds(simplex)`: the simplex belongs to a part whose mates nobody will ask for.
template <int N, typename Holds>
BoundaryFaces<N> findBoundaryFaces(const ReferenceMesh<N> &mesh, const Holds &holds) {
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
      if (k == i || boundary.mates[f][k] != kNone || holds(s)) continue;
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

/// How the face f of a part and its mate meet at a ridge, which f has without vertex k, from the planes of
/// their surfaces; only the sense of turning comes from the simplex.
template <int N>
RidgeFrame<N> frameAt(const ReferenceMesh<N> &mesh, const FaceRef<N> &f, int k,
                      const std::array<Index, N - 1> &ridge, const FaceRef<N> &mate) {
  RidgeFrame<N> frame;
  frame.tags = {mesh.tags[at(f.simplex)][f.face], mesh.tags[at(mate.simplex)][mate.face]};
  frame.outward = mesh.outwardNormal(f.simplex, f.face);
  const Vec<N> mateOutward = mesh.outwardNormal(mate.simplex, mate.face);
  const auto &s = mesh.simplices[at(f.simplex)];
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

/// Whether ridges make up one open chain: two nodes used once, all others twice, and nodes = ridges + 1.
template <int N>
bool isOpenChain(std::span<const std::array<Index, N - 1>> ridges, std::vector<Index> &ends) {
  if (N == 2 || ridges.size() == 1) return ridges.size() == 1;
  ends.clear();
  for (const auto &ridge : ridges) ends.insert(ends.end(), ridge.begin(), ridge.end());
  sortItems(ends);
  std::size_t single = 0;
  std::size_t distinct = 0;
  for (std::size_t b = 0, e = 0; b < ends.size(); b = e) {
    while (e < ends.size() && ends[e] == ends[b]) ++e;
    ++distinct;
    if (e - b == 1) ++single;
    if (e - b > 2) return false;
  }
  return single == 2 && distinct == ridges.size() + 1;
}

/// Groups the ridges between different sides into curves and decides which are open chains.
template <int N>
void buildCurves(const ReferenceMesh<N> &mesh, const BoundaryFaces<N> &boundary,
                 const std::vector<Index> &sideOf, const Earlier<Parts<N>> &earlier, Parts<N> &parts,
                 FeatureStore<N> &store) {
  struct Record {
    Index other; // side
    std::array<Index, N - 1> nodes;
    Index face; // the boundary face on the first side, and its vertex off the ridge
    int off;
  };
  store.ridges.reserve(boundary.faces.size() * N); // enough for the spans to stay where they are
  parts.curves.reserve(2 * parts.sides.size());    // as many as a box has
  std::vector<Record> records;                     // of one side
  std::vector<Index> ends;
  std::vector<std::size_t> framed; // curves with frames
  auto known = earlier.found.curves.begin();
  for (Index side = 0; side < toIndex(parts.sides.size()); ++side) {
    const Index part = parts.sides[at(side)].part;
    if (N == 3 && !earlier.holds.empty() && earlier.holds[at(part)]) {
      for (; known != earlier.found.curves.end() && known->part <= part; ++known) {
        if (known->part < part) continue;
        if (!known->frames.empty()) framed.push_back(parts.curves.size());
        for (const RidgeFrame<N> &frame : known->frames) store.frames.push_back(frame);
        parts.curves.push_back(*known);
        parts.curves.back().ridges = {store.ridges.data() + store.ridges.size(), known->ridges.size()};
        for (const auto &ridge : known->ridges) store.ridges.push_back(ridge);
      }
      continue;
    }
    records.clear();
    for (const FaceRef<N> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f) {
      const Index face = boundary.indexOf[at(f->simplex)][f->face];
      for (int k = 0; k < N + 1; ++k) {
        if (k == f->face) continue;
        const Index other = sideOf[at(boundary.mates[at(face)][k])];
        if (other > side) records.push_back({other, ridgeNodes(mesh, *f, k), face, k});
      }
    }
    sortItems(records, [](const Record &a, const Record &b) {
      return a.other != b.other ? a.other < b.other : a.nodes < b.nodes;
    });
    for (std::size_t begin = 0, end = 0; begin < records.size(); begin = end) {
      Curve<N> curve{part, {side, records[begin].other}};
      const auto frameOf = [&](const Record &r) {
        return frameAt(mesh, boundary.faces[at(r.face)], r.off, r.nodes,
                       boundary.faces[at(boundary.mates[at(r.face)][r.off])]);
      };
      const std::size_t first = store.ridges.size();
      std::size_t longest = begin; // short ridges have the worst rounding
      double most = -1;
      for (; end < records.size() && records[end].other == curve.sides[1]; ++end) {
        store.ridges.push_back(records[end].nodes);
        const double length = ridgeLength<N>(mesh, records[end].nodes);
        if (length <= most) continue;
        most = length;
        longest = end;
      }
      curve.ridges = {store.ridges.data() + first, end - begin};
      curve.angle = frameOf(records[longest]).angle;
      curve.open = isOpenChain<N>(curve.ridges, ends);
      if (curve.angle > kFlatAngle) {
        framed.push_back(parts.curves.size());
        for (std::size_t k = begin; k < end; ++k) store.frames.push_back(frameOf(records[k]));
      }
      parts.curves.push_back(curve);
    }
  }
  const RidgeFrame<N> *next = store.frames.data();
  for (const std::size_t c : framed) {
    parts.curves[c].frames = {next, parts.curves[c].ridges.size()};
    next += parts.curves[c].ridges.size();
  }
}

template <int N> void buildCorners(const ReferenceMesh<N> &mesh, Parts<N> &parts, FeatureStore<N> &store) {
  const std::vector<Kink> kinks = findKinks(mesh, parts);
  store.cornerSides = parts.nodeSides.items;
  for (Index node = 0; node < parts.nodeSides.count(); ++node) {
    const Index *list = store.cornerSides.data() + parts.nodeSides.offsets[at(node)];
    const Index *const last = list + parts.nodeSides.size(node);
    while (list != last) { // sides are numbered part by part, so one part's sides stand together
      const Index part = parts.sides[at(*list)].part;
      const Index *next = list;
      while (next != last && parts.sides[at(*next)].part == part) ++next;
      if (next - list >= N || std::binary_search(kinks.begin(), kinks.end(), Kink{node, part}))
        parts.corners.push_back({part, node, {list, next}});
      list = next;
    }
  }
  sortByIndex(
      parts.corners, parts.parts.size(), [](const Corner &c) { return c.part; },
      [](const Corner &a, const Corner &b) { return a.part < b.part; });
}

/// Euler characteristic of each side as a complex of its faces, ridges and nodes.
template <int N>
std::vector<Index> sideEuler(const Parts<N> &parts, const BoundaryFaces<N> &boundary,
                             const std::vector<Index> &sideOf) {
  std::vector<Index> chi(parts.sides.size(), 0);
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    Index inner = 0;
    for (int k = 0; k < N + 1; ++k)
      if (const Index mate = boundary.mates[f][k]; mate != kNone && sideOf[at(mate)] == sideOf[f]) ++inner;
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

} // namespace

template <int N> std::vector<UnlikeCorner> unlikeCorners(const Parts<N> &parts) {
  std::vector<UnlikeCorner> unlike;
  if constexpr (N == 2) return unlike;                 // a side's ends are those of the one behind it
  std::vector<Index> first(parts.parts.size() + 1, 0); // corner of each part
  for (const Corner &corner : parts.corners) ++first[at(corner.part) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  const auto hasCorner = [&](Index side, Index node) {
    const Index part = parts.sides[at(side)].part;
    const auto end = parts.corners.begin() + first[at(part) + 1];
    const auto found = std::lower_bound(parts.corners.begin() + first[at(part)], end, node,
                                        [](const Corner &c, Index n) { return c.node < n; });
    return found != end && found->node == node &&
           std::binary_search(found->sides.begin(), found->sides.end(), side);
  };
  for (const Corner &corner : parts.corners)
    for (const Index side : corner.sides) {
      const Index opposite = parts.sides[at(side)].opposite;
      if (opposite != kNone && !hasCorner(opposite, corner.node))
        unlike.push_back({parts.sides[at(opposite)].part, corner.node});
    }
  return unlike;
}

namespace {

/// Condition (c): a ball whose sides are discs, two sides share at most one curve, N sides meet at a corner.
template <int N>
void judgeParts(Parts<N> &parts, const BoundaryFaces<N> &boundary, const std::vector<Index> &sideOf,
                const Earlier<Parts<N>> &earlier) {
  const auto blame = [&](Index part, Defect defect) {
    if (N == 3 && !earlier.holds.empty() && earlier.holds[at(part)]) return;
    PartInfo &info = parts.parts[at(part)];
    if (info.isSimple()) info.defect = defect;
  };
  DisjointSets shells(parts.sides.size());
  for (const Curve<N> &curve : parts.curves) shells.unite(curve.sides[0], curve.sides[1]);
  std::vector<Index> shellOfPart(parts.parts.size(), kNone);
  for (Index side = 0; side < toIndex(parts.sides.size()); ++side) {
    const Index part = parts.sides[at(side)].part;
    const Index shell = shells.find(side);
    if (shellOfPart[at(part)] == kNone) shellOfPart[at(part)] = shell;
    if (shellOfPart[at(part)] != shell) blame(part, Defect::severalShells);
  }
  const std::vector<Index> chi = sideEuler(parts, boundary, sideOf);
  for (std::size_t s = 0; s < chi.size(); ++s)
    if (chi[s] != 1) blame(parts.sides[s].part, Defect::closedSide);
  std::vector<Index> euler(parts.parts.size(), 0); // corners - curves + sides
  for (const Side &side : parts.sides) euler[at(side.part)] += N == 3 ? 1 : -1;
  for (const Curve<N> &curve : parts.curves) {
    if (!curve.open) blame(curve.part, Defect::severalCurves);
    if constexpr (N == 3) --euler[at(curve.part)];
  }
  for (const Corner &corner : parts.corners) {
    ++euler[at(corner.part)];
    if (corner.sides.size() > N) blame(corner.part, Defect::crowdedCorner);
    if (corner.sides.size() < N) blame(corner.part, Defect::kink);
  }
  for (std::size_t p = 0; p < euler.size(); ++p)
    if (euler[p] != (N == 3 ? 2 : 0)) blame(toIndex(p), Defect::noBall);
  for (std::size_t p = 0; p < euler.size(); ++p)
    if (parts.partSides.size(toIndex(p)) < N + 1) blame(toIndex(p), Defect::fewSides);
  for (const Side &side : parts.sides)
    if (side.opposite != kNone && parts.sides[at(side.opposite)].opposite == kNone)
      blame(side.part, Defect::tornSplit);
  for (const UnlikeCorner &corner : unlikeCorners(parts)) blame(corner.part, Defect::unlikeSides);
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
    parts.parts[at(parts.sides[s].part)].defect = Defect::tornSplit;
    parts.sides[s].opposite = kNone;
  }
}

} // namespace

template <int N>
Parts<N> buildParts(const ReferenceMesh<N> &mesh, const PartOptions &options,
                    const Earlier<Parts<N>> &earlier) {
  Parts<N> parts;
  Index partCount = 0;
  parts.partOfSimplex = floodUntagged(mesh, partCount);
  parts.parts.assign(at(partCount), {});
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    parts.parts[at(parts.partOfSimplex[at(s)])].region = mesh.region[at(s)];
  const auto holds = [&](Index s) {
    return N == 3 && !earlier.holds.empty() && earlier.holds[at(parts.partOfSimplex[at(s)])];
  };
  for (std::size_t p = 0; N == 3 && p < earlier.holds.size(); ++p)
    if (earlier.holds[p]) parts.parts[p] = earlier.found.parts[p];

  // Sides: boundary faces of one part joined over ridges where the surface goes on.
  const BoundaryFaces<N> boundary = findBoundaryFaces(mesh, holds);
  DisjointSets joined(boundary.faces.size());
  for (Index side = 0; N == 3 && side < toIndex(earlier.found.sides.size()); ++side) {
    if (!earlier.holds[at(earlier.found.sides[at(side)].part)]) continue;
    const FaceRef<N> *const first = earlier.found.sideFaces.begin(side);
    for (const FaceRef<N> *f = first; f != earlier.found.sideFaces.end(side); ++f)
      joined.unite(boundary.indexOf[at(first->simplex)][first->face],
                   boundary.indexOf[at(f->simplex)][f->face]);
  }
  for (std::size_t f = 0; f < boundary.faces.size(); ++f) {
    const auto [s, i] = boundary.faces[f];
    if (holds(s) || (options.everyFace && (*options.everyFace)[at(s)])) continue;
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
  for (Index f = 0; f < toIndex(sideOf.size()); ++f) sideOf[at(f)] = sideOf[at(joined.find(f))];
  parts.sideFaces = collectLists<FaceRef<N>>(roots.size(), [&](auto put) {
    for (std::size_t f = 0; f < sideOf.size(); ++f) put(sideOf[f], boundary.faces[f]);
  });
  for (Index p = 0, s = 0; p < partCount; ++p) {
    for (; s < toIndex(parts.sides.size()) && parts.sides[at(s)].part == p; ++s)
      parts.partSides.items.push_back(s);
    parts.partSides.closeList();
  }

  // Node to sides, side by side.
  std::vector<Index> seenFrom(mesh.nodes.size());
  parts.nodeSides = collectLists<Index>(mesh.nodes.size(), [&](auto put) {
    seenFrom.assign(mesh.nodes.size(), kNone);
    for (Index side = 0; side < toIndex(parts.sides.size()); ++side)
      for (const FaceRef<N> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f)
        for (int v = 0; v < N + 1; ++v)
          if (const Index node = mesh.simplices[at(f->simplex)][v];
              v != f->face && seenFrom[at(node)] != side) {
            seenFrom[at(node)] = side;
            put(node, side);
          }
  });

  const auto store = std::make_shared<FeatureStore<N>>();
  buildCurves(mesh, boundary, sideOf, earlier, parts, *store);
  buildCorners(mesh, parts, *store);
  parts.store = store;
  linkOpposites(mesh, parts, boundary, sideOf);
  judgeParts(parts, boundary, sideOf, earlier);
  return parts;
}

template std::vector<UnlikeCorner> unlikeCorners(const Parts<2> &);
template std::vector<UnlikeCorner> unlikeCorners(const Parts<3> &);
template Parts<2> buildParts(const ReferenceMesh<2> &, const PartOptions &, const Earlier<Parts<2>> &);
template Parts<3> buildParts(const ReferenceMesh<3> &, const PartOptions &, const Earlier<Parts<3>> &);

} // namespace dualblock
