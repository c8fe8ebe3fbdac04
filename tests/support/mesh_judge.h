// A judge of hexahedral meshes that shares nothing with the core but plain arrays: it takes points at random
// and asks the facets whether they are in the solid, and the blocks which of them hold them.
#pragma once

#include <cstdio>
#include <string>

#include "support/block_membership.h"
#include "support/random_source.h"
#include "support/solid_membership.h"

namespace dualblock::test {

struct JudgeOptions {
  int samples = 2000; // points in the blocks, on their boundary, and, half as many, in the solid
  std::uint32_t seed = 1;
  double overlapLimit = 0.001; // of the volume, and of the boundary
  double guttedLimit = 0.3;    // of the volume: lost + excess
};

struct Verdict {
  double domainVolume = 0;
  double meshVolume = 0;       // signed
  double overlap = 0;          // of the volume of all blocks together: held by more than one
  double boundaryOverlap = 0;  // of the blocks' boundary: inside of another block
  double lost = 0;             // of the solid: in no block
  double excess = 0;           // outside of the solid, by the solid's volume
  Index solidPoints = 0;       // that `lost` comes from
  double worstDeterminant = 0; // by the mean one of its block; the smallest that was found
  Index invertedBlocks = 0;    // with a determinant that is not positive
  Index incoherentFaces = 0;   // whose two blocks are on the same side of it, by the order of the nodes
  Index brokenBlocks = 0;      // with a node twice, or one that does not exist
  bool overlaps = false;
  bool gutted = false;
  std::string complaint; // empty where nothing is wrong
};

/// Faces with the same nodes, from the nodes alone. Returns those of one block, as {block, face}, and counts
/// those of two that do not run against each other, or of more.
inline std::vector<std::array<Index, 2>> boundaryOfBlocks(const HexMesh &mesh, Index &incoherent) {
  struct Use {
    std::array<Index, 4> key, cycle;
    Index block, face;
  };
  std::vector<Use> uses;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (std::size_t f = 0; f < 6; ++f) {
      Use use{{}, {}, toIndex(b), toIndex(f)};
      for (std::size_t k = 0; k < 4; ++k) use.cycle[k] = mesh.blocks[b][at(kOutwardFaces[f][k])];
      std::rotate(use.cycle.begin(), std::min_element(use.cycle.begin(), use.cycle.end()), use.cycle.end());
      use.key = use.cycle;
      std::sort(use.key.begin(), use.key.end());
      uses.push_back(use);
    }
  std::sort(uses.begin(), uses.end(), [](const Use &a, const Use &b) { return a.key < b.key; });
  std::vector<std::array<Index, 2>> boundary;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].key == uses[begin].key) ++end;
    if (end - begin == 1) {
      boundary.push_back({uses[begin].block, uses[begin].face});
      continue;
    }
    std::array<Index, 4> back = uses[begin].cycle;
    std::reverse(back.begin() + 1, back.end());
    if (end - begin > 2 || uses[begin + 1].cycle != back) ++incoherent;
  }
  return boundary;
}

namespace judging {

inline void checkNodes(const HexMesh &mesh, Verdict &verdict) {
  for (auto nodes : mesh.blocks) {
    std::sort(nodes.begin(), nodes.end());
    if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end() || nodes[0] < 0 ||
        nodes[7] >= toIndex(mesh.positions.size()))
      ++verdict.brokenBlocks;
  }
}

/// Determinants at the 27 points of a block's corners and middles, and at some random ones.
inline void checkDeterminants(const HexMesh &mesh, RandomSource &random, Verdict &verdict) {
  verdict.worstDeterminant = 1;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    double worst = 0;
    double mean = 0;
    for (int k = 0; k < 27 + 8; ++k) {
      Vec<3> place(0.5 * (k % 3), 0.5 * (k / 3 % 3), 0.5 * (k / 9));
      if (k >= 27) place = {random.real(0, 1), random.real(0, 1), random.real(0, 1)};
      const double determinant = trilinear(mesh, b, place).determinant;
      worst = k == 0 ? determinant : std::min(worst, determinant);
      mean += std::abs(determinant) / 35;
    }
    if (!(worst > 0)) ++verdict.invertedBlocks;
    verdict.worstDeterminant = std::min(verdict.worstDeterminant, mean > 0 ? worst / mean : 0);
  }
}

/// The place of a random number among parts of the given sizes.
class Chooser {
public:
  void add(double size) { ends_.push_back(total() + size); }
  double total() const { return ends_.empty() ? 0 : ends_.back(); }
  std::size_t choose(RandomSource &random) const {
    const auto place = std::upper_bound(ends_.begin(), ends_.end(), random.real(0, total()));
    return std::min(static_cast<std::size_t>(place - ends_.begin()), ends_.size() - 1);
  }

private:
  std::vector<double> ends_;
};

