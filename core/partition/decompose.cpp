#include "partition/decompose.h"

#include <numeric>

#include "base/sort.h"
#include "partition/bent_search.h"
#include "partition/heuristics.h"
#include "partition/sources/corners.h"
#include "partition/sources/reflex.h"
#include "parts/place.h"
#include "reference/patches.h"

namespace dualblock {
namespace {

/// What each component may still spend. Where planes cross so often that they multiply the mesh, or the parts
/// would give more blocks than the fallback, that is cheaper and no worse.
template <int N> class Budget {
public:
  /// `limit`: of the mesh's simplices; 0: none.
  Budget(const ReferenceMesh<N> &mesh, Index limit) : gaveUp(at(mesh.componentCount), false), limit_(limit) {
    for (const Index n : sizes(mesh))
      limits_.push_back(kTimesSimplices * n + (N == 2 ? kMoreTriangles : kMoreSimplices));
  }

  /// Of all components together.
  Index most() const { return std::accumulate(limits_.begin(), limits_.end(), Index{0}); }

  void update(const ReferenceMesh<N> &mesh) { spend(mesh, 1, std::vector<bool>(gaveUp.size(), false)); }

  /// Components that may not be cut any more, as they have spent more than a `share` of the whole budget;
  /// those that `suffice` as they are do not give up.
  std::vector<bool> spend(const ReferenceMesh<N> &mesh, double share, const std::vector<bool> &suffice) {
    const std::vector<Index> now = sizes(mesh);
    const bool isTooLarge = limit_ > 0 && mesh.simplexCount() > limit_;
    std::vector<bool> isDone = gaveUp;
    for (std::size_t c = 0; c < now.size(); ++c) {
      if (!isTooLarge && now[c] <= share * limits_[c]) continue;
      isDone[c] = true;
      if (!suffice[c]) gaveUp[c] = true;
    }
    return isDone;
  }

  void limitBlocks(const ReferenceMesh<N> &mesh, const Parts<N> &parts,
                   const std::function<double(Index)> &limit) {
    std::vector<double> blocks(gaveUp.size(), 0);
    std::vector<bool> needed(gaveUp.size(), false);
    const std::vector<Index> component = componentOfParts(mesh, parts);
    for (const Corner &corner : parts.corners) {
      const std::size_t c = at(component[at(corner.part)]);
      blocks[c] += static_cast<double>(corner.sides.size()) - (N - 1);
      if (corner.sides.size() > N) needed[c] = true;
    }
    for (std::size_t c = 0; c < blocks.size(); ++c)
      if (needed[c] && !gaveUp[c] && blocks[c] > limit(toIndex(c))) gaveUp[c] = true;
  }

  std::vector<bool> gaveUp; // per component

private:
  static std::vector<Index> sizes(const ReferenceMesh<N> &mesh) {
    std::vector<Index> count(at(mesh.componentCount), 0);
    for (const Index c : mesh.component) ++count[at(c)];
    return count;
  }
  std::vector<Index> limits_; // per component
  Index limit_;
};

/// The order of curves by their extreme points, which is the same on every reference mesh: where a cut may
/// serve several curves, the first one decides.
template <int N> void sortByPlace(const ReferenceMesh<N> &mesh, std::vector<const Curve<N> *> &curves) {
  std::vector<std::pair<Extent<N>, const Curve<N> *>> order;
  for (const Curve<N> *curve : curves) order.push_back({extentOf(mesh, curve->ridges), curve});
  sortItems(order, [](const auto &a, const auto &b) { return a.first < b.first; });
  for (std::size_t k = 0; k < order.size(); ++k) curves[k] = order[k].second;
}

/// One round of rule 1.
template <int N>
void cutReflexCurves(ReferenceMesh<N> &mesh, const Parts<N> &parts, const DecomposeOptions &options,
                     Budget<N> &budget, Index &cuts) {
  const std::vector<Index> component = componentOfParts(mesh, parts);
  const auto policyOf = [&](const Curve<N> &curve) {
    return options.policies.empty() ? CutPolicy{} : options.policies[at(component[at(curve.part)])];
  };
  std::vector<const Curve<N> *> wanting;
  for (const Curve<N> &curve : parts.curves)
    if (policyOf(curve).wantsCut(curve.angle)) wanting.push_back(&curve);
  sortByPlace(mesh, wanting);
  Index lastCount = mesh.simplexCount();
  for (const Curve<N> *curve : wanting) {
    if (budget.gaveUp[at(component[at(curve->part)])]) continue;
    if (mesh.simplexCount() > kRecount * lastCount) {
      lastCount = mesh.simplexCount();
      budget.update(mesh);
    }
    cuts += cutReflexCurve<N>(mesh, *curve, wanting, parts.curves, policyOf(*curve), options);
  }
  if (mesh.simplexCount() > options.mostSimplices) budget.update(mesh);
}

/// Rule 3. Returns whether a cut has spoilt a joint.
bool cutBentParts(ReferenceMesh<3> &mesh, const Parts<3> &uncut, const DecomposeOptions &options,
                  bool weighsCuts, Budget<3> &budget, Decomposition<3> &result) {
  const auto cutReflex = [&](ReferenceMesh<3> &cut, const Parts<3> &parts) {
    Index cuts = 0;
    cutReflexCurves(cut, parts, options, budget, cuts);
    return cuts;
  };
  BentSearch search(mesh, result.parts, {options, axesOf(uncut, mesh.nodes), options.policies}, weighsCuts,
                    cutReflex);
  std::vector<bool> isDone = budget.gaveUp;
  for (int round = 0; round < kBentRounds; ++round) {
    const bool areSimple =
        std::find(search.isSimple.begin(), search.isSimple.end(), false) == search.isSimple.end();
    const CutReason reason = search.step(isDone);
    if (reason == CutReason::none) break;
    if (areSimple && reason == CutReason::shape && !result.early)
      result.early = std::make_shared<EarlyParts>(
          EarlyParts{std::move(search.meshBefore), std::move(search.partsBefore), result.bentCuts});
    ++result.bentCuts;
    isDone = budget.spend(mesh, kBentShare, search.isSimple);
  }
  if (result.early &&
      result.parts.parts.size() >
          kMoreParts * std::max(result.early->parts.parts.size(), at(bentSideCount(mesh))) + kFewMoreParts)
    takeEarly(mesh, result);
  result.reflexCuts += search.reflexCuts;
  return search.hasSpoilt;
}

/// The same by whichever way leaves less wrong, or else fewer blocks: each first cut that there is, or, where
/// one of these spoils how sides join, cuts that are weighed.
void cutBentPartsBest(ReferenceMesh<3> &mesh, const Parts<3> &uncut, const DecomposeOptions &options,
                      Budget<3> &budget, Decomposition<3> &result) {
  if (bentSideCount(mesh) == 0) return;
  ReferenceMesh<3> weighedMesh = mesh;
  Budget<3> weighedBudget = budget;
  Decomposition<3> weighed = result;
  if (!cutBentParts(mesh, uncut, options, false, budget, result)) return;
  cutBentParts(weighedMesh, uncut, options, true, weighedBudget, weighed);
  const auto score = [](const Decomposition<3> &d) {
    return std::pair(costOf(d.parts).sum(), d.parts.corners.size());
  };
  if (score(weighed) >= score(result)) return;
  mesh = std::move(weighedMesh);
  budget = std::move(weighedBudget);
  result = std::move(weighed);
}

} // namespace

void takeEarly(ReferenceMesh<3> &mesh, Decomposition<3> &decomposition) {
  mesh = std::move(decomposition.early->mesh);
  decomposition.parts = std::move(decomposition.early->parts);
  decomposition.bentCuts = decomposition.early->bentCuts;
  decomposition.vertexCuts = 0;
  decomposition.early.reset();
}

template <int N>
Decomposition<N> decompose(ReferenceMesh<N> &mesh, const Parts<N> &uncut, DecomposeOptions options) {
  const PartOptions partOptions;
  Decomposition<N> result;
  Budget<N> budget(mesh, options.simplexLimit);
  options.mostSimplices = budget.most();
  for (int round = 0; round < kReflexRounds; ++round) {
    const Index before = result.reflexCuts;
    cutReflexCurves(mesh, round == 0 ? uncut : result.parts, options, budget, result.reflexCuts);
    if (result.reflexCuts == before) {
      if (round == 0) result.parts = uncut;
      break;
    }
    result.parts = buildParts(mesh, partOptions);
  }
  if constexpr (N == 3) {
    cutBentPartsBest(mesh, uncut, options, budget, result);
    const bool needed = std::any_of(result.parts.corners.begin(), result.parts.corners.end(),
                                    [](const Corner &c) { return c.sides.size() > 3; });
    if (needed) result.pulled = pullParts(mesh, result.parts, options.apex);
    const auto limit = [&](Index component) {
      return std::min(options.blockLimit(component), result.pulled->blocks[at(component)]);
    };
    for (int round = 0; needed && round < kVertexRounds; ++round) {
      budget.limitBlocks(mesh, result.parts, limit);
      const Index cuts = cutCorners(mesh, result.parts, options, budget.gaveUp);
      if (cuts == 0) break;
      result.vertexCuts += cuts;
      result.parts = buildParts(mesh, partOptions);
      budget.update(mesh);
    }
  }
  result.gaveUp = std::move(budget.gaveUp);
  return result;
}

template Decomposition<2> decompose(ReferenceMesh<2> &, const Parts<2> &, DecomposeOptions);
template Decomposition<3> decompose(ReferenceMesh<3> &, const Parts<3> &, DecomposeOptions);

} // namespace dualblock
