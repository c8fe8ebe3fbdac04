#include "partition/bent_search.h"

#include "partition/heuristics.h"

namespace dualblock {
namespace {

/// Whether a component that was simple is not any more.
bool isWorse(const std::vector<bool> &before, const std::vector<bool> &now) {
  for (std::size_t c = 0; c < before.size(); ++c)
    if (before[c] && !now[c]) return true;
  return false;
}

/// Best-first search for cuts that leave no joint wrong.
class JointSearch {
public:
  /// `parts`, `cost`: how many the mesh has, and what they cost.
  JointSearch(const ReferenceMesh<3> &mesh, std::size_t parts, const Cost &cost,
              const BentCutOptions &options)
      : options_(options), start_(cost) {
    open_.push_back({start_.sum(), parts, mesh});
    trialsLeft_ = std::min<Index>(kJointTrials, kJointWork / (mesh.simplexCount() + 1));
  }

  std::optional<ReferenceMesh<3>> run() {
    while (!open_.empty() && trialsLeft_ > 0) {
      const auto best = std::min_element(open_.begin(), open_.end(), [](const State &a, const State &b) {
        return std::pair(a.cost, a.parts) < std::pair(b.cost, b.parts);
      });
      const State state = std::move(*best);
      open_.erase(best);
      if (auto found = expand(state)) return found;
    }
    return std::nullopt;
  }

private:
  struct State {
    Index cost;
    std::size_t parts;
    ReferenceMesh<3> mesh;
  };

  /// Adds what the cuts at the first wrong joint lead to.
  std::optional<ReferenceMesh<3>> expand(const State &state) {
    const Parts<3> parts = buildParts(state.mesh, PartOptions{});
    std::optional<ReferenceMesh<3>> found;
    visitParts(state.mesh, parts, options_.axes, [&](const PartView &view) {
      const std::vector<Cut> cuts = throughJoints(view);
      for (const Cut &cut : cuts) {
        if (--trialsLeft_ < 0) break;
        ReferenceMesh<3> mesh = state.mesh;
        if (!makeCut(mesh, view, cut, options_)) continue;
        const Parts<3> now = buildParts(mesh, PartOptions{});
        const Cost cost = costOf(now);
        if (cost.joints == 0 && cost.others <= start_.others) {
          found = std::move(mesh);
          return true;
        }
        const std::array<Index, 3> key{cost.sum(), toIndex(now.parts.size()), mesh.simplexCount()};
        if (cost.sum() > state.cost + kJointDetour ||
            std::find(seen_.begin(), seen_.end(), key) != seen_.end())
          continue;
        seen_.push_back(key);
        open_.push_back({cost.sum(), now.parts.size(), std::move(mesh)});
      }
      return !cuts.empty();
    });
    return found;
  }

  const BentCutOptions &options_;
  Cost start_;
  Index trialsLeft_;
  std::vector<State> open_;
  std::vector<std::array<Index, 3>> seen_; // what scores alike in all is the same
};

} // namespace

std::vector<bool> simpleComponents(const ReferenceMesh<3> &mesh, const Parts<3> &parts) {
  std::vector<bool> simple(at(mesh.componentCount), true);
  const std::vector<Index> component = componentOfParts(mesh, parts);
  for (std::size_t p = 0; p < parts.parts.size(); ++p)
    if (!parts.parts[p].isSimple()) simple[at(component[p])] = false;
  return simple;
}

BentSearch::BentSearch(ReferenceMesh<3> &mesh, Parts<3> &parts, BentCutOptions options, bool weighsCuts,
                       CutReflex cutReflex)
    : isSimple(simpleComponents(mesh, parts)), mesh_(mesh), parts_(parts), options_(std::move(options)),
      weighsCuts_(weighsCuts), cutReflex_(std::move(cutReflex)), partsWithoutReflex_(parts.parts.size()),
      cost_(costOf(parts)) {}

CutReason BentSearch::step(const std::vector<bool> &gaveUp) {
  const std::vector<Index> component = componentOfParts(mesh_, parts_);
  meshBefore = mesh_;
  const auto cut = [&](std::span<const Source> sources) {
    bool isCut = false;
    visitParts(mesh_, parts_, options_.axes, [&](PartView &view) {
      const std::size_t c = at(component[at(view.part)]);
      if (gaveUp[c]) return false;
      view.cutsHollows = !options_.policies.empty() && options_.policies[c].isLast;
      isCut = cutBy(sources, view);
      return isCut;
    });
    return isCut;
  };
  if (cut(kSmoothing) || cut(kSimplifying) || cutReflexAgain() || cutJoints() || cut(kFollowing))
    return CutReason::needed;
  return cut(kShaping) ? CutReason::shape : CutReason::none;
}

bool BentSearch::cutBy(std::span<const Source> sources, PartView &view) {
  return std::any_of(sources.begin(), sources.end(), [&](Source source) { return trySource(source, view); });
}

/// The first of a source's cuts; where they are weighed, that spoils no joint, or that which leaves least
/// wrong.
bool BentSearch::trySource(Source source, const PartView &view) {
  std::optional<ReferenceMesh<3>> best;
  Parts<3> bestParts;
  Cost least;
  for (const Cut &cut : source(view)) {
    if (!makeCut(mesh_, view, cut, options_, refused_)) continue;
    Parts<3> now = buildParts(mesh_, PartOptions{});
    if (isWorse(isSimple, simpleComponents(mesh_, now))) {
      refused_.push_back(mesh_.surfaces.back().plane);
      mesh_ = meshBefore;
      continue;
    }
    const Cost cost = costOf(now);
    if (!weighsCuts_ || (cost.joints <= cost_.joints && !best)) {
      hasSpoilt = hasSpoilt || cost.joints > cost_.joints;
      return take(std::move(now), cost);
    }
    if (!best || cost.sum() < least.sum()) {
      least = cost;
      best = std::move(mesh_);
      bestParts = std::move(now);
    }
    mesh_ = meshBefore;
  }
  if (!best) return false;
  mesh_ = std::move(*best);
  return take(std::move(bestParts), least);
}

bool BentSearch::take(Parts<3> parts, const Cost &cost) {
  partsBefore = std::exchange(parts_, std::move(parts));
  isSimple = simpleComponents(mesh_, parts_);
  cost_ = cost;
  return true;
}

bool BentSearch::cutReflexAgain() {
  if (parts_.parts.size() == partsWithoutReflex_) return false;
  partsWithoutReflex_ = parts_.parts.size();
  const Index cuts = cutReflex_(mesh_, parts_);
  if (cuts == 0) return false;
  Parts<3> now = buildParts(mesh_, PartOptions{});
  const Cost cost = costOf(now);
  if (isWorse(isSimple, simpleComponents(mesh_, now)) || cost.sum() > cost_.sum()) {
    mesh_ = meshBefore;
    return false;
  }
  reflexCuts += cuts;
  return take(std::move(now), cost);
}

bool BentSearch::cutJoints() {
  if (triedJoints_ || cost_.joints == 0) return false;
  triedJoints_ = true;
  auto found = JointSearch(mesh_, parts_.parts.size(), cost_, options_).run();
  if (!found) return false;
  mesh_ = std::move(*found);
  Parts<3> now = buildParts(mesh_, PartOptions{});
  const Cost cost = costOf(now);
  return take(std::move(now), cost);
}

} // namespace dualblock
