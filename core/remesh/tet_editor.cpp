#include "remesh/tet_editor.h"

#include <cmath>

#include "partition/heuristics.h"

namespace dualblock {

TetEditor::TetEditor(TetMesh &mesh, const ReferenceMesh<3> &domain, const BentShape<3> &shape,
                     const SizeField &sizes)
    : mesh_(mesh), shape_(shape), sizes_(sizes) {
  for (Index tag = 0; tag < 2 * toIndex(domain.surfaces.size()); ++tag)
    patchOfTag_.push_back(domain.sideKey(tag) / 2);
  for (const Surface<3> &surface : domain.surfaces) normals_.push_back(surface.plane.normal);
}

double TetEditor::lengthOf(Index a, Index b) const {
  return 2 * glm::length(mesh_.x(a) - mesh_.x(b)) / (mesh_.nodes[at(a)].size + mesh_.nodes[at(b)].size);
}

/// Whether an edge within a side lies along one of its creases.
bool TetEditor::isCrease(Index a, Index b, Index patch) const {
  if (!shape_.hasCurve(patch, patch)) return false;
  for (const Index v : {a, b}) {
    const TetNode &node = mesh_.nodes[at(v)];
    if (node.on == On::side || (node.on == On::curve && node.patches[0] != node.patches[1])) return false;
  }
  const Vec<3> middle = (mesh_.x(a) + mesh_.x(b)) / 2.0;
  return glm::length(shape_.onCurve(patch, patch, middle).point - middle) <=
         kFittingSagitta * glm::length(mesh_.x(a) - mesh_.x(b));
}

TetEditor::EdgePlace TetEditor::placeOf(Index a, Index b) {
  mesh_.shellOf(a, b, shell_);
  mesh_.facesAt(a, b, shell_, faces_);
  EdgePlace place{On::inside, {kNone, kNone}};
  for (const TetMesh::EdgeFace &face : faces_) {
    const Index patch = patchOf(face.tag);
    if (place.on == On::inside) {
      place = {On::side, {patch, kNone}};
    } else if (patch != place.patches[0] && patch != place.patches[1]) {
      const bool isKnown = place.on == On::curve && shape_.hasCurve(place.patches[0], place.patches[1]);
      if (!isKnown) place.patches = sortedPair(place.patches[0], patch);
      place.on = On::curve;
    }
  }
  if (place.on == On::side && isCrease(a, b, place.patches[0]))
    place = {On::curve, {place.patches[0], place.patches[0]}};
  return place;
}

Vec<3> TetEditor::projected(On on, const std::array<Index, 2> &patches, const Vec<3> &x) const {
  if (on == On::curve) return shape_.onCurve(patches[0], patches[1], x).point;
  return on == On::side && shape_.isBent(patches[0]) ? shape_.onSide(patches[0], x).point : x;
}

TetEditor::Directions TetEditor::directionsOf(const TetNode &node) const {
  Directions result;
  const auto put = [&](const Vec<3> &d) { result.of[result.count++] = d; };
  if (node.on == On::curve) {
    const Vec<3> along = shape_.onCurve(node.patches[0], node.patches[1], node.x).direction;
    if (along != Vec<3>(0.0)) put(along);
  }
  if (node.on == On::side) {
    const Vec<3> normal = shape_.isBent(node.patches[0]) ? shape_.onSide(node.patches[0], node.x).direction
                                                         : normals_[at(node.patches[0])];
    Vec<3> u{0.0};
    u[std::abs(normal.x) < 0.6 ? 0 : std::abs(normal.y) < 0.6 ? 1 : 2] = 1;
    u = glm::normalize(glm::cross(normal, u));
    put(u);
    put(glm::cross(normal, u));
  }
  if (node.on == On::inside)
    for (int k = 0; k < 3; ++k) {
      Vec<3> unit{0.0};
      unit[k] = 1;
      put(unit);
    }
  return result;
}

bool TetEditor::fits(const std::array<Index, 3> &face, Index patch) const {
  if (!shape_.isBent(patch)) return true;
  const Vec<3> &a = mesh_.x(face[0]);
  const Vec<3> &b = mesh_.x(face[1]);
  const Vec<3> &c = mesh_.x(face[2]);
  const Vec<3> middle = (a + b + c) / 3.0;
  const auto near = shape_.onSide(patch, middle);
  const Vec<3> normal = glm::cross(b - a, c - a);
  const double area2 = glm::length(normal);
  if (!(area2 > 0)) return false;
  const double cosine = std::abs(glm::dot(normal, near.direction)) / area2;
  const double shortest =
      std::sqrt(std::min({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
  const double most = kFittingSagitta * shortest;
  if (cosine < kFittingCosine || glm::length(near.point - middle) > most) return false;
  for (const auto &[from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const Vec<3> half = (from + to) / 2.0;
    if (glm::length(shape_.onSide(patch, half).point - half) > most) return false;
  }
  return true;
}

Index TetEditor::splitEdge(Index a, Index b) {
  const EdgePlace place = placeOf(a, b);
  const std::vector<Index> shell = shell_;
  const Vec<3> middle = (mesh_.x(a) + mesh_.x(b)) / 2.0;
  TetNode node{projected(place.on, place.patches, middle), place.on, place.patches, 0};
  if (place.on == On::side) node.patches[1] = kNone;
  const auto isPositive = [&](const Vec<3> &x) {
    return std::all_of(shell.begin(), shell.end(), [&](Index t) {
      for (const Index from : {a, b}) {
        std::array<Vec<3>, 4> c;
        for (std::size_t k = 0; k < 4; ++k) {
          const Index v = mesh_.tets[at(t)].v[k];
          c[k] = v == from ? x : mesh_.x(v);
        }
        const double half = mesh_.shape(t);
        if (!(shapeOf(c[0], c[1], c[2], c[3]) > kKeptBySplit * half)) return false;
      }
      return true;
    });
  };
  if (!isPositive(node.x)) {
    node.x = middle;
    if (!isPositive(middle)) return kNone;
  }
  const double sizeA = mesh_.nodes[at(a)].size;
  const double sizeB = mesh_.nodes[at(b)].size;
  node.size = std::min(std::min(sizeA, sizeB) + kSizeGrowth * glm::length(mesh_.x(a) - mesh_.x(b)) / 2,
                       sizes_.largest());
  if (place.on == On::side) node.size = std::min(node.size, sizes_.onSide(place.patches[0], node.x));
  if (place.on == On::curve) node.size = std::min(node.size, sizes_.onCurve(place.patches, node.x));
  const Index n = mesh_.addNode(node);
  for (const Index t : shell) {
    const Tet old = mesh_.tets[at(t)];
    mesh_.remove(t);
    for (const auto &[from, other] : {std::pair(a, b), std::pair(b, a)}) {
      Tet half = old;
      half.tags[at(old.local(other))] = kNone; // between the halves
      half.v[at(old.local(from))] = n;
      mesh_.add(half);
    }
  }
  return n;
}

double TetEditor::energyAround(Index node) const {
  double sum = 0;
  for (const Index t : mesh_.star(node)) {
    const double shape = mesh_.shape(t);
    if (!(shape > 0)) return std::numeric_limits<double>::infinity();
    sum += 1 / (shape * shape * shape);
  }
  return sum;
}

bool TetEditor::smooth(Index node) {
  TetNode &it = mesh_.nodes[at(node)];
  const Directions directions = directionsOf(it);
  if (directions.count == 0 || mesh_.star(node).empty()) return false;
  const Vec<3> start = it.x;
  const double before = energyAround(node);
  if (!std::isfinite(before)) return false;
  double scale = std::numeric_limits<double>::infinity();
  for (const Index t : mesh_.star(node))
    for (const Index v : mesh_.tets[at(t)].v)
      if (v != node) scale = std::min(scale, glm::length(mesh_.x(v) - start));
  const double h = 1e-3 * scale;
  Vec<3> step{0.0};
  for (std::size_t k = 0; k < directions.count; ++k) { // a Newton step per direction
    const Vec<3> &d = directions.of[k];
    it.x = start + h * d;
    const double ahead = energyAround(node);
    it.x = start - h * d;
    const double behind = energyAround(node);
    it.x = start;
    if (!std::isfinite(ahead) || !std::isfinite(behind)) continue;
    const double slope = (ahead - behind) / (2 * h);
    const double bend = (ahead - 2 * before + behind) / (h * h);
    const double limit = 0.3 * scale;
    const double length = bend > 0 ? -slope / bend : (slope > 0 ? -limit : limit);
    step += std::clamp(length, -limit, limit) * d;
  }
  const auto keepsSides = [&] {
    if (it.on == On::inside) return true;
    for (const Index t : mesh_.star(node)) {
      const Tet &tet = mesh_.tets[at(t)];
      for (std::size_t i = 0; i < 4; ++i) {
        if (tet.tags[i] == kNone || tet.v[i] == node) continue;
        if (!fits(tet.face(i), patchOf(tet.tags[i]))) return false;
      }
    }
    return true;
  };
  for (int halving = 0; halving < 4; ++halving, step *= 0.5) {
    it.x = projected(it.on, it.patches, start + step);
    const bool isBetter = energyAround(node) < before * (1 - 1e-4) && keepsSides();
    const Vec<3> end = it.x;
    it.x = start;
    if (!isBetter) continue;
    mesh_.move(node, end);
    return true;
  }
  return false;
}

} // namespace dualblock