/// Points in blocks: how many blocks hold them, and whether the solid does. Each stands for as much volume as
/// the determinant says, and for its share of it where several blocks hold it.
inline void judgeBlockPoints(const HexMesh &mesh, const SolidMembership &solid, const BlockMembership &blocks,
                             int samples, RandomSource &random, Verdict &verdict) {
  Chooser chooser;
  std::vector<double> volumes;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    volumes.push_back(volumeOfBlock(mesh, b));
    verdict.meshVolume += volumes[b];
    chooser.add(std::abs(volumes[b]));
  }
  if (!(chooser.total() > 0)) return;
  double covered = 0;
  double twice = 0;
  double outside = 0;
  for (int k = 0; k < samples; ++k) {
    const std::size_t b = chooser.choose(random);
    const auto [p, determinant] =
        trilinear(mesh, b, {random.real(0, 1), random.real(0, 1), random.real(0, 1)});
    const int times = std::max(1, blocks.count(p));
    const double weight = std::abs(determinant / volumes[b]) / times / samples;
    covered += weight;
    if (times > 1) twice += weight;
    if (!solid.holds(p)) outside += weight;
  }
  verdict.overlap = covered > 0 ? twice / covered : 0;
  verdict.excess = outside * chooser.total() / verdict.domainVolume;
}

/// Points hardly inside of the boundary's blocks: no other block holds them. Sees overlaps of little volume.
inline void judgeBoundary(const HexMesh &mesh, const std::vector<std::array<Index, 2>> &boundary,
                          const BlockMembership &blocks, int samples, RandomSource &random,
                          Verdict &verdict) {
  Chooser chooser;
  for (const auto &[block, face] : boundary) {
    std::array<Vec<3>, 4> x;
    for (std::size_t k = 0; k < 4; ++k)
      x[k] = mesh.positions[at(mesh.blocks[at(block)][at(kOutwardFaces[at(face)][k])])];
    chooser.add(glm::length(glm::cross(x[2] - x[0], x[3] - x[1])) / 2);
  }
  if (!(chooser.total() > 0)) return;
  int inside = 0;
  for (int k = 0; k < samples; ++k) {
    const auto &[block, face] = boundary[chooser.choose(random)];
    Vec<3> place{random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    place[face / 2] = face % 2 == 0 ? 1e-6 : 1 - 1e-6; // faces stand in pairs, by axis
    if (blocks.count(trilinear(mesh, at(block), place).x, block) > 0) ++inside;
  }
  verdict.boundaryOverlap = static_cast<double>(inside) / samples;
}

/// Points of the solid's box: which of those in the solid no block holds.
inline void judgeBoxPoints(const SolidMembership &solid, const BlockMembership &blocks, int samples,
                           RandomSource &random, Verdict &verdict) {
  const Vec<3> low = solid.low();
  const Vec<3> high = solid.high();
  int lost = 0;
  for (int k = 0; k < 20 * samples && verdict.solidPoints < samples; ++k) {
    const Vec<3> p{random.real(low.x, high.x), random.real(low.y, high.y), random.real(low.z, high.z)};
    if (!solid.holds(p)) continue;
    ++verdict.solidPoints;
    if (blocks.count(p) == 0) ++lost;
  }
  verdict.lost = verdict.solidPoints > 0 ? static_cast<double>(lost) / verdict.solidPoints : 1;
}

inline std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f %%", 100 * share);
  return text;
}

inline std::string complaintOf(const Verdict &v) {
  std::string text;
  const auto say = [&](bool wrong, const std::string &what) {
    if (wrong) text += (text.empty() ? "" : "; ") + what;
  };
  say(v.brokenBlocks > 0, std::to_string(v.brokenBlocks) + " blocks without eight nodes");
  say(v.invertedBlocks > 0, std::to_string(v.invertedBlocks) + " inverted blocks, determinant " +
                                std::to_string(v.worstDeterminant) + " of the mean");
  say(v.incoherentFaces > 0, std::to_string(v.incoherentFaces) + " faces with both blocks on one side");
  say(v.overlaps, "overlap in " + percent(v.overlap) + " of the volume, " + percent(v.boundaryOverlap) +
                      " of the boundary");
  say(v.gutted, "lost " + percent(v.lost) + " of the solid, " + percent(v.excess) + " outside of it");
  return text;
}

} // namespace judging

/// Judges a mesh of a solid whose facets are oriented outward and do not cross.
inline Verdict judge(const Domain<3> &domain, const HexMesh &mesh, const JudgeOptions &options = {}) {
  using namespace judging;
  Verdict verdict;
  checkNodes(mesh, verdict);
  if (verdict.brokenBlocks > 0) {
    verdict.complaint = complaintOf(verdict);
    return verdict;
  }
  RandomSource random(options.seed);
  const SolidMembership solid(domain);
  const BlockMembership blocks(mesh);
  verdict.domainVolume = solid.volume();
  checkDeterminants(mesh, random, verdict);
  const auto boundary = boundaryOfBlocks(mesh, verdict.incoherentFaces);
  judgeBlockPoints(mesh, solid, blocks, options.samples, random, verdict);
  judgeBoundary(mesh, boundary, blocks, options.samples, random, verdict);
  judgeBoxPoints(solid, blocks, options.samples / 2, random, verdict);
  verdict.overlaps = verdict.overlap > options.overlapLimit || verdict.boundaryOverlap > options.overlapLimit;
  verdict.gutted = verdict.lost + verdict.excess > options.guttedLimit;
  verdict.complaint = complaintOf(verdict);
  return verdict;
}

} // namespace dualblock::test
