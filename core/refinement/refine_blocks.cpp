#include "refinement/refine_blocks.h"

#include <algorithm>

#include "base/deadline.h"
#include "geometry/jacobian.h"
#include "refinement/curved_edges.h"
#include "refinement/transfinite.h"

namespace dualblock {
namespace {

/// The two axes of a hexahedron's face.
constexpr std::array<std::size_t, 2> axesOfFace(std::size_t face) {
  const std::size_t across = face / 2;
  return {across == 0 ? 1U : 0U, across == 2 ? 1U : 2U};
}

/// In digits, as long as that says more than powers of ten.
std::string wholeNumber(double x) {
  return x < 1e15 ? std::to_string(static_cast<long long>(x)) : formatNumber(x);
}

template <int N> class Refiner {
public:
  Refiner(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton, const BentShape<N> &shape,
          const Spacing &spacing)
      : blocks_(blocks), skeleton_(skeleton), shape_(shape), spacing_(spacing),
        isStraightEdge_(skeleton.edges.size()), isStraightFace_(skeleton.patchOfFace.size()),
        isListed_(skeleton.edges.size(), false) {
    for (std::size_t e = 0; e < skeleton.edges.size(); ++e)
      isStraightEdge_[e] = !isCurved(shape, skeleton, toIndex(e));
    for (std::size_t f = 0; f < skeleton.patchOfFace.size(); ++f)
      isStraightFace_[f] = skeleton.patchOfFace[f] == kNone || !shape.isBent(skeleton.patchOfFace[f]);
    result_.intervals = spacing.intervals;
    result_.places = spacing.places;
    number();
  }

  /// Throws OutOfTime.
  RefinedMesh<N> refine(const std::function<void(double)> &progress) {
    const Index count = blocks_.blockCount();
    const auto forBlocks = [&](double from, double share, auto work) {
      for (Index b = 0; b < count; ++b) {
        checkDeadline();
        if (progress && b % 256 == 0) progress(from + share * b / count);
        fillGrid(b);
        work(b);
      }
    };
    bool again = true;
    while (again) { // every round straightens something more, or is the last
      placeEdges();
      if constexpr (N == 3) placeFaces();
      again = false;
      forBlocks(0, 0.5, [&](Index b) {
        placeInside(b);
        if (isStraight(b) || isPositive()) return;
        straighten(b);
        again = true;
      });
    }
    result_.block.reserve(elementCount_);
    result_.elements.reserve(elementCount_);
    result_.quality.reserve(elementCount_);
    forBlocks(0.5, 0.5, [&](Index b) {
      const Index firstElement = toIndex(result_.elements.size());
      addElements(b);
      addOutline(b, firstElement);
      addFaces(b, firstElement);
    });
    return std::move(result_);
  }

private:
  Index intervalsOf(Index edge) const { return spacing_.intervals[at(skeleton_.surfaceOfEdge[at(edge)])]; }

  std::array<Index, N> intervalsOfBlock(Index b) const {
    std::array<Index, N> n;
    for (int a = 0; a < N; ++a) n[at(a)] = intervalsOf(skeleton_.edgesOf[at(b)][edgeAt<N>(a, 0)]);
    return n;
  }

  std::array<Index, 2> intervalsOfFace(Index f) const {
    const auto &edges = skeleton_.edgesOfFace[at(f)];
    return {intervalsOf(edges[0]), intervalsOf(edges[2])};
  }

  /// Gives the blocks' own nodes, then the nodes inside edges, faces and blocks their numbers.
  void number() {
    Index next = blocks_.nodeCount();
    for (Index e = 0; e < toIndex(skeleton_.edges.size()); ++e) {
      firstOfEdge_.push_back(next);
      next += intervalsOf(e) - 1;
    }
    for (Index f = 0; f < toIndex(skeleton_.faces.size()); ++f) {
      firstOfFace_.push_back(next);
      const auto n = intervalsOfFace(f);
      next += (n[0] - 1) * (n[1] - 1);
    }
    for (Index b = 0; b < blocks_.blockCount(); ++b) {
      firstOfBlock_.push_back(next);
      auto &reversed = result_.isReversed.emplace_back();
      for (int a = 0; a < N; ++a) {
        const Index edge = skeleton_.edgesOf[at(b)][edgeAt<N>(a, 0)];
        const bool isUp = skeleton_.edges[at(edge)][0] == blocks_.blocks[at(b)][0];
        reversed[at(a)] = spacing_.isReversed[at(edge)] == isUp;
      }
      Index inside = 1;
      std::size_t elements = 1;
      for (const Index n : intervalsOfBlock(b)) {
        inside *= n - 1;
        elements *= at(n);
      }
      next += inside;
      elementCount_ += elements;
    }
    result_.positions = blocks_.positions;
    result_.positions.resize(at(next));
    const auto &block = N == 3 ? skeleton_.faces.size() : skeleton_.edges.size();
    blocksAtFace_.assign(block, 0);
    for (Index b = 0; b < blocks_.blockCount(); ++b)
      for (int f = 0; f < 2 * N; ++f) ++blocksAtFace_[at(sharedFace(b, f))];
  }

  /// Face f of a block among the skeleton's faces (2D: edges).
  Index sharedFace(Index b, int f) const {
    if constexpr (N == 3) return skeleton_.facesOf[at(b)][at(f)];
    else return skeleton_.edgesOf[at(b)][edgeAt<2>(1 - f / 2, f % 2 ? 3U : 0U)];
  }

  /// Node k of an edge, counted from its end `from`.
  Index nodeOfEdge(Index e, Index from, Index k) const {
    const auto &[low, high] = skeleton_.edges[at(e)];
    const Index n = intervalsOf(e);
    const Index up = from == low ? k : n - k;
    if (up == 0) return low;
    return up == n ? high : firstOfEdge_[at(e)] + up - 1;
  }

  /// Node (x, y) of a face, x from its node 0 to 1 and y from 0 to 3.
  Index nodeOfFace(Index f, Index x, Index y) const {
    const auto &v = skeleton_.faces[at(f)];
    const auto &edges = skeleton_.edgesOfFace[at(f)];
    const auto n = intervalsOfFace(f);
    if (y == 0) return nodeOfEdge(edges[0], v[0], x);
    if (y == n[1]) return nodeOfEdge(edges[1], v[3], x);
    if (x == 0) return nodeOfEdge(edges[2], v[0], y);
    if (x == n[0]) return nodeOfEdge(edges[3], v[1], y);
    return firstOfFace_[at(f)] + (x - 1) + (n[0] - 1) * (y - 1);
  }

  double placeOf(Index edge, Index from, Index k) const {
    const Index surface = skeleton_.surfaceOfEdge[at(edge)];
    if (skeleton_.edges[at(edge)][0] == from) return spacing_.placeOf(edge, surface, k);
    return 1 - spacing_.placeOf(edge, surface, intervalsOf(edge) - k);
  }

  void placeEdges() {
    std::vector<Vec<N>> points;
    for (Index e = 0; e < toIndex(skeleton_.edges.size()); ++e) {
      const auto &[low, high] = skeleton_.edges[at(e)];
      const Vec<N> a = result_.positions[at(low)];
      const Vec<N> b = result_.positions[at(high)];
      std::vector<double> places;
      points.clear();
      for (Index k = 0; k <= intervalsOf(e); ++k) {
        places.push_back(placeOf(e, low, k));
        points.push_back(
            transfinite<N, 1>({places.back()}, [&](unsigned, unsigned bits) { return bits ? b : a; }));
      }
      if (!isStraightEdge_[at(e)]) bendEdge(shape_, skeleton_, e, places, points);
      for (Index k = 1; k < intervalsOf(e); ++k)
        result_.positions[at(firstOfEdge_[at(e)] + k - 1)] = points[at(k)];
    }
  }

  void placeFaces() {
    for (Index f = 0; f < toIndex(skeleton_.faces.size()); ++f) {
      const auto n = intervalsOfFace(f);
      const auto &v = skeleton_.faces[at(f)];
      const auto &edges = skeleton_.edgesOfFace[at(f)];
      for (Index y = 1; y < n[1]; ++y)
        for (Index x = 1; x < n[0]; ++x) {
          const std::array<double, 2> t{placeOf(edges[0], v[0], x), placeOf(edges[2], v[0], y)};
          Vec<N> point = transfinite<N, 2>(t, [&](unsigned axes, unsigned bits) {
            const Index i = axes & 1U ? (bits & 1U ? n[0] : 0) : x;
            const Index j = axes & 2U ? (bits & 2U ? n[1] : 0) : y;
            return result_.positions[at(nodeOfFace(f, i, j))];
          });
          if (!isStraightFace_[at(f)]) point = shape_.onSide(skeleton_.patchOfFace[at(f)], point).point;
          result_.positions[at(nodeOfFace(f, x, y))] = point;
        }
    }
  }

  /// The nodes of a block as a grid, first axis fastest: those on its boundary by the edges (3D: faces).
  void fillGrid(Index b) {
    n_ = intervalsOfBlock(b);
    std::size_t size = 1;
    for (std::size_t a = 0; a < N; ++a) {
      stride_[a] = size;
      size *= at(n_[a]) + 1;
    }
    grid_.resize(size);
    const auto &block = blocks_.blocks[at(b)];
    if constexpr (N == 2) {
      for (int axis = 0; axis < 2; ++axis)
        for (unsigned end = 0; end < 2; ++end) {
          const unsigned bits = end << (1 - axis);
          const Index edge = skeleton_.edgesOf[at(b)][edgeAt<2>(axis, bits)];
          const std::size_t start = end * at(n_[at(1 - axis)]) * stride_[at(1 - axis)];
          for (Index k = 0; k <= n_[at(axis)]; ++k)
            grid_[start + at(k) * stride_[at(axis)]] = nodeOfEdge(edge, block[cornerAt<2>(bits)], k);
        }
    } else {
      for (std::size_t f = 0; f < 6; ++f) fillFace(b, f);
    }
    Index next = firstOfBlock_[at(b)];
    forInside([&](std::size_t place, const std::array<Index, N> &) { grid_[place] = next++; });
  }

  void fillFace(Index b, std::size_t face) {
    const auto &block = blocks_.blocks[at(b)];
    const std::size_t p = axesOfFace(face)[0];
    const std::size_t q = axesOfFace(face)[1];
    const unsigned fixed = static_cast<unsigned>(face % 2) << face / 2;
    const auto cornerNode = [&](unsigned i, unsigned j) {
      return block[cornerAt<3>(fixed | i << p | j << q)];
    };
    const Index f = skeleton_.facesOf[at(b)][face];
    const auto &v = skeleton_.faces[at(f)];
    unsigned i0 = 0;
    unsigned j0 = 0; // where the face's node 0 is
    while (cornerNode(i0, j0) != v[0]) (i0 == j0 ? i0 : j0) ^= 1U;
    const bool isSwapped = cornerNode(i0 ^ 1U, j0) != v[1];
    const std::size_t start = face % 2 * at(n_[face / 2]) * stride_[face / 2];
    for (Index j = 0; j <= n_[q]; ++j)
      for (Index i = 0; i <= n_[p]; ++i) {
        const Index x = i0 ? n_[p] - i : i;
        const Index y = j0 ? n_[q] - j : j;
        grid_[start + at(i) * stride_[p] + at(j) * stride_[q]] =
            isSwapped ? nodeOfFace(f, y, x) : nodeOfFace(f, x, y);
      }
  }

  /// visit(place in the grid, its coordinates) for the nodes inside the block; first axis fastest.
  template <typename Visit> void forInside(Visit visit) const {
    forCells(1, [&](std::size_t place, const std::array<Index, N> &c) { visit(place, c); });
  }

  /// The same for all coordinates from `low` to the intervals, exclusive.
  template <typename Visit> void forCells(Index low, Visit visit) const {
    std::array<Index, N> c;
    c.fill(low);
    for (std::size_t a = 0; a < N; ++a)
      if (n_[a] <= low) return;
    while (true) {
      std::size_t place = 0;
      for (std::size_t a = 0; a < N; ++a) place += at(c[a]) * stride_[a];
      for (c[0] = low; c[0] < n_[0]; ++c[0]) visit(place + at(c[0] - low), c);
      std::size_t a = 1;
      c[0] = low;
      while (a < N && ++c[a] == n_[a]) c[a++] = low;
      if (a == N) return;
    }
  }

  void placeInside(Index b) {
    std::array<std::vector<double>, N> t;
    for (int a = 0; a < N; ++a)
      for (Index k = 0; k <= n_[at(a)]; ++k)
        t[at(a)].push_back(placeOf(skeleton_.edgesOf[at(b)][edgeAt<N>(a, 0)], blocks_.blocks[at(b)][0], k));
    forInside([&](std::size_t place, const std::array<Index, N> &c) {
      std::array<double, N> here;
      for (std::size_t a = 0; a < N; ++a) here[a] = t[a][at(c[a])];
      result_.positions[at(grid_[place])] = transfinite<N, N>(here, [&](unsigned axes, unsigned bits) {
        std::size_t end = place;
        for (std::size_t a = 0; a < N; ++a)
          if (axes >> a & 1U) end += ((bits >> a & 1U ? at(n_[a]) : 0) - at(c[a])) * stride_[a];
        return result_.positions[at(grid_[end])];
      });
    });
  }

  std::array<Index, 1 << N> elementAt(std::size_t place) const {
    std::array<Index, 1 << N> element;
    for (std::size_t k = 0; k < element.size(); ++k) {
      std::size_t corner = place;
      for (std::size_t a = 0; a < N; ++a)
        if (kBlockBits<N>[k] >> a & 1U) corner += stride_[a];
      element[k] = grid_[corner];
    }
    return element;
  }

  /// The number of an element within its block, as addElements lists them.
  Index elementInBlock(const std::array<Index, N> &c) const {
    Index number = 0;
    for (std::size_t a = N; a-- > 0;) number = number * n_[a] + c[a];
    return number;
  }

  bool isStraight(Index b) const {
    for (const Index e : skeleton_.edgesOf[at(b)])
      if (!isStraightEdge_[at(e)]) return false;
    if constexpr (N == 3)
      for (const Index f : skeleton_.facesOf[at(b)])
        if (!isStraightFace_[at(f)]) return false;
    return true;
  }

  void straighten(Index b) {
    ++result_.straightened;
    for (const Index e : skeleton_.edgesOf[at(b)]) isStraightEdge_[at(e)] = true;
    if constexpr (N == 3)
      for (const Index f : skeleton_.facesOf[at(b)]) isStraightFace_[at(f)] = true;
  }

  /// Whether every element of the block in the grid is clearly positive everywhere.
  bool isPositive() const {
    constexpr double kClearly = 1e-9; // of the largest coefficient
    bool all = true;
    forCells(0, [&](std::size_t place, const std::array<Index, N> &) {
      if (!all) return;
      const auto c = jacobianCoefficients<N>(cornersOf<N>(elementAt(place), result_.positions));
      const auto [low, high] = std::minmax_element(c.begin(), c.end());
      all = *low > kClearly * *high;
    });
    return all;
  }

  void addElements(Index b) {
    forCells(0, [&](std::size_t place, const std::array<Index, N> &) {
      result_.elements.push_back(elementAt(place));
      result_.block.push_back(b);
      result_.quality.push_back(scaledJacobian<N>(cornersOf<N>(result_.elements.back(), result_.positions)));
    });
  }

  /// The elements' edges along those of the block, each of which is listed once; a straight one as a whole.
  void addOutline(Index b, Index firstElement) {
    for (int axis = 0; axis < N; ++axis)
      for (unsigned bits = 0; bits < 1U << N; ++bits) {
        if (bits >> axis & 1U) continue;
        const Index edge = skeleton_.edgesOf[at(b)][edgeAt<N>(axis, bits)];
        if (isListed_[at(edge)]) continue;
        isListed_[at(edge)] = true;
        std::array<Index, N> c{};
        std::size_t place = 0;
        for (std::size_t a = 0; a < N; ++a)
          if (bits >> a & 1U) {
            c[a] = n_[a] - 1;
            place += at(n_[a]) * stride_[a];
          }
        const Index span = isStraightEdge_[at(edge)] ? n_[at(axis)] : 1;
        const std::size_t step = at(span) * stride_[at(axis)];
        for (Index &k = c[at(axis)]; k < n_[at(axis)]; k += span, place += step)
          result_.outline.push_back({grid_[place], grid_[place + step], firstElement + elementInBlock(c)});
      }
  }

  /// The elements' faces on facets; of an interface's, which two blocks have, those of the first.
  void addFaces(Index b, Index firstElement) {
    for (int f = 0; f < 2 * N; ++f) {
      const Index tag = blocks_.tags[at(b)][at(f)];
      if (tag == kNone) continue;
      Index &blocks = blocksAtFace_[at(sharedFace(b, f))];
      if (blocks == kNone) continue;
      const bool isOuter = blocks == 1;
      BoundaryFaces<N> &to = isOuter ? result_.boundary : result_.interfaces;
      blocks = kNone;
      const std::size_t across = at(f / 2);
      const Index layer = f % 2 ? n_[across] - 1 : 0;
      forCells(0, [&](std::size_t place, const std::array<Index, N> &c) {
        if (c[across] != layer) return;
        const auto element = elementAt(place);
        auto &face = to.faces.emplace_back();
        for (std::size_t k = 0; k < face.size(); ++k)
          face[k] = element[at(faceCorner<N>(f, static_cast<int>(k)))];
        to.facet.push_back(FaceTag::surface(tag));
        if (isOuter) result_.boundaryElement.push_back(firstElement + elementInBlock(c));
      });
    }
  }

  const BlockMesh<N> &blocks_;
  const Skeleton<N> &skeleton_;
  const BentShape<N> &shape_;
  const Spacing &spacing_;
  std::vector<bool> isStraightEdge_, isStraightFace_;
  std::vector<Index> firstOfEdge_, firstOfFace_, firstOfBlock_; // the first node inside each
  std::vector<Index> blocksAtFace_; // per face (2D: edge); kNone once its elements' faces are listed
  std::vector<bool> isListed_;      // per edge: in the outline
  std::size_t elementCount_ = 0;
  RefinedMesh<N> result_;
  // Of the block at hand:
  std::array<Index, N> n_{};
  std::array<std::size_t, N> stride_{};
  std::vector<Index> grid_;
};

} // namespace

template <int N>
Result<RefinedMesh<N>> refineBlocks(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface,
                                    const BentShape<N> &shape, const RefineOptions &options,
                                    const std::function<void(double)> &progress) {
  const Skeleton<N> skeleton = skeletonOf(blocks, patchOfSurface);
  const auto spacing = spacingOf(blocks, skeleton, patchOfSurface, options);
  if (!spacing.ok()) return spacing.error();
  double elements = 0;
  for (const auto &surfaces : blocks.surfaces) {
    double own = 1;
    for (const Index s : surfaces) own *= spacing.value().intervals[at(s)];
    elements += own;
  }
  if (elements > options.elementLimit)
    return Error{ErrorCode::badOption,
                 "The refined mesh would have " + wholeNumber(elements) + " elements, and " +
                     wholeNumber(options.elementLimit) +
                     " are the most: give fewer intervals, or a larger size.",
                 {}};
  return Refiner<N>(blocks, skeleton, shape, spacing.value()).refine(progress);
}

template Result<RefinedMesh<2>> refineBlocks(const BlockMesh<2> &, const std::vector<Index> &,
                                             const BentShape<2> &, const RefineOptions &,
                                             const std::function<void(double)> &);
template Result<RefinedMesh<3>> refineBlocks(const BlockMesh<3> &, const std::vector<Index> &,
                                             const BentShape<3> &, const RefineOptions &,
                                             const std::function<void(double)> &);

} // namespace dualblock
