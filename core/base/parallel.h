// Work that writes nothing in common, side by side where there are threads. WebAssembly has none here: they
// need headers that a page on any static host cannot send.
#pragma once

#include <utility>

#ifndef __EMSCRIPTEN__
#include <future>
#endif

namespace dualblock {

/// A task that may run on a thread of its own from now on, and has run once finish() returns.
template <typename Task> class Aside {
public:
  /// isWorthIt: whether the task takes longer than a thread to begin.
  Aside([[maybe_unused]] bool isWorthIt, Task task) : task_(std::move(task)) {
#ifndef __EMSCRIPTEN__
    if (isWorthIt) running_ = std::async(std::launch::async, [this] { task_(); });
#endif
  }
  Aside(const Aside &) = delete; // the thread refers to it; its end waits for the thread's
  Aside &operator=(const Aside &) = delete;

  /// Runs the task if it does not run yet; throws what it threw.
  void finish() {
#ifndef __EMSCRIPTEN__
    if (running_.valid()) return running_.get();
#endif
    task_();
  }

private:
  Task task_;
#ifndef __EMSCRIPTEN__
  std::future<void> running_;
#endif
};

} // namespace dualblock
