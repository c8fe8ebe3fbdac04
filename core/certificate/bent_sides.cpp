// Of check 5, where sides are bent. The blocks' boundary then only approximates the domain's, and two things
// do not follow from volumes and planes any more: that nodes lie on the surface, and that the boundary does
// not cross itself.
#include <cmath>
#include <limits>

#include "base/sort.h"
#include "certificate/checks.h"

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

using Quad = std::array<Vec<3>, 4>;

std::array<Quad, 4> quarters(const Quad &q) {
  const Vec<3> a = (q[0] + q[1]) / 2.0;
  const Vec<3> b = (q[1] + q[2]) / 2.0;
  const Vec<3> c = (q[2] + q[3]) / 2.0;
  const Vec<3> d = (q[3] + q[0]) / 2.0;
  const Vec<3> m = (a + c) / 2.0;
  return {Quad{q[0], a, m, d}, Quad{a, q[1], b, m}, Quad{m, b, q[2], c}, Quad{d, m, c, q[3]}};
}

/// Whether some plane has all corners of p behind it and those of q in front, up to `margin` (negative: and a
/// gap). A bilinear patch lies in the hull of its corners.
bool separated(const Quad &p, const Quad &q, double margin) {
  const auto splits = [&](const Vec<3> &axis) {
    const double length = glm::length(axis);
    if (!(length > 0)) return false;
    double highP = -std::numeric_limits<double>::infinity();
    double lowP = -highP;
    double highQ = highP;
    double lowQ = lowP;
    for (std::size_t k = 0; k < 4; ++k) {
      highP = std::max(highP, glm::dot(axis, p[k]) / length);
      lowP = std::min(lowP, glm::dot(axis, p[k]) / length);
      highQ = std::max(highQ, glm::dot(axis, q[k]) / length);
      lowQ = std::min(lowQ, glm::dot(axis, q[k]) / length);
    }
    return highP <= lowQ + margin || highQ <= lowP + margin;
  };
  const Vec<3> centre = p[0] + p[1] + p[2] + p[3] - q[0] - q[1] - q[2] - q[3];
  const Vec<3> normalP = glm::cross(p[2] - p[0], p[3] - p[1]);
  const Vec<3> normalQ = glm::cross(q[2] - q[0], q[3] - q[1]);
  if (splits(centre) || splits(normalP) || splits(normalQ)) return true;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec<3> edgeP = p[(k + 1) % 4] - p[k];
    const Vec<3> edgeQ = q[(k + 1) % 4] - q[k];
    if (splits(glm::cross(edgeP, normalP)) || splits(glm::cross(edgeQ, normalQ))) return true;
    if (splits(glm::cross(edgeP, edgeQ))) return true;
    if (splits(glm::cross(edgeP, q[(k + 2) % 4] - q[(k + 1) % 4]))) return true;
  }
  return false;
}

/// Whether two faces are apart. Faces that share a node can only be told apart beyond its surroundings, where
/// positive blocks keep them apart.
bool areApart(const Quad &p, const Quad &q, bool touch, double margin, int depth) {
  if (separated(p, q, touch ? margin : -margin)) return true;
  if (depth == 0) return touch;
  for (const Quad &a : quarters(p))
    for (const Quad &b : quarters(q))
      if (!areApart(a, b, touch, margin, depth - 1)) return false;
  return true;
}

void checkEmbedding(const BlockInput<3> &in, const BlockComplex<3> &complex, Certificate &certificate) {
  struct Face {
    double low, high;
    Index index;
  };
  std::vector<Face> faces;
  for (const Index f : complex.boundary) {
    Face face{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), f};
    for (const Index node : complex.faces[at(f)].cycle) {
      face.low = std::min(face.low, in.blocks.positions[at(node)].x);
      face.high = std::max(face.high, in.blocks.positions[at(node)].x);
    }
    faces.push_back(face);
  }
  sortItems(faces,
            [](const Face &a, const Face &b) { return a.low != b.low ? a.low < b.low : a.index < b.index; });
  const double margin = 1e-12 * in.mesh.size;
  const auto quadOf = [&](Index f) {
    Quad quad;
    for (std::size_t k = 0; k < 4; ++k) quad[k] = in.blocks.positions[at(complex.faces[at(f)].cycle[k])];
    return quad;
  };
  for (std::size_t a = 0; a < faces.size(); ++a) {
    const BlockFace<3> &first = complex.faces[at(faces[a].index)];
    const Quad p = quadOf(faces[a].index);
    for (std::size_t b = a + 1; b < faces.size() && faces[b].low <= faces[a].high + margin; ++b) {
      const BlockFace<3> &second = complex.faces[at(faces[b].index)];
      const bool touch = std::any_of(first.key.begin(), first.key.end(), [&](Index node) {
        return std::binary_search(second.key.begin(), second.key.end(), node);
      });
      if (!areApart(p, quadOf(faces[b].index), touch, margin, 5))
        certificate.fail(Check::features, "the blocks' boundary could not be shown not to cross itself",
                         {{"block", first.block}, {"block", second.block}});
    }
  }
}

} // namespace

void checkBentSides(const BlockInput<3> &in, const BlockComplex<3> &complex, double tolerance,
                    Certificate &certificate) {
  checkNodes(in, complex, tolerance, certificate);
  if (!certificate.isExact) checkEmbedding(in, complex, certificate);
}

} // namespace dualblock
