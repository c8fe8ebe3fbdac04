// The JavaScript face of the core. Arrays go in and come out as typed arrays that own their memory; errors
// come out as {ok: false, error}; no C++ exception crosses.
#include <emscripten/bind.h>
#include <malloc.h>

#include <limits>
#include <optional>

#include "certificate.h"
#include "geometry/jacobian.h"
#include "io/read_domain.h"
#include "marshal.h"
#include "pipeline.h"
#include "primal/boundary.h"

namespace dualblock {
namespace {

/// Vertices, and facets as loops of them.
template <int N> val polygonsToJs(const Domain<N> &domain) {
  std::vector<Index> loopOffsets{0};
  std::vector<Index> facetOffsets{0};
  std::vector<Index> corners;
  for (const Facet &facet : domain.facets) {
    for (const auto &loop : facet.loops) {
      corners.insert(corners.end(), loop.begin(), loop.end());
      loopOffsets.push_back(toIndex(corners.size()));
    }
    facetOffsets.push_back(toIndex(loopOffsets.size()) - 1);
  }
  val d = val::object();
  d.set("vertices", toJs<double>(domain.vertices));
  d.set("facetOffsets", toJs<Index>(facetOffsets));
  d.set("loopOffsets", toJs<Index>(loopOffsets));
  d.set("loopVertices", toJs<Index>(corners));
  return d;
}

template <int N> val domainToJs(const PreparedDomain<N> &prepared) {
  val d = polygonsToJs(prepared.domain);
  d.set("givenVertex", toJs<Index>(prepared.givenVertex));
  d.set("facetOfGiven", toJs<Index>(prepared.facetOfGiven));
  d.set("regions", static_cast<double>(prepared.domain.regions.size()));
  d.set("deviation", prepared.deviation);
  d.set("repairs", stringsToJs(prepared.repairs));
  return d;
}

template <int N> val featuresToJs(const PipelineResult<N> &r) {
  Lists<Index> ridges;
  for (const Curve<N> &curve : r.features.curves) {
    for (const auto &ridge : curve.ridges)
      ridges.items.insert(ridges.items.end(), ridge.begin(), ridge.end());
    ridges.closeList();
  }
  val f = val::object();
  f.set("nodes", toJs<double>(r.featureNodes));
  f.set("ridgeOffsets", toJs<Index>(ridges.offsets));
  f.set("ridgeNodes", toJs<Index>(ridges.items));
  f.set("angle", column<double>(r.features.curves, [](const Curve<N> &c) { return c.angle; }));
  f.set("facets", rows<2>(r.features.curves, [&](const Curve<N> &c) {
          return std::array<Index, 2>{FaceTag::surface(r.features.sides[at(c.sides[0])].tag),
                                      FaceTag::surface(r.features.sides[at(c.sides[1])].tag)};
        }));
  f.set("ideal", column<std::uint8_t>(r.certificate.features, [](const FeatureCount &c) { return c.ideal; }));
  f.set("actual", column<Index>(r.certificate.features, [](const FeatureCount &c) { return c.actual; }));
  f.set("kind", toJs<std::uint8_t>(r.featureKinds.curves));
  f.set("angleBound", r.angleBound);
  f.set("vertices", toJs<Index>(r.featureKinds.vertexNodes));
  f.set("vertexKind", toJs<std::uint8_t>(r.featureKinds.vertices));
  return f;
}

template <int N> val referenceToJs(const PipelineResult<N> &r) {
  val m = val::object();
  m.set("nodes", toJs<double>(r.mesh.nodes));
  m.set("simplices", toJs<Index>(r.mesh.simplices));
  m.set("neighbors", toJs<Index>(r.mesh.neighbors));
  m.set("tags", toJs<Index>(r.mesh.tags));
  m.set("region", toJs<Index>(r.mesh.region));
  m.set("surfaceKind", column<std::uint8_t>(r.mesh.surfaces, [](const Surface<N> &s) { return s.kind; }));
  m.set("surfacePatch", column<Index>(r.mesh.surfaces, [](const Surface<N> &s) { return s.patch; }));
  m.set("surfaceSource", column<Index>(r.mesh.surfaces, [](const Surface<N> &s) { return s.source; }));
  m.set("filled", static_cast<double>(r.fillSimplices));
  m.set("remedy", r.remedy);
  m.set("cuts", r.cuts);
  m.set("vertexCuts", r.vertexCuts);
  m.set("bentCuts", r.bentCuts);
  m.set("bentSides", r.bentSides);
  m.set("repairs", r.repairs);
  return m;
}

template <int N> val partsToJs(const PipelineResult<N> &r) {
  val p = val::object();
  p.set("count", static_cast<double>(r.parts.parts.size()));
  p.set("fallbackComponents", r.fallbackComponents);
  p.set("remeshedComponents", r.remeshedComponents);
  p.set("fallbackReason", r.fallbackReason);
  p.set("isCutShort", r.isCutShort);
  p.set("alternatives", toJs<double>(std::vector<double>(r.alternatives.begin(), r.alternatives.end())));
  val trials = val::object();
  trials.set("largestAngle",
             column<double>(r.cutTrials, [](const CutTrial &t) { return t.policy.largestAngle; }));
  trials.set("turn", column<double>(r.cutTrials, [](const CutTrial &t) { return t.policy.snap; }));
  trials.set("dishes", column<Index>(r.cutTrials, [](const CutTrial &t) { return t.policy.isLast ? 1 : 0; }));
  trials.set("blocks", column<double>(r.cutTrials, [](const CutTrial &t) { return t.blocks; }));
  trials.set("worstSine", column<double>(r.cutTrials, [](const CutTrial &t) { return t.worstSine; }));
  trials.set("components", column<Index>(r.cutTrials, [](const CutTrial &t) { return t.components; }));
  p.set("cutTrials", trials);
  val candidates = val::object();
  candidates.set("parts", column<Index>(r.candidates, [](const PartCandidate &c) { return c.parts; }));
  candidates.set("blocks", column<Index>(r.candidates, [](const PartCandidate &c) { return c.blocks; }));
  candidates.set("minScaledJacobian",
                 column<double>(r.candidates, [](const PartCandidate &c) { return c.minScaledJacobian; }));
  candidates.set("chosen",
                 column<std::uint8_t>(r.candidates, [](const PartCandidate &c) { return c.chosen; }));
  p.set("candidates", candidates);
  p.set("pulledComponents", r.pulledComponents);
  p.set("pulledParts", r.pulledParts);
  p.set("region", column<Index>(r.parts.parts, [](const PartInfo &i) { return i.region; }));
  p.set("ofSimplex", toJs<Index>(r.parts.partOfSimplex));
  p.set("sidePart", column<Index>(r.parts.sides, [](const Side &s) { return s.part; }));
  p.set("sideTag", column<Index>(r.parts.sides, [](const Side &s) { return s.tag; }));
  p.set("sideOpposite", column<Index>(r.parts.sides, [](const Side &s) { return s.opposite; }));
  return p;
}

template <int N> val dualToJs(const PipelineResult<N> &r) {
  val c = val::object();
  c.set("hardCount", r.contributions.hardCount);
  c.set("softCount", r.contributions.softCount);
  c.set("offsets", toJs<Index>(r.contributions.ofSimplex.offsets));
  c.set("side", column<Index>(r.contributions.ofSimplex.items, [](const Contribution &x) { return x.side; }));
  c.set("mask",
        column<std::uint8_t>(r.contributions.ofSimplex.items, [](const Contribution &x) { return x.mask; }));
  c.set("soft", toJs<std::uint16_t>(r.contributions.soft));
  c.set("surfaceOfSide", toJs<Index>(r.surfaces.ofSide));
  c.set("surfaces", r.surfaces.count);
  c.set("cells", r.dual.cellCount);
  c.set("classOffset", toJs<Index>(r.dual.classOffset));
  c.set("pieceOfClass", toJs<Index>(r.dual.pieceOf));
  c.set("piecePart", column<Index>(r.dual.pieces, [](const CellPiece<N> &p) { return p.part; }));
  c.set("pieceCell", column<Index>(r.dual.pieces, [](const CellPiece<N> &p) { return p.cell; }));
  c.set("pieceSides", rows<N>(r.dual.pieces, [](const CellPiece<N> &p) { return p.sides; }));
  return c;
}

template <int N> val primalToJs(const PipelineResult<N> &r) {
  val p = val::object();
  p.set("positions", toJs<double>(r.primal.positions));
  p.set("nodePiece", toJs<Index>(r.primal.nodePiece));
  p.set("edges", rows<2>(r.primal.edges, [](const PrimalEdge &e) { return e.nodes; }));
  p.set("edgeSurface", column<Index>(r.primal.edges, [](const PrimalEdge &e) { return e.surface; }));
  p.set("faces", rows<4>(r.primal.faces, [](const PrimalFace &f) { return f.nodes; }));
  p.set("faceSurfaces", rows<2>(r.primal.faces, [](const PrimalFace &f) { return f.surfaces; }));
  p.set("blocks", rows<1 << N>(r.primal.blocks, [](const Block<N> &b) { return b.nodes; }));
  p.set("blockPart", column<Index>(r.primal.blocks, [](const Block<N> &b) { return b.part; }));
  p.set("blockSides", rows<N>(r.primal.blocks, [](const Block<N> &b) { return b.sides; }));
  p.set("quality", toJs<double>(r.quality));
  p.set("history", toJs<double>(r.history));
  const BoundaryFaces<N> boundary = boundaryFaces(r.mesh, r.parts, r.primal);
  p.set("boundaryFaces", toJs<Index>(boundary.faces));
  p.set("boundaryFacet", toJs<Index>(boundary.facet));
  return p;
}

/// The final mesh, or null where it is the primal.
template <int N> val finalMeshToJs(const PipelineResult<N> &r) {
  if (!r.finalMesh) return val::null();
  const BlockMesh<N> &blocks = r.finalMesh->blocks;
  val m = val::object();
  m.set("positions", toJs<double>(blocks.positions));
  m.set("blocks", toJs<Index>(blocks.blocks));
  m.set("blockPart", toJs<Index>(blocks.part));
  m.set("blockTags", toJs<Index>(blocks.tags));
  m.set("blockSurfaces", toJs<Index>(blocks.surfaces));
  m.set("quality", toJs<double>(r.finalMesh->quality));
  m.set("extracted", toJs<Index>(r.finalMesh->extracted));
  m.set("inserted", toJs<Index>(r.finalMesh->inserted));
  m.set("doubled", r.finalMesh->doubled);
  const BoundaryFaces<N> boundary = boundaryOf(blocks, patchOfSurface(r.mesh));
  m.set("boundaryFaces", toJs<Index>(boundary.faces));
  m.set("boundaryFacet", toJs<Index>(boundary.facet));
  return m;
}

template <int N> val bentFacetsToJs(const PipelineResult<N> &r) {
  const BentFacets<N> facets = bentFacetsOf(r.sideMesh(), r.features, r.featureNodes);
  val b = val::object();
  b.set("faces", toJs<double>(facets.faces));
  b.set("patchOfFace", toJs<Index>(facets.patchOfFace));
  b.set("segments", toJs<double>(facets.segments));
  b.set("patchesOfSegment", toJs<Index>(facets.patchesOfSegment));
  return b;
}

template <int N> val resultToJs(const PipelineResult<N> &r) {
  val out = val::object();
  out.set("ok", true);
  out.set("dimension", N);
  out.set("name", r.domain.domain.name);
  out.set("title", r.domain.domain.title);
  out.set("figure", r.domain.domain.figure);
  out.set("onlyMatching", r.onlyMatching);
  out.set("domain", domainToJs(r.domain));
  out.set("features", featuresToJs(r));
  out.set("reference", referenceToJs(r));
  out.set("parts", partsToJs(r));
  out.set("contributions", dualToJs(r));
  out.set("primal", primalToJs(r));
  out.set("mesh", finalMeshToJs(r));
  out.set("bent", bentFacetsToJs(r));
  out.set("certificate", certificateToJs(r.certificate, 0, r.onlyMatching ? 1 : std::size(kCheckNames)));
  val timings = val::object();
  for (const StageTime &t : r.timings) timings.set(t.stage, t.milliseconds);
  out.set("timings", timings);
  return out;
}

/// settings: {edgeLength, seed, tolerance, featureAngle, timeLimit, relax, history, coarsest, shape}, every
/// one a number in its range, extract, an array of whole numbers, and insertFacets and insertShares, typed
/// arrays.
Result<PipelineOptions> readOptions(const val &settings) {
  std::optional<Error> wrong;
  const auto take = [&](const char *name, double low, double high, const char *wanted) {
    const val given = settings[name];
    const double value = given.isNumber() ? given.as<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!wrong && !(value >= low && value <= high))
      wrong = {ErrorCode::badOption,
               std::string("The setting ") + name + " is out of its range: give " + wanted,
               {}};
    return value;
  };
  using Double = std::numeric_limits<double>;
  using Seed = std::numeric_limits<std::uint32_t>;
  const double edgeLength = take("edgeLength", 0, Double::max(), "a length, or 0 for the coarsest mesh.");
  const double seed = take("seed", 0, Seed::max(), "a number from 0 to 4294967295.");
  const double tolerance =
      take("tolerance", Double::min(), 1 - Double::epsilon(), "a number over 0 and under 1.");
  const double featureAngle =
      take("featureAngle", -1, 180, "degrees from 0 to 180, or a number below 0 for the automatic choice.");
  const double timeLimit = take("timeLimit", 0, Double::max(), "seconds, or 0 for no limit.");
  const double relax = take("relax", 0, 1, "true or false.");
  const double history = take("history", 0, 1, "true or false.");
  const double coarsest = take("coarsest", 0, 1, "the mode layered or coarsest.");
  const double shape = take("shape", 0, 1, "the objective blocks or shape.");
  std::vector<Index> surfaces;
  const val extract = settings["extract"];
  for (unsigned k = 0, n = extract.isArray() ? extract["length"].as<unsigned>() : 0; k < n; ++k) {
    const double id = extract[k].isNumber() ? extract[k].as<double>() : -1;
    if (!(id >= 0 && id <= std::numeric_limits<Index>::max()) || id != std::floor(id))
      return Error{ErrorCode::badOption, "A D̄-surface to extract is no whole number from 0 on.", {}};
    surfaces.push_back(static_cast<Index>(id));
  }
  if (wrong) return *wrong;
  std::vector<ModeOptions::Insert> insert;
  const std::vector<Index> facets = fromJs<Index>(settings["insertFacets"]);
  const std::vector<double> shares = fromJs<double>(settings["insertShares"]);
  for (std::size_t k = 0; k < std::min(facets.size(), shares.size()); ++k) {
    if (!(shares[k] > 0 && shares[k] < 1))
      return Error{
          ErrorCode::badOption, "The share of an inserted layer is a number over 0 and under 1.", {}};
    const bool isAnother = facets[k] < 0; // ~facet: of the same entry as the one before
    insert.push_back({isAnother ? ~facets[k] : facets[k], shares[k], isAnother});
  }
  PipelineOptions options;
  options.mode = {coarsest > 0 ? Mode::coarsest : Mode::layered, std::move(surfaces), relax > 0,
                  std::move(insert)};
  options.objective = shape > 0 ? Objective::shape : Objective::blocks;
  options.mode.keepsShape = shape > 0;
  options.history = history > 0;
  options.edgeLength = edgeLength;
  options.seed = static_cast<std::uint32_t>(seed);
  options.tolerance = tolerance;
  options.featureAngle = featureAngle;
  options.timeLimit = timeLimit;
  return options;
}

/// One domain at a time: load it, run it as often as wanted. A load that fails leaves the last domain.
class Session {
public:
  /// bytes: Uint8Array with the whole file; format: "json", "off", "poly" or "smesh".
  val load(const std::string &format, const val &bytes) {
    return guarded([&] {
      const std::vector<char> text = fromJs<char>(bytes);
      auto domain = readDomain(format, {text.data(), text.size()});
      return domain.ok() ? accept(std::move(domain.value())) : failure(domain.error());
    });
  }

