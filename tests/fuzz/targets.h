// What the fuzzer calls, one function per target. Each takes any bytes, must return, and must not leak:
// crashes, hangs and sanitizer reports are the findings. The same functions replay the saved corpus in the
// native tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dualblock::fuzz {

void readJsonTarget(const std::uint8_t *data, std::size_t size);
void readOffTarget(const std::uint8_t *data, std::size_t size);
void readPolyTarget(const std::uint8_t *data, std::size_t size); // the first byte chooses .poly or .smesh
/// Makes a small solid out of the bytes and runs every stage. Aborts where a solid that is sound by
/// construction gets no certified mesh.
void pipelineTarget(const std::uint8_t *data, std::size_t size);

struct Target {
  const char *name;
  void (*run)(const std::uint8_t *, std::size_t);
};
inline constexpr Target kTargets[] = {{"read_json", readJsonTarget},
                                      {"read_off", readOffTarget},
                                      {"read_poly", readPolyTarget},
                                      {"pipeline", pipelineTarget}};

} // namespace dualblock::fuzz
