#pragma once

#include <optional>

#include "trajectory/unicycle.h"

namespace mocha {

/// Forgets velocity commands that grow old: the node that sent them may be dead.
class CommandWatchdog {
 public:
  explicit CommandWatchdog(double max_age_s) : max_age_s_(max_age_s) {}

  /// False for a command that is not finite: it is refused and counted, and the one before stays.
  bool take(double now_s, const UnicycleState& command);

  /// The newest command; nothing once it is older than the limit, or when the clock was set back.
  std::optional<UnicycleState> command(double now_s) const;

  int refused() const { return refused_; }

 private:
  double max_age_s_;
  std::optional<UnicycleState> command_;
  double taken_s_ = 0.0;
  int refused_ = 0;
};

}  // namespace mocha
