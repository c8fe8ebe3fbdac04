// Contracting edges: a node moves into another, and what was between them goes.
#include <cmath>

#include "partition/heuristics.h"
#include "remesh/tet_editor.h"

namespace dualblock {

/// Whether the boundary and the curves of the domain stay what they are if a moves into b (T. K. Dey et al.,
/// "Topology preserving edge contraction", 1999). placeOf(a, b) has filled shell_ and faces_.
bool TetEditor::mayCollapse(Index a, Index b, const EdgePlace &place) {
  const TetNode &node = mesh_.nodes[at(a)];
  const TetNode &to = mesh_.nodes[at(b)];
  if (node.on == On::corner) return false;
  if (node.on == On::inside) return true;
  if (place.on != node.on) return false;
  if (place.patches[0] != node.patches[0] || (node.on == On::curve && place.patches[1] != node.patches[1]))
    return false;
  if (node.on == On::curve && to.on != On::curve && to.on != On::corner) return false;
  std::vector<Index> thirds;
  for (const TetMesh::EdgeFace &face : faces_) thirds.push_back(face.third);
  std::array<std::vector<Index>, 2> around; // nodes at the other ends of edges of tagged faces
  for (std::size_t k = 0; k < 2; ++k) {
    const Index centre = k == 0 ? a : b;
    for (const Index t : mesh_.star(centre)) {
      const Tet &tet = mesh_.tets[at(t)];
      for (std::size_t i = 0; i < 4; ++i) {
        if (tet.tags[i] == kNone || tet.v[i] == centre) continue;
        for (std::size_t m = 0; m < 4; ++m)
          if (m != i && tet.v[m] != a && tet.v[m] != b) around[k].push_back(tet.v[m]);
      }
    }
    sortItems(around[k]);
  }
  for (const Index c : around[0])
    if (std::binary_search(around[1].begin(), around[1].end(), c) &&
        std::find(thirds.begin(), thirds.end(), c) == thirds.end())
      return false;
  if (node.on == On::curve)
    for (const Index c : thirds)
      if (placeOf(a, c).on == On::curve && placeOf(b, c).on == On::curve) return false;
  return true;
}

bool TetEditor::fitsCollapsed(Index a, Index b, const EdgePlace &place, double least, double longest) {
  double before = 1;
  for (const Index t : mesh_.star(a)) before = std::min(before, mesh_.shape(t));
  const double wanted = std::max(1e-6, std::min(least, before));
  for (const Index t : mesh_.star(a)) {
    Tet tet = mesh_.tets[at(t)];
    if (tet.has(b)) {
      const Index tagA = tet.tags[at(tet.local(a))];
      const Index tagB = tet.tags[at(tet.local(b))];
      if (tagA != kNone && tagB != kNone) return false;
      continue;
    }
    const std::size_t slot = at(tet.local(a));
    tet.v[slot] = b;
    if (!(mesh_.shape(tet.v) >= wanted)) return false;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != slot && lengthOf(tet.v[i], b) > longest) return false;
      if (i == slot || tet.tags[i] == kNone) continue;
      if (!fits(tet.face(i), patchOf(tet.tags[i]))) return false;
    }
  }
  if (place.on != On::curve) return true;
  for (const Index t : mesh_.star(a))
    for (const Index c : mesh_.tets[at(t)].v) { // the edge of the curve that gets longer
      if (c == a || c == b || mesh_.nodes[at(c)].on > On::curve || placeOf(a, c).on != On::curve) continue;
      const Vec<3> middle = (mesh_.x(b) + mesh_.x(c)) / 2.0;
      const Vec<3> on = projected(On::curve, place.patches, middle);
      if (glm::length(on - middle) > kFittingSagitta * glm::length(mesh_.x(b) - mesh_.x(c))) return false;
    }
  return true;
}

/// The tetrahedron that is left at the face of b and two others takes the tag of one that goes.
void TetEditor::moveTagsToNeighbours(Index b, const std::array<Index, 2> &others, Index tag) {
  for (const Index t : mesh_.star(b)) {
    const Tet &tet = mesh_.tets[at(t)];
    if (!tet.has(others[0]) || !tet.has(others[1])) continue;
    for (std::size_t i = 0; i < 4; ++i)
      if (tet.v[i] != b && tet.v[i] != others[0] && tet.v[i] != others[1] && tet.tags[i] == kNone)
        mesh_.setTag(t, i, tag);
  }
}

bool TetEditor::collapseEdge(Index a, Index b, double least, double longest) {
  if (mesh_.nodes[at(a)].on == On::corner) return false;
  const EdgePlace place = placeOf(a, b);
  if (!mayCollapse(a, b, place) || !fitsCollapsed(a, b, place, least, longest)) return false;
  struct Pending {
    std::array<Index, 2> others;
    Index tag;
  };
  std::vector<Pending> pending;
  while (!mesh_.star(a).empty()) {
    const Index t = mesh_.star(a).front();
    Tet tet = mesh_.tets[at(t)];
    mesh_.remove(t);
    const std::size_t slot = at(tet.local(a));
    if (!tet.has(b)) {
      tet.v[slot] = b;
      mesh_.add(tet);
      continue;
    }
    const Index tag = std::max(tet.tags[slot], tet.tags[at(tet.local(b))]); // kNone is below all
    if (tag == kNone) continue;
    Pending &p = pending.emplace_back(Pending{{kNone, kNone}, tag});
    for (const Index v : tet.v)
      if (v != a && v != b) p.others[p.others[0] == kNone ? 0 : 1] = v;
  }
  for (const Pending &p : pending) moveTagsToNeighbours(b, p.others, p.tag);
  return true;
}

} // namespace dualblock
