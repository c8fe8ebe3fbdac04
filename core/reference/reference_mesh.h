// The reference mesh (paper 3.2): simplices that fill the domain, with adjacency and, on each face, the
// surface that the face lies on. The mesh is edited in place by subdivision only.
//
//   triangle, local numbering          tetrahedron, local numbering
//            2                                  3
//           / \                                /|\            face i is opposite to vertex i;
//          /   \                              / | \           a ridge is the part shared by two
//         0-----1                            0--|--2          faces: a node in 2D, an edge in 3D
//                                             \ | /
//                                               1
#pragma once

#include <algorithm>
#include <tuple>

#include "base/sort.h"
#include "reference/cut_field.h"

namespace dualblock {

/// Where a surface of the decomposed domain comes from.
enum class SurfaceKind : std::uint8_t {
  facet,       // the domain's boundary, or an interface between two regions; source = facet
  reflexCut,   // through a reflex curve; source = the curve's first domain facet
  vertexCut,   // through a vertex of more than N curves; source = the node
  simplexFace, // the fallback: every inner face of the reference mesh
  bentCut // across bent sides, closed curves and what else is no polytope; source = a domain facet, or kNone
};

template <int N> struct Surface {
  SurfaceKind kind;
  Index source;
  Plane<N> plane; // facets: the normal points out of the domain; interfaces: into the higher-numbered cell
  Index patch = kNone; // facets that join smoothly have one patch; kNone: the surface is one by itself
  std::shared_ptr<const CutField<N>> field{}; // of a bent cut; the plane is then the nearest one
  bool bent = false;                          // the side is no plane
};

/// A face tag names a surface and the side of it that the simplex lies on.
struct FaceTag {
  static Index back(Index surface) { return 2 * surface; }      // the plane's normal points out
  static Index front(Index surface) { return 2 * surface + 1; } // the plane's normal points in
  static Index surface(Index tag) { return tag >> 1; }
  static Index flipped(Index tag) { return tag ^ 1; }
  static bool isFront(Index tag) { return (tag & 1) != 0; }
};

template <int N> struct FaceRef {
  Index simplex;
  int face;
};

template <int N> struct ReferenceMesh {
  static constexpr int kVertices = N + 1;
  using Simplex = std::array<Index, kVertices>;

  std::vector<Vec<N>> nodes;
  std::vector<Simplex> simplices; // positively oriented
  std::vector<Simplex> neighbors; // across face i, or kNone
  std::vector<Simplex> tags;      // FaceTag of face i, or kNone for an inner face
  std::vector<Index> region;      // per simplex: the region of an assembly, 0 where there is one only
  std::vector<Index> component;   // per simplex: the connected piece of the domain, by its lowest facet
  Index componentCount = 0;
  std::vector<Index> nodeSimplex; // per node: one simplex that has it
  std::vector<Surface<N>> surfaces;
  double size = 0;         // diagonal of the domain's bounding box: the scale of all tolerances
  double smoothCosine = 1; // of the feature angle: curves of bent sides that turn by as much keep a vertex

  Index simplexCount() const { return toIndex(simplices.size()); }
  Index nodeCount() const { return toIndex(nodes.size()); }

  /// What a side consists of: faces on one patch, seen from one side.
  Index sideKey(Index tag) const {
    const Index patch = surfaces[at(FaceTag::surface(tag))].patch;
    return patch == kNone ? tag : 2 * patch + (tag & 1);
  }

  int localVertex(Index s, Index node) const {
    for (int i = 0; i < kVertices; ++i)
      if (simplices[at(s)][i] == node) return i;
    return -1;
  }

  /// The local number, in the neighbour across face i of s, of the face they share.
  int mirrorFace(Index s, int i) const {
    const Simplex &back = neighbors[at(neighbors[at(s)][i])];
    for (int k = 0; k < kVertices; ++k)
      if (back[k] == s && (isLast(back, k) || sharesFace(s, i, neighbors[at(s)][i], k))) return k;
    return -1;
  }

  /// The nodes of face i of s, sorted.
  std::array<Index, N> sortedFace(Index s, int i) const {
    std::array<Index, N> face;
    for (int k = 0, m = 0; k < kVertices; ++k)
      if (k != i) face[m++] = simplices[at(s)][k];
    sortItems(face);
    return face;
  }

  /// Unit normal of the tagged face i of s that points out of s: from the surface's plane, never from the
  /// face itself, which may be a sliver; only bent cuts and the fallback's faces have no other plane than
  /// their own.
  Vec<N> outwardNormal(Index s, int i) const {
    const Index tag = tags[at(s)][i];
    const Surface<N> &surface = surfaces[at(FaceTag::surface(tag))];
    if (surface.kind == SurfaceKind::simplexFace || surface.field) return faceNormal(s, i);
    return FaceTag::isFront(tag) ? -surface.plane.normal : surface.plane.normal;
  }

  Vec<N> faceNormal(Index s, int i) const {
    const Simplex &v = simplices[at(s)];
    const Vec<N> o = nodes[at(v[(i + 1) % kVertices])];
    const Vec<N> a = nodes[at(v[(i + 2) % kVertices])] - o;
    Vec<N> n;
    if constexpr (N == 2) n = {a.y, -a.x};
    else n = glm::cross(a, nodes[at(v[(i + 3) % kVertices])] - o);
    n = glm::normalize(n);
    return glm::dot(n, nodes[at(v[i])] - o) > 0 ? -n : n;
  }

private:
  /// Simplices that share several faces are rare.
  static bool isLast(const Simplex &list, int k) {
    for (int m = k + 1; m < kVertices; ++m)
      if (list[m] == list[k]) return false;
    return true;
  }

  bool sharesFace(Index s, int i, Index t, int k) const {
    const Index apex = simplices[at(t)][k];
    for (int v = 0; v < kVertices; ++v)
      if (v != i && simplices[at(s)][v] == apex) return false;
    return true;
  }
};

/// What turnAroundRidge passes through: surfaces numbered from this one on, besides untagged faces.
inline constexpr Index kCrossAll = 0;
inline constexpr Index kCrossNone = 0x3fffffff;

/// Turns around the ridge of s that its faces `from` and `to` share, starting through face `to`, until an
/// outer face or one on a surface below `crossFrom` stops it. Returns that face, or {s, from} after a full
/// turn; `visit(simplex)` sees each simplex passed, s included.
template <int N, typename Visit>
FaceRef<N> turnAroundRidge(const ReferenceMesh<N> &mesh, Index s, int from, int to, Index crossFrom,
                           Visit visit) {
  const Index start = s;
  const int startFrom = from;
  while (true) {
    visit(s);
    const Index next = mesh.neighbors[at(s)][to];
    const Index tag = mesh.tags[at(s)][to];
    if (next == kNone || (tag != kNone && FaceTag::surface(tag) < crossFrom)) return {s, to};
    // In `next` the ridge lies in the face just crossed and in the face opposite to the vertex that
    // `s` has behind the crossed face's far side: the one vertex of the crossed face off the ridge.
    const Index pivot = mesh.simplices[at(s)][from];
    from = mesh.mirrorFace(s, to);
    to = mesh.localVertex(next, pivot);
    s = next;
    if (s == start && from == startFrom) return {start, startFrom}; // a full turn: an inner ridge
  }
}

/// All simplices around a node that hang together over faces, in the order found, until `visit(simplex)`
/// returns true.
template <int N, typename Visit> void visitStar(const ReferenceMesh<N> &mesh, Index node, Visit visit) {
  std::vector<Index> star{mesh.nodeSimplex[at(node)]};
  for (std::size_t head = 0; head < star.size(); ++head) {
    const Index s = star[head];
    if (visit(s)) return;
    for (int i = 0; i < N + 1; ++i) {
      const Index t = mesh.neighbors[at(s)][i];
      if (t == kNone || mesh.simplices[at(s)][i] == node) continue;
      if (std::find(star.begin(), star.end(), t) == star.end()) star.push_back(t);
    }
  }
}

template <int N> void collectStar(const ReferenceMesh<N> &mesh, Index node, std::vector<Index> &star) {
  star.clear();
  visitStar(mesh, node, [&](Index s) {
    star.push_back(s);
    return false;
  });
}

/// Numbers the pieces that the mesh falls into when it is cut along the faces that `isWall(simplex, face)`
/// holds for, in the order of their lowest simplex. Returns the piece of each simplex.
template <int N, typename IsWall>
std::vector<Index> floodPieces(const ReferenceMesh<N> &mesh, Index &count, IsWall isWall) {
  std::vector<Index> piece(mesh.simplices.size(), kNone);
  std::vector<Index> stack;
  count = 0;
  for (Index seed = 0; seed < mesh.simplexCount(); ++seed) {
    if (piece[at(seed)] != kNone) continue;
    piece[at(seed)] = count;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const Index s = stack.back();
      stack.pop_back();
      for (int i = 0; i < N + 1; ++i) {
        const Index t = mesh.neighbors[at(s)][i];
        if (t == kNone || piece[at(t)] != kNone || isWall(s, i)) continue;
        piece[at(t)] = count;
        stack.push_back(t);
      }
    }
    ++count;
  }
  return piece;
}

