#include "certified_mesh.h"

#include <utility>

#include "base/parallel.h"
#include "blocks/relax.h"
#include "contributions/repair.h"
#include "geometry/jacobian.h"
#include "geometry/placement.h"
#include "geometry/turn_placement.h"
#include "partition/heuristics.h"

namespace dualblock {
namespace {

// Marked noinline: the module is 1 kB (gzip) smaller if these are there once for each dimension.
constexpr Index kLongestHistory = 5000;
constexpr int kRepairRounds = 12;

/// The primal's nodes, moved to where its blocks have a better shape.
/// `holdsBent`: those on bent sides stay.
template <int N> [[gnu::noinline]] void relaxPrimal(PipelineResult<N> &r, bool history, bool holdsBent) {
  BlockMesh<N> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const bool holds = r.fallbackComponents + r.pulledComponents > r.remeshedComponents;
  const Freedom<N> freedom(r.sideMesh(), r.features, r.featureNodes, blocks, holds || holdsBent,
                           r.given != nullptr);
  RelaxOptions options;
  const auto keep = [&] {
    r.history.insert(r.history.end(), blocks.positions.begin(), blocks.positions.end());
  };
  if (history && blocks.nodeCount() <= kLongestHistory) {
    keep();
    options.onRound = keep;
  }
  relax(freedom, blocks, options);
  r.primal.positions = std::move(blocks.positions);
}

/// Where faces of the reference mesh only stand for bent sides: the nodes there, onto the sides themselves.
template <int N> [[gnu::noinline]] void putOnSides(PipelineResult<N> &r) {
  const BlockMesh<N> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const Freedom<N> freedom(r.sideMesh(), r.features, r.featureNodes, blocks, false, true);
  for (Index v = 0; v < blocks.nodeCount(); ++v)
    if (!freedom.isFixed(v)) r.primal.positions[at(v)] = freedom.project(v, blocks.positions[at(v)]);
}

template <int N> void measureQuality(PipelineResult<N> &r) {
  r.quality.clear();
  for (const Block<N> &block : r.primal.blocks)
    r.quality.push_back(scaledJacobian<N>(cornersOf<N>(block.nodes, r.primal.positions)));
}

double worstOf(const std::vector<double> &quality) {
  return *std::min_element(quality.begin(), quality.end());
}

/// Where nodes that were moved to where blocks have a better shape do not serve: the places that they had
/// first, as where bent sides nearly touch; then those where bent sides turn. Else they are as they were.
/// False where the shape has suffered.
template <int N>
[[gnu::noinline]] bool tryOtherPlaces(PipelineResult<N> &r, std::vector<Vec<N>> placed,
                                      const CertificateInput<N> &toCertify, const Certificate &ofDual) {
  const std::vector<Vec<N>> relaxed = std::exchange(r.primal.positions, std::move(placed));
  const std::vector<double> quality = r.quality;
  const std::vector<Vec<N>> history = std::exchange(r.history, {});
  const Certificate ofRelaxed = std::exchange(r.certificate, certify(toCertify, ofDual));
  const auto keepsShape = [&] {
    measureQuality(r);
    return worstOf(r.quality) >= kKeptShape * worstOf(quality);
  };
  if (r.certificate.valid) return keepsShape();
  if constexpr (N == 3)
    if (r.bentSides > 0) {
      placeByTurning(r.mesh, r.parts, r.dual, r.primal);
      relaxPrimal(r, false, true);
      r.certificate = certify(toCertify, ofDual);
      if (r.certificate.valid) return keepsShape();
    }
  r.primal.positions = relaxed;
  r.quality = quality;
  r.history = history;
  r.certificate = ofRelaxed;
  return true;
}

} // namespace

template <int N>
bool buildDual(PipelineResult<N> &r, const PartOptions &partOptions, std::vector<bool> &everyFace,
               StageClock &clock) {
  Earlier<Contributions<N>> contributions;
  Earlier<DualCells<N>> dual;
  for (int round = 0; round < kRepairRounds; ++round) {
    clock.start("contributions", 0.5);
    r.contributions = assignContributions(r.mesh, r.parts, contributions);
    bool isInside = false; // whether the repair stays inside of parts
    Index added = 0;
    if (!r.contributions.notFull.empty()) {
      added = repairFullness(r.mesh, r.parts, r.contributions.notFull);
    } else {
      clock.start("dual", 0.6);
      r.dual = buildDualCells(r.mesh, r.parts, r.contributions, dual);
      if (r.dual.surplus.empty()) {
        r.surfaces = buildDualSurfaces(r.parts);
        return true;
      }
      added = repairBubbles(r.mesh, r.parts, r.dual);
      // Where each face is a side, sides count on their simplices; and plane meshes are quick without.
      isInside = N == 3 && !r.dual.overfull && !partOptions.everyFace;
      if constexpr (N == 3) {
        contributions.found = std::move(r.contributions);
        dual.found = std::move(r.dual);
      }
    }
    if (added == 0) return false;
    r.repairs += added;
    everyFace.resize(r.mesh.simplices.size(), false);
    clock.start("parts", 0.4);
    Earlier<Parts<N>> parts;
    if (isInside) parts = earlierParts(r.mesh, std::move(r.parts));
    r.parts = buildParts(r.mesh, partOptions, parts);
    contributions.holds = dual.holds = std::move(parts.holds);
    contributions.holds.resize(r.parts.parts.size(), false);
    dual.holds.resize(r.parts.parts.size(), false);
  }
  return false;
}

template <int N> bool buildResult(PipelineResult<N> &r, const PipelineOptions &options, StageClock &clock) {
  const CertificateInput<N> toCertify{r.domain.domain, r.features,         r.featureNodes, r.mesh,
                                      r.parts,         r.contributions,    r.dual,         r.surfaces,
                                      r.primal,        r.domain.deviation, r.given.get()};
  Certificate ofDual;
  Aside dual(at(r.dual.cellCount), [&] { ofDual = certifyDual(toCertify); });
  clock.start("primal", 0.7);
  r.primal = buildPrimal(r.mesh, r.parts, r.contributions, r.dual, r.surfaces);
  clock.start("placement", 0.8);
  placeNodes(r.mesh, r.parts, r.dual, r.primal);
  if (r.given) putOnSides(r);
  std::vector<Vec<N>> placed = r.primal.positions;
  if (options.mode.relax) {
    clock.start("relaxation", 0.85);
    r.history.clear();
    relaxPrimal(r, options.history, false);
  }
  clock.start("certificate", 0.9);
  dual.finish();
  r.certificate = certify(toCertify, ofDual);
  measureQuality(r);
  bool isGood = true;
  if (!r.certificate.valid && options.mode.relax)
    isGood = tryOtherPlaces(r, std::move(placed), toCertify, ofDual);
  return isGood && r.certificate.fidelity.coarse.empty();
}

#define DUALBLOCK_DEFINE(N)                                                                                  \
  template bool buildDual(PipelineResult<N> &, const PartOptions &, std::vector<bool> &, StageClock &);      \
  template bool buildResult(PipelineResult<N> &, const PipelineOptions &, StageClock &);
DUALBLOCK_DEFINE(2)
DUALBLOCK_DEFINE(3)
#undef DUALBLOCK_DEFINE

} // namespace dualblock
