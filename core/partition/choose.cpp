#include "partition/choose.h"

#include <cmath>
#include <limits>
#include <utility>

#include "partition/heuristics.h"

namespace dualblock {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The smallest sine of an angle between two faces.
template <int N> double smallestSine(const ReferenceMesh<N> &mesh, Index s) {
  std::array<Vec<N>, N + 1> normals;
  for (int i = 0; i < N + 1; ++i) normals[at(i)] = mesh.faceNormal(s, i);
  double largest = 0;
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t k = i + 1; k < normals.size(); ++k)
      largest = std::max(largest, std::abs(glm::dot(normals[i], normals[k])));
  return std::sqrt(std::max(0.0, 1 - largest * largest));
}

/// Fewer blocks, but not so much worse; or as many and better.
bool isBetter(const Score &a, const Score &b) {
  if (a.blocks < b.blocks) return a.worstSine >= std::min(kGoodSine, kWorseSine * b.worstSine);
  return a.blocks == b.blocks && a.blocks < kNever && a.worstSine > b.worstSine + kSameSine;
}

/// A policy's result for the whole domain.
template <int N> struct Trial {
  CutPolicy policy;
  ReferenceMesh<N> mesh;
  Decomposition<N> decomposition;
  std::array<std::vector<Score>, 3> scores; // by PartSource, per component
  bool hasSimplices = false;                // the third were asked for
  std::vector<PartSource> source;
  std::vector<Score> best;

  void choose() {
    source.assign(scores[0].size(), PartSource::cuts);
    best = scores[0];
    for (std::size_t c = 0; c < source.size(); ++c) // cuts before others, where they give no more blocks
      for (const PartSource other : {PartSource::pulled, PartSource::simplices})
        if (const Score &score = scores[static_cast<std::size_t>(other)][c]; score.blocks < best[c].blocks) {
          best[c] = score;
          source[c] = other;
        }
  }
};

template <int N> class Chooser {
public:
  Chooser(const Parts<N> &uncut, const CutOptions &options, const CoarseMesh<N> &coarse,
          std::size_t components)
      : uncut_(uncut), components_(components), coarse_(coarse) {
    static_cast<CutOptions &>(options_) = options;
    options_.blockLimit = [this](Index c) { return simplices()[at(c)].blocks; };
  }

  /// Cuts the mesh by a policy per component.
  Trial<N> run(ReferenceMesh<N> mesh, std::vector<CutPolicy> policies, Index simplexLimit,
               Apex apex = Apex::corner) {
    Trial<N> trial;
    trial.policy = policies.empty() ? CutPolicy{} : policies[0];
    options_.policies = std::move(policies);
    options_.simplexLimit = simplexLimit;
    options_.apex = apex;
    trial.mesh = std::move(mesh);
    trial.decomposition = decompose(trial.mesh, uncut_, options_);
    trial.scores = {ofCuts(trial), ofPulled(trial), std::vector<Score>(components_, {kNever, 0})};
    trial.hasSimplices = !simplices_.empty(); // where vertices had to be cut
    for (const Score &score : trial.scores[0]) trial.hasSimplices |= score.blocks == kNever;
    if (trial.hasSimplices) trial.scores[2] = simplices();
    trial.choose();
    return trial;
  }

  /// Makes them a choice even where cuts serve.
  void countSimplices() { simplices(); }

private:
  std::vector<Score> ofCuts(const Trial<N> &trial) const {
    const Parts<N> &parts = trial.decomposition.parts;
    const std::vector<Index> component = componentOfParts(trial.mesh, parts);
    std::vector<Score> scores(components_);
    for (const Corner &corner : parts.corners) scores[at(component[at(corner.part)])].blocks += 1;
    for (const Curve<N> &curve : parts.curves) {
      double &worst = scores[at(component[at(curve.part)])].worstSine;
      worst = std::min(worst, std::sin(curve.angle));
    }
    for (std::size_t p = 0; p < parts.parts.size(); ++p)
      if (!parts.parts[p].isSimple()) scores[at(component[p])].blocks = kNever;
    for (std::size_t c = 0; c < components_; ++c)
      if (trial.decomposition.gaveUp[c]) scores[c].blocks = kNever;
    return scores;
  }

  std::vector<Score> ofPulled(const Trial<N> &trial) const {
    std::vector<Score> scores(components_, {kNever, 1});
    if constexpr (N == 3)
      if (const auto &pulled = trial.decomposition.pulled) {
        for (std::size_t c = 0; c < components_; ++c) scores[c].blocks = pulled->blocks[c];
        for (Index s = 0; s < pulled->mesh.simplexCount(); ++s) {
          double &worst = scores[at(pulled->mesh.component[at(s)])].worstSine;
          if (pulled->everyFace[at(s)]) worst = std::min(worst, smallestSine(pulled->mesh, s));
        }
      }
    return scores;
  }

  /// Of the coarsest reference mesh, each simplex a part.
  const std::vector<Score> &simplices() {
    if (!simplices_.empty()) return simplices_;
    const ReferenceMesh<N> *const mesh = coarse_();
    simplices_.assign(components_, {mesh ? 0 : kNever, 1});
    if (!mesh) return simplices_;
    for (Index s = 0; s < mesh->simplexCount(); ++s) {
      Score &score = simplices_[at(mesh->component[at(s)])];
      score.blocks += N + 1;
      score.worstSine = std::min(score.worstSine, smallestSine(*mesh, s));
    }
    return simplices_;
  }

  const Parts<N> &uncut_;
  std::size_t components_;
  DecomposeOptions options_;
  const CoarseMesh<N> &coarse_;
  std::vector<Score> simplices_;
};