  /// points: Float64Array, 3 per point; offsets, corners: Int32Array, polygon k has the corners
  /// offsets[k] .. offsets[k + 1].
  val loadSurface(const val &points, const val &offsets, const val &corners) {
    return guarded([&] {
      const std::vector<double> xyz = fromJs<double>(points);
      const std::vector<Index> begin = fromJs<Index>(offsets);
      const std::vector<Index> list = fromJs<Index>(corners);
      bool sound = xyz.size() % 3 == 0 && !begin.empty() && begin.front() == 0 &&
                   static_cast<std::size_t>(begin.back()) == list.size();
      for (std::size_t f = 0; f + 1 < begin.size(); ++f) sound = sound && begin[f] <= begin[f + 1];
      if (!sound) return failure({ErrorCode::internal, "The surface's arrays do not fit together.", {}});
      Domain<3> domain;
      for (std::size_t k = 0; k + 2 < xyz.size(); k += 3)
        domain.vertices.emplace_back(xyz[k], xyz[k + 1], xyz[k + 2]);
      for (std::size_t f = 0; f + 1 < begin.size(); ++f)
        domain.facets.push_back({{std::vector<Index>(list.begin() + begin[f], list.begin() + begin[f + 1])}});
      return accept(std::move(domain));
    });
  }

