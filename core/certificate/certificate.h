// What a result must prove (ARCHITECTURE.md 6). Nothing here is shared with the construction but the data
// types: what is checked is computed anew, by other means.
#pragma once

#include <string>

#include "blocks/block_mesh.h"
#include "certificate/fidelity.h"
#include "domain/domain.h"

namespace dualblock {

enum class Check : std::uint8_t { matching, cells, topology, geometry, features };

struct CertificateFailure {
  Check check;
  std::string message;
  std::vector<EntityRef> entities;
};

/// A curve (2D: vertex) of the domain and how many blocks meet along it.
struct FeatureCount {
  std::uint8_t ideal; // 1 end, 2 side, 3 corner, 4 reversal (paper 2.4)
  Index actual;
};

/// How near the blocks come to a domain with bent sides; zeros where they are the domain.
struct Fidelity {
  double largestDistance = 0;  // between bent sides and faces, curves and edges: a share of their size
  double largestDepth = 0;     // between sides and faces: a share of how thick the blocks behind are
  double largestTurning = 0;   // degrees, of a side in a face, or of a curve along an edge
  double volumeDifference = 0; // of the blocks' volume from the domain's, as a share of that
  double strayed = 0;          // volume between bent sides and faces, lost or gained, as a share of the same
  std::vector<EntityRef> furthest; // blocks that most of it lies beside
  std::vector<EntityRef> coarse;   // blocks that are further from a side than is aimed at: see kAimedDepth
  std::vector<SideFidelity> sides; // the bent ones
};

struct Certificate {
  std::array<bool, 5> passed{true, true, true, true, true}; // by Check
  std::vector<CertificateFailure> failures;                 // the first few of each check
  std::vector<EntityRef> culprits;                          // what all failures name, of each check in turn
  bool valid = true;
  double domainMeasure = 0;    // area or volume, from the domain's facets alone
  double meshMeasure = 0;      // the same of the blocks, exactly integrated
  bool isExact = true;         // the two agree; where sides are bent, blocks may cut corners
  double worstCoefficient = 0; // smallest Bezier coefficient over its block's largest
  Fidelity fidelity;
  std::vector<FeatureCount> features; // per domain curve, in the order of CertificateInput::curves

  void fail(Check check, std::string message, std::vector<EntityRef> entities = {});
};

/// What the checks of blocks need: the domain, and a mesh of it.
template <int N> struct BlockInput {
  const Domain<N> &domain;                 // validated, facets oriented outward where they bound the domain
  const Parts<N> &features;                // of the uncut mesh: the domain's own curves and corners
  const std::vector<Vec<N>> &featureNodes; // the nodes that `features` refers to
  const ReferenceMesh<N> &mesh;
  const BlockMesh<N> &blocks;
  double facetDeviation; // how far corners of facets lie off their planes, at most: the domain is only
                         // known up to this, which bounds how well volumes can agree
  const ReferenceMesh<N> *given = nullptr; // as PipelineResult::given

  /// Its faces on facets are the facets' own.
  const ReferenceMesh<N> &sideMesh() const { return given ? *given : mesh; }
};

template <int N> struct CertificateInput {
  const Domain<N> &domain; // as in BlockInput
  const Parts<N> &features;
  const std::vector<Vec<N>> &featureNodes;
  const ReferenceMesh<N> &mesh;
  const Parts<N> &parts;
  const Contributions<N> &contributions;
  const DualCells<N> &dual;
  const DualSurfaces &surfaces;
  const Primal<N> &primal;
  double facetDeviation;
  const ReferenceMesh<N> *given = nullptr;
};

/// The checks of the dual alone: matching and cells. Reads nothing of the primal, which may still be in the
/// making.
template <int N> Certificate certifyDual(const CertificateInput<N> &input);

/// All five checks of a primal and the dual that it was read off, of which two have been made.
template <int N> Certificate certify(const CertificateInput<N> &input, const Certificate &ofDual);

template <int N> Certificate certify(const CertificateInput<N> &input) {
  return certify(input, certifyDual(input));
}

/// Topology, geometry and features of a mesh that has been changed since, and has no dual of its own.
template <int N> Certificate certifyBlocks(const BlockInput<N> &input);

extern template Certificate certifyDual(const CertificateInput<2> &);
extern template Certificate certifyDual(const CertificateInput<3> &);
extern template Certificate certify(const CertificateInput<2> &, const Certificate &);
extern template Certificate certify(const CertificateInput<3> &, const Certificate &);
extern template Certificate certifyBlocks(const BlockInput<2> &);
extern template Certificate certifyBlocks(const BlockInput<3> &);

} // namespace dualblock
