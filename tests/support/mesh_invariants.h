// What holds for every reference mesh at every moment, checked by plain means.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "reference/reference_mesh.h"

namespace dualblock::test {

/// Area or volume of the mesh.
template <int N> double measureOf(const ReferenceMesh<N> &mesh) {
  double sum = 0;
  for (const auto &s : mesh.simplices) sum += orientation<N>(mesh.nodes, s) / (N == 2 ? 2 : 6);
  return sum;
}

/// Length or area of face i of s.
template <int N> double faceMeasure(const ReferenceMesh<N> &mesh, Index s, int i) {
  const auto face = mesh.sortedFace(s, i);
  const Vec<N> a = mesh.nodes[at(face[1])] - mesh.nodes[at(face[0])];
  if constexpr (N == 2) return glm::length(a);
  else return glm::length(glm::cross(a, mesh.nodes[at(face[2])] - mesh.nodes[at(face[0])])) / 2;
}

/// Length or area of all faces tagged with a surface, each counted from its back side.
template <int N> double surfaceMeasure(const ReferenceMesh<N> &mesh, Index surface) {
  double sum = 0;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i)
      if (mesh.tags[at(s)][at(i)] == FaceTag::back(surface)) sum += faceMeasure(mesh, s, i);
  return sum;
}

/// Everything that is wrong with the mesh, in words; empty if nothing is. `flat`: simplices may have a volume
/// of nothing but rounding. `chords`: faces on bent sides only stand for their facets.
template <int N>
std::vector<std::string> brokenInvariants(const ReferenceMesh<N> &mesh, bool flat = false,
                                          bool chords = false) {
  std::vector<std::string> broken;
  const auto fail = [&](const std::string &what, Index s) {
    if (broken.size() < 10) broken.push_back(what + " (simplex " + std::to_string(s) + ")");
  };
  const std::size_t count = mesh.simplices.size();
  if (mesh.neighbors.size() != count || mesh.tags.size() != count || mesh.region.size() != count)
    return {"the arrays per simplex differ in length"};
  if (mesh.nodeSimplex.size() != mesh.nodes.size()) return {"nodeSimplex has not one entry per node"};

  struct Use {
    Index simplex;
    int face;
  };
  std::map<std::array<Index, N>, std::vector<Use>> faces;
  std::vector<bool> used(mesh.nodes.size(), false);
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    for (const Index v : mesh.simplices[at(s)]) {
      if (v < 0 || v >= mesh.nodeCount()) return {"a simplex has a node that does not exist"};
      used[at(v)] = true;
    }
    auto sorted = mesh.simplices[at(s)];
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) fail("a node twice", s);
    if (!(orientation<N>(mesh.nodes, mesh.simplices[at(s)]) > (flat ? -1e-12 : 0)))
      fail("not positively oriented", s);
    for (int i = 0; i < N + 1; ++i) faces[mesh.sortedFace(s, i)].push_back({s, i});
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    const Index s = mesh.nodeSimplex[v];
    if (used[v] && (s == kNone || mesh.localVertex(s, toIndex(v)) < 0)) fail("nodeSimplex is wrong", s);
  }
  for (const auto &[key, uses] : faces) {
    const Use &a = uses[0];
    const Index tag = mesh.tags[at(a.simplex)][at(a.face)];
    if (uses.size() > 2) fail("a face of three simplices", a.simplex);
    if (uses.size() == 1) { // outer: no neighbour, on a facet, with the domain behind it
      if (mesh.neighbors[at(a.simplex)][at(a.face)] != kNone)
        fail("a neighbour that lacks the face", a.simplex);
      if (tag == kNone) fail("an outer face without a tag", a.simplex);
      else if (FaceTag::isFront(tag)) fail("an outer facet that points into the domain", a.simplex);
    } else {
      const Use &b = uses[1];
      if (mesh.neighbors[at(a.simplex)][at(a.face)] != b.simplex ||
          mesh.neighbors[at(b.simplex)][at(b.face)] != a.simplex)
        fail("adjacency is wrong or not symmetric", a.simplex);
      else if (mesh.mirrorFace(a.simplex, a.face) != b.face || mesh.mirrorFace(b.simplex, b.face) != a.face)
        fail("mirrorFace is wrong", a.simplex);
      const Index other = mesh.tags[at(b.simplex)][at(b.face)];
      if ((tag == kNone) != (other == kNone) || (tag != kNone && FaceTag::flipped(tag) != other))
        fail("the tags on both sides of a face do not match", a.simplex);
    }
    if (tag == kNone) continue;
    const Index surface = FaceTag::surface(tag);
    if (surface >= toIndex(mesh.surfaces.size())) return {"a tag names a surface that does not exist"};
    if (mesh.surfaces[at(surface)].kind == SurfaceKind::simplexFace) continue;
    if (chords && mesh.surfaces[at(surface)].bent) continue;
    const Plane<N> &plane = mesh.surfaces[at(surface)].plane;
    for (const Index v : key)
      if (std::abs(plane.distance(mesh.nodes[at(v)])) > 1e-8 * mesh.size)
        fail("a face off its surface", a.simplex);
    const double apex = plane.distance(mesh.nodes[at(mesh.simplices[at(a.simplex)][at(a.face)])]);
    if (FaceTag::isFront(tag) ? apex < -1e-8 * mesh.size : apex > 1e-8 * mesh.size)
      fail("a tag names the wrong side of its surface", a.simplex);
  }
  return broken;
}

/// All edges, sorted.
template <int N> std::vector<std::pair<Index, Index>> edgesOf(const ReferenceMesh<N> &mesh) {
  std::vector<std::pair<Index, Index>> edges;
  for (const auto &v : mesh.simplices)
    for (std::size_t i = 0; i < v.size(); ++i)
      for (std::size_t k = i + 1; k < v.size(); ++k) edges.push_back(std::minmax(v[i], v[k]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The number of simplices that have both nodes.
template <int N> Index simplicesAround(const ReferenceMesh<N> &mesh, Index a, Index b) {
  Index count = 0;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    if (mesh.localVertex(s, a) >= 0 && mesh.localVertex(s, b) >= 0) ++count;
  return count;
}

} // namespace dualblock::test