/// The policies that may make a difference.
template <int N> std::vector<CutPolicy> policiesFor(const Parts<N> &uncut) {
  const CutPolicy standard;
  bool isFlat = false;
  Index wanting = 0;
  for (const Curve<N> &curve : uncut.curves) {
    if (!standard.wantsCut(curve.angle)) continue;
    ++wanting;
    isFlat |= curve.angle <= kNearlyFlatAngle;
  }
  std::vector<CutPolicy> policies{standard};
  if (wanting > 1) policies.push_back({standard.largestAngle, kSnap});
  if (isFlat) policies.push_back({kNearlyFlatAngle, 0});
  if (isFlat && wanting > 1) policies.push_back({kNearlyFlatAngle, kSnap});
  return policies;
}

/// Where no other policy serves well: a rim's two sheets may pass other rims by little, or meet in the
/// middle, and what a side is hollow around is not seen from the middle of its part.
template <int N> std::optional<CutPolicy> lastPolicyFor(const ReferenceMesh<N> &mesh) {
  CutPolicy policy;
  policy.isLast = true;
  policy.largestAngle = kNearlyFlatAngle;
  const bool isBent =
      std::any_of(mesh.surfaces.begin(), mesh.surfaces.end(), [](const Surface<N> &s) { return s.bent; });
  return isBent ? std::optional(policy) : std::nullopt;
}

/// Says why the first component that does without cuts does so, and what there was to choose from.
template <int N> void explain(const Trial<N> &trial, PartChoice<N> &choice) {
  for (std::size_t k = 0; k < 3; ++k) {
    const bool asked = k == 0 || (k == 1 ? trial.decomposition.pulled.has_value() : trial.hasSimplices);
    for (const Score &score : trial.scores[k])
      if (asked) choice.alternatives[k] = std::max(choice.alternatives[k], 0.0) + score.blocks;
  }
  const Parts<N> &parts = trial.decomposition.parts;
  for (std::size_t c = 0; c < trial.source.size() && choice.whySimplices.empty(); ++c) {
    if (trial.source[c] == PartSource::cuts) continue;
    choice.whySimplices = "the cut parts would give more blocks than simplices";
    if (trial.scores[0][c].blocks < kNever) continue;
    choice.whySimplices =
        "cuts would give more blocks, or many times more simplices, than the reference mesh has";
    if (trial.decomposition.gaveUp[c]) continue;
    for (const PartInfo &part : parts.parts)
      if (!part.isSimple())
        choice.whySimplices = "a part could not be made simple: " + describe(part.defect, N);
  }
}

