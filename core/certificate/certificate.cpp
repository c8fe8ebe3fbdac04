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

template <int N> Certificate certify(const CertificateInput<N> &input) {
  Certificate certificate;
  checkMatching(input, certificate);
  const BlockComplex<N> complex = buildBlockComplex(input);
  checkCells(input, complex, certificate);
  checkTopology(input, complex, certificate);
  checkGeometry(input, certificate);
  checkFeatures(input, complex, certificate);
  return certificate;
}

template Certificate certify(const CertificateInput<2> &);
template Certificate certify(const CertificateInput<3> &);

} // namespace dualblock
