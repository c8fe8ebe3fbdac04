#include "blame.h"

#include "base/sort.h"
#include "partition/halve_parts.h"
#include "partition/heuristics.h"

namespace dualblock {
namespace {

/// Parts at fault, in components that are cut.
std::vector<Index> partsAtFault(const PipelineResult<3> &r, const std::vector<PartSource> &source,
                                Blame blame) {
  std::vector<Index> which;
  const auto addPart = [&](const EntityRef &e) {
    if (e.kind == "block") which.push_back(r.primal.blocks[static_cast<std::size_t>(e.index)].part);
  };
  const auto isWanted = [&] { return blame == Blame::wide || which.empty(); };
  if (blame == Blame::narrow)
    for (std::size_t b = 0; b < r.quality.size(); ++b)
      if (!(r.quality[b] > 0)) which.push_back(r.primal.blocks[b].part);
  if (isWanted()) std::for_each(r.certificate.culprits.begin(), r.certificate.culprits.end(), addPart);
  if (isWanted()) {
    std::vector<bool> isAtFault(r.primal.positions.size(), false); // nodes
    for (const EntityRef &e : r.certificate.culprits)
      if (e.kind == "node") isAtFault[static_cast<std::size_t>(e.index)] = true;
    for (const Block<3> &block : r.primal.blocks)
      if (std::any_of(block.nodes.begin(), block.nodes.end(), [&](Index n) { return isAtFault[at(n)]; }))
        which.push_back(block.part);
  }
  if (isWanted())
    std::for_each(r.certificate.fidelity.coarse.begin(), r.certificate.fidelity.coarse.end(), addPart);
  sortItems(which);
  which.erase(std::unique(which.begin(), which.end()), which.end());
  const std::vector<Index> component = componentOfParts(r.mesh, r.parts);
  which.erase(std::remove_if(which.begin(), which.end(),
                             [&](Index part) { return source[at(component[at(part)])] != PartSource::cuts; }),
              which.end());
  return which;
}

} // namespace

template <int N> std::vector<bool> blamed(const PipelineResult<N> &r, const std::vector<PartSource> &source) {
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

template <int N>
bool cutFiner(PipelineResult<N> &r, const std::vector<PartSource> &source, Blame blame, double tolerance,
              int &triesLeft) {
  if constexpr (N == 3) {
    if (r.bentSides == 0 ||
        r.mesh.simplexCount() > (blame == Blame::wide ? kCheapToHalve : kCheapToHalveFewer))
      return false;
    const std::vector<Index> which = partsAtFault(r, source, blame);
    const BentCutOptions options{
        {tolerance, toIndex(r.domain.domain.facets.size())}, axesOf(r.features, r.featureNodes), {}};
    const Index cuts = halveParts(r.mesh, r.parts, which, options, triesLeft);
    r.bentCuts += cuts;
    r.cuts += cuts;
    return cuts > 0;
  }
  return false;
}

#define DUALBLOCK_DEFINE(N)                                                                                  \
  template std::vector<bool> blamed(const PipelineResult<N> &, const std::vector<PartSource> &);             \
  template bool cutFiner(PipelineResult<N> &, const std::vector<PartSource> &, Blame, double, int &);
DUALBLOCK_DEFINE(2)
DUALBLOCK_DEFINE(3)
#undef DUALBLOCK_DEFINE

} // namespace dualblock
