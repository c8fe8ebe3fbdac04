#include "pipeline.h"

#include <limits>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "blocks/relax.h"
#include "contributions/given_matching.h"
#include "contributions/repair.h"
#include "geometry/jacobian.h"
#include "geometry/placement.h"
#include "parts/bent_cuts.h"
#include "reference/culprits.h"
#include "stage_clock.h"

namespace dualblock {
namespace {

// Marked noinline: the module is 1 kB (gzip) smaller if these are there once for each dimension.
constexpr Index kLongestHistory = 5000;
constexpr int kRepairRounds = 12;
constexpr int kBlameRounds = 4;        // then all components fall back
constexpr Index kCheapToHalve = 60000; // simplices, up to which parts that do not serve are halved
constexpr int kHalvings = 8;           // rounds of that
constexpr int kHalvedAlone = 40;       // cuts of single parts that are tried in all of them
constexpr double kPoorShape = 0.1;     // scaled Jacobian of a mesh of bent parts below which others are tried

/// Contributions and D-bar-cells of the parts, with repairs of the mesh until conditions (a) and (b) hold.
/// False if they cannot be made to hold.
template <int N>
[[gnu::noinline]] bool buildDual(PipelineResult<N> &r, const PartOptions &partOptions,
                                 std::vector<bool> &everyFace, StageClock &clock) {
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

/// The primal's nodes, moved to where its blocks have a better shape.
template <int N> [[gnu::noinline]] void relaxPrimal(PipelineResult<N> &r, bool history) {
  BlockMesh<N> blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  const bool hasSimplices = r.fallbackComponents + r.pulledComponents > 0;
  const Freedom<N> freedom(r.mesh, r.features, r.featureNodes, blocks, hasSimplices);
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

template <int N>
[[gnu::noinline]] void buildResult(PipelineResult<N> &r, const PipelineOptions &options, StageClock &clock) {
  const CertificateInput<N> toCertify{r.domain.domain, r.features,        r.featureNodes, r.mesh,
                                      r.parts,         r.contributions,   r.dual,         r.surfaces,
                                      r.primal,        r.domain.deviation};
  Certificate ofDual;
  Aside dual(at(r.dual.cellCount), [&] { ofDual = certifyDual(toCertify); });
  clock.start("primal", 0.7);
  r.primal = buildPrimal(r.mesh, r.parts, r.contributions, r.dual, r.surfaces);
  clock.start("placement", 0.8);
  placeNodes(r.mesh, r.parts, r.dual, r.primal);
  std::vector<Vec<N>> placed = r.primal.positions;
  if (options.mode.relax) {
    clock.start("relaxation", 0.85);
    r.history.clear();
    relaxPrimal(r, options.history);
  }
  clock.start("certificate", 0.9);
  dual.finish();
  r.certificate = certify(toCertify, ofDual);
  if (!r.certificate.valid &&
      options.mode.relax) { // where bent sides nearly touch, the first places may serve better
    std::swap(r.primal.positions, placed);
    r.history.clear();
    const Certificate relaxed = std::move(r.certificate);
    r.certificate = certify(toCertify, ofDual);
    if (!r.certificate.valid) {
      std::swap(r.primal.positions, placed);
      r.certificate = relaxed;
    }
  }
  r.quality.clear();
  for (const Block<N> &block : r.primal.blocks)
    r.quality.push_back(scaledJacobian<N>(cornersOf<N>(block.nodes, r.primal.positions)));
}

/// The components of what the certificate's failures name, of those that can still change; all of them where
/// a failure names nothing that belongs to one.
template <int N>
[[gnu::noinline]] std::vector<bool> blamed(const PipelineResult<N> &r,
                                           const std::vector<PartSource> &source) {
  std::vector<bool> blame(source.size(), false);
  const std::vector<Index> component = componentOfParts(r.mesh, r.parts);
  std::vector<Index> ofFacet(r.domain.domain.facets.size(), kNone);
  for (const Side &side : r.parts.sides)
    if (const Index surface = FaceTag::surface(side.tag); at(surface) < ofFacet.size())
      ofFacet[at(surface)] = component[at(side.part)];
  bool clear = true;
  for (const CertificateFailure &failure : r.certificate.failures) {
    bool found = false;
    for (const EntityRef &e : failure.entities) {
      Index c = kNone;
      const Index k = static_cast<Index>(e.index);
      if (e.kind == "block") c = component[at(r.primal.blocks[at(k)].part)];
      if (e.kind == "node" || e.kind == "cell")
        c = component[at(r.dual.pieces[at(r.primal.nodePiece[at(k)])].part)];
      if (e.kind == "simplex") c = r.mesh.component[at(k)];
      if (e.kind == "facet") c = ofFacet[at(k)];
      if (c == kNone || source[at(c)] == PartSource::simplices) continue;
      blame[at(c)] = true;
      found = true;
    }
    clear &= found;
  }
  if (!clear) blame.assign(blame.size(), true);
  return blame;
}

/// Parts that the certificate's failures name, in components that are cut: those of blocks, and of all blocks
/// around nodes.
std::vector<Index> partsAtFault(const PipelineResult<3> &r, const std::vector<PartSource> &source) {
  std::vector<bool> isAtFault(r.primal.positions.size(), false); // nodes
  std::vector<Index> which;
  for (const EntityRef &e : r.certificate.culprits) {
    if (e.kind == "node") isAtFault[static_cast<std::size_t>(e.index)] = true;
    if (e.kind == "block") which.push_back(r.primal.blocks[static_cast<std::size_t>(e.index)].part);
  }
  for (const Block<3> &block : r.primal.blocks)
    if (std::any_of(block.nodes.begin(), block.nodes.end(), [&](Index n) { return isAtFault[at(n)]; }))
      which.push_back(block.part);
  sortItems(which);
  which.erase(std::unique(which.begin(), which.end()), which.end());
  const std::vector<Index> component = componentOfParts(r.mesh, r.parts);
  which.erase(std::remove_if(which.begin(), which.end(),
                             [&](Index part) { return source[at(component[at(part)])] != PartSource::cuts; }),
              which.end());
  return which;
}

/// Halves the parts whose blocks strayed from their bent sides, or cross others, or are inverted. Returns
/// whether that was possible, and is still cheap.
template <int N>
[[gnu::noinline]] bool cutFiner(PipelineResult<N> &r, const std::vector<PartSource> &source, double tolerance,
                                int &triesLeft) {
  if constexpr (N == 3) {
    if (r.bentSides == 0 || r.mesh.simplexCount() > kCheapToHalve) return false;
    const std::vector<Index> which = partsAtFault(r, source);
    const BentCutOptions options{
        {tolerance, toIndex(r.domain.domain.facets.size())}, axesOf(r.features, r.featureNodes), {}, {}};
    const Index cuts = halveParts(r.mesh, r.parts, which, options, triesLeft);
    r.bentCuts += cuts;
    r.cuts += cuts;
    return cuts > 0;
  }
  return false;
}

/// From the parts that were chosen to a mesh with its certificate. Parts that this blames are halved; where
/// that does not serve, their components go down the ladder of the fallback, if they may. False if they may
/// not, or there is no coarsest mesh for them.
template <int N>
[[gnu::noinline]] bool meshParts(PipelineResult<N> &r, PartChoice<N> choice, bool mayFallBack,
                                 const PipelineOptions &options, const CoarseMesh<N> &coarse,
                                 StageClock &clock) {
  Decomposition<N> &decomposition = choice.decomposition;
  const auto takeParts = [&] {
    r.parts = std::move(decomposition.parts);
    r.vertexCuts = decomposition.vertexCuts;
    r.bentCuts = decomposition.bentCuts;
    r.cuts = decomposition.reflexCuts + r.bentCuts + r.vertexCuts;
  };
  takeParts();
  r.fallbackReason = std::move(choice.whySimplices);
  std::vector<PartSource> source =
      std::move(choice.source); // changes where the certificate blames a component
  const auto count = [&](PartSource wanted) {
    return toIndex(static_cast<std::size_t>(std::count(source.begin(), source.end(), wanted)));
  };
  PartOptions partOptions;
  std::vector<bool> everyFace;
  int halvings = 0;
  int triesLeft = kHalvedAlone;
  for (int attempt = 0;; ++attempt) {
    r.fallbackComponents = count(PartSource::simplices);
    r.pulledComponents = count(PartSource::pulled);
    if (r.fallbackComponents + r.pulledComponents > 0) {
      clock.start("fallback", 0.4);
      const ReferenceMesh<N> *const mesh = r.fallbackComponents > 0 ? coarse() : nullptr;
      if (!mesh && r.fallbackComponents > 0) return false;
      const ReferenceMesh<N> *pulled = nullptr;
      const std::vector<bool> *pulledFace = nullptr;
      if constexpr (N == 3)
        if (decomposition.pulled) {
          pulled = &decomposition.pulled->mesh;
          pulledFace = &decomposition.pulled->everyFace;
        }
      MixedMesh<N> mixed = mixMeshes(r.mesh, pulled, pulledFace, mesh, source);
      r.mesh = std::move(mixed.mesh);
      everyFace = std::move(mixed.everyFace);
      partOptions.everyFace = &everyFace;
      if (r.fallbackComponents == r.mesh.componentCount) { // nothing of the cut mesh is left
        r.cuts = r.vertexCuts = r.bentCuts = 0;
        r.repairs = 0;
        r.fillSimplices = mesh->simplexCount();
      }
      clock.start("parts", 0.45);
      r.parts = buildParts(r.mesh, partOptions);
    }
    const bool built = buildDual(r, partOptions, everyFace, clock);
    if (built) buildResult(r, options, clock);
    if (built && r.certificate.valid) break;
    if (built && halvings < kHalvings &&
        cutFiner(r, source, options.tolerance * r.mesh.size + 2 * r.domain.deviation, triesLeft)) {
      ++halvings;
      everyFace.resize(r.mesh.simplices.size(), false);
      r.certificate = {};
      continue;
    }
    if constexpr (N == 3)
      if (decomposition.early && r.fallbackComponents + r.pulledComponents == 0) {
        takeEarly(r.mesh, decomposition);
        takeParts();
        halvings = 0;
        r.certificate = {};
        continue;
      }
    if (!mayFallBack) return false;
    if (r.fallbackComponents == r.mesh.componentCount) {
      if (!built) r.certificate.fail(Check::cells, "repairs of the reference mesh did not end");
      break;
    }
    if (r.fallbackReason.empty())
      r.fallbackReason =
          built ? "the cut parts did not pass the certificate: " + r.certificate.failures[0].message
                : "repairs of the reference mesh did not end";
    const std::vector<bool> more =
        built && attempt < kBlameRounds ? blamed(r, source) : std::vector<bool>(source.size(), true);
    for (std::size_t c = 0; c < source.size(); ++c) {
      if (!more[c]) continue;
      const bool canPull =
          decomposition.pulled && decomposition.pulled->blocks[c] < std::numeric_limits<double>::infinity();
      source[c] = source[c] == PartSource::cuts && canPull ? PartSource::pulled : PartSource::simplices;
    }
    r.certificate = {};
  }
  if (decomposition.pulled)
    for (std::size_t c = 0; c < source.size(); ++c)
      if (source[c] == PartSource::pulled) r.pulledParts += decomposition.pulled->simplified[c];
  return true;
}

template <int N> PartCandidate figuresOf(const PipelineResult<N> &r) {
  PartCandidate figures{toIndex(r.parts.parts.size()), toIndex(r.quality.size())};
  figures.minScaledJacobian = -std::numeric_limits<double>::infinity();
  if (r.certificate.valid) figures.minScaledJacobian = *std::min_element(r.quality.begin(), r.quality.end());
  return figures;
}

/// Carries what else the parts could be through to meshes of their own, each from what all have in `common`,
/// and leaves the one of the best shape in r: never a worse one than was there.
template <int N>
[[gnu::noinline]] void takeBestShape(PipelineResult<N> &r, const PipelineResult<N> &common,
                                     std::vector<PartProposal<N>> proposals, const PipelineOptions &options,
                                     const CoarseMesh<N> &coarse, StageClock &clock) {
  std::vector<PartCandidate> candidates{figuresOf(r)};
  std::vector<PipelineResult<N>> others;
  if (!proposals.empty()) clock.start("shape", 0.92);
  const Progress silent; // all their stages are one
  std::vector<StageTime> untold;
  StageClock inner(silent, untold);
  for (PartProposal<N> &proposal : proposals) {
    PipelineResult<N> other = common;
    other.mesh = std::move(proposal.mesh);
    if (!meshParts(other, std::move(proposal.choice), false, options, coarse, inner)) continue;
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

  clock.start("features", 0.3);
  r.features = buildParts(r.mesh, PartOptions{});
  keepVertices(r.mesh, r.features);
  r.featureNodes = r.mesh.nodes;
  r.featureKinds = classifyFeatures(r.features);

  clock.start("parts", 0.35);
  const CutOptions cutOptions{options.tolerance * r.mesh.size + 2 * r.domain.deviation,
                              toIndex(domain.facets.size())};
  const bool wantsShape = options.objective == Objective::shape;
  for (Index f = 0; f < toIndex(domain.facets.size()); ++f)
    r.bentSides += r.mesh.surfaces[at(f)].patch == f ? 1 : 0;
  const bool mayPropose = wantsShape || r.bentSides > 0;
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
  if (!meshParts(r, std::move(choice), true, options, needCoarse, clock)) return *coarseError;
  const bool falls = r.fallbackComponents + r.pulledComponents > 0;
  if (mayPropose && !wantsShape) {
    if (falls && !hasLastPolicy(r.cutTrials)) propose(Proposals::last);
    const bool isPoor = options.mode.relax && figuresOf(r).minScaledJacobian < kPoorShape;
    if (!falls && isPoor) propose(Proposals::all);
  }
  takeBestShape(r, common, std::move(proposals), options, needCoarse, clock);
  r.features.partOfSimplex = {}; // of the uncut mesh, which is no more
  r.features.nodeSides = {};
  r.features.sideFaces = {};
  const ModeOptions &mode = options.mode;
  if (r.certificate.valid && (mode.mode != Mode::layered || !mode.extract.empty() || !mode.insert.empty())) {
    clock.start("extraction", 0.95);
    const BlockMesh<N> layered = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
    const BlockInput<N> input{r.domain.domain, r.features, r.featureNodes,
                              r.mesh,          layered,    r.domain.deviation};
    auto made = makeFinalMesh(input, r.certificate, mode, r.domain.facetOfGiven);
    if (!made.ok()) return made.error();
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
