#include "base/error.h"

#include <cstdio>

namespace dualblock {

const char *errorCodeName(ErrorCode code) {
  static constexpr const char *kNames[] = {
#define CODE(name, meaning) #name,
#include "base/error_codes.def"
#undef CODE
  };
  return kNames[static_cast<std::size_t>(code)];
}

std::string formatNumber(double x) {
  char text[32]; // a stream would bring 28 kB (gzip) of locales into the module
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

} // namespace dualblock
