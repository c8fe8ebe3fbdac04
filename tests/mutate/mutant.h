// What the mutated copy of the certificate asks: which of its mutants is active. See mutate-cpp.mjs.
#pragma once

#include <cstdlib>
#include <type_traits>

namespace dualblock {

/// 0 or no number: none.
inline bool mutantIs(int mutant) {
  static const int active = [] {
    const char *const text = std::getenv("DUALBLOCK_MUTANT");
    return text ? std::atoi(text) : 0;
  }();
  return active == mutant;
}

/// Whole numbers are rounded down, and those that would be too large stay within their type.
template <typename T> T widened(int mutant, double factor, T bound) {
  if (!mutantIs(mutant)) return bound;
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(static_cast<long long>(static_cast<double>(bound) * factor));
  else return bound * factor;
}

} // namespace dualblock
