#include "partition/halve_parts.h"

#include <optional>

#include "partition/heuristics.h"
#include "partition/sources.h"

namespace dualblock {
namespace {

PartView viewOf(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index part,
                const BentCutOptions &options) {
  PartView v{mesh, parts, part, {}, {}, options.axes};
  for (const Curve<3> &curve : parts.curves)
    if (curve.part == part) v.curves.push_back(&curve);
  for (const Corner &corner : parts.corners)
    if (corner.part == part) v.corners.push_back(&corner);
  return v;
}

Index notSimple(const Parts<3> &parts) {
  return toIndex(static_cast<std::size_t>(std::count_if(
      parts.parts.begin(), parts.parts.end(), [](const PartInfo &part) { return !part.isSimple(); })));
}

/// Halves a part by whichever of its cuts leaves the fewest blocks in all. A plane that leaves the part
/// through a split side runs on behind it, and may divide much that nobody asked for: such ones are refused.
bool halveAlone(ReferenceMesh<3> &mesh, Parts<3> &parts, Index part, const BentCutOptions &options,
                int &triesLeft) {
  const PartView v = viewOf(mesh, parts, part, options);
  const Index before = notSimple(parts);
  std::optional<ReferenceMesh<3>> best;
  Parts<3> bestParts;
  std::size_t tried = 0;
  const ReferenceMesh<3> uncut = mesh;
  for (const Cut &cut : halving(v)) {
    if (++tried > kProposalsAlone || --triesLeft < 0) break;
    if (!makeCut(mesh, v, cut, options)) continue;
    Parts<3> now = buildParts(mesh, PartOptions{});
    if (notSimple(now) <= before && now.parts.size() <= parts.parts.size() + kMostSpread &&
        (!best || now.corners.size() < bestParts.corners.size())) {
      best = std::move(mesh);
      bestParts = std::move(now);
    }
    mesh = uncut;
  }
  if (!best) return false;
  mesh = std::move(*best);
  parts = std::move(bestParts);
  return true;
}

} // namespace

Index halveParts(ReferenceMesh<3> &mesh, Parts<3> &parts, const std::vector<Index> &which,
                 const BentCutOptions &options, int &triesLeft) {
  parts = buildParts(mesh, PartOptions{}); // as they are judged again below
  // All at once where that serves: mostly it does. The parts are those of before; what has been split off
  // their simplices since is found from them.
  ReferenceMesh<3> uncut = mesh;
  Index cuts = 0;
  for (const Index part : which) {
    const PartView v = viewOf(mesh, parts, part, options);
    for (const Cut &cut : halving(v))
      if (makeCut(mesh, v, cut, options)) {
        ++cuts;
        break;
      }
  }
  Parts<3> halved = buildParts(mesh, PartOptions{});
  if (notSimple(halved) <= notSimple(parts) && halved.parts.size() <= parts.parts.size() + 2 * which.size()) {
    parts = std::move(halved);
    return cuts;
  }
  // Else one by one: a simplex of each part leads back to what is left of it after the other cuts.
  mesh = std::move(uncut);
  std::vector<Index> seeds;
  for (const Index part : which)
    seeds.push_back(toIndex(
        static_cast<std::size_t>(std::find(parts.partOfSimplex.begin(), parts.partOfSimplex.end(), part) -
                                 parts.partOfSimplex.begin())));
  cuts = 0;
  for (const Index seed : seeds)
    if (triesLeft > 0)
      cuts += halveAlone(mesh, parts, parts.partOfSimplex[at(seed)], options, triesLeft) ? 1 : 0;
  return cuts;
}

} // namespace dualblock
