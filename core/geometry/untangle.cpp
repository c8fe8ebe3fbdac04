#include "geometry/untangle.h"

#include "base/deadline.h"
#include "base/sort.h"
#include "geometry/jacobian.h"
#include "geometry/linear_programme.h"

namespace dualblock {
namespace {

constexpr int kRounds = 6;

template <int N> double smallest(const Block<N> &block, const std::vector<Vec<N>> &positions) {
  const auto coefficients = jacobianCoefficients<N>(cornersOf<N>(block.nodes, positions));
  return *std::min_element(coefficients.begin(), coefficients.end());
}

template <int N>
std::ptrdiff_t countBad(const std::vector<const Block<N> *> &blocks, const std::vector<Vec<N>> &positions) {
  return std::count_if(blocks.begin(), blocks.end(),
                       [&](const Block<N> *b) { return smallest<N>(*b, positions) <= 0; });
}

/// Moves `node` along D directions to the depth inside every coefficient's half-space that is largest. False
/// if it stands there already, or there is no better place. Where no place is valid, the deepest one may be
/// far away and tangle blocks that were not: it stays, then.
template <int N, int D>
bool moveNode(const std::vector<const Block<N> *> &blocks, Index node,
              const std::array<Vec<N>, D> &directions, std::vector<Vec<N>> &positions) {
  const Vec<N> start = positions[at(node)];
  double scale = 0;
  for (const Block<N> *b : blocks)
    for (const Index v : b->nodes) scale = std::max(scale, glm::length(positions[at(v)] - start));
  // Unknowns: steps along the directions in units of scale, and the depth. An affine function is known from
  // its values at the start and one step along each direction.
  std::vector<LinearConstraint<D + 1>> constraints;
  double depth = std::numeric_limits<double>::infinity();
  for (const Block<N> *b : blocks) {
    std::array<std::array<double, kJacobianCoefficients<N>>, D + 1> values;
    for (std::size_t k = 0; k <= D; ++k) {
      positions[at(node)] = k < D ? start + scale * directions[k] : start;
      values[k] = jacobianCoefficients<N>(cornersOf<N>(b->nodes, positions));
    }
    positions[at(node)] = start;
    for (std::size_t c = 0; c < values[0].size(); ++c) {
      LinearConstraint<D + 1> row{};
      double length = 0;
      for (std::size_t k = 0; k < D; ++k) {
        row.normal[k] = -(values[k][c] - values[D][c]);
        length += row.normal[k] * row.normal[k];
      }
      length = std::sqrt(length);
      if (length < 1e-12 * std::abs(values[D][c]) || length == 0) continue; // the node has no say in it
      for (std::size_t k = 0; k < D; ++k) row.normal[k] /= length;
      row.normal[D] = 1;
      row.bound = values[D][c] / length;
      depth = std::min(depth, row.bound);
      constraints.push_back(row);
    }
  }
  std::array<double, D + 1> objective{};
  objective[D] = 1;
  const auto best = solveLinearProgramme<D + 1>(std::move(constraints), objective, 1.0);
  if (!best || (*best)[D] <= depth + 1e-9) return false;
  const std::ptrdiff_t before = countBad<N>(blocks, positions);
  for (std::size_t k = 0; k < D; ++k) positions[at(node)] += scale * (*best)[k] * directions[k];
  if (countBad<N>(blocks, positions) < before) return true;
  positions[at(node)] = start;
  return false;
}

/// Which way a node may go: across none of the planes that it lies on.
template <int N> struct Freedom {
  std::vector<Vec<N>> normals; // an orthonormal basis of what is forbidden

  void forbid(Vec<N> normal) {
    for (const Vec<N> &n : normals) normal -= glm::dot(normal, n) * n;
    if (glm::length(normal) > 1e-5) normals.push_back(glm::normalize(normal));
  }
  std::vector<Vec<N>> directions() const {
    Freedom all = *this;
    for (int k = 0; k < N; ++k) {
      Vec<N> unit{0.0};
      unit[k] = 1;
      for (const Vec<N> &n : all.normals) unit -= glm::dot(unit, n) * n;
      if (glm::length(unit) > 0.3) all.normals.push_back(glm::normalize(unit));
    }
    return {all.normals.begin() + static_cast<std::ptrdiff_t>(normals.size()), all.normals.end()};
  }
};

template <int N> class Untangler {
public:
  Untangler(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualCells<N> &dual, Primal<N> &primal)
      : primal_(primal), freedom_(at(primal.nodeCount)) {
    for (const CellPiece<N> &piece : dual.pieces)
      for (int k = 0; k < piece.sideCount(); ++k) {
        const Index tag = parts.sides[at(piece.sides[at(k)])].tag;
        const Surface<N> &surface = mesh.surfaces[at(FaceTag::surface(tag))];
        if (surface.kind != SurfaceKind::facet) continue;
        Freedom<N> &freedom = freedom_[at(piece.cell)];
        if (!surface.bent && piece.sideCount() < N) freedom.forbid(surface.plane.normal);
        else
          for (int axis = 0; axis < N; ++axis) { // a corner, or on a bent side: it stays
            Vec<N> unit{0.0};
            unit[axis] = 1;
            freedom.forbid(unit);
          }
      }
    blocksAt_ = collectLists<Index>(at(primal.nodeCount), [&](auto put) {
      for (std::size_t b = 0; b < primal.blocks.size(); ++b)
        for (const Index v : primal.blocks[b].nodes) put(v, toIndex(b));
    });
  }

  Index run(std::vector<Index> bad) {
    Index moves = 0;
    for (int round = 0; round < kRounds && !bad.empty(); ++round) {
      const Index before = moves;
      std::vector<Index> touched = bad;
      for (const Index b : bad)
        for (const Index node : primal_.blocks[at(b)].nodes) { // from the centre, node 0, outwards
          checkDeadline();
          if (isGood(b)) break;
          if (!move(node)) continue;
          ++moves;
          touched.insert(touched.end(), blocksAt_.begin(node), blocksAt_.end(node));
        }
      if (moves == before) break;
      sortItems(touched);
      touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
      bad.clear();
      for (const Index b : touched)
        if (!isGood(b)) bad.push_back(b);
    }
    return moves;
  }

private:
  bool isGood(Index b) const { return smallest<N>(primal_.blocks[at(b)], primal_.positions) > 0; }

  bool move(Index node) {
    std::vector<const Block<N> *> blocks;
    for (const Index *b = blocksAt_.begin(node); b != blocksAt_.end(node); ++b)
      blocks.push_back(&primal_.blocks[at(*b)]);
    const std::vector<Vec<N>> d = freedom_[at(node)].directions();
    if (d.size() == 1) return moveNode<N, 1>(blocks, node, {d[0]}, primal_.positions);
    if (d.size() == 2) return moveNode<N, 2>(blocks, node, {d[0], d[1]}, primal_.positions);
    if constexpr (N == 3)
      if (d.size() == 3) return moveNode<3, 3>(blocks, node, {d[0], d[1], d[2]}, primal_.positions);
    return false;
  }

  Primal<N> &primal_;
  std::vector<Freedom<N>> freedom_;
  Lists<Index> blocksAt_;
};

} // namespace

template <int N>
Index untangle(const ReferenceMesh<N> &mesh, const Parts<N> &parts, const DualCells<N> &dual,
               std::vector<Index> bad, Primal<N> &primal) {
  if (bad.empty()) return 0;
  return Untangler<N>(mesh, parts, dual, primal).run(std::move(bad));
}

template Index untangle(const ReferenceMesh<2> &, const Parts<2> &, const DualCells<2> &, std::vector<Index>,
                        Primal<2> &);
template Index untangle(const ReferenceMesh<3> &, const Parts<3> &, const DualCells<3> &, std::vector<Index>,
                        Primal<3> &);

} // namespace dualblock
