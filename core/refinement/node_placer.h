// Where the nodes of a refined mesh go: on edges, then on faces, then inside of blocks (ARCHITECTURE.md 9).
#pragma once

#include "domain/domain.h"
#include "geometry/jacobian.h"
#include "refinement/carry_bends.h"
#include "refinement/curved_edges.h"
#include "refinement/node_grid.h"
#include "refinement/transfinite.h"

namespace dualblock {

/// Places nodes round by round, until no block asks for more.
template <int N> class NodePlacer {
public:
  /// `grid` is entered by whoever calls placeInside; `positions` holds the blocks' own nodes, and room for
  /// all.
  NodePlacer(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton, const BentShape<N> &shape,
             NodeGrid<N> &grid, std::vector<Vec<N>> &positions)
      : blocks_(blocks), skeleton_(skeleton), shape_(shape), grid_(grid), positions_(positions),
        mayBendEdge_(skeleton.edges.size(), true), mayBendFace_(skeleton.faces.size(), true),
        isStraightEdge_(skeleton.edges.size(), true), isStraightFace_(skeleton.faces.size(), true),
        follows_(blocks.blocks.size(), false), edgeFollows_(skeleton.edges.size(), false),
        faceFollows_(skeleton.faces.size(), false) {
    constexpr double kLeastShift = 1e-4; // of the mesh's size
    leastShift_ = kLeastShift * domainSize<N>(blocks.positions);
    for (Index e = 0; e < toIndex(skeleton.edges.size()); ++e)
      isBent_ = isBent_ || isCurved(shape, skeleton, e);
  }

  /// The nodes that blocks share.
  void placeShared() {
    placeEdges();
    if constexpr (N == 3) placeFaces();
  }

  /// Those inside the block that the grid holds. False if an element is not positive: then the block has
  /// asked for its edges and faces to follow the bends around it, or else to stay straight, and everything
  /// has to be placed once more.
  bool placeInside(Index b) {
    interpolateInside(b);
    if (isStraight(b) || evenOut(b)) return true;
    if (!follows_[at(b)]) follow(b);
    else straighten(b);
    return false;
  }

  bool isStraightEdge(Index edge) const { return isStraightEdge_[at(edge)]; }
  /// Blocks that had to stay straight.
  const std::vector<Index> &straightened() const { return straightened_; }

private:
  void placeEdges() {
    std::vector<double> places;
    std::vector<Vec<N>> points;
    const Index edges = toIndex(skeleton_.edges.size());
    for (Index e = 0; e < edges; ++e) {
      const auto &[low, high] = skeleton_.edges[at(e)];
      const Vec<N> a = positions_[at(low)];
      const Vec<N> b = positions_[at(high)];
      for (Index k = 1; k < grid_.intervalsOf(e); ++k)
        positions_[at(grid_.firstOfEdge(e) + k - 1)] = transfinite<N, 1>(
            {grid_.placeOf(e, low, k)}, [&](unsigned, unsigned bits) { return bits ? b : a; });
    }
    if constexpr (N == 3) {
      if (!isBent_) return;
      // First the curves, then what is inside of sides, which starts from where those around it lead: what is
      // next to a far chord would be the side's rim. Then what is inside of the domain.
      std::vector<Vec<N>> shifts(at(firstInFaces_ - firstInEdges_), Vec<N>(0.0));
      const auto bend = [&](bool curves) {
        for (Index e = 0; e < edges; ++e) {
          const bool isWanted = mayBendEdge_[at(e)] && isCurved(shape_, skeleton_, e);
          if (!isWanted || (skeleton_.patchesOfEdge.size(e) > 1) != curves) continue;
          const auto &[low, high] = skeleton_.edges[at(e)];
          places.clear();
          points.clear();
          for (Index k = 0; k <= grid_.intervalsOf(e); ++k) {
            const Index node = grid_.nodeOfEdge(e, low, k);
            places.push_back(grid_.placeOf(e, low, k));
            points.push_back(positions_[at(node)]);
            if (node >= firstInEdges_) points.back() += shifts[at(node - firstInEdges_)];
          }
          bendEdge(shape_, skeleton_, e, places, points);
          for (Index k = 1; k < grid_.intervalsOf(e); ++k) {
            const Index node = grid_.firstOfEdge(e) + k - 1;
            shifts[at(node - firstInEdges_)] = points[at(k)] - positions_[at(node)];
          }
        }
      };
      bend(true);
      carryShifts<N>(edgesFollowed(true), shifts);
      bend(false);
      carryShifts<N>(edgesFollowed(false), shifts);
      for (Index e = 0; e < edges; ++e)
        isStraightEdge_[at(e)] = !shift(grid_.firstOfEdge(e), grid_.intervalsOf(e) - 1, firstInEdges_, shifts,
                                        isCurved(shape_, skeleton_, e) ? 0 : leastShift_);
    }
  }

  /// Adds shifts to `count` nodes from `first` on, if any is larger than `least`.
  bool shift(Index first, Index count, Index base, const std::vector<Vec<N>> &shifts, double least) {
    bool any = false;
    for (Index n = first; n < first + count; ++n) any |= glm::length(shifts[at(n - base)]) > least;
    for (Index n = first; any && n < first + count; ++n) positions_[at(n)] += shifts[at(n - base)];
    return any;
  }

  /// Edges inside of sides, or those inside of the domain, follow the ones across the faces there.
  Lists<Index> edgesFollowed(bool onSides) const {
    const auto followsIn = [&](Index edge, Index face) {
      const Index *const patch = skeleton_.patchesOfEdge.begin(edge);
      if (!mayBendEdge_[at(edge)] || skeleton_.patchesOfEdge.size(edge) != (onSides ? 1 : 0)) return false;
      if (!onSides) return static_cast<bool>(edgeFollows_[at(edge)]);
      return skeleton_.patchOfFace[at(face)] == *patch && (edgeFollows_[at(edge)] || shape_.isBent(*patch));
    };
    return collectLists<Index>(at(firstInFaces_ - firstInEdges_), [&](auto put) {
      for (Index f = 0; f < toIndex(skeleton_.faces.size()); ++f) {
        const auto &v = skeleton_.faces[at(f)];
        const auto &edges = skeleton_.edgesOfFace[at(f)];
        const std::array<Index, 4> from{v[0], v[3], v[0], v[1]};
        for (std::size_t e = 0; e < 4; ++e) {
          if (!followsIn(edges[e], f)) continue;
          for (Index k = 1; k < grid_.intervalsOf(edges[e]); ++k)
            put(grid_.nodeOfEdge(edges[e], from[e], k) - firstInEdges_,
                grid_.nodeOfEdge(edges[e ^ 1U], from[e ^ 1U], k) - firstInEdges_);
        }
      }
    });
  }

  void placeFaces() {
    std::vector<Vec<N>> shifts(isBent_ ? at(firstInBlocks_ - firstInFaces_) : 0, Vec<N>(0.0));
    for (Index f = 0; f < toIndex(skeleton_.faces.size()); ++f) {
      const auto n = grid_.intervalsOfFace(f);
      const auto &v = skeleton_.faces[at(f)];
      const auto &edges = skeleton_.edgesOfFace[at(f)];
      for (Index y = 1; y < n[1]; ++y)
        for (Index x = 1; x < n[0]; ++x) {
          const std::array<double, 2> t{grid_.placeOf(edges[0], v[0], x), grid_.placeOf(edges[2], v[0], y)};
          const Vec<N> point = transfinite<N, 2>(t, [&](unsigned axes, unsigned bits) {
            const Index i = axes & 1U ? (bits & 1U ? n[0] : 0) : x;
            const Index j = axes & 2U ? (bits & 2U ? n[1] : 0) : y;
            return positions_[at(grid_.nodeOfFace(f, i, j))];
          });
          const Index node = grid_.nodeOfFace(f, x, y);
          positions_[at(node)] = point;
          if (isOnBentSide(f) && mayBendFace_[at(f)])
            shifts[at(node - firstInFaces_)] =
                shape_.onSide(skeleton_.patchOfFace[at(f)], point).point - point;
        }
    }
    if (!isBent_) return;
    carryShifts<N>(facesFollowed(), shifts);
    for (Index f = 0; f < toIndex(skeleton_.faces.size()); ++f) {
      const auto n = grid_.intervalsOfFace(f);
      isStraightFace_[at(f)] = !shift(grid_.firstOfFace(f), (n[0] - 1) * (n[1] - 1), firstInFaces_, shifts,
                                      isOnBentSide(f) ? 0 : leastShift_);
    }
  }

  bool isOnBentSide(Index f) const {
    const Index patch = skeleton_.patchOfFace[at(f)];
    return patch != kNone && shape_.isBent(patch);
  }

  /// Faces inside the domain follow those across the blocks on either side.
  Lists<Index> facesFollowed() {
    return collectLists<Index>(at(firstInBlocks_ - firstInFaces_), [&](auto put) {
      for (Index b = 0; b < blocks_.blockCount(); ++b) {
        grid_.enter(b);
        for (std::size_t a = 0; a < N; ++a) {
          const std::size_t across = at(grid_.intervals(a)) * grid_.stride(a);
          const std::array<Index, 2> faces{skeleton_.facesOf[at(b)][2 * a],
                                           skeleton_.facesOf[at(b)][2 * a + 1]};
          const std::array<bool, 2> follows{mayFollow(faces[0]), mayFollow(faces[1])};
          grid_.forFace(a, [&](std::size_t place) {
            const Index low = grid_[place] - firstInFaces_;
            const Index high = grid_[place + across] - firstInFaces_;
            if (follows[0]) put(low, high);
            if (follows[1]) put(high, low);
          });
        }
      }
    });
  }

  bool mayFollow(Index face) const {
    return faceFollows_[at(face)] && mayBendFace_[at(face)] && skeleton_.patchOfFace[at(face)] == kNone;
  }

  void interpolateInside(Index b) {
    std::array<std::vector<double>, N> t;
    for (int a = 0; a < N; ++a)
      for (Index k = 0; k <= grid_.intervals(at(a)); ++k)
        t[at(a)].push_back(
            grid_.placeOf(skeleton_.edgesOf[at(b)][edgeAt<N>(a, 0)], blocks_.blocks[at(b)][0], k));
    grid_.forInside([&](std::size_t place, const std::array<Index, N> &c) {
      std::array<double, N> here;
      for (std::size_t a = 0; a < N; ++a) here[a] = t[a][at(c[a])];
      positions_[at(grid_[place])] = transfinite<N, N>(here, [&](unsigned axes, unsigned bits) {
        std::size_t end = place;
        for (std::size_t a = 0; a < N; ++a)
          if (axes >> a & 1U)
            end += ((bits >> a & 1U ? at(grid_.intervals(a)) : 0) - at(c[a])) * grid_.stride(a);
        return positions_[at(grid_[end])];
      });
    });
  }

  /// Where elements are badly shaped, or worse, moves the nodes inside the block to the middles of their
  /// neighbours, over and over: elements along a bent side then keep their height, which the interpolation
  /// slants. Keeps the best it meets. Whether every element is positive then.
  bool evenOut(Index b) {
    constexpr double kPoor = 0.2; // scaled Jacobian, or half the block's own where that is less
    constexpr int kRounds = 20;
    constexpr int kPatience = 3;
    const auto &block = blocks_.blocks[at(b)];
    const double wanted = std::min(kPoor, 0.5 * scaledJacobian<N>(cornersOf<N>(block, positions_)));
    double best = worst();
    if (best >= wanted) return true;
    std::vector<Vec<N>> kept;
    const auto keep = [&] {
      kept.clear();
      grid_.forInside([&](std::size_t place, const std::array<Index, N> &) {
        kept.push_back(positions_[at(grid_[place])]);
      });
    };
    keep();
    int last = 0; // round that was of use
    const auto mayHelp = [&](int round) { return best < wanted && (best < 0 || round < last + kPatience); };
    for (int round = 0; round < kRounds && mayHelp(round) && !kept.empty(); ++round) {
      grid_.forInside([&](std::size_t place, const std::array<Index, N> &) {
        Vec<N> sum{0.0};
        for (std::size_t a = 0; a < N; ++a)
          sum +=
              positions_[at(grid_[place - grid_.stride(a)])] + positions_[at(grid_[place + grid_.stride(a)])];
        positions_[at(grid_[place])] = sum / (2.0 * N);
      });
      if (const double now = worst(); now > best) {
        best = now;
        last = round;
        keep();
      }
    }
    std::size_t next = 0;
    grid_.forInside([&](std::size_t place, const std::array<Index, N> &) {
      positions_[at(grid_[place])] = kept[next++];
    });
    return best > 0;
  }

  bool isStraight(Index b) const {
    for (const Index e : skeleton_.edgesOf[at(b)])
      if (!isStraightEdge_[at(e)]) return false;
    if constexpr (N == 3)
      for (const Index f : skeleton_.facesOf[at(b)])
        if (!isStraightFace_[at(f)]) return false;
    return true;
  }

  /// Lets what is inside of the domain follow the bends around it, at this block.
  void follow(Index b) {
    follows_[at(b)] = true;
    for (const Index e : skeleton_.edgesOf[at(b)]) edgeFollows_[at(e)] = true;
    if constexpr (N == 3)
      for (const Index f : skeleton_.facesOf[at(b)]) faceFollows_[at(f)] = true;
  }

  void straighten(Index b) {
    straightened_.push_back(b);
    for (const Index e : skeleton_.edgesOf[at(b)]) mayBendEdge_[at(e)] = false;
    if constexpr (N == 3)
      for (const Index f : skeleton_.facesOf[at(b)]) mayBendFace_[at(f)] = false;
  }

  /// The smallest scaled Jacobian of the elements of the block in the grid, or -1 where one is not clearly
  /// positive everywhere.
  double worst() const {
    constexpr double kClearly = 1e-9; // of the largest coefficient
    double least = 1;
    grid_.forCells(0, [&](std::size_t place, const std::array<Index, N> &) {
      if (least < 0) return;
      const auto corners = cornersOf<N>(grid_.elementAt(place), positions_);
      const auto c = jacobianCoefficients<N>(corners);
      const auto [low, high] = std::minmax_element(c.begin(), c.end());
      least = *low > kClearly * *high ? std::min(least, scaledJacobian<N>(corners)) : -1;
    });
    return least;
  }

  const BlockMesh<N> &blocks_;
  const Skeleton<N> &skeleton_;
  const BentShape<N> &shape_;
  NodeGrid<N> &grid_;
  std::vector<Vec<N>> &positions_;
  const Index firstInEdges_ = grid_.firstOfKind()[0];
  const Index firstInFaces_ = grid_.firstOfKind()[1];
  const Index firstInBlocks_ = grid_.firstOfKind()[2];
  bool isBent_ = false;                         // any edge at all
  double leastShift_ = 0;                       // inside of the domain: what is bent by less stays straight
  std::vector<bool> mayBendEdge_, mayBendFace_; // not where that made a block invalid
  std::vector<bool> isStraightEdge_, isStraightFace_;     // as they are now
  std::vector<bool> follows_, edgeFollows_, faceFollows_; // blocks, and what they have
  std::vector<Index> straightened_;                       // blocks
};

} // namespace dualblock
