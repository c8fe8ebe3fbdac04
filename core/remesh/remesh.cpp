#include "remesh/remesh.h"

#include <cmath>

#include "base/deadline.h"
#include "partition/heuristics.h"
#include "remesh/load.h"
#include "remesh/tet_editor.h"

namespace dualblock {
namespace {

using Edge = std::array<Index, 2>;
constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

class Remesher {
public:
  Remesher(const ReferenceMesh<3> &coarse, const Parts<3> &features, const RemeshOptions &options)
      : coarse_(coarse), sizes_(coarse, features, options.scale),
        shape_(bentFacetsOf(coarse, features, coarse.nodes, true)), mesh_(loadTets(coarse, features, shape_)),
        editor_(mesh_, coarse, shape_, sizes_),
        most_(static_cast<Index>(kMostTets / (options.scale * options.scale * options.scale))),
        limit_(kTimesMost * std::max(most_, coarse.simplexCount())), mostTets_(options.mostTets) {
    for (std::size_t v = 0; v < mesh_.nodes.size(); ++v) {
      TetNode &node = mesh_.nodes[v];
      node.size = sizes_.largest();
      if (node.on == On::side) node.size = sizes_.onSide(node.patches[0], node.x);
      if (node.on == On::curve) node.size = sizes_.onCurve(node.patches, node.x);
    }
    gradeSizes();
  }

