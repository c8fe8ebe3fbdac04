// Midpoint subdivision of the parts, as an oracle for the primal (ARCHITECTURE.md 4): in simple parts the
// D-bar- cells correspond one to one to the faces of the part as a polytope, and the blocks to its corners.
//
// Nothing of the dual is used. A face of a polytope (a corner, curve, side, or the polytope itself) is known
// by its dimension and the set of its corners' coordinates; that alone glues the polytopes to one another,
// since parts meet in whole sides. Curves get their corners from their chain of ridges, sides from the faces
// of the reference mesh that they consist of.
#pragma once

#include <map>
#include <set>
#include <stdexcept>

#include "canonical_form.h"
#include "parts/parts.h"

namespace dualblock::test {

template <int N> struct MidpointSubdivision {
  using Point = std::array<double, N>;
  struct Face {
    int dimension;
    std::vector<Point> corners; // sorted
    bool operator<(const Face &o) const {
      return dimension != o.dimension ? dimension < o.dimension : corners < o.corners;
    }
  };

  std::map<Face, Index> nodes; // the complex's nodes
  BlockList<N> blocks;
  std::set<std::array<Index, 2>> edges;
  std::set<std::array<Index, 4>> faces; // sorted nodes
};

template <int N> class MidpointSubdivider {
public:
  MidpointSubdivider(const ReferenceMesh<N> &mesh, const Parts<N> &parts) : mesh_(mesh), parts_(parts) {
    for (const Corner &corner : parts.corners) cornersOf_[corner.part].insert(corner.node);
    for (Index s = 0; s < toIndex(parts.sides.size()); ++s) sideCorners_.push_back(cornersOnSide(s));
    if constexpr (N == 3)
      for (const Curve<N> &curve : parts.curves) curveEnds_.push_back(endsOf(curve));
  }

  MidpointSubdivision<N> build() {
    for (const Corner &corner : parts_.corners) addBlock(corner);
    return std::move(result_);
  }

private:
  using Nodes = std::set<Index>;

  Nodes cornersOnSide(Index side) const {
    Nodes found;
    const Nodes &corners = cornersOf_.at(parts_.sides[at(side)].part);
    for (const FaceRef<N> *f = parts_.sideFaces.begin(side); f != parts_.sideFaces.end(side); ++f)
      for (const Index v : mesh_.sortedFace(f->simplex, f->face))
        if (corners.count(v)) found.insert(v);
    return found;
  }

  /// The nodes that the chain passes an odd number of times.
  static Nodes endsOf(const Curve<3> &curve) {
    Nodes ends;
    for (const auto &ridge : curve.ridges)
      for (const Index v : ridge)
        if (!ends.insert(v).second) ends.erase(v);
    return ends;
  }

  Index nodeFor(int dimension, const Nodes &corners) {
    typename MidpointSubdivision<N>::Face face{dimension, {}};
    for (const Index v : corners) {
      std::array<double, N> point{};
      for (int k = 0; k < N; ++k) point[at(k)] = mesh_.nodes[at(v)][k];
      face.corners.push_back(point);
    }
    std::sort(face.corners.begin(), face.corners.end());
    return result_.nodes.emplace(std::move(face), toIndex(result_.nodes.size())).first->second;
  }

  /// The part's curve between two sides that ends at the node.
  const Nodes &curveAt(const Corner &corner, Index a, Index b) const {
    const Nodes *found = nullptr;
    for (std::size_t c = 0; c < parts_.curves.size(); ++c) {
      const Curve<N> &curve = parts_.curves[c];
      if (curve.part != corner.part || curve.sides != sortedPair(a, b) || !curveEnds_[c].count(corner.node))
        continue;
      if (found) throw std::invalid_argument("two curves between the same sides end at one corner");
      found = &curveEnds_[c];
    }
    if (!found) throw std::invalid_argument("no curve between two sides of a corner");
    return *found;
  }

  void addBlock(const Corner &corner) {
    if (corner.sides.size() != N) throw std::invalid_argument("a corner of more sides than dimensions");
    std::array<Index, 1 << N> byBits{};
    byBits[0] = nodeFor(N, cornersOf_.at(corner.part));
    byBits[(1U << N) - 1] = nodeFor(0, {corner.node});
    for (unsigned k = 0; k < N; ++k) byBits[1U << k] = nodeFor(N - 1, sideCorners_[at(corner.sides[k])]);
    if constexpr (N == 3)
      for (unsigned k = 0; k < 3; ++k)
        for (unsigned m = k + 1; m < 3; ++m)
          byBits[1U << k | 1U << m] = nodeFor(1, curveAt(corner, corner.sides[k], corner.sides[m]));
    std::array<Index, 1 << N> block{};
    for (unsigned bits = 0; bits < 1U << N; ++bits) {
      block[at(vtkPlace<N>(bits))] = byBits[bits];
      for (unsigned k = 0; k < N; ++k) {
        if (bits >> k & 1) continue;
        result_.edges.insert(sortedPair(byBits[bits], byBits[bits | 1U << k]));
        for (unsigned m = k + 1; m < N; ++m) {
          if (bits >> m & 1) continue;
          std::array<Index, 4> face{byBits[bits], byBits[bits | 1U << k], byBits[bits | 1U << m],
                                    byBits[bits | 1U << k | 1U << m]};
          std::sort(face.begin(), face.end());
          result_.faces.insert(face);
        }
      }
    }
    result_.blocks.push_back(block);
  }

  const ReferenceMesh<N> &mesh_;
  const Parts<N> &parts_;
  std::map<Index, Nodes> cornersOf_; // per part
  std::vector<Nodes> sideCorners_;   // per side
  std::vector<Nodes> curveEnds_;     // per curve (3D)
  MidpointSubdivision<N> result_;
};

/// Throws where a part is not simple, and so has no midpoint subdivision.
template <int N>
MidpointSubdivision<N> midpointSubdivision(const ReferenceMesh<N> &mesh, const Parts<N> &parts) {
  return MidpointSubdivider<N>(mesh, parts).build();
}

} // namespace dualblock::test
