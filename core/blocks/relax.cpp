#include "blocks/relax.h"

#include <cmath>
#include <limits>

#include "base/deadline.h"
#include "geometry/jacobian.h"

namespace dualblock {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Per corner of a block, in VTK's order: the corners at the other ends of its edges, along each axis.
template <int N> constexpr auto neighbourTable() {
  std::array<std::array<int, N>, 1 << N> table{};
  for (std::size_t k = 0; k < table.size(); ++k)
    for (std::size_t a = 0; a < N; ++a)
      for (std::size_t m = 0; m < table.size(); ++m)
        if (kBlockBits<N>[m] == (kBlockBits<N>[k] ^ 1U << a)) table[k][a] = static_cast<int>(m);
  return table;
}
template <int N> constexpr auto kNeighbours = neighbourTable<N>();

double determinant(const std::array<Vec<2>, 2> &e) { return e[0].x * e[1].y - e[0].y * e[1].x; }
double determinant(const std::array<Vec<3>, 3> &e) { return glm::dot(e[0], glm::cross(e[1], e[2])); }

/// A corner of one block around the node that moves: the positions it depends on, and its orientation.
template <int N> struct CornerRef {
  Index at;
  std::array<Index, N> ends;
  double sign;
};

/// A corner's determinant, the product of its edges' lengths and the sum of their squares.
struct CornerMeasure {
  double determinant, lengths, squares;
  double scaled() const { return lengths > 0 ? determinant / lengths : 0; } // the scaled Jacobian
};

template <int N> CornerMeasure measure(const CornerRef<N> &corner, const std::vector<Vec<N>> &x) {
  std::array<Vec<N>, N> e;
  CornerMeasure m{0, 1, 0};
  for (std::size_t a = 0; a < N; ++a) {
    e[a] = x[at(corner.ends[a])] - x[at(corner.at)];
    const double square = glm::dot(e[a], e[a]);
    m.lengths *= square;
    m.squares += square;
  }
  m.lengths = std::sqrt(m.lengths);
  m.determinant = corner.sign * determinant(e);
  return m;
}

/// 0 for a corner of a cube, infinite for a flat or inverted one. Angles weigh by the fourth power, so that
/// bad ones count most; the edges' squares over the volume even out the edges that meet.
template <int N> double distortionOf(const CornerMeasure &m) {
  if (!(m.determinant > 0)) return kInfinity;
  const double inverse = m.lengths * m.lengths / (m.determinant * m.determinant);
  const double mean = m.squares / N;
  const double ratio = (N == 2 ? mean * mean : mean * mean * mean) / (m.determinant * m.determinant);
  return inverse * inverse - 1 + 0.03 * (ratio - 1);
}

template <int N> class Relaxer {
public:
  Relaxer(const Freedom<N> &freedom, BlockMesh<N> &mesh)
      : freedom_(freedom), mesh_(mesh), blocksAt_(blocksOfNodes(mesh)) {}

  /// One move of a node down the distortion around it, while the scaled Jacobian there stays over `floor`, or
  /// what it was.
  bool descend(Index node, double floor, double precision) {
    gather(node);
    Vec<N> &x = mesh_.positions[at(node)];
    const Vec<N> start = x;
    const std::vector<Vec<N>> directions = freedom_.directions(node, start);
    if (directions.empty()) return false;
    const double scale = shortestEdge(node);
    const double before = distortion();
    if (before == kInfinity || !(scale > 0)) return false; // for untangle
    const double least = std::min(floor, smallest());
    const double h = 1e-3 * scale;
    Vec<N> step{0.0};
    for (const Vec<N> &d : directions) { // a Newton step per direction
      x = start + h * d;
      const double ahead = distortion();
      x = start - h * d;
      const double behind = distortion();
      x = start;
      if (ahead == kInfinity || behind == kInfinity) {
        step += (ahead == kInfinity ? -0.1 : 0.1) * scale * d;
        continue;
      }
      const double slope = (ahead - behind) / (2 * h);
      const double bend = (ahead - 2 * before + behind) / (h * h);
      const double limit = 0.3 * scale;
      const double length = bend > 0 ? -slope / bend : (slope > 0 ? -limit : limit);
      step += std::clamp(length, -limit, limit) * d;
    }
    if (glm::length(step) < precision * scale) return false;
    for (int halving = 0; halving < 6; ++halving, step *= 0.5) {
      x = freedom_.project(node, start + step);
      if (distortion() < before * (1 - 0.1 * precision) && smallest() >= least && areValid(node, start))
        return true;
    }
    x = start;
    return false;
  }

  /// One move of a node up the smallest scaled Jacobian around it.
  bool climb(Index node) {
    gather(node);
    Vec<N> &x = mesh_.positions[at(node)];
    const Vec<N> start = x;
    const std::vector<Vec<N>> directions = freedom_.directions(node, start);
    if (directions.empty()) return false;
    const double before = smallest();
    double best = before;
    Vec<N> place = start;
    const double scale = shortestEdge(node);
    for (double length = 0.25 * scale; length > 0.01 * scale; length *= 0.4) {
      bool found = true;
      for (int step = 0; step < 4 && found; ++step) {
        found = false;
        const Vec<N> from = place;
        for (const Vec<N> &d : directions)
          for (const double side : {-1.0, 1.0}) {
            x = freedom_.project(node, from + side * length * d);
            if (const double value = smallest(); value > best + 1e-6) {
              best = value;
              place = x;
              found = true;
            }
          }
      }
    }
    x = place;
    if (best > before + 1e-4 && areValid(node, start)) return true;
    x = start;
    return false;
  }

  /// Calls visit(node) for every node that shares a block with this one, itself included, maybe repeatedly.
  template <typename Visit> void forAround(Index node, Visit visit) const {
    for (const Index *b = blocksAt_.begin(node); b != blocksAt_.end(node); ++b)
      for (const Index v : mesh_.blocks[at(*b)]) visit(v);
  }

  double smallestAround(Index node) {
    gather(node);
    return smallest();
  }

private:
  /// The corners that change when the node moves: its own in each block, and those at the ends of its edges.
  void gather(Index node) {
    corners_.clear();
    for (const Index *b = blocksAt_.begin(node); b != blocksAt_.end(node); ++b) {
      const auto &block = mesh_.blocks[at(*b)];
      for (std::size_t k = 0; k < block.size(); ++k) {
        bool touches = block[k] == node;
        CornerRef<N> corner{block[k], {}, 1};
        for (std::size_t a = 0; a < N; ++a) {
          corner.ends[a] = block[at(kNeighbours<N>[k][a])];
          touches |= corner.ends[a] == node;
          if (kBlockBits<N>[k] >> a & 1) corner.sign = -corner.sign;
        }
        if (touches) corners_.push_back(corner);
      }
    }
  }

  double distortion() const {
    double sum = 0;
    for (const CornerRef<N> &corner : corners_) sum += distortionOf<N>(measure(corner, mesh_.positions));
    return sum;
  }

  double smallest() const {
    double least = kInfinity;
    for (const CornerRef<N> &corner : corners_)
      least = std::min(least, measure(corner, mesh_.positions).scaled());
    return least;
  }

  double shortestEdge(Index node) const {
    double least = kInfinity;
    for (const CornerRef<N> &corner : corners_) {
      if (corner.at != node) continue;
      for (const Index end : corner.ends)
        least = std::min(least, glm::length(mesh_.positions[at(end)] - mesh_.positions[at(node)]));
    }
    return least == kInfinity ? 0 : least;
  }

  /// Smallest Bezier coefficient of a block's Jacobian, and the largest.
  std::pair<double, double> coefficients(Index block) const {
    const auto c = jacobianCoefficients<N>(cornersOf<N>(mesh_.blocks[at(block)], mesh_.positions));
    const auto [low, high] = std::minmax_element(c.begin(), c.end());
    return {*low, *high};
  }

  /// Whether each block around the node is clearly positive, or no worse than it was with the node at
  /// `before`.
  bool areValid(Index node, const Vec<N> &before) {
    constexpr double kClearly = 0.01; // of the largest coefficient
    for (const Index *b = blocksAt_.begin(node); b != blocksAt_.end(node); ++b) {
      const auto [low, high] = coefficients(*b);
      if (low > kClearly * high) continue;
      const Vec<N> x = mesh_.positions[at(node)];
      mesh_.positions[at(node)] = before;
      const auto [lowThen, highThen] = coefficients(*b);
      mesh_.positions[at(node)] = x;
      if (!(low >= lowThen && low * highThen >= lowThen * high)) return false;
    }
    return true;
  }

  const Freedom<N> &freedom_;
  BlockMesh<N> &mesh_;
  const Lists<Index> blocksAt_;
  std::vector<CornerRef<N>> corners_;
};

/// Moves the nodes around the worst corners up, round by round, while that helps and the worst is below
/// `goal`.
template <int N>
Index climbWorst(Relaxer<N> &relaxer, const std::vector<Index> &nodes, std::size_t nodeCount,
                 const RelaxOptions &options, double goal) {
  constexpr double kBand = 0.02; // of the scaled Jacobian: what counts as among the worst
  Index moves = 0;
  std::vector<double> around(nodes.size());
  std::vector<bool> isDue(nodeCount, true); // something around has moved since it was tried
  std::vector<bool> isStale(nodeCount, true);
  for (int round = 0; round < options.worstRounds; ++round) {
    checkDeadline();
    double worst = kInfinity;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (isStale[at(nodes[k])]) around[k] = relaxer.smallestAround(nodes[k]);
      isStale[at(nodes[k])] = false;
      worst = std::min(worst, around[k]);
    }
    if (worst > goal) break;
    Index moved = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (around[k] > std::max(worst, std::min(goal, 0.0)) + kBand || !isDue[at(nodes[k])]) continue;
      isDue[at(nodes[k])] = false;
      if (!relaxer.climb(nodes[k])) continue;
      ++moved;
      relaxer.forAround(nodes[k], [&](Index v) { isDue[at(v)] = isStale[at(v)] = true; });
    }
    moves += moved;
    if (moved == 0) break;
    if (options.onRound) options.onRound();
  }
  return moves;
}

} // namespace

