#include "partition/fills/pull.h"

#include <limits>
#include <map>

#include "base/sort.h"
#include "geometry/linear_programme.h"
#include "parts/place.h"

namespace dualblock {
namespace {

/// Sides as polygons: their corners in a cycle. Empty where a side's curves form no single cycle.
std::vector<std::vector<Index>> sidePolygons(const Parts<3> &parts) {
  std::vector<std::vector<std::array<Index, 2>>> edges(parts.sides.size());
  for (const Curve<3> &curve : parts.curves) {
    std::map<Index, int> uses;
    for (const auto &ridge : curve.ridges)
      for (const Index node : ridge) ++uses[node];
    std::array<Index, 2> ends{kNone, kNone};
    for (const auto &[node, n] : uses)
      if (n == 1) ends[ends[0] == kNone ? 0 : 1] = node;
    for (const Index side : curve.sides)
      edges[at(side)].push_back(curve.open ? ends : std::array<Index, 2>{kNone, kNone});
  }
  std::vector<std::vector<Index>> polygons(parts.sides.size());
  for (std::size_t side = 0; side < edges.size(); ++side) {
    auto &list = edges[side];
    std::vector<Index> cycle;
    Index here = list.empty() ? kNone : list[0][0];
    while (here != kNone && !list.empty()) {
      const auto next =
          std::find_if(list.begin(), list.end(), [&](const auto &e) { return e[0] == here || e[1] == here; });
      if (next == list.end()) break;
      cycle.push_back(here);
      here = (*next)[0] == here ? (*next)[1] : (*next)[0];
      list.erase(next);
    }
    if (list.empty() && cycle.size() >= 3 && here == cycle[0]) polygons[side] = std::move(cycle);
  }
  return polygons;
}

/// Parts of each component in the closure of what is not simple: over split sides that are no triangles.
std::vector<bool> closureOf(const Parts<3> &parts, const std::vector<std::vector<Index>> &polygons) {
  std::vector<bool> inside(parts.parts.size(), false);
  std::vector<Index> queue;
  for (Index p = 0; p < toIndex(parts.parts.size()); ++p)
    if (!parts.parts[at(p)].isSimple()) {
      inside[at(p)] = true;
      queue.push_back(p);
    }
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (const Index *side = parts.partSides.begin(queue[head]); side != parts.partSides.end(queue[head]);
         ++side) {
      const Index opposite = parts.sides[at(*side)].opposite;
      if (opposite == kNone || polygons[at(*side)].size() == 3) continue;
      const Index p = parts.sides[at(opposite)].part;
      if (inside[at(p)]) continue;
      inside[at(p)] = true;
      queue.push_back(p);
    }
  return inside;
}

/// The order in which corners are pulled: where most sides of the parts meet first, for a part becomes as
/// many simplices as it has triangles that miss its apex; then by place.
class PullOrder {
public:
  PullOrder(const ReferenceMesh<3> &mesh, const Parts<3> &parts,
            const std::vector<std::vector<Index>> &polygons, const std::vector<bool> &simplify)
      : mesh_(mesh), valence_(mesh.nodes.size(), 0) {
    for (std::size_t side = 0; side < polygons.size(); ++side)
      if (simplify[at(parts.sides[side].part)])
        for (const Index node : polygons[side]) ++valence_[at(node)];
  }
  bool operator()(Index a, Index b) const {
    if (valence_[at(a)] != valence_[at(b)]) return valence_[at(a)] > valence_[at(b)];
    const Place<3> placeA = placeOf(mesh_, a);
    const Place<3> placeB = placeOf(mesh_, b);
    return placeA != placeB ? placeA < placeB : a < b;
  }

private:
  const ReferenceMesh<3> &mesh_;
  std::vector<Index> valence_;
};

/// A triangle of a part's boundary.
struct SideTriangle {
  Index side;
  std::array<Index, 3> nodes; // of one side, all run round it alike
};

/// The part's point that is furthest from the planes of its sides, if it is behind all of them.
std::optional<Vec<3>> centreOf(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index part) {
  const Vec<3> origin =
      mesh.nodes[at(mesh.simplices[at(parts.sideFaces.begin(*parts.partSides.begin(part))->simplex)][0])];
  std::vector<LinearConstraint<4>> behind; // x, y, z and the distance, in units of the domain's size
  for (const Index *side = parts.partSides.begin(part); side != parts.partSides.end(part); ++side) {
    const FaceRef<3> face = *parts.sideFaces.begin(*side);
    const Vec<3> n = mesh.outwardNormal(face.simplex, face.face);
    const Vec<3> on = mesh.nodes[at(mesh.sortedFace(face.simplex, face.face)[0])];
    behind.push_back({{n.x, n.y, n.z, 1}, glm::dot(n, on - origin) / mesh.size});
  }
  const auto found = solveLinearProgramme<4>(std::move(behind), {0, 0, 0, 1}, 2);
  if (!found || !((*found)[3] > 1e-6)) return std::nullopt;
  return origin + mesh.size * Vec<3>((*found)[0], (*found)[1], (*found)[2]);
}

/// Divides a side: around its centre, if it has one, or from the first corner of the cycle.
void divideSide(Index side, const std::vector<Index> &cycle, Index centre,
                std::vector<SideTriangle> &triangles) {
  const std::size_t n = cycle.size();
  if (centre == kNone)
    for (std::size_t k = 1; k + 1 < n; ++k) triangles.push_back({side, {cycle[0], cycle[k], cycle[k + 1]}});
  else
    for (std::size_t k = 0; k < n; ++k) triangles.push_back({side, {centre, cycle[k], cycle[(k + 1) % n]}});
}

/// Whether the apex sees the whole of every side from within: no triangle is turned over.
bool seesAll(const std::vector<Vec<3>> &nodes, const std::vector<SideTriangle> &triangles, Index apex) {
  Index side = kNone;
  double first = 0;
  for (const SideTriangle &t : triangles) {
    const double volume = orientation<3>(nodes, {apex, t.nodes[0], t.nodes[1], t.nodes[2]});
    if (t.side != side) first = volume;
    side = t.side;
    if (!(first * volume > 0)) return false;
  }
  return true;
}

} // namespace

PulledMesh pullParts(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Apex wanted) {
  const std::vector<std::vector<Index>> polygons = sidePolygons(parts);
  const std::vector<bool> simplify = closureOf(parts, polygons);
  const PullOrder isBefore(mesh, parts, polygons, simplify);
  const std::vector<Index> component = componentOfParts(mesh, parts);
  PulledMesh result;
  result.blocks.assign(at(mesh.componentCount), 0);
  result.simplified.assign(at(mesh.componentCount), 0);
  ReferenceMesh<3> &out = result.mesh;
  out.size = mesh.size;
  out.smoothCosine = mesh.smoothCosine;
  out.surfaces = mesh.surfaces;
  out.componentCount = mesh.componentCount;
  const Index inner = toIndex(out.surfaces.size());
  out.surfaces.push_back({SurfaceKind::simplexFace, kNone, {}});

  std::vector<Vec<3>> nodes = mesh.nodes; // and centres
  std::vector<Index> number(nodes.size(), kNone);
  const auto nodeOf = [&](Index node) {
    Index &n = number[at(node)];
    if (n == kNone) {
      n = out.nodeCount();
      out.nodes.push_back(nodes[at(node)]);
    }
    return n;
  };
  const auto addNode = [&](const Vec<3> &x) {
    nodes.push_back(x);
    number.push_back(kNone);
    return toIndex(nodes.size()) - 1;
  };
  std::map<std::array<Index, 3>, Index> tagOf; // per part: faces on its sides
  std::vector<SideTriangle> triangles;
  for (Index p = 0; p < toIndex(parts.parts.size()); ++p) {
    const std::size_t c = at(component[at(p)]);
    const auto cannot = [&] { result.blocks[c] = std::numeric_limits<double>::infinity(); };
    Index apex = kNone;
    std::size_t corners = 0;
    Index triangleCount = 0; // without centres
    for (const Index *side = parts.partSides.begin(p); side != parts.partSides.end(p); ++side) {
      const auto &polygon = polygons[at(*side)];
      const Surface<3> &surface = mesh.surfaces[at(FaceTag::surface(parts.sides[at(*side)].tag))];
      const bool split = surface.kind != SurfaceKind::facet;
      if (polygon.empty() || surface.bent || (split && parts.sides[at(*side)].opposite == kNone)) cannot();
      for (const Index node : polygon)
        if (apex == kNone || isBefore(node, apex)) apex = node;
      corners += polygon.size();
      triangleCount += toIndex(polygon.size()) - 2;
    }
    if (result.blocks[c] == std::numeric_limits<double>::infinity()) continue;
    const bool hasCentre = wanted == Apex::centre && simplify[at(p)] && triangleCount > 4; // no simplex yet
    if (hasCentre) {
      const auto centre = centreOf(mesh, parts, p);
      if (centre) apex = addNode(*centre);
      else cannot();
    }
    const auto missesApex = [&](Index side) {
      const std::vector<Index> &polygon = polygons[at(side)];
      return std::find(polygon.begin(), polygon.end(), apex) == polygon.end();
    };
    // Pulling: each side from its first corner in the order, the part from its own; so neighbours divide a
    // common side alike. Only where nothing is behind a side it may have a centre instead.
    tagOf.clear();
    triangles.clear();
    for (const Index *side = parts.partSides.begin(p); side != parts.partSides.end(p); ++side) {
      std::vector<Index> cycle = polygons[at(*side)];
      std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end(), isBefore), cycle.end());
      Index centre = kNone;
      if (wanted != Apex::corner && simplify[at(p)] && cycle.size() > 3 && missesApex(*side) &&
          parts.sides[at(*side)].opposite == kNone) {
        Vec<3> sum(0.0);
        for (const Index node : cycle) sum += nodes[at(node)];
        centre = addNode(sum / static_cast<double>(cycle.size()));
      }
      divideSide(*side, cycle, centre, triangles);
    }
    if (hasCentre && !seesAll(nodes, triangles, apex)) cannot();
    std::vector<std::array<Index, 4>> simplices;
    for (const auto &[side, v] : triangles) {
      std::array<Index, 3> face = v;
      sortItems(face);
      tagOf[face] = parts.sides[at(side)].tag;
      if (missesApex(side)) simplices.push_back({apex, v[0], v[1], v[2]});
    }
    const Index first = out.simplexCount();
    for (std::array<Index, 4> &s : simplices) {
      double volume = orientation<3>(nodes, s);
      if (volume < 0) {
        std::swap(s[2], s[3]);
        volume = -volume;
      }
      if (!(volume > 1e-14 * mesh.size * mesh.size * mesh.size)) cannot();
      std::array<Index, 4> tags;
      for (int i = 0; i < 4; ++i) {
        std::array<Index, 3> face;
        for (int v = 0, m = 0; v < 4; ++v)
          if (v != i) face[at(m++)] = s[at(v)];
        sortItems(face);
        const auto known = tagOf.find(face);
        tags[at(i)] = known == tagOf.end() ? kNone : known->second;
      }
      for (Index &v : s) v = nodeOf(v);
      out.simplices.push_back(s);
      out.tags.push_back(tags);
      out.region.push_back(parts.parts[at(p)].region);
      out.component.push_back(toIndex(c));
      result.everyFace.push_back(simplify[at(p)]);
    }
    if (simplify[at(p)]) {
      ++result.simplified[c];
      result.blocks[c] += 4.0 * (out.simplexCount() - first);
    } else {
      result.blocks[c] += static_cast<double>(corners) / 3; // each corner of a simple part has three sides
    }
  }
  connect(out);
  for (Index s = 0; s < out.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const Index t = out.neighbors[at(s)][at(i)];
      if (t == kNone || out.tags[at(s)][at(i)] != kNone || !result.everyFace[at(s)]) continue;
      out.tags[at(s)][at(i)] = s < t ? FaceTag::back(inner) : FaceTag::front(inner);
    }
  return result;
}

} // namespace dualblock
