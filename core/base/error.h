// Errors as values: a code from the one list, a message for people, and the entities at fault.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dualblock {

enum class ErrorCode : std::uint8_t {
#define CODE(name, meaning) name,
#include "base/error_codes.def"
#undef CODE
};

/// The code's name as in error_codes.def, e.g. "openBoundary".
const char *errorCodeName(ErrorCode code);

/// A kind of input entity and its index in the input, zero-based.
struct EntityRef {
  std::string kind; // "line", "vertex", "facet", "edge", "hole", "region", "simplex", "file"
  std::int64_t index;
};

struct Error {
  ErrorCode code;
  std::string message; // what is wrong, where, and what to do about it
  std::vector<EntityRef> entities;
};

/// A number for a message, in up to six digits.
std::string formatNumber(double x);

/// Either a value or an Error. `ok()` first; `value()` and `error()` require the matching state.
template <typename T> class [[nodiscard]] Result {
public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  T &value() { return std::get<0>(state_); }
  const T &value() const { return std::get<0>(state_); }
  const Error &error() const { return std::get<1>(state_); }

private:
  std::variant<T, Error> state_;
};

} // namespace dualblock
