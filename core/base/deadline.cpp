#include "base/deadline.h"

#include <chrono>

namespace dualblock {
namespace {

using Clock = std::chrono::steady_clock;
Clock::time_point deadline = Clock::time_point::max();

} // namespace

DeadlineScope::DeadlineScope(double seconds) {
  constexpr double kForEver = 1e9;
  if (seconds > 0 && seconds < kForEver)
    deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

DeadlineScope::~DeadlineScope() { deadline = Clock::time_point::max(); }

void checkDeadline() {
  if (deadline != Clock::time_point::max() && Clock::now() > deadline) throw OutOfTime{};
}

} // namespace dualblock
