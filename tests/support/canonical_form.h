// A canonical form of a block complex: two complexes are isomorphic exactly if their forms are equal.
//
// A flag of a block is a corner with an order of the axes there: 8 per quad, 48 per hexahedron. From a
// starting flag the blocks are visited breadth first across their faces, each in the frame that it inherits
// through the face, nodes being numbered as they are met; what is written down on the way is a code of the
// complex that depends on the starting flag alone. The smallest code over all flags is the form of a
// component. Mirror images have equal forms, as frames of both hands are tried.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include "primal/primal.h"

namespace dualblock::test {

/// Node lists in the order of Block::nodes (VTK's).
template <int N> using BlockList = std::vector<std::array<Index, 1 << N>>;

template <int N> BlockList<N> blocksOf(const Primal<N> &primal) {
  BlockList<N> list;
  for (const Block<N> &block : primal.blocks) list.push_back(block.nodes);
  return list;
}

/// Place in VTK's order of the corner with the given parameter bits; written out here so as not to lean on
/// the core's table.
template <int N> constexpr int vtkPlace(unsigned bits) {
  constexpr int kPlace[8] = {0, 1, 3, 2, 4, 5, 7, 6};
  return kPlace[bits & ((1U << N) - 1)];
}

template <int N> class CanonicalForm {
public:
  using Code = std::vector<Index>;

  /// Throws if components that share no face share a node: their codes would not tell how.
  static std::vector<Code> of(const BlockList<N> &blocks) {
    CanonicalForm form(blocks);
    std::vector<Code> codes;
    std::vector<bool> done(blocks.size(), false);
    std::set<Index> usedNodes;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (done[b]) continue;
      const std::vector<Index> component = form.componentOf(toIndex(b));
      std::set<Index> nodes;
      for (const Index c : component) {
        done[at(c)] = true;
        nodes.insert(form.nodes_[at(c)].begin(), form.nodes_[at(c)].end());
      }
      for (const Index v : nodes)
        if (!usedNodes.insert(v).second) throw std::invalid_argument("components share a node but no face");
      codes.push_back(form.smallestCode(component));
    }
    std::sort(codes.begin(), codes.end());
    return codes;
  }

private:
  static constexpr unsigned kCorners = 1U << N;
  static constexpr Index kBoundary = -1;
  /// Per place in the inherited frame: the block's own corner, as bits.
  using Frame = std::array<unsigned, kCorners>;
  using FaceKey = std::array<Index, 1 << (N - 1)>;

  explicit CanonicalForm(const BlockList<N> &blocks) {
    std::map<Index, Index> dense;
    for (const auto &block : blocks) {
      std::array<Index, kCorners> byBits;
      for (unsigned bits = 0; bits < kCorners; ++bits) {
        const Index node = block[at(vtkPlace<N>(bits))];
        byBits[bits] = dense.emplace(node, toIndex(dense.size())).first->second;
      }
      nodes_.push_back(byBits);
    }
    nodeCount_ = dense.size();
    std::map<FaceKey, std::vector<std::pair<Index, int>>> faces;
    for (std::size_t b = 0; b < nodes_.size(); ++b)
      for (int f = 0; f < 2 * N; ++f) faces[keyOf(toIndex(b), f)].push_back({toIndex(b), f});
    neighbors_.resize(nodes_.size());
    for (auto &row : neighbors_) row.fill({kBoundary, -1});
    for (const auto &[key, uses] : faces) {
      if (uses.size() > 2) throw std::invalid_argument("more than two blocks share a face");
      if (uses.size() < 2) continue;
      neighbors_[at(uses[0].first)][at(uses[0].second)] = uses[1];
      neighbors_[at(uses[1].first)][at(uses[1].second)] = uses[0];
    }
  }

  /// The corners of face f (across axis f / 2, at its end f % 2), in a cycle.
  static std::array<unsigned, 1 << (N - 1)> cornersOfFace(int f) {
    const unsigned end = static_cast<unsigned>(f % 2) << (f / 2);
    const unsigned a = 1U << ((f / 2 + 1) % N);
    if constexpr (N == 2) return {end, end | a};
    else {
      const unsigned b = 1U << ((f / 2 + 2) % N);
      return {end, end | a, end | a | b, end | b};
    }
  }

  /// The face's nodes as a cycle in its one form, so that faces that are twisted against each other differ.
  FaceKey keyOf(Index b, int f) const {
    FaceKey key;
    const auto corners = cornersOfFace(f);
    for (std::size_t k = 0; k < key.size(); ++k) key[k] = nodes_[at(b)][corners[k]];
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    if constexpr (N == 3)
      if (key[3] < key[1]) std::swap(key[1], key[3]);
    return key;
  }

