#include "refinement/refine_blocks.h"

#include <algorithm>
#include <cmath>

#include "base/deadline.h"
#include "refinement/node_placer.h"

namespace dualblock {
namespace {

/// The blocks' edges tell the size of their elements where these are straight and even; bent ones are longer.
constexpr int kSizeRounds = 5;

/// Asks for more intervals where elements are longer than the size that was asked for. Whether it did; not
/// where intervals were given, or graded: a grading's largest element keeps its share of an edge, however
/// many there are.
template <int N>
bool divideFurther(const BlockMesh<N> &blocks, const RefinedMesh<N> &mesh, const RefineOptions &options,
                   RefineOptions &asked) {
  if (!(options.size > 0)) return false;
  std::vector<double> longest(mesh.intervals.size(), 0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (int a = 0; a < N; ++a) {
      double &length = longest[at(blocks.surfaces[at(mesh.block[e])][at(a)])];
      for (unsigned bits = 0; bits < 1U << N; ++bits) {
        if (bits >> a & 1U) continue;
        const Vec<N> &from = mesh.positions[at(mesh.elements[e][cornerAt<N>(bits)])];
        length = std::max(
            length, glm::length(mesh.positions[at(mesh.elements[e][cornerAt<N>(bits | 1U << a)])] - from));
      }
    }
  bool any = false;
  for (std::size_t s = 0; s < longest.size(); ++s) {
    const double *const p = mesh.places.begin(toIndex(s));
    const Index n = mesh.intervals[s];
    const auto isGiven = [&](const std::array<Index, 2> &of) { return of[0] == toIndex(s); };
    if (n == 0 || longest[s] <= options.size * (1 + 1e-6)) continue;
    if (std::any_of(options.ofSurface.begin(), options.ofSurface.end(), isGiven)) continue;
    if (std::abs(p[1] - p[0] - 1.0 / n) > 1e-12) continue; // graded
    const Index more = std::max(n + 1, static_cast<Index>(std::ceil(n * longest[s] / options.size - 1e-6)));
    asked.ofSurface.push_back({toIndex(s), more});
    any = true;
  }
  return any;
}

/// In digits, as long as that says more than powers of ten.
std::string wholeNumber(double x) {
  return x < 1e15 ? std::to_string(static_cast<long long>(x)) : formatNumber(x);
}

template <int N> class Refiner {
public:
  Refiner(const BlockMesh<N> &blocks, const Skeleton<N> &skeleton, const BentShape<N> &shape,
          const Spacing &spacing)
      : blocks_(blocks), skeleton_(skeleton), grid_(blocks, skeleton, spacing),
        placer_(blocks, skeleton, shape, grid_, result_.positions),
        blocksAtFace_(blocksAtFaces(blocks, skeleton)), isListed_(skeleton.edges.size(), false) {
    result_.intervals = spacing.intervals;
    result_.places = spacing.places;
    result_.positions = blocks.positions;
    result_.positions.resize(at(grid_.nodeCount()));
    for (Index b = 0; b < blocks.blockCount(); ++b) {
      auto &reversed = result_.isReversed.emplace_back();
      for (int a = 0; a < N; ++a) {
        const Index edge = skeleton.edgesOf[at(b)][edgeAt<N>(a, 0)];
        const bool isUp = skeleton.edges[at(edge)][0] == blocks.blocks[at(b)][0];
        reversed[at(a)] = spacing.isReversed[at(edge)] == isUp;
      }
    }
  }

  /// Throws OutOfTime.
  RefinedMesh<N> refine(const std::function<void(double)> &progress) {
    const Index count = blocks_.blockCount();
    const Index atOnce = 1 + count / 100;
    const auto forBlocks = [&](double from, double share, auto work) {
      for (Index b = 0; b < count; ++b) {
        checkDeadline();
        if (progress && b % atOnce == 0) progress(from + share * b / count);
        grid_.enter(b);
        work(b);
      }
    };
    bool again = true;
    while (again) { // every round bends or straightens something more, or is the last
      placer_.placeShared();
      again = false;
      forBlocks(0, 0.5, [&](Index b) { again = !placer_.placeInside(b) || again; });
    }
    result_.straightened = placer_.straightened();
    result_.block.reserve(grid_.elementCount());
    result_.elements.reserve(grid_.elementCount());
    result_.quality.reserve(grid_.elementCount());
    forBlocks(0.5, 0.5, [&](Index b) {
      const Index firstElement = toIndex(result_.elements.size());
      addElements(b);
      addOutline(b, firstElement);
      addFaces(b, firstElement);
    });
    return std::move(result_);
  }

private:
  void addElements(Index b) {
    grid_.forCells(0, [&](std::size_t place, const std::array<Index, N> &) {
      result_.elements.push_back(grid_.elementAt(place));
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
            c[a] = grid_.intervals(a) - 1;
            place += at(grid_.intervals(a)) * grid_.stride(a);
          }
        const Index span = placer_.isStraightEdge(edge) ? grid_.intervals(at(axis)) : 1;
        const std::size_t step = at(span) * grid_.stride(at(axis));
        for (Index &k = c[at(axis)]; k < grid_.intervals(at(axis)); k += span, place += step)
          result_.outline.push_back(
              {grid_[place], grid_[place + step], firstElement + grid_.elementInBlock(c)});
      }
  }

  /// The elements' faces on facets; of an interface's, which two blocks have, those of the first.
  void addFaces(Index b, Index firstElement) {
    for (int f = 0; f < 2 * N; ++f) {
      const Index tag = blocks_.tags[at(b)][at(f)];
      if (tag == kNone) continue;
      Index &blocks = blocksAtFace_[at(sharedFace(skeleton_, at(b), f))];
      if (blocks == kNone) continue;
      const bool isOuter = blocks == 1;
      BoundaryFaces<N> &to = isOuter ? result_.boundary : result_.interfaces;
      blocks = kNone;
      const std::size_t across = at(f / 2);
      const Index layer = f % 2 ? grid_.intervals(across) - 1 : 0;
      grid_.forCells(0, [&](std::size_t place, const std::array<Index, N> &c) {
        if (c[across] != layer) return;
        const auto element = grid_.elementAt(place);
        auto &face = to.faces.emplace_back();
        for (std::size_t k = 0; k < face.size(); ++k)
          face[k] = element[at(faceCorner<N>(f, static_cast<int>(k)))];
        to.facet.push_back(FaceTag::surface(tag));
        if (isOuter) result_.boundaryElement.push_back(firstElement + grid_.elementInBlock(c));
      });
    }
  }

  const BlockMesh<N> &blocks_;
  const Skeleton<N> &skeleton_;
  RefinedMesh<N> result_;
  NodeGrid<N> grid_;
  NodePlacer<N> placer_;
  std::vector<Index> blocksAtFace_; // per face (2D: edge); kNone once its elements' faces are listed
  std::vector<bool> isListed_;      // per edge: in the outline
};

} // namespace

template <int N>
Result<RefinedMesh<N>> refineBlocks(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface,
                                    const BentShape<N> &shape, const RefineOptions &options,
                                    const std::function<void(double)> &progress) {
  const Skeleton<N> skeleton = skeletonOf(blocks, patchOfSurface);
  RefineOptions asked = options;
  for (int round = 1;; ++round) {
    const auto spacing = spacingOf(blocks, skeleton, patchOfSurface, asked);
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
    RefinedMesh<N> mesh = Refiner<N>(blocks, skeleton, shape, spacing.value()).refine(progress);
    const auto bad =
        std::count_if(mesh.quality.begin(), mesh.quality.end(), [](double q) { return !(q > 0); });
    if (bad > 0)
      return Error{ErrorCode::badOption,
                   "The refined mesh would have " + std::to_string(bad) +
                       " elements that are inverted or flat: give fewer intervals, or grade them less.",
                   {}};
    if (round == kSizeRounds || !divideFurther(blocks, mesh, options, asked)) return mesh;
  }
}

template Result<RefinedMesh<2>> refineBlocks(const BlockMesh<2> &, const std::vector<Index> &,
                                             const BentShape<2> &, const RefineOptions &,
                                             const std::function<void(double)> &);
template Result<RefinedMesh<3>> refineBlocks(const BlockMesh<3> &, const std::vector<Index> &,
                                             const BentShape<3> &, const RefineOptions &,
                                             const std::function<void(double)> &);

} // namespace dualblock
