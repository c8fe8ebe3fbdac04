// How a reader leaves what it is in the middle of. Internal to the readers.
#pragma once

#include "base/error.h"

namespace dualblock {

/// Thrown by the parts of a reader, and never past it: a reader returns `error`.
struct Refusal {
  Error error;
};

} // namespace dualblock