  std::vector<Index> componentOf(Index seed) const {
    std::vector<Index> found{seed};
    std::set<Index> seen{seed};
    for (std::size_t head = 0; head < found.size(); ++head)
      for (const auto &[block, face] : neighbors_[at(found[head])])
        if (block != kBoundary && seen.insert(block).second) found.push_back(block);
    return found;
  }

  /// All frames of a block: each corner as origin, each order of the axes.
  static const std::vector<Frame> &frames() {
    static const std::vector<Frame> all = [] {
      std::vector<Frame> list;
      std::array<unsigned, N> axes;
      for (unsigned k = 0; k < N; ++k) axes[k] = k;
      do {
        for (unsigned origin = 0; origin < kCorners; ++origin) {
          Frame frame{};
          for (unsigned place = 0; place < kCorners; ++place) {
            frame[place] = origin;
            for (unsigned k = 0; k < N; ++k)
              if (place >> k & 1) frame[place] ^= 1U << axes[k];
          }
          list.push_back(frame);
        }
      } while (std::next_permutation(axes.begin(), axes.end()));
      return list;
    }();
    return all;
  }

  /// The face of the block that the frame shows across `axis` at its end `end`.
  static int faceOf(const Frame &frame, unsigned axis, unsigned end) {
    const unsigned own = frame[0] ^ frame[1U << axis]; // the own axis that the frame's axis runs along
    int number = 0;
    while (own >> number != 1) ++number;
    const unsigned corner = frame[end << axis];
    return 2 * number + static_cast<int>(corner >> number & 1);
  }

  /// The neighbour's frame when the frame of b is carried on across the face.
  Frame carry(Index b, const Frame &frame, unsigned axis, unsigned end, std::pair<Index, int> across) const {
    Frame result{};
    const auto &target = nodes_[at(across.first)];
    const auto corners = cornersOfFace(across.second);
    const unsigned step = 1U << (across.second / 2);
    for (unsigned place = 0; place < kCorners; ++place) {
      if ((place >> axis & 1) != end) continue;
      const Index node = nodes_[at(b)][frame[place]];
      for (const unsigned corner : corners) {
        if (target[corner] != node) continue;
        result[place ^ (1U << axis)] = corner;
        result[place] = corner ^ step;
      }
    }
    return result;
  }

  Code smallestCode(const std::vector<Index> &component) {
    Code best;
    for (const Index start : component)
      for (const Frame &frame : frames()) writeCode(start, frame, best);
    return best;
  }

  /// Replaces `best` if the code from this flag is smaller; stops as soon as it is known to be larger.
  void writeCode(Index start, const Frame &startFrame, Code &best) {
    number_.assign(nodeCount_, kNone);
    order_.assign(nodes_.size(), kNone);
    queue_.clear();
    code_.clear();
    Index nextNode = 0;
    bool smaller = best.empty();
    const auto write = [&](Index value) {
      if (!smaller) {
        const Index other = best[code_.size()]; // codes of one component are equally long
        if (value > other) return false;
        smaller = value < other;
      }
      code_.push_back(value);
      return true;
    };
    order_[at(start)] = 0;
    queue_.push_back({start, startFrame});
    for (std::size_t head = 0; head < queue_.size(); ++head) {
      const auto [b, frame] = queue_[head];
      for (unsigned place = 0; place < kCorners; ++place) {
        Index &number = number_[at(nodes_[at(b)][frame[place]])];
        if (number == kNone) number = nextNode++;
        if (!write(number)) return;
      }
      for (unsigned axis = 0; axis < N; ++axis)
        for (unsigned end = 0; end < 2; ++end) {
          const auto across = neighbors_[at(b)][at(faceOf(frame, axis, end))];
          Index met = kBoundary;
          if (across.first != kBoundary) {
            if (order_[at(across.first)] == kNone) {
              order_[at(across.first)] = toIndex(queue_.size());
              queue_.push_back({across.first, carry(b, frame, axis, end, across)});
            }
            met = order_[at(across.first)];
          }
          if (!write(met)) return;
        }
    }
    if (smaller) best = code_;
  }

  std::vector<std::array<Index, kCorners>> nodes_; // per block, by bits, numbered densely
  std::size_t nodeCount_ = 0;
  std::vector<std::array<std::pair<Index, int>, 2 * N>> neighbors_; // block and its face
  std::vector<Index> number_;                                       // scratch of writeCode
  std::vector<Index> order_;
  std::vector<std::pair<Index, Frame>> queue_;
  Code code_;
};

/// One code per component, sorted.
template <int N> std::vector<std::vector<Index>> canonicalForm(const BlockList<N> &blocks) {
  return CanonicalForm<N>::of(blocks);
}

} // namespace dualblock::test
