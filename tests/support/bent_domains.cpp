#include "support/bent_domains.h"

namespace dualblock::test {

Domain<3> bentSolid(int kind, std::uint32_t seed) {
  RandomSource random(100000 * static_cast<std::uint32_t>(kind + 1) + seed);
  Domain<3> domain = kBentKinds[at(kind)].make(random);
  domain.name = kBentKinds[at(kind)].name;
  if (seed % 2 == 0) {
    const double s = random.real(0, 3);
    const double t = random.real(0, 3);
    for (Vec<3> &v : domain.vertices) {
      const Vec<3> y{std::cos(s) * v.x - std::sin(s) * v.y, std::sin(s) * v.x + std::cos(s) * v.y, v.z};
      v = {y.x, std::cos(t) * y.y - std::sin(t) * y.z, std::sin(t) * y.y + std::cos(t) * y.z};
    }
  }
  if (seed % 5 == 0)
    for (Vec<3> &v : domain.vertices) v = 0.01 * v + Vec<3>{1, -2, 0.5};
  return domain;
}

} // namespace dualblock::test
