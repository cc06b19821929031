#pragma once

#include <cstdint>
#include <optional>

namespace mocha {

/// Whether a node keeps its robot stopped, from what it hears: "stop", at once and from any sender,
/// and the state of the robot's emergency stop, which knows of resets. Once told to stop it stays
/// stopped until a later reset, even where the node that knows the state is dead or has not heard
/// of the stop.
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
  /// The state of the emergency stop has been heard, and no stop holds.
  bool released() const { return resets_ && !stopped(); }
  /// It was told to stop, and the state of the emergency stop says nothing of it.
  bool by_itself() const { return pressed_ && !held_; }

 private:
  bool pressed_ = false;
  bool held_ = false;
  std::optional<std::uint64_t> resets_;      // as heard last
  std::optional<std::uint64_t> pressed_at_;  // as known when it was told to stop
};

}  // namespace mocha
