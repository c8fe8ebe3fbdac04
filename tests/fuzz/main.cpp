// One libFuzzer program per target: DUALBLOCK_FUZZ_TARGET is set by CMake.
#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  dualblock::fuzz::DUALBLOCK_FUZZ_TARGET(data, size);
  return 0;
}
