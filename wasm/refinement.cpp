// Refinement, as a module of its own: who only looks at blocks need not load it, its memory goes when it is
// done, and it is compiled for speed where the core's module is kept small.
#include <emscripten/bind.h>

#include "certificate.h"
#include "certificate/elements.h"
#include "marshal.h"
#include "refinement/refine_blocks.h"

namespace dualblock {
namespace {

template <int N> val refinedToJs(const RefinedMesh<N> &refined) {
  val m = val::object();
  m.set("ok", true);
  m.set("positions", toJs<double>(refined.positions));
  m.set("elements", toJs<Index>(refined.elements));
  m.set("block", toJs<Index>(refined.block));
  m.set("quality", toJs<double>(refined.quality));
  m.set("boundaryFaces", toJs<Index>(refined.boundary.faces));
  m.set("boundaryFacet", toJs<Index>(refined.boundary.facet));
  m.set("boundaryElement", toJs<Index>(refined.boundaryElement));
  m.set("interfaceFaces", toJs<Index>(refined.interfaces.faces));
  m.set("interfaceFacet", toJs<Index>(refined.interfaces.facet));
  m.set("outline", toJs<Index>(refined.outline));
  m.set("intervals", toJs<Index>(refined.intervals));
  m.set("placeOffsets", toJs<Index>(refined.places.offsets));
  m.set("places", toJs<double>(refined.places.items));
  m.set("isReversed", toJs<std::uint8_t>(refined.isReversed));
  m.set("straightened", refined.straightened.size());
  return m;
}

template <int N>
val refineArrays(const val &mesh, const RefineOptions &options, bool mayStayStraight, const val &progress) {
  BlockMesh<N> blocks;
  blocks.positions = rowsFromJs<Vec<N>, double>(mesh["positions"]);
  blocks.blocks = rowsFromJs<std::array<Index, 1 << N>, Index>(mesh["blocks"]);
  blocks.tags = rowsFromJs<std::array<Index, 2 * N>, Index>(mesh["tags"]);
  blocks.surfaces = rowsFromJs<std::array<Index, N>, Index>(mesh["surfaces"]);
  BentFacets<N> bent;
  bent.faces = rowsFromJs<std::array<Vec<N>, N>, double>(mesh["faces"]);
  bent.patchOfFace = fromJs<Index>(mesh["patchOfFace"]);
  bent.segments = rowsFromJs<Segment<N>, double>(mesh["segments"]);
  bent.patchesOfSegment = rowsFromJs<std::array<Index, 2>, Index>(mesh["patchesOfSegment"]);
  std::function<void(double)> report;
  if (!progress.isNull() && !progress.isUndefined()) report = [&](double done) { progress(done); };
  const std::vector<Index> patches = fromJs<Index>(mesh["surfacePatch"]);
  const auto refined = refineBlocks<N>(blocks, patches, BentShape<N>(bent), options, report);
  if (!refined.ok()) return failure(refined.error());
  val m = refinedToJs(refined.value());
  const Certificate certificate = certifyElements<N>(
      {refined.value(), blocks, patches, bent, mesh["domainMeasure"].as<double>(), mayStayStraight});
  m.set("certificate", certificateToJs(certificate, 2, std::size(kCheckNames)));
  return m;
}

/// mesh: {dimension, positions, blocks, tags, surfaces, surfacePatch, faces, patchOfFace, segments,
/// patchesOfSegment}, arrays of a run's result, and its domainMeasure; options: {intervals, size, limit,
/// ofSurface, gradedFacets, growths, straight}; progress: (done) => void or null.
val refine(const val &mesh, const val &options, const val &progress) {
  return guarded([&] {
    RefineOptions wanted;
    wanted.intervals = options["intervals"].as<Index>();
    wanted.size = options["size"].as<double>();
    wanted.elementLimit = options["limit"].as<double>();
    wanted.ofSurface = rowsFromJs<std::array<Index, 2>, Index>(options["ofSurface"]);
    const std::vector<Index> facets = fromJs<Index>(options["gradedFacets"]);
    const std::vector<double> growths = fromJs<double>(options["growths"]);
    for (std::size_t k = 0; k < facets.size(); ++k) wanted.gradings.push_back({facets[k], growths[k]});
    const bool isFlat = mesh["dimension"].as<int>() == 2;
    const bool mayStayStraight = options["straight"].as<bool>();
    return isFlat ? refineArrays<2>(mesh, wanted, mayStayStraight, progress)
                  : refineArrays<3>(mesh, wanted, mayStayStraight, progress);
  });
}

} // namespace
} // namespace dualblock

EMSCRIPTEN_BINDINGS(refinement) { emscripten::function("refine", &dualblock::refine); }