  void setName(const std::string &name) {
    if (domain_) std::visit([&](auto &domain) { domain.name = name; }, *domain_);
  }

  /// settings: see readOptions; progress: (stage, done) => void or null. A failure brings the domain as given
  /// along, so that the entities at fault can be shown.
  val run(const val &settings, const val &progress) {
    return guarded([&] {
      if (!domain_)
        return failure(
            {ErrorCode::nothingLoaded, "There is no domain yet: load one before calling run.", {}});
      const auto options = readOptions(settings);
      if (!options.ok()) return failure(options.error());
      Progress report;
      if (!progress.isNull() && !progress.isUndefined())
        report = [&](const char *stage, double done) { progress(std::string(stage), done); };
      return std::visit(
          [&](const auto &domain) {
            auto result = runPipeline(domain, options.value(), report);
            if (result.ok()) return resultToJs(result.value());
            val failed = failure(result.error());
            failed.set("given", polygonsToJs(domain));
            return failed;
          },
          *domain_);
    });
  }

private:
  template <typename D> val accept(D domain) {
    domain_ = AnyDomain(std::move(domain));
    val result = val::object();
    result.set("ok", true);
    return result;
  }

  std::optional<AnyDomain> domain_;
};

double heapInUse() { return static_cast<double>(static_cast<unsigned>(mallinfo().uordblks)); }

} // namespace
} // namespace dualblock

EMSCRIPTEN_BINDINGS(dualblock) {
  emscripten::class_<dualblock::Session>("Session")
      .constructor<>()
      .function("load", &dualblock::Session::load)
      .function("loadSurface", &dualblock::Session::loadSurface)
      .function("setName", &dualblock::Session::setName)
      .function("run", &dualblock::Session::run);
  emscripten::function("heapInUse", &dualblock::heapInUse);
}
