// A time limit for a run. Whatever loops calls checkDeadline() now and then; it throws once the time is up,
// and the pipeline turns that into an error. There is one run at a time, as TetGen allows no more.
#pragma once

namespace dualblock {

struct OutOfTime {};

/// Sets the limit for as long as it lives. seconds: 0 for none.
class DeadlineScope {
public:
  explicit DeadlineScope(double seconds);
  ~DeadlineScope();
  DeadlineScope(const DeadlineScope &) = delete;
  DeadlineScope &operator=(const DeadlineScope &) = delete;
};

/// Throws OutOfTime after the limit.
void checkDeadline();

} // namespace dualblock
