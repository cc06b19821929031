#pragma once

#include <cstdint>
#include <optional>

namespace mocha {

/// Whether a node keeps its robot stopped, from what it hears: "stop", at once and from anybody,
/// and the state of the robot's emergency stop, which knows of resets. Once told to stop it stays
/// stopped until a reset after that: also where whoever knows the state is dead, or has not heard
/// the same.
class StopLatch {
 public:
  void stop() {
    pressed_ = true;
    pressed_at_ = resets_;
  }

  /// `resets` counts the resets so far.
  void hear(bool stopped, std::uint64_t resets) {
    const bool reset = pressed_ && pressed_at_ && *pressed_at_ != resets;
    if (reset && !stopped) pressed_ = false;
    if (pressed_ && !pressed_at_) pressed_at_ = resets;
    resets_ = resets;
    held_ = stopped;
  }

  bool stopped() const { return pressed_ || held_; }
  /// Whoever knows has said that no stop holds.
  bool released() const { return resets_ && !stopped(); }
  /// It was told to, and whoever knows the state says nothing of a stop.
  bool by_itself() const { return pressed_ && !held_; }

 private:
  bool pressed_ = false;
  bool held_ = false;
  std::optional<std::uint64_t> resets_;      // as heard last
  std::optional<std::uint64_t> pressed_at_;  // as known when it was told to stop
};

}  // namespace mocha
