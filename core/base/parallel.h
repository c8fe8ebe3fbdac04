// Work that writes nothing in common, side by side where there are threads. WebAssembly has none here: they
// need headers that a page on any static host cannot send.
#pragma once

#include <cstddef>
#include <utility>

#ifndef __EMSCRIPTEN__
#include <future>
#endif

namespace dualblock {

/// Cells or blocks; a task on fewer is done before a thread has begun.
inline constexpr std::size_t kWorthThread = 1000;

/// A task that may run on a thread of its own from now on, and has run once finish() returns.
template <typename Task> class Aside {
public:
  /// size: of what the task goes through, in cells or blocks.
  Aside([[maybe_unused]] std::size_t size, Task task) : task_(std::move(task)) {
#ifndef __EMSCRIPTEN__
    if (size >= kWorthThread) running_ = std::async(std::launch::async, [this] { task_(); });
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
