#include "blocks/modes.h"

#include <cmath>

#include "blocks/coarsen.h"
#include "blocks/insert.h"
#include "blocks/relax.h"
#include "blocks/skeleton.h"
#include "geometry/jacobian.h"

namespace dualblock {
namespace {

constexpr double kGood = 0.3;       // scaled Jacobian that coarsening need not exceed
constexpr double kShare = 0.6;      // of the layered mesh's worst: what it may go down to
constexpr double kLessExact = 1.05; // of the layered mesh's error of volume, where sides are bent

/// What is lost and what is gained may cancel, so the volume beside bent sides counts as well.
double errorOf(const Certificate &certificate) {
  return std::max(std::abs(certificate.meshMeasure - certificate.domainMeasure),
                  certificate.fidelity.strayed * std::abs(certificate.domainMeasure));
}

Error refusal(Index surface, const std::string &why) {
  return {ErrorCode::badOption,
          "D\u0304-surface " + std::to_string(surface) + " cannot be extracted: " + why +
              ". Leave it out, or choose another one.",
          {{"surface", surface}}};
}

Error noInsertion(Index facet, const std::string &why) {
  return {ErrorCode::badOption,
          "No D\u0304-surface can be inserted along facet " + std::to_string(facet) + ": " + why +
              ". Leave it out, or choose another one.",
          {{"facet", facet}}};
}

} // namespace

template <int N> std::vector<double> qualityOf(const BlockMesh<N> &blocks) {
  std::vector<double> quality;
  for (const auto &block : blocks.blocks)
    quality.push_back(scaledJacobian<N>(cornersOf<N>(block, blocks.positions)));
  return quality;
}

template <int N>
Result<FinalMesh<N>> makeFinalMesh(const BlockInput<N> &layered, const Certificate &certificate,
                                   const ModeOptions &options, const std::vector<Index> &facetOfGiven) {
  FinalMesh<N> result;
  BlockMesh<N> &blocks = result.blocks;
  blocks = layered.blocks;
  const auto certified = [&](const BlockMesh<N> &mesh) {
    return certifyBlocks<N>({layered.domain, layered.features, layered.featureNodes, layered.mesh, mesh,
                             layered.facetDeviation, layered.given});
  };
  const auto freedomOf = [&](const BlockMesh<N> &mesh) {
    return Freedom<N>(layered.sideMesh(), layered.features, layered.featureNodes, mesh);
  };
  for (const Index surface : options.extract) {
    Extraction<N> next = extract(layered.mesh, freedomOf(blocks), blocks, surface);
    if (!next.why.empty()) return refusal(surface, next.why);
    if (options.relax) relax(freedomOf(next.blocks), next.blocks, {});
    if (const Certificate c = certified(next.blocks); !c.valid)
      return refusal(surface, c.failures[0].message);
    blocks = std::move(next.blocks);
    result.extracted.push_back(surface);
  }
  if (options.mode == Mode::coarsest) {
    CoarsenOptions<N> coarsenOptions;
    const std::vector<double> quality = qualityOf(blocks);
    const double worst = *std::min_element(quality.begin(), quality.end());
    coarsenOptions.floor = options.keepsShape ? worst - kSameShape : std::min(kGood, kShare * worst);
    // What was extracted by hand may have cost more than that already.
    const double allowed = std::max(kLessExact * errorOf(certificate), errorOf(certified(blocks))) +
                           1e-9 * std::abs(certificate.domainMeasure);
    coarsenOptions.isValid = [&](const BlockMesh<N> &mesh) {
      const Certificate c = certified(mesh);
      return c.valid && errorOf(c) <= allowed &&
             (c.fidelity.coarse.empty() || !certificate.fidelity.coarse.empty());
    };
    const std::vector<Index> more =
        coarsen(layered.sideMesh(), layered.features, layered.featureNodes, blocks, coarsenOptions);
    result.extracted.insert(result.extracted.end(), more.begin(), more.end());
  }
  result.certificate = certified(blocks);
  if (options.relax) {
    BlockMesh<N> relaxed = blocks;
    RelaxOptions thorough;
    thorough.sweeps = 60; // few blocks are left
    const Freedom<N> freedom = freedomOf(relaxed);
    relax(freedom, relaxed, thorough);
    thorough.precision = 1e-8;
    thorough.dip = 0.9;
    relax(freedom, relaxed, thorough);
    if (Certificate c = certified(relaxed); c.valid) {
      blocks = std::move(relaxed);
      result.certificate = std::move(c);
    }
  }
  if (!options.insert.empty()) {
    const BentShape<N> shape(bentFacetsOf(layered.sideMesh(), layered.features, layered.featureNodes));
    const std::vector<Index> patches = patchOfSurface(layered.mesh);
    std::vector<Index> sides; // of facets that go together
    for (const auto &[facet, share, isAnother] : options.insert) {
      const bool exists = facet >= 0 && at(facet) < facetOfGiven.size() && facetOfGiven[at(facet)] != kNone;
      if (!exists) return noInsertion(facet, "it does not exist");
      const Index side = patchOf(patches, facetOfGiven[at(facet)]);
      if (!isAnother) sides.clear();
      if (std::find(sides.begin(), sides.end(), side) != sides.end()) continue;
      sides.push_back(side);
      Insertion<N> next = insertAlong(layered.mesh, shape, blocks, facetOfGiven[at(facet)], share);
      if (!next.why.empty()) return noInsertion(facet, next.why);
      Certificate c = certified(next.blocks);
      if (!c.valid) return noInsertion(facet, c.failures[0].message);
      blocks = std::move(next.blocks);
      result.certificate = std::move(c);
      result.inserted.insert(result.inserted.end(), next.inserted.begin(), next.inserted.end());
    }
  }
  result.quality = qualityOf(blocks);
  return result;
}

template <int N>
BoundaryFaces<N> boundaryOf(const BlockMesh<N> &blocks, const std::vector<Index> &patchOfSurface) {
  const Skeleton<N> skeleton = skeletonOf(blocks, patchOfSurface);
  const std::vector<Index> uses = blocksAtFaces(blocks, skeleton);
  BoundaryFaces<N> result;
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (int f = 0; f < 2 * N; ++f) {
      if (uses[at(sharedFace(skeleton, b, f))] > 1) continue; // inside the domain
      auto &cycle = result.faces.emplace_back();
      for (std::size_t k = 0; k < cycle.size(); ++k)
        cycle[k] = blocks.blocks[b][at(faceCorner<N>(f, static_cast<int>(k)))];
      result.facet.push_back(FaceTag::surface(blocks.tags[b][at(f)]));
    }
  return result;
}

template Result<FinalMesh<2>> makeFinalMesh(const BlockInput<2> &, const Certificate &, const ModeOptions &,
                                            const std::vector<Index> &);
template Result<FinalMesh<3>> makeFinalMesh(const BlockInput<3> &, const Certificate &, const ModeOptions &,
                                            const std::vector<Index> &);
template std::vector<double> qualityOf(const BlockMesh<2> &);
template std::vector<double> qualityOf(const BlockMesh<3> &);
template BoundaryFaces<2> boundaryOf(const BlockMesh<2> &, const std::vector<Index> &);
template BoundaryFaces<3> boundaryOf(const BlockMesh<3> &, const std::vector<Index> &);

} // namespace dualblock
