#pragma once

#include <cstdint>

namespace mocha::test {

/// One thing that happens in a ProtocolModel.
struct Action {
  enum class Kind : std::uint8_t {
    kTimeGoesOn,
    kDeliver,
    kDuplicate,  ///< delivers a message, which arrives once more in the next step or later
    kLose,
    kDelay,  ///< by a step
    kPropose,
    kBrake,
    kRestart,  ///< of its broadcaster, which then sleeps until it knows what the tracker drives
    kWakeUp,
    kCut,  ///< the link between two robots, both ways; what is under way on it is lost
    kRestore,
  };
  Kind kind = Kind::kTimeGoesOn;
  std::uint8_t robot = 0;  ///< that acts, or receives; the first of two
  std::uint8_t which = 0;  ///< message under way; second robot
};

}  // namespace mocha::test
