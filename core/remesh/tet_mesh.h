// Tetrahedra that are edited one by one: the stars of all nodes are kept, and nothing else, so that an edit
// is a handful of tetrahedra that go and some that come.
#pragma once

#include <cmath>
#include <span>

#include "reference/reference_mesh.h"

namespace dualblock {

/// What a node lies on, by its dimension: it stays there.
enum class On : std::uint8_t { corner, curve, side, inside };

struct TetNode {
  Vec<3> x{0.0};
  On on = On::inside;
  std::array<Index, 2> patches{kNone,
                               kNone}; // of the curve or side: half of ReferenceMesh::sideKey, ascending
  double size = 0;                     // length that edges here should have
};

struct Tet {
  std::array<Index, 4> v{};
  std::array<Index, 4> tags{}; // FaceTag of the face opposite to v[i], or kNone
  Index region = 0;
  Index component = 0;

  int local(Index node) const {
    for (int i = 0; i < 4; ++i)
      if (v[at(i)] == node) return i;
    return -1;
  }
  bool has(Index node) const { return local(node) >= 0; }
  /// The nodes of the face opposite to v[i], in their order.
  std::array<Index, 3> face(std::size_t i) const {
    std::array<Index, 3> nodes{};
    for (std::size_t k = 0, m = 0; k < 4; ++k)
      if (k != i) nodes[m++] = v[k];
    return nodes;
  }
};

/// Six times the signed volume.
inline double volume6(const Vec<3> &a, const Vec<3> &b, const Vec<3> &c, const Vec<3> &d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

/// 1 for a regular tetrahedron, 0 for a flat one, below for an inverted one: its volume over the edges' root
/// mean square cubed (A. Liu, B. Joe, "Relationship between tetrahedron shape measures", 1994, to the power
/// of 3/2).
inline double shapeOf(const Vec<3> &a, const Vec<3> &b, const Vec<3> &c, const Vec<3> &d) {
  constexpr double kRegular = 20.784609690826528; // 12 sqrt(3): makes it 1 for a regular one
  const Vec<3> ab = b - a;
  const Vec<3> ac = c - a;
  const Vec<3> ad = d - a;
  const Vec<3> bc = c - b;
  const Vec<3> bd = d - b;
  const Vec<3> cd = d - c;
  const double squares = glm::dot(ab, ab) + glm::dot(ac, ac) + glm::dot(ad, ad) + glm::dot(bc, bc) +
                         glm::dot(bd, bd) + glm::dot(cd, cd);
  return squares > 0 ? kRegular * glm::dot(glm::cross(ab, ac), ad) / (squares * std::sqrt(squares)) : 0;
}

class TetMesh {
public:
  std::vector<TetNode> nodes;
  std::vector<Tet> tets;

  bool isAlive(Index t) const { return tets[at(t)].v[0] != kNone; }
  std::span<const Index> star(Index node) const { return stars_[at(node)]; }
  Index aliveCount() const { return alive_; }

  Index addNode(const TetNode &node) {
    nodes.push_back(node);
    stars_.emplace_back();
    stamps_.push_back(0);
    return toIndex(nodes.size()) - 1;
  }
  Index add(const Tet &tet);
  void remove(Index t);

  /// From here on edits can be taken back, all together: rollBack(), or keep() them. `worstOfNew`: the worst
  /// shape among the tetrahedra that came, or whose nodes moved.
  void mark();
  void rollBack();
  void keep() { isMarked_ = false; }
  void move(Index node, const Vec<3> &x);
  /// Whether anything at the nodes of a tetrahedron, or where a neighbour of them is, has changed since
  /// unchanged(t).
  bool hasChanged(Index t) const;
  void unchanged(Index t) { seen_[at(t)] = clock_; }
  void setTag(Index t, std::size_t face, Index tag);
  double worstOfNew() const;

  const Vec<3> &x(Index node) const { return nodes[at(node)].x; }
  double shape(const std::array<Index, 4> &v) const { return shapeOf(x(v[0]), x(v[1]), x(v[2]), x(v[3])); }
  double shape(Index t) const { return shape(tets[at(t)].v); }
  /// The tetrahedra that have the edge, in `shell`.
  void shellOf(Index a, Index b, std::vector<Index> &shell) const;
  bool hasEdge(Index a, Index b) const;
  /// The tagged faces at the edge within its shell: their tags and third nodes; from each tetrahedron that
  /// has one.
  struct EdgeFace {
    Index tag, third, tet;
  };
  void facesAt(Index a, Index b, const std::vector<Index> &shell, std::vector<EdgeFace> &faces) const;

private:
  void place(Index node, const Vec<3> &x);
  void touch(Index t); // something at its nodes has changed

  std::vector<std::vector<Index>> stars_;
  std::uint64_t clock_ = 1;             // counts changes
  std::vector<std::uint64_t> stamps_{}; // per node: of the last one there
  std::vector<std::uint64_t> seen_{};   // per tetrahedron: when it was last found unchanged
  struct Edit { // a tetrahedron that came (its number) or went (what it was), or where a node was
    Index tet, node;
    Tet was;
    Vec<3> place;
  };
  bool isMarked_ = false;
  std::vector<Edit> edits_;
  std::vector<Index> free_;
  Index alive_ = 0;
};

} // namespace dualblock
