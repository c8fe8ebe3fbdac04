// Tells how far a run is and how long its stages take, and stops it at its deadline.
#pragma once

#include <chrono>

#include "base/deadline.h"
#include "pipeline.h"

namespace dualblock {

class StageClock {
public:
  StageClock(const Progress &progress, std::vector<StageTime> &timings)
      : progress_(progress), timings_(timings) {}
  StageClock(const StageClock &) = delete;
  StageClock &operator=(const StageClock &) = delete;

  /// Moves time of the running stage to one that was measured inside it.
  void credit(const char *stage, double milliseconds) {
    timings_.push_back({stage, milliseconds});
    begin_ += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double, std::milli>(milliseconds));
  }

  void start(const char *stage, double done) {
    checkDeadline();
    stop();
    stage_ = stage;
    if (progress_) progress_(stage, done);
    begin_ = std::chrono::steady_clock::now();
  }

  /// Ends the running stage.
  void stop() {
    if (!stage_) return;
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
    auto known = timings_.begin();
    while (known != timings_.end() && known->stage != stage_) ++known;
    if (known == timings_.end()) timings_.push_back({stage_, ms});
    else known->milliseconds += ms;
    stage_ = nullptr;
  }

private:
  const Progress &progress_;
  std::vector<StageTime> &timings_;
  const char *stage_ = nullptr;
  std::chrono::steady_clock::time_point begin_;
};

} // namespace dualblock
