// Random bent solids of every kind: each gets a certified mesh, and a judge that shares nothing with the core
// finds nothing wrong with it, nor with its refinement. 42 a run; DUALBLOCK_TRIALS sets another number per
// kind, DUALBLOCK_FIRST_SEED where to begin. A failure names kind and seed; each kind has a line of numbers.
#include <chrono>
#include <iostream>
#include <sstream>

#include <gtest/gtest.h>

#include "support/bent_domains.h"
#include "support/mesh_judge.h"

namespace dualblock::test {
namespace {

/// What became of the solids of one kind.
struct Tally {
  int solids = 0, errors = 0, refused = 0, good = 0;
  int inverted = 0, incoherent = 0, overlapping = 0, gutted = 0; // of the valid ones; also by refinement
  int refinedOnly = 0;                                           // of those: the blocks are right
  double worstOverlap = 0, worstVolume = 0, worstDeterminant = 1;
  std::uint32_t seedOfOverlap = 0, seedOfVolume = 0; // of the worst
  int simplices = 0;                                 // solids that became simplices, in all or in part
  std::size_t blocks = 0;
  double seconds = 0, judging = 0;

  void add(const Verdict &v, std::uint32_t seed) {
    inverted += v.invertedBlocks > 0;
    incoherent += v.incoherentFaces > 0;
    overlapping += v.overlaps;
    gutted += v.gutted;
    worstDeterminant = std::min(worstDeterminant, v.worstDeterminant);
    const double overlap = std::max(v.overlap, v.boundaryOverlap);
    if (overlap > worstOverlap) seedOfOverlap = seed;
    worstOverlap = std::max(worstOverlap, overlap);
    if (v.lost + v.excess > worstVolume) seedOfVolume = seed;
    worstVolume = std::max(worstVolume, v.lost + v.excess);
  }

  void print(const std::string &name) const {
    std::ostringstream line; // so that lines of processes side by side stay whole
    line.precision(3);
    line << name << ": " << solids << " solids, " << errors << " errors, " << refused << " not certified, "
         << good << " good; certified but inverted " << inverted << ", incoherent " << incoherent
         << ", overlapping " << overlapping << ", gutted " << gutted << " (only when refined: " << refinedOnly
         << "); worst overlap " << 100 * worstOverlap << " % (seed " << seedOfOverlap << "), lost and excess "
         << 100 * worstVolume << " % (seed " << seedOfVolume << "), determinant " << worstDeterminant << "; "
         << blocks << " blocks, simplices in " << simplices << ", " << seconds << " s, judged in " << judging
         << " s\n";
    std::cout << line.str();
  }
};

HexMesh meshOf(const PipelineResult<3> &r) {
  if (r.finalMesh) return {r.finalMesh->blocks.positions, r.finalMesh->blocks.blocks};
  HexMesh mesh{r.primal.positions, {}};
  for (const Block<3> &b : r.primal.blocks) mesh.blocks.push_back(b.nodes);
  return mesh;
}

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Refined on the true facets, elements fit them better: where the blocks are right, so are they.
std::string complaintOfRefined(const Domain<3> &domain, const PipelineResult<3> &r, std::uint32_t seed,
                               Tally &tally) {
  RefineOptions options;
  options.intervals = 2;
  const auto refined = refineResult<3>(r, options);
  if (!refined.ok()) return refined.error().message;
  const Verdict v = judge(domain, {refined.value().positions, refined.value().elements}, {1000, seed});
  if (!v.complaint.empty()) {
    tally.add(v, seed);
    ++tally.refinedOnly;
  }
  return v.complaint;
}

class BentProperty : public ::testing::TestWithParam<int> {};

TEST_P(BentProperty, EverySolidGetsARightMesh) {
  const std::uint32_t first = fromEnvironment("DUALBLOCK_FIRST_SEED", 1);
  const std::uint32_t trials = fromEnvironment("DUALBLOCK_TRIALS", 3);
  Tally tally;
  for (std::uint32_t seed = first; seed < first + trials; ++seed) {
    const Domain<3> domain = bentSolid(GetParam(), seed);
    SCOPED_TRACE(domain.name + ", kind " + std::to_string(GetParam()) + ", seed " + std::to_string(seed));
    ++tally.solids;
    const auto start = std::chrono::steady_clock::now();
    const auto result = runPipeline<3>(domain, {});
    tally.seconds += since(start);
    if (!result.ok()) {
      ++tally.errors;
      ADD_FAILURE() << result.error().message;
      continue;
    }
    const auto &r = result.value();
    if (!r.certificate.valid) {
      ++tally.refused;
      ADD_FAILURE() << failuresOf(r.certificate);
      continue;
    }
    const auto judged = std::chrono::steady_clock::now();
    const HexMesh mesh = meshOf(r);
    tally.blocks += mesh.blocks.size();
    tally.simplices += r.fallbackComponents + r.pulledComponents > 0;
    JudgeOptions options;
    options.seed = seed;
    const Verdict verdict = judge(domain, mesh, options);
    tally.add(verdict, seed);
    std::string complaint = verdict.complaint;
    if (complaint.empty() && seed % 3 == 0 && mesh.blocks.size() < 500) {
      complaint = complaintOfRefined(domain, r, seed, tally);
      if (!complaint.empty()) complaint = "refined: " + complaint;
    }
    tally.judging += since(judged);
    EXPECT_EQ(complaint, "") << mesh.blocks.size() << " blocks";
    tally.good += complaint.empty();
  }
  tally.print(kBentKinds[at(GetParam())].name);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BentProperty, ::testing::Range(0, kBentKindCount));

} // namespace
} // namespace dualblock::test
