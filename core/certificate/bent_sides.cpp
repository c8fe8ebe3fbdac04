// Of check 5, where sides are bent. The blocks' boundary then only approximates the domain's, and three
// things do not follow from volumes and planes any more: that nodes lie on the surface, that the boundary
// does not cross itself, and that it stays near the surface.
#include <cmath>
#include <limits>

#include "base/sort.h"
#include "certificate/checks.h"
#include "certificate/embedding.h"

namespace dualblock {
namespace {

/// Distance of a point from a planar polygon with holes.
double distanceToFacet(const std::vector<Vec<3>> &v, const Facet &facet, const Plane<3> &plane,
                       const Vec<3> &x) {
  double least = std::numeric_limits<double>::infinity();
  bool inside = false;
  const Vec<3> n = glm::abs(plane.normal);
  const int drop = n.x > n.y && n.x > n.z ? 0
                   : n.y > n.z            ? 1
                                          : 2; // project along the longest axis of the normal
  const int i = (drop + 1) % 3;
  const int j = (drop + 2) % 3;
  for (const auto &loop : facet.loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec<3> &a = v[at(loop[k])];
      const Vec<3> &b = v[at(loop[(k + 1) % loop.size()])];
      const Vec<3> d = b - a;
      const double t = std::clamp(glm::dot(x - a, d) / glm::dot(d, d), 0.0, 1.0);
      least = std::min(least, glm::length(x - (a + t * d)));
      if ((a[j] > x[j]) != (b[j] > x[j]) && x[i] < a[i] + (x[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i]))
        inside = !inside;
    }
  return inside ? std::min(least, std::abs(plane.distance(x))) : least;
}

void checkNodes(const BlockInput<3> &in, const BlockComplex<3> &complex, double tolerance,
                Certificate &certificate) {
  // Facets of bent patches by patch, then by where they begin along x.
  struct Extent {
    Index patch;
    double low, high;
    Index facet;
  };
  std::vector<Extent> extents;
  for (Index f = 0; f < toIndex(in.domain.facets.size()); ++f) {
    if (!in.mesh.surfaces[at(f)].bent) continue;
    Extent e{in.mesh.surfaces[at(f)].patch, std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity(), f};
    for (const Index v : in.domain.facets[at(f)].loops[0]) {
      e.low = std::min(e.low, in.domain.vertices[at(v)].x);
      e.high = std::max(e.high, in.domain.vertices[at(v)].x);
    }
    extents.push_back(e);
  }
  sortItems(extents, [](const Extent &a, const Extent &b) {
    return a.patch != b.patch ? a.patch < b.patch : a.low != b.low ? a.low < b.low : a.facet < b.facet;
  });
  std::vector<std::pair<Index, Index>> wanted; // patch, node
  for (const BlockFace<3> &face : complex.faces) {
    const Index facet = facetOf(face);
    if (facet == kNone || !in.mesh.surfaces[at(facet)].bent) continue;
    for (const Index node : face.key) wanted.emplace_back(in.mesh.surfaces[at(facet)].patch, node);
  }
  sortItems(wanted);
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const auto &[patch, node] : wanted) {
    const Vec<3> &x = in.blocks.positions[at(node)];
    auto e = std::lower_bound(extents.begin(), extents.end(), patch,
                              [](const Extent &a, Index p) { return a.patch < p; });
    bool found = false;
    for (; !found && e != extents.end() && e->patch == patch && e->low <= x.x + tolerance; ++e)
      found =
          e->high >= x.x - tolerance && distanceToFacet(in.domain.vertices, in.domain.facets[at(e->facet)],
                                                        in.mesh.surfaces[at(e->facet)].plane, x) <= tolerance;
    if (!found)
      certificate.fail(Check::features,
                       "node " + std::to_string(node) + " is off the bent side of facet " +
                           std::to_string(patch),
                       {{"node", node}, {"facet", patch}});
  }
}

constexpr std::size_t kCrossings = 64; // that are looked for
constexpr int kSamples = 3;            // along each direction inside of a block's face

void checkEmbedding(const BlockInput<3> &in, const BlockComplex<3> &complex, Certificate &certificate) {
  QuadSurface surface{in.blocks.positions, {}};
  for (const Index f : complex.boundary) surface.faces.push_back(complex.faces[at(f)].cycle);
  const auto blockAt = [&](Index face) { return complex.faces[at(complex.boundary[at(face)])].block; };
  for (const auto &[a, b] : crossingFaces(surface, 1e-12 * in.mesh.size, kCrossings))
    certificate.fail(Check::features, "the blocks' boundary could not be shown not to cross itself",
                     {{"block", blockAt(a)}, {"block", blockAt(b)}});
  if (!certificate.passed[static_cast<std::size_t>(Check::features)]) return;
  for (const WrongShell &shell : wrongShells(surface))
    certificate.fail(Check::features,
                     shell.isKnown ? "just outside of a block's boundary face there are blocks already, " +
                                         std::to_string(shell.layers) + " layer(s)"
                                   : "nothing could tell whether blocks lie inside of one another",
                     {{"block", blockAt(shell.face)}});
}

/// How thick the domain is behind a face of a block: through the row of blocks to where it ends at a facet.
double columnBehind(const BlockInput<3> &in, const BlockComplex<3> &complex, const BlockFace<3> &face) {
  const auto middle = [&](Index block, int local) {
    Vec<3> sum{0.0};
    for (int k = 0; k < 4; ++k)
      sum += in.blocks.positions[at(in.blocks.blocks[at(block)][at(faceCorner<3>(local, k))])];
    return sum / 4.0;
  };
  double length = 0;
  Index block = face.block;
  int local = face.local;
  for (Index n = 0; n < in.blocks.blockCount(); ++n) { // a wrong complex might lead around in a circle
    length += glm::length(middle(block, local ^ 1) - middle(block, local));
    const Index next = complex.behind[at(6 * block + (local ^ 1))];
    if (next == kNone || in.blocks.tags[at(block)][at(local ^ 1)] != kNone) break;
    block = next / 6;
    local = next % 6;
  }
  return length;
}

void checkFidelity(const BlockInput<3> &in, const BlockComplex<3> &complex, Certificate &certificate) {
  const auto patchOf = [&](Index tag) { return in.mesh.sideKey(tag) / 2; };
  const auto isBentTag = [&](Index tag) {
    if (tag == kNone) return false;
    const Surface<3> &surface = in.mesh.surfaces[at(FaceTag::surface(tag))];
    return surface.kind == SurfaceKind::facet && surface.bent;
  };
  std::vector<SideFace> faces;
  for (const BlockFace<3> &face : complex.faces)
    if (isBentTag(face.tag))
      faces.push_back({face.cycle, patchOf(face.tag), face.block, columnBehind(in, complex, face)});
  const ReferenceMesh<3> &mesh = in.sideMesh();
  std::vector<SideTriangle> triangles;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (!isBentTag(tag) || mesh.neighbors[at(s)][i] > s) continue;
      SideTriangle &triangle = triangles.emplace_back(SideTriangle{{}, patchOf(tag), FaceTag::surface(tag)});
      for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = mesh.nodes[at(mesh.sortedFace(s, i)[k])];
      const auto &[a, b, c] = triangle.corners; // seen from the same side all over, as normals are compared
      if ((glm::dot(glm::cross(b - a, c - a), mesh.faceNormal(s, i)) < 0) != FaceTag::isFront(tag))
        std::swap(triangle.corners[1], triangle.corners[2]);
    }
  SideMeasures measures = measureSides(in.blocks.positions, faces, triangles, kSamples);
  for (const FaceFault &fault : measures.faults) {
    const SideFace &face = faces[at(fault.face)];
    certificate.fail(Check::features,
                     "block " + std::to_string(face.owner) + " strays from the bent side of facet " +
                         std::to_string(face.patch) + describe(fault),
                     {{"block", face.owner}, {"facet", face.patch}});
  }
  for (const Index f : measures.furthest) // to be cut further where that is too much
    certificate.fidelity.furthest.push_back({"block", faces[at(f)].owner});
  for (const Index f : measures.coarse) certificate.fidelity.coarse.push_back({"block", faces[at(f)].owner});
  certificate.fidelity.sides = std::move(measures.sides);
}

} // namespace

void checkBentSides(const BlockInput<3> &in, const BlockComplex<3> &complex, double tolerance,
                    Certificate &certificate) {
  checkNodes(in, complex, tolerance, certificate);
  checkEmbedding(in, complex, certificate);
  checkFidelity(in, complex, certificate);
}

} // namespace dualblock
