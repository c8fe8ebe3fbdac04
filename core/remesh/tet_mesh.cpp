#include "remesh/tet_mesh.h"

namespace dualblock {

Index TetMesh::add(const Tet &tet) {
  Index t = toIndex(tets.size());
  if (free_.empty()) {
    tets.push_back(tet);
    seen_.push_back(0);
  } else {
    t = free_.back();
    free_.pop_back();
    tets[at(t)] = tet;
  }
  for (const Index v : tet.v) stars_[at(v)].push_back(t);
  touch(t);
  ++alive_;
  if (isMarked_) edits_.push_back({t, kNone, {}, {}});
  return t;
}

void TetMesh::remove(Index t) {
  if (isMarked_) edits_.push_back({kNone, kNone, tets[at(t)], {}});
  touch(t);
  for (Index &v : tets[at(t)].v) {
    std::vector<Index> &star = stars_[at(v)];
    *std::find(star.begin(), star.end(), t) = star.back();
    star.pop_back();
    v = kNone;
  }
  free_.push_back(t);
  --alive_;
}

void TetMesh::mark() {
  isMarked_ = true;
  edits_.clear();
}

void TetMesh::move(Index node, const Vec<3> &x) {
  if (isMarked_) edits_.push_back({kNone, node, {}, nodes[at(node)].x});
  place(node, x);
}

void TetMesh::place(Index node, const Vec<3> &x) {
  nodes[at(node)].x = x;
  for (const Index t : stars_[at(node)]) touch(t);
}

void TetMesh::touch(Index t) {
  ++clock_;
  for (const Index v : tets[at(t)].v) stamps_[at(v)] = clock_;
}

bool TetMesh::hasChanged(Index t) const {
  const auto &v = tets[at(t)].v;
  return std::any_of(v.begin(), v.end(), [&](Index node) { return stamps_[at(node)] > seen_[at(t)]; });
}

void TetMesh::setTag(Index t, std::size_t face, Index tag) {
  if (isMarked_) { // as if it went and came again
    edits_.push_back({kNone, kNone, tets[at(t)], {}});
    edits_.push_back({t, kNone, {}, {}});
  }
  tets[at(t)].tags[face] = tag;
  touch(t);
}

void TetMesh::rollBack() {
  isMarked_ = false;
  // In between a tetrahedron's number may have gone to another: from the last edit on, each is the one meant.
  for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit)
    if (edit->node != kNone) place(edit->node, edit->place);
    else if (edit->tet != kNone) remove(edit->tet);
    else add(edit->was);
}

double TetMesh::worstOfNew() const {
  double worst = 1;
  for (const Edit &edit : edits_) {
    if (edit.tet != kNone && isAlive(edit.tet)) worst = std::min(worst, shape(edit.tet));
    if (edit.node != kNone)
      for (const Index t : stars_[at(edit.node)]) worst = std::min(worst, shape(t));
  }
  return worst;
}

void TetMesh::shellOf(Index a, Index b, std::vector<Index> &shell) const {
  shell.clear();
  const bool fewer = stars_[at(a)].size() <= stars_[at(b)].size();
  for (const Index t : stars_[at(fewer ? a : b)])
    if (tets[at(t)].has(fewer ? b : a)) shell.push_back(t);
}

bool TetMesh::hasEdge(Index a, Index b) const {
  return std::any_of(stars_[at(a)].begin(), stars_[at(a)].end(), [&](Index t) { return tets[at(t)].has(b); });
}

void TetMesh::facesAt(Index a, Index b, const std::vector<Index> &shell, std::vector<EdgeFace> &faces) const {
  faces.clear();
  for (const Index t : shell) {
    const Tet &tet = tets[at(t)];
    for (std::size_t i = 0; i < 4; ++i) {
      if (tet.tags[i] == kNone || tet.v[i] == a || tet.v[i] == b) continue;
      Index third = kNone;
      for (std::size_t k = 0; k < 4; ++k)
        if (k != i && tet.v[k] != a && tet.v[k] != b) third = tet.v[k];
      faces.push_back({tet.tags[i], third, t});
    }
  }
}

} // namespace dualblock
