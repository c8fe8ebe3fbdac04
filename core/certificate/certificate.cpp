#include "certificate/certificate.h"

#include <cmath>
#include <cstdio>

#include "base/parallel.h"
#include "certificate/checks.h"

namespace dualblock {

void Certificate::fail(Check check, std::string message, std::vector<EntityRef> entities) {
  constexpr std::size_t kListed = 8; // of each check: enough to see the pattern
  passed[static_cast<std::size_t>(check)] = false;
  valid = false;
  culprits.insert(culprits.end(), entities.begin(), entities.end());
  std::size_t same = 0;
  for (const CertificateFailure &f : failures) same += f.check == check ? 1 : 0;
  if (same < kListed) failures.push_back({check, std::move(message), std::move(entities)});
}

std::string scientific(double x) {
  char text[32]; // a stream would bring 28 kB (gzip) of locales into the module
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

void summarize(Fidelity &fidelity, double volumeDifference, double domainMeasure) {
  double strayed = 0;
  for (const SideFidelity &side : fidelity.sides) {
    fidelity.largestDistance = std::max(fidelity.largestDistance, side.distance);
    fidelity.largestDepth = std::max(fidelity.largestDepth, side.depth);
    fidelity.largestTurning = std::max(fidelity.largestTurning, side.turning);
    strayed += side.strayed / domainMeasure;
  }
  fidelity.volumeDifference = volumeDifference;
  // Distances to what is nearest are less than those along normals: what is missing in all is known better.
  fidelity.strayed = std::max(std::abs(volumeDifference), strayed);
}

namespace {

/// By Check, each a certificate of its own, for they may be made at the same time; the first one holds what
/// the dual's two checks found.
using Findings = std::array<Certificate, 5>;

Certificate &of(Findings &findings, Check check) { return findings[static_cast<std::size_t>(check)]; }

Certificate joined(Findings &findings) {
  Certificate all = of(findings, Check::geometry); // with what it measured
  all.features = std::move(of(findings, Check::features).features);
  all.fidelity = std::move(of(findings, Check::features).fidelity);
  all.failures.clear();
  all.culprits.clear();
  for (const Certificate &one : findings) {
    for (std::size_t k = 0; k < all.passed.size(); ++k) all.passed[k] = all.passed[k] && one.passed[k];
    all.valid = all.valid && one.valid;
    all.failures.insert(all.failures.end(), one.failures.begin(), one.failures.end());
    all.culprits.insert(all.culprits.end(), one.culprits.begin(), one.culprits.end());
  }
  return all;
}

void checkStrayed(const Certificate &geometry, Certificate &features) {
  Fidelity &fidelity = features.fidelity;
  const double share = geometry.meshMeasure / geometry.domainMeasure;
  summarize(fidelity, geometry.isExact ? 0 : share - 1, geometry.domainMeasure);
  if (!(fidelity.strayed <= kMostStrayed))
    features.fail(Check::features,
                  scientific(100 * fidelity.strayed) +
                      " % of the domain's volume lies between its bent sides and the blocks",
                  fidelity.furthest);
}

/// Checks 3 to 5.
template <int N> void checkBlocks(const BlockInput<N> &in, Findings &findings) {
  const std::size_t size = in.blocks.blocks.size();
  Aside geometry(size, [&] { checkGeometry(in, of(findings, Check::geometry)); });
  const BlockComplex<N> complex = buildBlockComplex(in);
  Aside topology(size, [&] { checkTopology(in, complex, of(findings, Check::topology)); });
  checkFeatures(in, complex, of(findings, Check::features));
  topology.finish();
  geometry.finish();
  checkStrayed(of(findings, Check::geometry), of(findings, Check::features));
}

} // namespace

template <int N> Certificate certifyDual(const CertificateInput<N> &in) {
  Certificate certificate;
  checkMatching(in, certificate);
  checkCells(in, certificate);
  return certificate;
}

template <int N> Certificate certify(const CertificateInput<N> &in, const Certificate &ofDual) {
  const BlockMesh<N> blocks = layeredBlocks(in.mesh, in.parts, in.surfaces, in.primal);
  Findings findings{ofDual};
  for (const std::string &fault : in.primal.faults)
    of(findings, Check::topology).fail(Check::topology, fault);
  checkBlocks<N>({in.domain, in.features, in.featureNodes, in.mesh, blocks, in.facetDeviation, in.given},
                 findings);
  return joined(findings);
}

template <int N> Certificate certifyBlocks(const BlockInput<N> &input) {
  Findings findings;
  checkBlocks(input, findings);
  return joined(findings);
}

#define DUALBLOCK_DEFINE(N)                                                                                  \
  template Certificate certifyDual(const CertificateInput<N> &);                                             \
  template Certificate certify(const CertificateInput<N> &, const Certificate &);                            \
  template Certificate certifyBlocks(const BlockInput<N> &);
DUALBLOCK_DEFINE(2)
DUALBLOCK_DEFINE(3)
#undef DUALBLOCK_DEFINE

} // namespace dualblock