  std::optional<ReferenceMesh<3>> run() {
    for (int pass = 0; pass < kSizePasses; ++pass) {
      divideLong();
      if (mostTets_ > 0 && mesh_.aliveCount() > kTimesMost * mostTets_) return std::nullopt;
      swapAll();
      contractShort();
      swapAll();
      smoothAll();
      gradeSizes();
      if (mesh_.aliveCount() > most_)
        for (TetNode &node : mesh_.nodes) node.size *= kCoarser;
    }
    if (mostTets_ > 0 && mesh_.aliveCount() > mostTets_) return std::nullopt;
    for (int pass = 0; pass < kShapePasses; ++pass) {
      const Index divided = divideCorners();
      if (improveWorst() + divided == 0) break;
    }
    divideCorners();
    return result();
  }

private:
  std::vector<Edge> edges() const {
    std::vector<Edge> all;
    for (Index t = 0; t < toIndex(mesh_.tets.size()); ++t) {
      if (!mesh_.isAlive(t)) continue;
      const auto &v = mesh_.tets[at(t)].v;
      for (const auto &[a, b] : kEdges) all.push_back(sortedPair(v[a], v[b]));
    }
    sortItems(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// No size is so much larger than one nearby that edges could not grow as fast; corners take what is
  /// around.
  void gradeSizes() {
    const std::vector<Edge> all = edges();
    for (int round = 0; round < kGradeRounds; ++round) {
      bool changed = false;
      for (const Edge &e : all)
        for (const auto &[from, to] : {std::pair(e[0], e[1]), std::pair(e[1], e[0])}) {
          const double most =
              mesh_.nodes[at(from)].size + kSizeGrowth * glm::length(mesh_.x(e[0]) - mesh_.x(e[1]));
          if (mesh_.nodes[at(to)].size <= most * (1 + 1e-9)) continue;
          mesh_.nodes[at(to)].size = most;
          changed = true;
        }
      if (!changed) break;
    }
  }

  /// Edges by length, the longest first if asked for, of those that `wanted(length)` holds for.
  template <typename Wanted> std::vector<Edge> sortedEdges(bool longestFirst, const Wanted &wanted) const {
    std::vector<std::pair<double, Edge>> found;
    for (const Edge &e : edges())
      if (const double length = editor_.lengthOf(e[0], e[1]); wanted(length))
        found.emplace_back(longestFirst ? -length : length, e);
    sortItems(found);
    std::vector<Edge> result;
    for (const auto &[length, e] : found) result.push_back(e);
    return result;
  }

  void divideLong() {
    for (int round = 0; round < kDivideRounds; ++round) {
      checkDeadline();
      Index divided = 0;
      for (const Edge &e : sortedEdges(true, [](double length) { return length > kLongEdge; })) {
        if (mesh_.aliveCount() > limit_) return;
        if (mesh_.hasEdge(e[0], e[1]) && editor_.lengthOf(e[0], e[1]) > kLongEdge)
          divided += editor_.splitEdge(e[0], e[1]) != kNone ? 1 : 0;
      }
      if (divided == 0) break;
    }
  }

  void contractShort() {
    for (int round = 0; round < kDivideRounds; ++round) {
      checkDeadline();
      Index contracted = 0;
      for (const Edge &e : sortedEdges(false, [](double length) { return length < kShortEdge; })) {
        if (mesh_.star(e[0]).empty() || mesh_.star(e[1]).empty() || !mesh_.hasEdge(e[0], e[1])) continue;
        if (editor_.lengthOf(e[0], e[1]) >= kShortEdge) continue;
        // What lies on more moves into what lies on less.
        const bool second = mesh_.nodes[at(e[1])].on > mesh_.nodes[at(e[0])].on;
        const Index a = second ? e[1] : e[0];
        const Index b = second ? e[0] : e[1];
        if (editor_.collapseEdge(a, b, kShapeOfContracted, kLongEdge) ||
            editor_.collapseEdge(b, a, kShapeOfContracted, kLongEdge))
          ++contracted;
      }
      if (contracted == 0) break;
    }
  }

  /// Tetrahedra that could be better, by their shapes.
  std::vector<std::pair<double, Index>> worstFirst() const {
    std::vector<std::pair<double, Index>> order;
    for (Index t = 0; t < toIndex(mesh_.tets.size()); ++t)
      if (mesh_.isAlive(t))
        if (const double shape = mesh_.shape(t); shape < kGoodShape) order.emplace_back(shape, t);
    sortItems(order);
    return order;
  }

  void swapAll() {
    for (int round = 0; round < kSwapRounds; ++round) {
      checkDeadline();
      Index swapped = 0;
      for (const auto &[shape, t] : worstFirst())
        if (mesh_.isAlive(t) && mesh_.shape(t) == shape && swapAt(t)) ++swapped;
      if (swapped == 0) break;
    }
  }

  bool swapAt(Index t) {
    if (!mesh_.hasChanged(t)) return false; // since it could not be bettered
    const auto v = mesh_.tets[at(t)].v;
    for (const auto &[a, b] : kEdges)
      if (editor_.swapEdge(v[a], v[b])) return true;
    for (std::size_t i = 0; i < 4; ++i)
      if (editor_.swapFace(t, i)) return true;
    mesh_.unchanged(t);
    return false;
  }

  void smoothAll() {
    for (int round = 0; round < kSmoothRounds; ++round) {
      checkDeadline();
      for (Index v = 0; v < toIndex(mesh_.nodes.size()); ++v) editor_.smooth(v);
    }
  }

  /// A tetrahedron with two faces on one bent side would make blocks with two faces there, at an angle of 180
  /// degrees or more. Its edge between those faces' third nodes is divided. Returns how many were.
  Index divideCorners() {
    Index divided = 0;
    for (Index t = 0; t < toIndex(mesh_.tets.size()); ++t) {
      if (!mesh_.isAlive(t)) continue;
      const Tet tet = mesh_.tets[at(t)];
      for (const auto &[i, k] : kEdges) {
        if (tet.tags[i] == kNone || tet.tags[k] == kNone) continue;
        const Index patch = coarse_.sideKey(tet.tags[i]) / 2;
        if (patch != coarse_.sideKey(tet.tags[k]) / 2 || !shape_.isBent(patch)) continue;
        std::array<Index, 2> shared{kNone, kNone};
        for (std::size_t m = 0; m < 4; ++m)
          if (m != i && m != k) shared[shared[0] == kNone ? 0 : 1] = tet.v[m];
        if (editor_.placeOf(shared[0], shared[1]).on == On::curve) continue; // in a crease the angle is less
        const Index node = editor_.splitEdge(tet.v[i], tet.v[k]);
        if (node == kNone) continue;
        settle(node);
        ++divided;
        break;
      }
    }
    return divided;
  }

  /// Whatever betters the worst tetrahedra. Returns how many edits did.
  Index improveWorst() {
    checkDeadline();
    Index edits = 0;
    for (const auto &[shape, t] : worstFirst()) {
      if (!mesh_.isAlive(t) || mesh_.shape(t) != shape) continue;
      edits += improve(t) ? 1 : 0;
    }
    return edits;
  }

  bool improve(Index t) {
    if (swapAt(t)) return true;
    const double shape = mesh_.shape(t);
    const auto v = mesh_.tets[at(t)].v;
    bool moved = false;
    for (const Index node : v) moved |= editor_.smooth(node);
    if (moved) return true;
    for (const auto &[a, b] : kEdges)
      for (const auto &[from, to] : {std::pair(v[a], v[b]), std::pair(v[b], v[a])})
        if (editor_.collapseEdge(from, to, shape + kLeastGain, 2 * kLongEdge)) return true;
    return shape < kPoorTet && improveByTrial(t);
  }

  /// Divides or contracts an edge of a poor tetrahedron although that makes others as poor at first, lets
  /// what is around find its way, and takes it back if nothing is won.
  bool improveByTrial(Index t) {
    const double least = mesh_.shape(t) + kLeastGain;
    const auto v = mesh_.tets[at(t)].v;
    std::vector<std::pair<double, Edge>> order;
    for (const auto &[a, b] : kEdges)
      order.emplace_back(-glm::length(mesh_.x(v[a]) - mesh_.x(v[b])), Edge{v[a], v[b]});
    sortItems(order);
    const auto serves = [&](Index node) {
      settle(node);
      const bool isBetter = mesh_.worstOfNew() > least;
      if (isBetter) mesh_.keep();
      else mesh_.rollBack();
      return isBetter;
    };
    for (const auto &[length, e] : order) {
      mesh_.mark();
      const Index node = editor_.splitEdge(e[0], e[1]);
      if (node == kNone) mesh_.keep();
      else if (serves(node)) return true;
    }
    for (auto edge = order.rbegin(); edge != order.rend(); ++edge)
      for (const auto &[from, to] :
           {std::pair(edge->second[0], edge->second[1]), std::pair(edge->second[1], edge->second[0])}) {
        mesh_.mark();
        if (!editor_.collapseEdge(from, to, 0, 2 * kLongEdge)) mesh_.keep();
        else if (serves(to)) return true;
      }
    return false;
  }

  /// Nodes around one move, and edges swap, to where shapes are better.
  void settle(Index node) {
    for (int round = 0; round < 2; ++round) {
      editor_.smooth(node);
      const std::vector<Index> star(mesh_.star(node).begin(), mesh_.star(node).end());
      std::vector<Index> around;
      for (const Index t : star)
        for (const Index v : mesh_.tets[at(t)].v) around.push_back(v);
      sortItems(around);
      around.erase(std::unique(around.begin(), around.end()), around.end());
      for (const Index t : star)
        if (mesh_.isAlive(t) && mesh_.tets[at(t)].has(node) && mesh_.shape(t) < kGoodShape) swapAt(t);
      for (const Index v : around) editor_.smooth(v);
    }
  }

  ReferenceMesh<3> result() const {
    ReferenceMesh<3> mesh;
    mesh.componentCount = coarse_.componentCount;
    mesh.surfaces = coarse_.surfaces;
    mesh.size = coarse_.size;
    mesh.smoothCosine = coarse_.smoothCosine;
    std::vector<Index> number(mesh_.nodes.size(), kNone);
    for (std::size_t v = 0; v < mesh_.nodes.size(); ++v) {
      if (mesh_.star(toIndex(v)).empty()) continue;
      number[v] = mesh.nodeCount();
      mesh.nodes.push_back(mesh_.nodes[v].x);
    }
    for (Index t = 0; t < toIndex(mesh_.tets.size()); ++t) {
      if (!mesh_.isAlive(t)) continue;
      const Tet &tet = mesh_.tets[at(t)];
      auto v = tet.v;
      for (Index &n : v) n = number[at(n)];
      mesh.simplices.push_back(v);
      mesh.tags.push_back(tet.tags);
      mesh.region.push_back(tet.region);
      mesh.component.push_back(tet.component);
    }
    connect(mesh);
    return mesh;
  }

  const ReferenceMesh<3> &coarse_;
  SizeField sizes_;
  BentShape<3> shape_;
  TetMesh mesh_;
  TetEditor editor_;
  Index most_;
  Index limit_; // while there are more than in the end
  Index mostTets_;
};

} // namespace

std::optional<ReferenceMesh<3>> remesh(const ReferenceMesh<3> &coarse, const Parts<3> &features,
                                       const RemeshOptions &options) {
  if (coarse.simplices.empty()) return std::nullopt;
  return Remesher(coarse, features, options).run();
}

} // namespace dualblock
