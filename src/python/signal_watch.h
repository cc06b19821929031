#pragma once

#include <atomic>
#include <thread>

namespace mocha {

/// Hears of Ctrl-C, and of all that makes Python's signal handlers raise, while the GIL is
/// released.
class SignalWatch {
 public:
  /// Whether a handler has raised. The thread that made this lets them run, at most every 50 ms;
  /// others, several at once, only hear of it.
  bool has_raised();

  /// Throws what a handler has raised, with the GIL held again.
  void rethrow() const;

 private:
  const std::thread::id owner_ = std::this_thread::get_id();
  double next_s_ = 0.0;  // of the owner only
  std::atomic<bool> raised_{false};
};

}  // namespace mocha