template <int N>
RelaxResult relax(const Freedom<N> &freedom, BlockMesh<N> &blocks, const RelaxOptions &options,
                  const std::vector<bool> &isWanted) {
  RelaxResult result;
  Relaxer<N> relaxer(freedom, blocks);
  std::vector<Index> active;
  for (Index v = 0; v < blocks.nodeCount(); ++v)
    if (!freedom.isFixed(v) && (isWanted.empty() || isWanted[at(v)])) active.push_back(v);
  // Where a block is inverted, nothing can descend: climb out of that first.
  result.moves += climbWorst(relaxer, active, blocks.positions.size(), options, 0);
  const auto worst = [&] {
    double least = kInfinity;
    for (const Index v : active) least = std::min(least, relaxer.smallestAround(v));
    return least;
  };
  const double before = worst();
  const bool dips = options.dip < 1; // else no move lowers the smallest
  const std::vector<Vec<N>> start = dips ? blocks.positions : std::vector<Vec<N>>{};
  const double floor = before > 0 ? options.dip * before : before;
  std::vector<bool> isDue(blocks.positions.size(), true); // something around has moved since it was looked at
  for (; result.sweeps < options.sweeps; ++result.sweeps) {
    checkDeadline();
    Index moved = 0;
    for (const Index v : active) {
      if (!isDue[at(v)]) continue;
      isDue[at(v)] = false;
      if (!relaxer.descend(v, floor, options.precision)) continue;
      ++moved;
      relaxer.forAround(v, [&](Index w) { isDue[at(w)] = true; });
    }
    result.moves += moved;
    if (moved == 0) break;
    if (options.onRound) options.onRound();
  }
  result.moves += climbWorst(relaxer, active, blocks.positions.size(), options, kInfinity);
  if (dips && worst() < before) blocks.positions = start; // it did not come up again
  return result;
}

template RelaxResult relax(const Freedom<2> &, BlockMesh<2> &, const RelaxOptions &,
                           const std::vector<bool> &);
template RelaxResult relax(const Freedom<3> &, BlockMesh<3> &, const RelaxOptions &,
                           const std::vector<bool> &);

} // namespace dualblock
