// From a domain to a certified block mesh: the only place that knows the order of the stages.
#pragma once

#include <functional>

#include "blocks/modes.h"
#include "domain/prepare.h"
#include "partition/choose.h"
#include "parts/features.h"
#include "reference/fill.h"
#include "refinement/refine_blocks.h"

namespace dualblock {

/// What parts are chosen for.
enum class Objective : std::uint8_t {
  blocks, // few of them
  shape   // the largest minimum of the scaled Jacobian, where it is cheap to try several meshes; then few
          // blocks
};

struct PipelineOptions {
  double edgeLength = 0;    // of the reference mesh; 0: as coarse as TetGen makes it
  std::uint32_t seed = 0;   // > 0: vary the reference mesh at random
  double tolerance = 1e-6;  // of planarity, relative to the domain's size
  double timeLimit = 0;     // seconds for the whole run; 0: none
  ModeOptions mode{};       // of the mesh that is handed out
  bool history = false;     // keep where nodes were after every round of relaxation, up to 5,000 of them
  double featureAngle = -1; // degrees: facets that meet at less are one bent side; below 0: see patches.h
  Objective objective = Objective::blocks;
};

/// Called before each stage with its name and the share of the work done, 0 to 1.
using Progress = std::function<void(const char *stage, double done)>;

struct StageTime {
  const char *stage;
  double milliseconds;
};

/// Parts that were carried through to a mesh, to choose between them.
struct PartCandidate {
  Index parts = 0;
  Index blocks = 0;
  double minScaledJacobian = 0; // minus infinity where the mesh is not valid
  bool chosen = false;
};

/// Everything that a run derives, each stage's result with the ids of what it came from. On failure the
/// stages that were reached are filled in.
template <int N> struct PipelineResult {
  // Out of line: else all that a result consists of is compiled wherever there is one.
  PipelineResult();
  PipelineResult(const PipelineResult &);
  PipelineResult(PipelineResult &&) noexcept;
  PipelineResult &operator=(const PipelineResult &);
  PipelineResult &operator=(PipelineResult &&) noexcept;
  ~PipelineResult();

  PreparedDomain<N> domain;
  ReferenceMesh<N> mesh;
  /// Where faces of `mesh` on bent sides only stand for them: the mesh whose faces are the facets' own. Else
  /// null.
  std::shared_ptr<const ReferenceMesh<N>> given;
  Parts<N> features;                // of the uncut reference mesh: the domain's own
  std::vector<Vec<N>> featureNodes; // the nodes that `features` refers to
  Features featureKinds;
  double angleBound = 1;   // of the smallest scaled Jacobian: features.h
  Index fillSimplices = 0; // of the reference mesh before cuts and repairs
  std::string remedy;      // what it took TetGen to succeed, or empty
  Index cuts = 0;
  Index vertexCuts = 0;         // of the cuts: by vertices of too many sides
  Index bentCuts = 0;           // of the cuts: across bent sides
  Index bentSides = 0;          // of the domain
  Index repairs = 0;            // nodes added by repairs of conditions (a) and (b)
  Index fallbackComponents = 0; // components where every reference simplex became a part
  Index pulledComponents = 0;   // components where only parts that are not simple became simplices
  Index pulledParts = 0;        // those parts
  Index remeshedComponents = 0; // components whose simplices were made for their shape
  bool isRemeshRefused = false; // such simplices gave no valid mesh
  std::string fallbackReason;
  std::array<double, 3> alternatives{-1, -1, -1}; // PartChoice
  std::vector<CutTrial> cutTrials;
  std::vector<PartCandidate> candidates; // the first is what the objective `blocks` gives
  Parts<N> parts;
  Contributions<N> contributions;
  DualCells<N> dual;
  DualSurfaces surfaces;
  Primal<N> primal;
  std::vector<double> quality; // per block: scaled Jacobian
  std::vector<Vec<N>> history; // of the primal's nodes: all as placed, then after every round of relaxation
  Certificate certificate;     // of what is handed out: the final mesh, where there is one
  std::optional<FinalMesh<N>> finalMesh; // in place of the primal, where D-bar-surfaces have been extracted
  bool isCutShort = false;               // the time limit came before all that might be better was tried
  bool onlyMatching = false; // the domain gives its own contributions: they are checked, no mesh is made
  std::vector<StageTime> timings;

  const ReferenceMesh<N> &sideMesh() const { return given ? *given : mesh; }
};

/// Runs all stages. An Error is bad input, a failed fill or a time limit before there was any valid mesh; a
/// result whose certificate is not valid is no error here, but must not be handed out as a mesh.
template <int N>
Result<PipelineResult<N>> runPipeline(const Domain<N> &domain, const PipelineOptions &options,
                                      const Progress &progress = {});

/// Refines the mesh that a run hands out: the final mesh, or the primal where there is none. Errors: as
/// refineBlocks.
template <int N>
Result<RefinedMesh<N>> refineResult(const PipelineResult<N> &result, const RefineOptions &options) {
  const BentShape<N> shape(bentFacetsOf(result.sideMesh(), result.features, result.featureNodes));
  const std::vector<Index> patches = patchOfSurface(result.mesh);
  if (result.finalMesh) return refineBlocks(result.finalMesh->blocks, patches, shape, options);
  const BlockMesh<N> layered = layeredBlocks(result.mesh, result.parts, result.surfaces, result.primal);
  return refineBlocks(layered, patches, shape, options);
}

extern template Result<PipelineResult<2>> runPipeline(const Domain<2> &, const PipelineOptions &,
                                                      const Progress &);
extern template Result<PipelineResult<3>> runPipeline(const Domain<3> &, const PipelineOptions &,
                                                      const Progress &);

} // namespace dualblock
