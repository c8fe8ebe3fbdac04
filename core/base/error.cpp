#include "base/error.h"

namespace dualblock {

const char *errorCodeName(ErrorCode code) {
  static constexpr const char *kNames[] = {
#define CODE(name, meaning) #name,
#include "base/error_codes.def"
#undef CODE
  };
  return kNames[static_cast<std::size_t>(code)];
}

} // namespace dualblock
