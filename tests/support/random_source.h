// Random numbers that are the same on every machine, and which seeds a run of the random tests takes.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>

namespace dualblock::test {

class RandomSource {
public:
  explicit RandomSource(std::uint32_t seed) : engine_(seed) {}
  /// From low to high; only the engine's own sequence is fixed by the standard, so no distributions.
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }
  int whole(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  bool chance(double p) { return real(0, 1) < p; }

private:
  std::mt19937 engine_;
};

/// DUALBLOCK_TRIALS, DUALBLOCK_FIRST_SEED, or what else a test takes.
inline std::uint32_t fromEnvironment(const char *name, std::uint32_t otherwise) {
  const char *const text = std::getenv(name);
  return text ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}

} // namespace dualblock::test
