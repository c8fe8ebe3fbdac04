// Swapping: other tetrahedra in the place of those around an edge, or at a face.
#include "partition/heuristics.h"
#include "remesh/tet_editor.h"

namespace dualblock {

/// The nodes around an edge in order, so that (a, b, ring i, ring i + 1) are the tetrahedra of shell_. False
/// where they are no single fan, or too many.
bool TetEditor::findRing(Index a, Index b, bool &isClosed) {
  pairs_.clear();
  for (const Index t : shell_) {
    const Tet &tet = mesh_.tets[at(t)];
    std::array<Index, 2> pair{kNone, kNone};
    for (const Index v : tet.v)
      if (v != a && v != b) pair[pair[0] == kNone ? 0 : 1] = v;
    if (volume6(mesh_.x(a), mesh_.x(b), mesh_.x(pair[0]), mesh_.x(pair[1])) < 0) std::swap(pair[0], pair[1]);
    pairs_.push_back(pair);
  }
  const auto from = [&](Index node, std::size_t k) {
    return std::find_if(pairs_.begin(), pairs_.end(), [&](const auto &p) { return p[k] == node; });
  };
  auto start = pairs_.begin();
  for (auto p = pairs_.begin(); p != pairs_.end(); ++p)
    if (from((*p)[0], 1) == pairs_.end()) start = p;
  isClosed = from((*start)[0], 1) != pairs_.end();
  ring_.assign(1, (*start)[0]);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto next = from(ring_.back(), 0);
    if (next == pairs_.end()) return false;
    ring_.push_back((*next)[1]);
  }
  if (isClosed) {
    if (ring_.back() != ring_.front()) return false;
    ring_.pop_back();
  }
  return ring_.size() >= 3 && ring_.size() <= kMostRing;
}

/// The triangulation of the ring whose tetrahedra with a and b have the best worst shape (L. A. Freitag, C.
/// Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and smoothing", 1997). Returns that shape.
double TetEditor::fillRing(Index a, Index b, double least) {
  const std::size_t n = ring_.size();
  for (std::size_t i = 0; i + 1 < n; ++i) best_[i][i + 1] = 1;
  for (std::size_t width = 2; width < n; ++width)
    for (std::size_t i = 0; i + width < n; ++i) {
      const std::size_t k = i + width;
      best_[i][k] = -1;
      for (std::size_t j = i + 1; j < k; ++j) {
        double worst = std::min(best_[i][j], best_[j][k]);
        if (worst <= std::max(least, best_[i][k])) continue;
        worst = std::min(worst, mesh_.shape({ring_[i], ring_[j], ring_[k], b}));
        worst = std::min(worst, mesh_.shape({ring_[i], ring_[k], ring_[j], a}));
        if (worst <= best_[i][k]) continue;
        best_[i][k] = worst;
        apex_[i][k] = j;
      }
    }
  return best_[0][n - 1];
}

void TetEditor::addTriangle(Index a, Index b, std::size_t i, std::size_t k, std::vector<Tet> &fresh) const {
  if (k - i < 2) return;
  const std::size_t j = apex_[i][k];
  fresh.push_back({{ring_[i], ring_[j], ring_[k], b}, {kNone, kNone, kNone, kNone}});
  fresh.push_back({{ring_[i], ring_[k], ring_[j], a}, {kNone, kNone, kNone, kNone}});
  addTriangle(a, b, i, j, fresh);
  addTriangle(a, b, j, k, fresh);
}

bool TetEditor::swapEdge(Index a, Index b) {
  const EdgePlace place = placeOf(a, b);
  if (place.on == On::curve || shell_.size() > kMostRing) return false;
  bool isClosed = false;
  if (!findRing(a, b, isClosed) || isClosed != (place.on == On::inside)) return false;
  if (!isClosed && faces_.size() != 2) return false;
  double before = 1;
  for (const Index t : shell_) before = std::min(before, mesh_.shape(t));
  const double least = before + kLeastGain;
  if (fillRing(a, b, least) <= least) return false;
  const Index first = ring_.front();
  const Index last = ring_.back();
  if (!isClosed) {
    if (mesh_.hasEdge(first, last)) return false;
    if (!fits({a, first, last}, place.patches[0]) || !fits({b, first, last}, place.patches[0])) return false;
  }
  std::vector<Tet> fresh;
  addTriangle(a, b, 0, ring_.size() - 1, fresh);
  struct Outer { // faces of the shell that were tagged
    std::array<Index, 3> nodes;
    Index tag;
  };
  std::vector<Outer> outer;
  const auto note = [&](std::array<Index, 3> nodes, Index tag) {
    if (tag == kNone) return;
    sortItems(nodes);
    outer.push_back({nodes, tag});
  };
  for (const Index t : shell_) {
    const Tet &tet = mesh_.tets[at(t)];
    for (const Index apex : {a, b}) {
      for (std::size_t i = 0; i < 4; ++i)
        if (tet.v[i] == apex) note(tet.face(i), tet.tags[i]);
    }
  }
  if (!isClosed)
    for (const Index end : {a, b}) note({end, first, last}, faces_[0].tag);
  const Tet model = mesh_.tets[at(shell_[0])];
  const std::vector<Index> shell = shell_;
  for (const Index t : shell) mesh_.remove(t);
  for (Tet &tet : fresh) {
    tet.region = model.region;
    tet.component = model.component;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<Index, 3> nodes = tet.face(i);
      sortItems(nodes);
      for (const Outer &o : outer)
        if (o.nodes == nodes) tet.tags[i] = o.tag;
    }
    mesh_.add(tet);
  }
  return true;
}

bool TetEditor::swapFace(Index t, std::size_t face) {
  const Tet one = mesh_.tets[at(t)];
  if (one.tags[face] != kNone) return false;
  std::array<Index, 3> f = one.face(face);
  Index u = kNone;
  for (const Index s : mesh_.star(f[0]))
    if (s != t && mesh_.tets[at(s)].has(f[1]) && mesh_.tets[at(s)].has(f[2])) u = s;
  if (u == kNone) return false;
  const Tet two = mesh_.tets[at(u)];
  const Index p = one.v[face];
  Index q = kNone;
  for (const Index v : two.v)
    if (v != f[0] && v != f[1] && v != f[2]) q = v;
  if (volume6(mesh_.x(f[0]), mesh_.x(f[1]), mesh_.x(f[2]), mesh_.x(p)) < 0) std::swap(f[1], f[2]);
  const double least = std::min(mesh_.shape(t), mesh_.shape(u)) + kLeastGain;
  for (std::size_t k = 0; k < 3; ++k)
    if (mesh_.shape({q, p, f[k], f[(k + 1) % 3]}) <= least) return false;
  if (mesh_.hasEdge(p, q)) return false;
  mesh_.remove(t);
  mesh_.remove(u);
  for (std::size_t k = 0; k < 3; ++k) {
    const Index third = f[(k + 2) % 3];
    mesh_.add({{q, p, f[k], f[(k + 1) % 3]},
               {one.tags[at(one.local(third))], two.tags[at(two.local(third))], kNone, kNone},
               one.region,
               one.component});
  }
  return true;
}

} // namespace dualblock
