#include "remesh/load.h"

namespace dualblock {
namespace {

/// An edge of the mesh on a crease within a bent side.
struct CreaseEdge {
  Index a, b, patch;
};

std::vector<CreaseEdge> creasesOf(const ReferenceMesh<3> &mesh, const BentShape<3> &shape) {
  std::vector<CreaseEdge> creases;
  const double least = 1e-9 * mesh.size;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone || FaceTag::isFront(tag)) continue;
      const Index patch = mesh.sideKey(tag) / 2;
      if (!shape.hasCurve(patch, patch)) continue;
      const std::array<Index, 3> v = mesh.sortedFace(s, i);
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = v[k];
        const Index b = v[(k + 1) % 3];
        const Vec<3> &x = mesh.nodes[at(a)];
        const Vec<3> &y = mesh.nodes[at(b)];
        const auto isOn = [&](const Vec<3> &p) {
          return glm::length(shape.onCurve(patch, patch, p).point - p) <= least;
        };
        if (isOn(x) && isOn(y) && isOn((x + y) / 2.0))
          creases.push_back({std::min(a, b), std::max(a, b), patch});
      }
    }
  sortItems(creases,
            [](const CreaseEdge &a, const CreaseEdge &b) { return a.a != b.a ? a.a < b.a : a.b < b.b; });
  creases.erase(
      std::unique(creases.begin(), creases.end(),
                  [](const CreaseEdge &a, const CreaseEdge &b) { return a.a == b.a && a.b == b.b; }),
      creases.end());
  return creases;
}

/// Nodes of faces on one side may move on it.
void markSides(const ReferenceMesh<3> &coarse, TetMesh &mesh) {
  for (Index s = 0; s < coarse.simplexCount(); ++s)
    for (std::size_t i = 0; i < 4; ++i) {
      const Index tag = coarse.tags[at(s)][i];
      if (tag == kNone) continue;
      const Index patch = coarse.sideKey(tag) / 2;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k == i) continue;
        TetNode &node = mesh.nodes[at(coarse.simplices[at(s)][k])];
        if (node.on == On::inside) {
          node.on = On::side;
          node.patches[0] = patch;
        } else if (node.patches[0] != patch) {
          node.on = On::corner; // but for the nodes of curves
        }
      }
    }
}

void markCurves(const ReferenceMesh<3> &coarse, const Parts<3> &features, TetMesh &mesh) {
  for (const Curve<3> &curve : features.curves) {
    std::array<Index, 2> patches;
    for (std::size_t k = 0; k < 2; ++k)
      patches[k] = coarse.sideKey(features.sides[at(curve.sides[k])].tag) / 2;
    const bool isOne = patches[0] == patches[1]; // a side that meets itself: nothing to slide along
    for (const auto &ridge : curve.ridges)
      for (const Index v : ridge)
        if (TetNode &node = mesh.nodes[at(v)]; isOne) node.on = On::corner;
        else if (node.on != On::curve) node = {node.x, On::curve, sortedPair(patches[0], patches[1]), 0};
  }
}

/// A crease within a side is a curve between that and itself.
void markCreases(const ReferenceMesh<3> &coarse, const BentShape<3> &shape, TetMesh &mesh) {
  struct Crease {
    double cosine = 1; // between its last two segments
    Index count = 0;
    Vec<3> direction{0.0};
  };
  std::vector<Crease> creases(mesh.nodes.size());
  for (const auto &[a, b, patch] : creasesOf(coarse, shape))
    for (const auto &[v, w] : {std::pair(a, b), std::pair(b, a)}) {
      Crease &crease = creases[at(v)];
      const Vec<3> d = glm::normalize(mesh.x(w) - mesh.x(v));
      if (++crease.count == 2) crease.cosine = -glm::dot(d, crease.direction);
      crease.direction = d;
    }
  for (std::size_t v = 0; v < creases.size(); ++v) {
    if (creases[v].count == 0) continue;
    TetNode &node = mesh.nodes[v];
    const bool goesOn =
        node.on == On::side && creases[v].count == 2 && creases[v].cosine > coarse.smoothCosine;
    if (goesOn) node = {node.x, On::curve, {node.patches[0], node.patches[0]}, 0};
    else node.on = On::corner;
  }
}

} // namespace

TetMesh loadTets(const ReferenceMesh<3> &mesh, const Parts<3> &features, const BentShape<3> &shape) {
  TetMesh tets;
  for (const Vec<3> &x : mesh.nodes) tets.addNode({x});
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    tets.add({mesh.simplices[at(s)], mesh.tags[at(s)], mesh.region[at(s)], mesh.component[at(s)]});
  markSides(mesh, tets);
  markCurves(mesh, features, tets);
  markCreases(mesh, shape, tets);
  for (const Corner &corner : features.corners) tets.nodes[at(corner.node)].on = On::corner;
  return tets;
}

} // namespace dualblock
