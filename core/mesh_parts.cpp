#include "mesh_parts.h"

#include <limits>
#include <optional>
#include <utility>

#include "base/sort.h"
#include "partition/heuristics.h"
#include "parts/bent_cuts.h"
#include "remesh/tet_mesh.h"

namespace dualblock {
namespace {

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
/// around nodes; and those of blocks that are further from a side than is aimed at.
std::vector<Index> partsAtFault(const PipelineResult<3> &r, const std::vector<PartSource> &source) {
  std::vector<bool> isAtFault(r.primal.positions.size(), false); // nodes
  std::vector<Index> which;
  const auto blame = [&](const EntityRef &e) {
    if (e.kind == "node") isAtFault[static_cast<std::size_t>(e.index)] = true;
    if (e.kind == "block") which.push_back(r.primal.blocks[static_cast<std::size_t>(e.index)].part);
  };
  std::for_each(r.certificate.culprits.begin(), r.certificate.culprits.end(), blame);
  std::for_each(r.certificate.fidelity.coarse.begin(), r.certificate.fidelity.coarse.end(), blame);
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
    for (int attempt = 0;; ++attempt, r.certificate = {}) {
      if (!mixSources()) return false;
      const bool built = buildDual(r, partOptions_, everyFace_, clock_);
      const bool isGood = built && buildResult(r, options_, clock_);
      const bool holds = built && r.certificate.valid && serves(r, coarser_);
      if (holds && isGood && !wantsFiner()) break;
      if (holds && !coarser_) coarser_ = r;
      if (built && halve()) continue;
      if (holds && wantsFiner()) {
        ++goodAttempts_;
        continue;
      }
      if (coarser_) {
        std::swap(r.timings, coarser_->timings);
        r = std::move(*coarser_);
        break;
      }
      if (takeEarlyCuts()) continue;
      if (r.remeshedComponents > 0) { // finer ones may be nearer to bent sides; the coarsest always work
        r.isRemeshRefused = ++goodAttempts_ == kGoodAttempts;
        if (!r.isRemeshRefused || mayFallBack) continue;
      }
      if (!mayFallBack) return false;
      if (r.fallbackComponents == r.mesh.componentCount) {
        if (!built) r.certificate.fail(Check::cells, "repairs of the reference mesh did not end");
        break;
      }
      fallDown(built, attempt);
    }
    if (decomposition_.pulled)
      for (std::size_t c = 0; c < source_.size(); ++c)
        if (source_[c] == PartSource::pulled) r.pulledParts += decomposition_.pulled->simplified[c];
    return true;
  }

private:
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
    if (halvings_ >= kHalvings ||
        !cutFiner(r, source_, options_.tolerance * r.mesh.size + 2 * r.domain.deviation, triesLeft_))
      return false;
    ++halvings_;
    everyFace_.resize(r.mesh.simplices.size(), false);
    return true;
  }

  bool takeEarlyCuts() {
    if constexpr (N == 3)
      if (decomposition_.early && r.fallbackComponents + r.pulledComponents == 0) {
        takeEarly(r.mesh, decomposition_);
        takeParts();
        halvings_ = 0;
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
  int halvings_ = 0;
  int triesLeft_ = kHalvedAlone;
  // Valid, but further from a side than is aimed at, or of a poorer shape: taken if nothing better comes.
  std::optional<PipelineResult<N>> coarser_;
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
