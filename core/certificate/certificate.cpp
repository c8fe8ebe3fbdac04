#include "certificate/certificate.h"

#include "certificate/checks.h"

namespace dualblock {

void Certificate::fail(Check check, std::string message, std::vector<EntityRef> entities) {
  constexpr std::size_t kListed = 8; // of each check: enough to see the pattern
  passed[static_cast<std::size_t>(check)] = false;
  valid = false;
  std::size_t same = 0;
  for (const CertificateFailure &f : failures) same += f.check == check ? 1 : 0;
  if (same < kListed) failures.push_back({check, std::move(message), std::move(entities)});
}

namespace {

template <int N>
void checkBlocks(const BlockInput<N> &in, const BlockComplex<N> &complex, Certificate &certificate) {
  checkTopology(in, complex, certificate);
  checkGeometry(in, certificate);
  checkFeatures(in, complex, certificate);
}

} // namespace

template <int N> Certificate certify(const CertificateInput<N> &in) {
  Certificate certificate;
  checkMatching(in, certificate);
  const BlockMesh<N> blocks = layeredBlocks(in.mesh, in.parts, in.surfaces, in.primal);
  const BlockInput<N> input{in.domain, in.features, in.featureNodes, in.mesh, blocks, in.facetDeviation};
  const BlockComplex<N> complex = buildBlockComplex(input);
  checkCells(in, complex, certificate);
  for (const std::string &fault : in.primal.faults) certificate.fail(Check::topology, fault);
  checkBlocks(input, complex, certificate);
  return certificate;
}

template <int N> Certificate certifyBlocks(const BlockInput<N> &input) {
  Certificate certificate;
  checkBlocks(input, buildBlockComplex(input), certificate);
  return certificate;
}

template Certificate certify(const CertificateInput<2> &);
template Certificate certify(const CertificateInput<3> &);
template Certificate certifyBlocks(const BlockInput<2> &);
template Certificate certifyBlocks(const BlockInput<3> &);

} // namespace dualblock
