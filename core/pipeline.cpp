#include "pipeline.h"

#include <limits>
#include <optional>
#include <utility>

#include "contributions/given_matching.h"
#include "mesh_parts.h"
#include "partition/heuristics.h"
#include "reference/culprits.h"
#include "reference/patches.h"
#include "remesh/remesh.h"
#include "stage_clock.h"

namespace dualblock {
namespace {

// Marked noinline: the module is 1 kB (gzip) smaller if these are there once for each dimension.
template <int N> PartCandidate figuresOf(const PipelineResult<N> &r) {
  PartCandidate figures{toIndex(r.parts.parts.size()), toIndex(shapesOf(r).size())};
  figures.minScaledJacobian = -std::numeric_limits<double>::infinity();
  if (r.certificate.valid) figures.minScaledJacobian = worstShape(r);
  return figures;
}

/// Carries what else the parts could be through to meshes of their own, each from what all have in `common`,
/// and leaves the one of the best shape in r: never a worse one than was there, and where few blocks are
/// wanted, not many times as many.
template <int N>
[[gnu::noinline]] void takeBestShape(PipelineResult<N> &r, const PipelineResult<N> &common,
                                     std::vector<PartProposal<N>> proposals, const PipelineOptions &options,
                                     const FillMeshes<N> &fills, StageClock &clock) {
  std::vector<PartCandidate> candidates{figuresOf(r)};
  std::vector<PipelineResult<N>> others;
  if (!proposals.empty()) clock.start("shape", 0.92);
  const Progress silent; // all their stages are one
  std::vector<StageTime> untold;
  StageClock inner(silent, untold);
  for (PartProposal<N> &proposal : proposals) {
    PipelineResult<N> other = common;
    other.mesh = std::move(proposal.mesh);
    const double times = options.objective == Objective::shape       ? std::numeric_limits<double>::infinity()
                         : candidates[0].minScaledJacobian < kNeedle ? kTimesForNeedles
                                                                     : kTimesForShape;
    if (proposal.choice.score.blocks > times * candidates[0].blocks) continue;
    if (!meshParts(other, std::move(proposal.choice), false, options, fills, inner)) continue;
    candidates.push_back(figuresOf(other));
    others.push_back(std::move(other));
  }
  clock.stop();
  double wanted = candidates[0].minScaledJacobian;
  for (const PartCandidate &c : candidates) wanted = std::max(wanted, c.minScaledJacobian - kSameShape);
  std::size_t best = 0;
  for (std::size_t k = 1; k < candidates.size(); ++k)
    if (candidates[k].minScaledJacobian >= wanted &&
        (candidates[best].minScaledJacobian < wanted || candidates[k].blocks < candidates[best].blocks))
      best = k;
  if (best > 0) {
    std::vector<StageTime> timings = std::move(r.timings);
    r = std::move(others[best - 1]);
    r.timings = std::move(timings);
  }
  candidates[best].chosen = true;
  r.candidates = std::move(candidates);
}

/// Good simplices where blocks are poor, if that makes them sound, or at least much better.
template <int N>
void takeGoodSimplices(PipelineResult<N> &r, const PipelineOptions &options, const FillMeshes<N> &fills,
                       StageClock &clock) {
  clock.start("shape", 0.92);
  const Progress silent;
  std::vector<StageTime> untold;
  StageClock inner(silent, untold);
  const double before = worstShape(r);
  const double times = before < kNeedle ? kTimesForNeedles : kTimesForShape;
  PipelineResult<N> other = r;
  const auto most = static_cast<Index>(times * static_cast<double>(shapesOf(r).size()) / (N + 1));
  const bool holds = meshGoodSimplices(other, most, options, fills, inner);
  clock.stop();
  if (!holds || !other.certificate.valid) return;
  const double after = worstShape(other);
  if (after < kPoorShape && !(after > kMuchBetter * before)) return;
  other.timings = std::move(r.timings);
  PartCandidate figures = figuresOf(other);
  for (PartCandidate &c : other.candidates) c.chosen = false;
  figures.chosen = true;
  other.candidates.push_back(figures);
  r = std::move(other);
}

/// The paper's rules on the contributions that the domain itself gives (figure 12).
void checkMatchingOnly(PipelineResult<2> &r) {
  const Domain<2> &domain = r.domain.domain;
  r.contributions = givenContributions(r.mesh, domain.contributions);
  for (const MatchingFault &fault :
       checkGivenContributions(domain.reference->simplices, domain.contributions))
    r.certificate.fail(Check::matching, fault.message, {{"node", fault.near}, {"node", fault.far}});
}

template <int N>
Result<PipelineResult<N>> runStages(const Domain<N> &given, const PipelineOptions &options,
                                    const Progress &progress) {
  PipelineResult<N> r;
  StageClock clock(progress, r.timings);
  clock.start("domain", 0);
  auto prepared = prepareDomain(given, options.tolerance);
  if (!prepared.ok()) return prepared.error();
  r.domain = std::move(prepared.value());
  const Domain<N> &domain = r.domain.domain;

  clock.start("reference", 0.05);
  FillOptions fillOptions;
  fillOptions.edgeLength = options.edgeLength;
  fillOptions.seed = options.seed;
  fillOptions.planarTolerance = options.tolerance;
  fillOptions.featureAngle = options.featureAngle;
  auto filled = fillDomain(domain, fillOptions);
  if (!filled.ok()) return nameCulprits(filled.error(), given, r.domain, options.tolerance);
  r.mesh = std::move(filled.value().mesh);
  r.domain.deviation = std::max(r.domain.deviation, filled.value().deviation);
  clock.credit("tetgen", filled.value().tetgenMilliseconds);
  r.remedy = std::move(filled.value().remedy);
  r.fillSimplices = r.mesh.simplexCount();

  if (!domain.contributions.empty()) {
    r.onlyMatching = true;
    if constexpr (N == 2) checkMatchingOnly(r);
    clock.stop();
    return r;
  }

  // The fallback always works on the coarsest mesh: a refined one would only multiply its blocks.
  std::optional<ReferenceMesh<N>> coarse;
  std::optional<Error> coarseError;
  const bool isCoarse = options.edgeLength <= 0 && options.seed == 0;
  const CoarseMesh<N> needCoarse = [&]() -> const ReferenceMesh<N> * {
    if (!coarse && !coarseError) {
      FillOptions plain = fillOptions;
      plain.edgeLength = 0;
      plain.seed = 0;
      auto again = fillDomain(domain, plain);
      if (again.ok()) coarse = std::move(again.value().mesh);
      else coarseError = again.error();
    }
    return coarse ? &*coarse : nullptr;
  };
  if (isCoarse) coarse = r.mesh;
  std::optional<ReferenceMesh<N>> good;
  std::pair<int, Index> goodAttempt{-1, 0};
  const auto needGood = [&](int attempt, Index most) -> const ReferenceMesh<N> * {
    if constexpr (N == 3) {
      const std::pair<int, Index> wanted{attempt, most};
      const bool isMade = std::exchange(goodAttempt, wanted) == wanted;
      if (const ReferenceMesh<N> *const from = isMade ? nullptr : needCoarse()) {
        Parts<N> features = buildParts(*from, PartOptions{});
        keepVertices(*from, features);
        good = remesh(*from, features, {attempt == 0 ? 1.0 : kFinerAttempt, most});
      }
    }
    return good ? &*good : nullptr;
  };
  const FillMeshes<N> fills{needCoarse, needGood};

  clock.start("features", 0.3);
  r.features = buildParts(r.mesh, PartOptions{});
  keepVertices(r.mesh, r.features);
  r.angleBound = angleBound(r.mesh, r.features);
  r.featureNodes = r.mesh.nodes;
  r.featureKinds = classifyFeatures(r.features);

  clock.start("parts", 0.35);
  const CutOptions cutOptions{options.tolerance * r.mesh.size + 2 * r.domain.deviation,
                              toIndex(domain.facets.size())};
  const bool wantsShape = options.objective == Objective::shape;
  r.bentSides = bentSideCount(r.mesh);
  const bool mayPropose = wantsShape || r.bentSides > 0 || (N == 2 && r.mesh.simplexCount() <= kCheap);
  const ReferenceMesh<N> uncut = mayPropose ? r.mesh : ReferenceMesh<N>{};
  PartChoice<N> choice = chooseParts<N>(r.mesh, r.features, cutOptions, needCoarse, isCoarse);
  std::vector<PartProposal<N>> proposals;
  const auto propose = [&, score = choice.score](Proposals which) {
    proposals = proposeParts<N>(uncut, r.features, cutOptions, needCoarse, score, which);
  };
  if (wantsShape) propose(Proposals::all);
  r.alternatives = choice.alternatives;
  r.cutTrials = std::move(choice.trials);
  ReferenceMesh<N> cut = std::exchange(r.mesh, {}); // proposals bring their own
  const PipelineResult<N> common = mayPropose ? r : PipelineResult<N>{};
  r.mesh = std::move(cut);
  if (!meshParts(r, std::move(choice), true, options, fills, clock)) return *coarseError;
  try {
    const bool falls = r.fallbackComponents + r.pulledComponents > 0;
    if (mayPropose && !wantsShape) {
      if (r.bentSides > 0 && falls && !hasLastPolicy(r.cutTrials)) propose(Proposals::last);
      const double sound = std::min(kPoorShape, kNearBound * r.angleBound);
      const bool isPoor = options.mode.relax && figuresOf(r).minScaledJacobian < sound;
      if (isPoor && (N == 2 || !falls)) propose(Proposals::all);
    }
    takeBestShape(r, common, std::move(proposals), options, fills, clock);
    if constexpr (N == 3)
      if (options.mode.relax && r.certificate.valid &&
          worstShape(r) < std::min(kPoorShape, kNearBound * r.angleBound) && r.remeshedComponents == 0 &&
          !r.isRemeshRefused)
        takeGoodSimplices(r, options, fills, clock);
  } catch (const OutOfTime &) { // what there is, if anything
    if (!r.certificate.valid) throw;
    r.isCutShort = true;
  }
  r.features.partOfSimplex = {}; // of the uncut mesh, which is no more
  r.features.nodeSides = {};
  r.features.sideFaces = {};
  const ModeOptions &mode = options.mode;
  if (r.certificate.valid && (mode.mode != Mode::layered || !mode.extract.empty() || !mode.insert.empty())) {
    clock.start("extraction", 0.95);
    const BlockMesh<N> layered =
        r.finalMesh ? r.finalMesh->blocks : layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
    const BlockInput<N> input{r.domain.domain, r.features,         r.featureNodes, r.mesh,
                              layered,         r.domain.deviation, r.given.get()};
    auto made = makeFinalMesh(input, r.certificate, mode, r.domain.facetOfGiven);
    if (!made.ok()) return made.error();
    if (r.finalMesh) {
      const auto &doubled = r.finalMesh->inserted;
      made.value().inserted.insert(made.value().inserted.begin(), doubled.begin(), doubled.end());
      made.value().doubled = r.finalMesh->doubled;
    }
    r.finalMesh = std::move(made.value());
    r.certificate = r.finalMesh->certificate; // matching and cells have passed, on the layered mesh
  }
  clock.stop();
  return r;
}

} // namespace

template <int N>
Result<PipelineResult<N>> runPipeline(const Domain<N> &given, const PipelineOptions &options,
                                      const Progress &progress) {
  const DeadlineScope scope(options.timeLimit);
  try {
    return runStages(given, options, progress);
  } catch (const OutOfTime &) {
    return Error{ErrorCode::timeLimit,
                 "The run took longer than the limit of " + formatNumber(options.timeLimit) +
                     " s: raise it, refine less, or simplify the domain.",
                 {}};
  }
}

template Result<PipelineResult<2>> runPipeline(const Domain<2> &, const PipelineOptions &, const Progress &);
template Result<PipelineResult<3>> runPipeline(const Domain<3> &, const PipelineOptions &, const Progress &);

} // namespace dualblock
