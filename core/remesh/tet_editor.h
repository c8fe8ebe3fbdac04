// Edits of tetrahedra that keep them a mesh of the domain: none inverts one, or takes a node off what it lies
// on.
#pragma once

#include "blocks/bent_shape.h"
#include "remesh/size_field.h"
#include "remesh/tet_mesh.h"

namespace dualblock {

class TetEditor {
public:
  /// domain: where the tags, sides and planes of `mesh` come from.
  TetEditor(TetMesh &mesh, const ReferenceMesh<3> &domain, const BentShape<3> &shape, const SizeField &sizes);

  /// What an edge lies on.
  struct EdgePlace {
    On on;
    std::array<Index, 2> patches;
  };
  EdgePlace placeOf(Index a, Index b);
  /// Length of an edge, as a share of what it should be.
  double lengthOf(Index a, Index b) const;

  /// Divides an edge in its middle. Returns the new node, or kNone if nothing has changed.
  Index splitEdge(Index a, Index b);
  /// Moves a into b, if the tetrahedra around then have a shape of `least`, or none is worse than the worst
  /// before, and no edge is longer than `longest`. Returns whether it did.
  bool collapseEdge(Index a, Index b, double least, double longest);
  /// Takes an edge away and fills its place otherwise, if that betters the worst shape there.
  bool swapEdge(Index a, Index b);
  /// Three tetrahedra around a new edge for the two at a face, if that betters the worst.
  bool swapFace(Index t, std::size_t face);
  /// Moves a node to where the tetrahedra around it have better shapes.
  bool smooth(Index node);

private:
  Index patchOf(Index tag) const { return patchOfTag_[at(tag)]; }
  bool isCrease(Index a, Index b, Index patch) const;
  bool fits(const std::array<Index, 3> &face, Index patch) const;
  Vec<3> projected(On on, const std::array<Index, 2> &patches, const Vec<3> &x) const;
  struct Directions {
    std::array<Vec<3>, 3> of;
    std::size_t count = 0;
  };
  Directions directionsOf(const TetNode &node) const;
  double energyAround(Index node) const;
  bool mayCollapse(Index a, Index b, const EdgePlace &place);
  bool fitsCollapsed(Index a, Index b, const EdgePlace &place, double least, double longest);
  void moveTagsToNeighbours(Index b, const std::array<Index, 2> &others, Index tag);
  bool findRing(Index a, Index b, bool &isClosed);
  double fillRing(Index a, Index b, double least);
  void addTriangle(Index a, Index b, std::size_t i, std::size_t k, std::vector<Tet> &fresh) const;

  TetMesh &mesh_;
  const BentShape<3> &shape_;
  const SizeField &sizes_;
  std::vector<Index> patchOfTag_;
  std::vector<Vec<3>> normals_; // per patch, of its plane
  std::vector<Index> shell_;
  std::vector<TetMesh::EdgeFace> faces_;
  static constexpr std::size_t kMostRing = 8;
  std::vector<Index> ring_;
  std::vector<std::array<Index, 2>> pairs_; // of the ring's nodes, as tetrahedra have them
  std::array<std::array<double, kMostRing>, kMostRing> best_{};
  std::array<std::array<std::size_t, kMostRing>, kMostRing> apex_{};
};

} // namespace dualblock