/// The choice by trials on the mesh itself, and the policy that each component took.
template <int N>
PartChoice<N> chooseOn(ReferenceMesh<N> &mesh, const Parts<N> &uncut, const CutOptions &options,
                       const CoarseMesh<N> &coarse, std::vector<CutPolicy> &policyOf) {
  const std::size_t components = at(mesh.componentCount);
  Chooser<N> chooser(uncut, options, coarse, components);
  const std::vector<CutPolicy> policies = policiesFor(uncut);
  const std::optional<CutPolicy> last = lastPolicyFor(mesh);
  const bool isCheap = policies.size() > 1 && mesh.simplexCount() <= kCheap;
  const ReferenceMesh<N> original = isCheap || last ? mesh : ReferenceMesh<N>{};
  std::vector<Trial<N>> trials;
  trials.push_back(chooser.run(std::move(mesh), {}, 0));
  const Index standardSize = trials[0].mesh.simplexCount();
  const bool isLost = std::any_of(trials[0].scores[0].begin(), trials[0].scores[0].end(),
                                  [](const Score &score) { return score.blocks == kNever; });
  if (isCheap && (standardSize <= kCheap || isLost))
    for (std::size_t p = 1; p < policies.size(); ++p)
      trials.push_back(
          chooser.run(original, std::vector<CutPolicy>(components, policies[p]), 2 * standardSize));
  const auto isServed = [&](std::size_t c) {
    return std::any_of(trials.begin(), trials.end(), [c](const Trial<N> &t) {
      return t.source[c] == PartSource::cuts && t.best[c].worstSine >= kGoodSine;
    });
  };
  for (std::size_t c = 0; last && c < components; ++c) {
    if (isServed(c)) continue;
    trials.push_back(chooser.run(original, std::vector<CutPolicy>(components, *last), 0));
    break;
  }

  std::vector<std::size_t> chosen(components, 0); // the trial of each component
  PartChoice<N> choice;
  for (const Trial<N> &trial : trials) {
    CutTrial &result = choice.trials.emplace_back();
    result.policy = trial.policy;
    for (const Score &score : trial.best) result.add(score);
  }
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t t = 1; t < trials.size(); ++t)
      if (isBetter(trials[t].best[c], trials[chosen[c]].best[c])) chosen[c] = t;
  for (const std::size_t t : chosen) ++choice.trials[t].components;
  policyOf.clear();
  for (const std::size_t t : chosen) policyOf.push_back(trials[t].policy);
  std::size_t taken = chosen[0];
  if (std::find_if(chosen.begin(), chosen.end(), [&](std::size_t t) { return t != taken; }) != chosen.end()) {
    taken = trials.size();
    trials.push_back(chooser.run(original, policyOf, 0));
  }
  explain(trials[taken], choice);
  mesh = std::move(trials[taken].mesh);
  choice.source = std::move(trials[taken].source);
  for (const Score &score : trials[taken].best) choice.score.add(score);
  choice.decomposition = std::move(trials[taken].decomposition);
  return choice;
}

} // namespace

template <int N>
PartChoice<N> chooseParts(ReferenceMesh<N> &mesh, const Parts<N> &uncut, const CutOptions &options,
                          const CoarseMesh<N> &coarse, bool isCoarse) {
  std::vector<CutPolicy> policyOf;
  const bool isBent =
      std::any_of(mesh.surfaces.begin(), mesh.surfaces.end(), [](const Surface<N> &s) { return s.bent; });
  const ReferenceMesh<N> *const judge = isCoarse || isBent ? nullptr : coarse();
  if (!judge) return chooseOn(mesh, uncut, options, coarse, policyOf);
  ReferenceMesh<N> judged = *judge;
  const Parts<N> uncutJudged = buildParts(judged, PartOptions{});
  PartChoice<N> choice = chooseOn(judged, uncutJudged, options, coarse, policyOf);
  Chooser<N> chooser(uncut, options, coarse, policyOf.size());
  Trial<N> trial = chooser.run(std::move(mesh), std::move(policyOf), 0);
  bool isPossible = true;
  for (std::size_t c = 0; c < trial.source.size(); ++c) {
    const PartSource wanted = choice.source[c];
    const bool isHere =
        wanted == PartSource::simplices || trial.scores[static_cast<std::size_t>(wanted)][c].blocks < kNever;
    if (isHere) trial.source[c] = wanted;
    isPossible = isPossible && isHere;
  }
  if (!isPossible) {
    choice.whySimplices.clear();
    choice.alternatives = {-1, -1, -1};
    explain(trial, choice);
  }
  mesh = std::move(trial.mesh);
  choice.source = std::move(trial.source);
  choice.decomposition = std::move(trial.decomposition);
  return choice;
}

