#include "mesh_parts.h"

#include <limits>
#include <optional>
#include <utility>

#include "base/deadline.h"
#include "blame.h"
#include "doubled_mesh.h"
#include "partition/heuristics.h"
#include "remesh/tet_mesh.h"

namespace dualblock {
namespace {

/// Whether a valid mesh of parts that were cut on may take the place of the one before: not at the price of a
/// poor shape.
template <int N> bool serves(const PipelineResult<N> &r, const std::optional<PipelineResult<N>> &before) {
  return !before || worstShape(r) >= std::min(kPoorShape, worstShape(*before));
}

/// The shape of the simplex that is furthest from a regular one, of the components that `isWanted` holds for.
template <int N, typename IsWanted>
double worstSimplex(const ReferenceMesh<N> &mesh, const IsWanted &isWanted) {
  double worst = 1;
  if constexpr (N == 3)
    for (Index s = 0; s < mesh.simplexCount(); ++s) {
      const auto &[a, b, c, d] = mesh.simplices[at(s)];
      if (isWanted(mesh.component[at(s)]))
        worst = std::min(worst,
                         shapeOf(mesh.nodes[at(a)], mesh.nodes[at(b)], mesh.nodes[at(c)], mesh.nodes[at(d)]));
    }
  return worst;
}

/// The way of one choice of parts to its mesh.
template <int N> class PartsMesher {
public:
  PartsMesher(PipelineResult<N> &result, PartChoice<N> choice, const PipelineOptions &options,
              const FillMeshes<N> &fills, StageClock &clock)
      : r(result), decomposition_(std::move(choice.decomposition)), source_(std::move(choice.source)),
        options_(options), fills_(fills), clock_(clock) {
    takeParts();
    r.fallbackReason = std::move(choice.whySimplices);
  }

  /// See meshParts.
  bool run(bool mayFallBack, Index most = 0) {
    mayFallBack_ = mayFallBack;
    most_ = most;
    try {
      if (!findMesh()) return false;
    } catch (const OutOfTime &) {
      if (!coarser_) throw;
      takeCoarser();
      r.isCutShort = true;
    }
    if (decomposition_.pulled)
      for (std::size_t c = 0; c < source_.size(); ++c)
        if (source_[c] == PartSource::pulled) r.pulledParts += decomposition_.pulled->simplified[c];
    return true;
  }

private:
  /// Attempts until a mesh serves, or nothing is left to try. False if there is none and may be none.
  bool findMesh() {
    for (int attempt = 0;; ++attempt, r.certificate = {}) {
      r.finalMesh.reset();
      if (!mixSources()) return false;
      const bool built = buildDual(r, partOptions_, everyFace_, clock_);
      const bool isGood = built && buildResult(r, options_, clock_);
      const bool holds = built && r.certificate.valid && serves(r, coarser_);
      if (holds && isGood && !wantsFiner()) break;
      if (holds && !coarser_) coarser_ = r;
      if (built && !holds && worstShape(r) > 0 && r.fallbackComponents == 0) keepStraying();
      if (built && halve()) continue;
      if (holds && wantsFiner()) {
        ++goodAttempts_;
        continue;
      }
      if (coarser_) {
        takeCoarser();
        break;
      }
      if (halveFewer() || takeEarlyCuts()) continue;
      if (takeDoubled()) break;
      if (r.remeshedComponents > 0) { // finer ones may be nearer to bent sides; the coarsest always work
        r.isRemeshRefused = ++goodAttempts_ == kGoodAttempts;
        if (!r.isRemeshRefused || mayFallBack_) continue;
      }
      if (!mayFallBack_) return false;
      if (r.fallbackComponents == r.mesh.componentCount) {
        if (!built) r.certificate.fail(Check::cells, "repairs of the reference mesh did not end");
        break;
      }
      fallDown(built, attempt);
    }
    return true;
  }

  void takeCoarser() {
    std::swap(r.timings, coarser_->timings);
    r = std::move(*coarser_);
  }

  Index count(PartSource wanted) const {
    return toIndex(static_cast<std::size_t>(std::count(source_.begin(), source_.end(), wanted)));
  }

  void takeParts() {
    r.parts = std::move(decomposition_.parts);
    r.vertexCuts = decomposition_.vertexCuts;
    r.bentCuts = decomposition_.bentCuts;
    r.cuts = decomposition_.reflexCuts + r.bentCuts + r.vertexCuts;
  }

  /// Components that do not take what was cut get their parts elsewhere. False if there is no coarsest mesh.
  bool mixSources() {
    r.fallbackComponents = count(PartSource::simplices);
    r.pulledComponents = count(PartSource::pulled);
    if (r.fallbackComponents + r.pulledComponents == 0) return true;
    clock_.start("fallback", 0.4);
    const ReferenceMesh<N> *const mesh = r.fallbackComponents > 0 ? simplices() : nullptr;
    if (!mesh && r.fallbackComponents > 0) return false;
    const ReferenceMesh<N> *pulled = nullptr;
    const std::vector<bool> *pulledFace = nullptr;
    if constexpr (N == 3)
      if (decomposition_.pulled) {
        pulled = &decomposition_.pulled->mesh;
        pulledFace = &decomposition_.pulled->everyFace;
      }
    MixedMesh<N> mixed = mixMeshes(r.mesh, pulled, pulledFace, mesh, source_);
    r.mesh = std::move(mixed.mesh);
    if (r.remeshedComponents > 0) {
      auto given = std::make_shared<ReferenceMesh<N>>(*fills_.coarsest());
      given->surfaces = r.mesh.surfaces;
      r.given = std::move(given);
    }
    everyFace_ = std::move(mixed.everyFace);
    partOptions_.everyFace = &everyFace_;
    if (r.fallbackComponents == r.mesh.componentCount) { // nothing of the cut mesh is left
      r.cuts = r.vertexCuts = r.bentCuts = 0;
      r.repairs = 0;
      r.fillSimplices = mesh->simplexCount();
    }
    clock_.start("parts", 0.45);
    r.parts = buildParts(r.mesh, partOptions_);
    return true;
  }

  /// Good ones where the coarsest would make poor blocks; those if they will not do.
  const ReferenceMesh<N> *simplices() {
    const ReferenceMesh<N> *mesh = fills_.coarsest();
    const auto isSimplices = [&](Index component) { return source_[at(component)] == PartSource::simplices; };
    const bool isFew = mesh && mayFallBack_ && mesh->simplexCount() < kFewSimplices;
    const ReferenceMesh<N> *const good =
        mesh && !isFew && goodAttempts_ < kGoodAttempts && worstSimplex(*mesh, isSimplices) < kSoundShape
            ? fills_.good(goodAttempts_, most_)
            : nullptr;
    const bool isBetter =
        good && worstSimplex(*good, isSimplices) > std::max(kUsefulShape, worstSimplex(*mesh, isSimplices));
    r.remeshedComponents = isBetter ? r.fallbackComponents : 0;
    r.given = nullptr;
    return isBetter ? good : mesh;
  }

  /// Whether finer simplices may be of a better shape than these, which is poor.
  bool wantsFiner() const {
    return r.remeshedComponents > 0 && goodAttempts_ + 1 < kGoodAttempts &&
           worstShape(r) < std::min(kPoorShape, kNearBound * r.angleBound) &&
           r.mesh.simplexCount() >= kFewSimplices && r.mesh.simplexCount() <= kCheap;
  }

  bool halve() {
    if (halvings_ == 0) unhalved_ = {r.mesh, r.parts, r.bentCuts, r.cuts, invertedBlocks() > 0};
    const Index inverted = invertedBlocks();
    const bool goesAstray = blame_ == Blame::narrow && halvings_ > 0 && inverted > 0 && inverted >= inverted_;
    inverted_ = inverted;
    if (goesAstray || halvings_ >= kHalvings ||
        !cutFiner(r, source_, blame_, options_.tolerance * r.mesh.size + 2 * r.domain.deviation, triesLeft_))
      return false;
    ++halvings_;
    everyFace_.resize(r.mesh.simplices.size(), false);
    return true;
  }

  Index invertedBlocks() const {
    return toIndex(static_cast<std::size_t>(
        std::count_if(r.quality.begin(), r.quality.end(), [](double q) { return !(q > 0); })));
  }

  /// Back to the parts before they were halved, to cut fewer of them at a time.
  bool halveFewer() {
    if (halvings_ == 0 || blame_ == Blame::narrow || !unhalved_.hasInverted) return false;
    r.mesh = std::move(unhalved_.mesh);
    r.parts = std::move(unhalved_.parts);
    r.bentCuts = unhalved_.bentCuts;
    r.cuts = unhalved_.cuts;
    blame_ = Blame::narrow;
    halvings_ = 0;
    triesOfAll_ = std::exchange(triesLeft_, kFewerAlone);
    return true;
  }

  /// The last few of what may only be too far from bent sides.
  void keepStraying() {
    if (straying_.size() == kStraying) straying_.erase(straying_.begin());
    straying_.push_back(r);
  }

  /// One of them with D-bar-surfaces doubled.
  bool takeDoubled() {
    const ReferenceMesh<N> *const mesh = straying_.empty() ? nullptr : fills_.coarsest();
    const double ofSimplices = mesh ? (N + 1.0) * mesh->simplexCount() : 0;
    for (; !straying_.empty(); straying_.pop_back()) {
      PipelineResult<N> &straying = straying_.back();
      const double most =
          std::max(kTimesForShape * static_cast<double>(straying.quality.size()), ofSimplices);
      if (!doubleStraying(straying, options_, most)) continue;
      std::swap(r.timings, straying.timings);
      r = std::move(straying);
      return true;
    }
    return false;
  }

  bool takeEarlyCuts() {
    if constexpr (N == 3)
      if (decomposition_.early && r.fallbackComponents + r.pulledComponents == 0) {
        takeEarly(r.mesh, decomposition_);
        takeParts();
        halvings_ = 0;
        if (std::exchange(blame_, Blame::wide) == Blame::narrow) triesLeft_ = triesOfAll_;
        return true;
      }
    return false;
  }

  /// The components that the certificate blames, one step down.
  void fallDown(bool built, int attempt) {
    if (r.fallbackReason.empty())
      r.fallbackReason =
          built ? "the cut parts did not pass the certificate: " + r.certificate.failures[0].message
                : "repairs of the reference mesh did not end";
    const std::vector<bool> more =
        built && attempt < kBlameRounds ? blamed(r, source_) : std::vector<bool>(source_.size(), true);
    const auto &pulled = decomposition_.pulled;
    for (std::size_t c = 0; c < source_.size(); ++c) {
      if (!more[c]) continue;
      const bool canPull = pulled && pulled->blocks[c] < std::numeric_limits<double>::infinity();
      source_[c] = source_[c] == PartSource::cuts && canPull ? PartSource::pulled : PartSource::simplices;
    }
  }

  PipelineResult<N> &r;
  Decomposition<N> decomposition_;
  std::vector<PartSource> source_; // changes where the certificate blames a component
  const PipelineOptions &options_;
  const FillMeshes<N> &fills_;
  StageClock &clock_;
  PartOptions partOptions_;
  std::vector<bool> everyFace_;
  bool mayFallBack_ = true;
  Index most_ = 0;       // good simplices; 0: no bound
  int goodAttempts_ = 0; // that the certificate has refused
  struct Unhalved {
    ReferenceMesh<N> mesh;
    Parts<N> parts;
    Index bentCuts = 0, cuts = 0;
    bool hasInverted = false;
  } unhalved_;
  Blame blame_ = Blame::wide;
  int halvings_ = 0;
  Index inverted_ = 0; // blocks, before the last halving
  int triesLeft_ = kHalvedAlone;
  int triesOfAll_ = 0; // left when fewer parts were halved at a time
  // Valid, but further from a side than is aimed at, or of a poorer shape: taken if nothing better comes.
  std::optional<PipelineResult<N>> coarser_;
  std::vector<PipelineResult<N>> straying_; // not valid, but with no block inverted
};

} // namespace

template <int N>
bool meshParts(PipelineResult<N> &r, PartChoice<N> choice, bool mayFallBack, const PipelineOptions &options,
               const FillMeshes<N> &fills, StageClock &clock) {
  return PartsMesher<N>(r, std::move(choice), options, fills, clock).run(mayFallBack);
}

template <int N>
bool meshGoodSimplices(PipelineResult<N> &r, Index most, const PipelineOptions &options,
                       const FillMeshes<N> &fills, StageClock &clock) {
  const auto all = [](Index) { return true; };
  const ReferenceMesh<N> *const good = fills.good(0, most);
  if (!good || worstSimplex(*good, all) < kUsefulShape ||
      worstSimplex(*good, all) < kMuchBetter * worstSimplex(*fills.coarsest(), all))
    return false;
  PartChoice<N> choice;
  choice.source.assign(at(r.mesh.componentCount), PartSource::cuts);
  const std::vector<Index> component = componentOfParts(r.mesh, r.parts);
  for (std::size_t b = 0; b < r.quality.size(); ++b)
    if (r.quality[b] < kPoorShape)
      choice.source[at(component[at(r.primal.blocks[b].part)])] = PartSource::simplices;
  // Of what is made of simplices already, nobody knows any more which of them are parts.
  for (Index s = 0; s < r.mesh.simplexCount(); ++s)
    for (const Index tag : r.mesh.tags[at(s)])
      if (tag != kNone && r.mesh.surfaces[at(FaceTag::surface(tag))].kind == SurfaceKind::simplexFace)
        choice.source[at(r.mesh.component[at(s)])] = PartSource::simplices;
  choice.decomposition.parts = std::move(r.parts);
  choice.decomposition.vertexCuts = r.vertexCuts;
  choice.decomposition.bentCuts = r.bentCuts;
  choice.decomposition.reflexCuts = r.cuts - r.vertexCuts - r.bentCuts;
  choice.whySimplices = "simplices give a better shape";
  r.pulledParts = 0;
  PartsMesher<N> mesher(r, std::move(choice), options, fills, clock);
  return mesher.run(false, most) && r.remeshedComponents > 0;
}

#define DUALBLOCK_DEFINE(N)                                                                                  \
  template bool meshParts(PipelineResult<N> &, PartChoice<N>, bool, const PipelineOptions &,                 \
                          const FillMeshes<N> &, StageClock &);                                              \
  template bool meshGoodSimplices(PipelineResult<N> &, Index, const PipelineOptions &,                       \
                                  const FillMeshes<N> &, StageClock &);
DUALBLOCK_DEFINE(2)
DUALBLOCK_DEFINE(3)
#undef DUALBLOCK_DEFINE

} // namespace dualblock