/// Pieces between tagged faces.
template <int N> std::vector<Index> floodUntagged(const ReferenceMesh<N> &mesh, Index &count) {
  return floodPieces(mesh, count, [&](Index s, int i) { return mesh.tags[at(s)][i] != kNone; });
}

/// N! times the signed volume of simplex s.
template <int N> double orientation(const std::vector<Vec<N>> &nodes, const std::array<Index, N + 1> &s) {
  const Vec<N> a = nodes[at(s[1])] - nodes[at(s[0])];
  const Vec<N> b = nodes[at(s[2])] - nodes[at(s[0])];
  if constexpr (N == 2) {
    return a.x * b.y - a.y * b.x;
  } else {
    return glm::dot(glm::cross(a, b), nodes[at(s[3])] - nodes[at(s[0])]);
  }
}

/// Fills neighbors and nodeSimplex from the simplices alone. Faces shared by more than two simplices
/// are left unconnected beyond the first two.
template <int N> void connect(ReferenceMesh<N> &mesh) {
  struct Half {
    std::array<Index, N> key;
    Index simplex;
    int face;
  };
  std::vector<Half> halves;
  halves.reserve(mesh.simplices.size() * (N + 1));
  mesh.neighbors.assign(mesh.simplices.size(), {});
  mesh.nodeSimplex.assign(mesh.nodes.size(), kNone);
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    mesh.neighbors[at(s)].fill(kNone);
    for (int i = 0; i < N + 1; ++i) {
      halves.push_back({mesh.sortedFace(s, i), s, i});
      mesh.nodeSimplex[at(mesh.simplices[at(s)][i])] = s;
    }
  }
  sortByIndex(
      halves, mesh.nodes.size(), [](const Half &h) { return h.key[0]; },
      [](const Half &a, const Half &b) { return std::tie(a.key, a.simplex) < std::tie(b.key, b.simplex); });
  for (std::size_t h = 0; h + 1 < halves.size(); ++h) {
    if (halves[h].key != halves[h + 1].key) continue;
    mesh.neighbors[at(halves[h].simplex)][halves[h].face] = halves[h + 1].simplex;
    mesh.neighbors[at(halves[h + 1].simplex)][halves[h + 1].face] = halves[h].simplex;
    ++h;
  }
}

} // namespace dualblock