template <int N>
std::vector<PartProposal<N>> proposeParts(const ReferenceMesh<N> &mesh, const Parts<N> &uncut,
                                          const CutOptions &options, const CoarseMesh<N> &coarse,
                                          const Score &chosen, Proposals which) {
  std::vector<PartProposal<N>> proposals;
  const bool isLast = which == Proposals::last;
  if (!isLast && mesh.simplexCount() > kCheap) return proposals;
  const std::size_t components = at(mesh.componentCount);
  Chooser<N> chooser(uncut, options, coarse, components);
  if (N == 2) chooser.countSimplices(); // few and cheap
  const auto propose = [&](const Trial<N> &trial, PartSource wanted) {
    std::vector<PartSource> source = trial.source;
    Score score;
    for (std::size_t c = 0; c < components; ++c) {
      const auto of = [&](PartSource s) { return trial.scores[static_cast<std::size_t>(s)][c]; };
      if (of(wanted).blocks < kNever) source[c] = wanted;
      score.add(of(source[c]));
    }
    if (isLast && std::count(source.begin(), source.end(), PartSource::cuts) == 0) return;
    const bool isKnown = // what scores alike to the last bit is the same
        score == chosen || std::any_of(proposals.begin(), proposals.end(),
                                       [&](const auto &p) { return score == p.choice.score; });
    if (isKnown || score.blocks > kCheap) return;
    PartProposal<N> &proposal = proposals.emplace_back();
    proposal.mesh = trial.mesh;
    proposal.choice.decomposition = trial.decomposition;
    proposal.choice.score = score;
    const auto count = [&](PartSource s) {
      return static_cast<std::size_t>(std::count(source.begin(), source.end(), s));
    };
    if (count(PartSource::cuts) < components) proposal.choice.whySimplices = "simplices give a better shape";
    if (count(PartSource::pulled) == components) { // of the mesh before rule 2
      proposal.choice.decomposition.vertexCuts = 0;
    }
    proposal.choice.source = std::move(source);
  };
  std::vector<CutPolicy> policies;
  if (!isLast) policies = policiesFor(uncut);
  if (const auto last = lastPolicyFor(mesh)) policies.push_back(*last);
  for (const CutPolicy &policy : policies)
    for (const Apex apex : kApexes) {
      const Trial<N> trial =
          chooser.run(mesh, std::vector<CutPolicy>(components, policy), isLast ? 0 : kCheap, apex);
      propose(trial, PartSource::cuts);
      if (isLast) break; // the others have been tried
      propose(trial, PartSource::pulled);
      propose(trial, PartSource::simplices);
      if (!trial.decomposition.pulled) break; // there is nothing that could have a centre
    }
  return proposals;
}

template PartChoice<2> chooseParts(ReferenceMesh<2> &, const Parts<2> &, const CutOptions &,
                                   const CoarseMesh<2> &, bool);
template PartChoice<3> chooseParts(ReferenceMesh<3> &, const Parts<3> &, const CutOptions &,
                                   const CoarseMesh<3> &, bool);
template std::vector<PartProposal<2>> proposeParts(const ReferenceMesh<2> &, const Parts<2> &,
                                                   const CutOptions &, const CoarseMesh<2> &, const Score &,
                                                   Proposals);
template std::vector<PartProposal<3>> proposeParts(const ReferenceMesh<3> &, const Parts<3> &,
                                                   const CutOptions &, const CoarseMesh<3> &, const Score &,
                                                   Proposals);

} // namespace dualblock
