#include "doubled_mesh.h"

#include "blocks/relax.h"
#include "geometry/jacobian.h"
#include "partition/heuristics.h"
#include "refinement/double_surfaces.h"

namespace dualblock {
namespace {

/// Whether all that is wrong is how far blocks are from the domain.
bool onlyStrays(const Certificate &certificate) {
  for (const Check check : {Check::matching, Check::cells, Check::topology, Check::geometry})
    if (!certificate.passed[static_cast<std::size_t>(check)]) return false;
  return true;
}

/// Of the blocks that the certificate names, the D-bar-surfaces that cross their faces on bent sides; and
/// those that cross edges between two of the nodes that it names.
template <int N>
std::vector<bool> strayingSurfaces(const ReferenceMesh<N> &mesh, const BlockMesh<N> &blocks,
                                   const Certificate &certificate) {
  Index count = 0;
  for (const auto &surfaces : blocks.surfaces)
    for (const Index s : surfaces) count = std::max(count, s + 1);
  std::vector<bool> wanted(at(count), false);
  std::vector<bool> isNamed(blocks.positions.size(), false);
  for (const EntityRef &e : certificate.culprits) {
    if (e.kind == "node") isNamed[static_cast<std::size_t>(e.index)] = true;
    if (e.kind != "block") continue;
    const auto b = static_cast<std::size_t>(e.index);
    for (std::size_t f = 0; f < 2 * N; ++f) {
      const Index tag = blocks.tags[b][f];
      if (tag == kNone || !mesh.surfaces[at(FaceTag::surface(tag))].bent) continue;
      for (std::size_t a = 0; a < N; ++a)
        if (a != f / 2) wanted[at(blocks.surfaces[b][a])] = true;
    }
  }
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b)
    for (std::size_t a = 0; a < N; ++a)
      for (unsigned bits = 0; bits < 1U << N; ++bits) {
        if (bits >> a & 1U) continue;
        const auto named = [&](unsigned corner) {
          return isNamed[at(blocks.blocks[b][cornerAt<N>(corner)])];
        };
        if (named(bits) && named(bits | 1U << a)) wanted[at(blocks.surfaces[b][a])] = true;
      }
  return wanted;
}

/// Nodes that are off what they lie on, onto it, as far as the blocks around them stay valid; those that
/// cannot go yet are tried again once their neighbours have moved.
template <int N> void putOnSides(const Freedom<N> &freedom, BlockMesh<N> &mesh) {
  const Lists<Index> blocksAt = blocksOfNodes(mesh);
  const auto worstAt = [&](Index v) {
    double worst = 1;
    for (const Index *b = blocksAt.begin(v); b != blocksAt.end(v); ++b)
      worst = std::min(worst, scaledJacobian<N>(cornersOf<N>(mesh.blocks[at(*b)], mesh.positions)));
    return worst;
  };
  for (int round = 0; round < kPutRounds; ++round) {
    Index left = 0;
    for (Index v = 0; v < mesh.nodeCount(); ++v) {
      if (freedom.isFixed(v) || freedom.patchCount(v) == 0) continue;
      const Vec<N> from = mesh.positions[at(v)];
      const Vec<N> to = freedom.project(v, from);
      if (to == from) continue;
      const double before = worstAt(v);
      double share = 1;
      for (int k = 0; k < kPutHalvings; ++k, share /= 2) {
        mesh.positions[at(v)] = share == 1 ? to : from + share * (to - from);
        if (worstAt(v) > std::min(kPutShape, before)) break;
        mesh.positions[at(v)] = from;
      }
      if (mesh.positions[at(v)] != to) ++left;
    }
    if (left == 0) return;
    RelaxOptions few;
    few.sweeps = kPutSweeps;
    relax(freedom, mesh, few);
  }
}

} // namespace

template <int N> bool doubleStraying(PipelineResult<N> &r, const PipelineOptions &options, double most) {
  if (!onlyStrays(r.certificate)) return false;
  const BentShape<N> shape(bentFacetsOf(r.sideMesh(), r.features, r.featureNodes));
  const std::vector<Index> patches = patchOfSurface(r.mesh);
  FinalMesh<N> mesh;
  mesh.blocks = layeredBlocks(r.mesh, r.parts, r.surfaces, r.primal);
  mesh.certificate = r.certificate;
  for (int round = 0; round < kDoublings && !mesh.certificate.valid; ++round) {
    auto doubled =
        doubleSurfaces(mesh.blocks, patches, shape, strayingSurfaces(r.mesh, mesh.blocks, mesh.certificate));
    if (!doubled.ok() || doubled.value().blocks.blockCount() > most) return false;
    mesh.blocks = std::move(doubled.value().blocks);
    const auto &inserted = doubled.value().inserted;
    mesh.inserted.insert(mesh.inserted.end(), inserted.begin(), inserted.end());
    mesh.doubled = toIndex(mesh.inserted.size());
    const Freedom<N> freedom(r.sideMesh(), r.features, r.featureNodes, mesh.blocks);
    putOnSides(freedom, mesh.blocks);
    if (options.mode.relax) relax(freedom, mesh.blocks, {});
    mesh.certificate = certifyBlocks<N>({r.domain.domain, r.features, r.featureNodes, r.mesh, mesh.blocks,
                                         r.domain.deviation, r.given.get()});
    if (!onlyStrays(mesh.certificate)) return false;
  }
  if (!mesh.certificate.valid) return false;
  mesh.quality = qualityOf(mesh.blocks);
  r.certificate = mesh.certificate;
  r.finalMesh = std::move(mesh);
  return true;
}

template bool doubleStraying(PipelineResult<2> &, const PipelineOptions &, double);
template bool doubleStraying(PipelineResult<3> &, const PipelineOptions &, double);

} // namespace dualblock
