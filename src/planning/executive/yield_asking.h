#pragma once

#include <limits>
#include <optional>

namespace mocha {

/// When a robot asks its team-mates for its way: once it has stood for a while with one of them on
/// it, and then again and again until none is near it any more.
class YieldAsking {
 public:
  /// Whether to look at the way now; `rests`: the robot stands, though it wants to go on.
  bool due(double now_s, bool rests);
  /// The look: whether a team-mate is on the way, or near it. Says whether to ask (again).
  bool look(double now_s, bool on_it, bool near_it);
  /// Asks no more, and begins anew with another way.
  void stop();

  bool asks() const { return asks_; }
  /// Once after the end of a request: the others should be told.
  bool take_withdrawal();

 private:
  bool asks_ = false;
  bool withdraws_ = false;
  std::optional<double> stands_since_s_;
  double looked_s_ = -std::numeric_limits<double>::infinity();
  double near_s_ = 0.0;  // when a team-mate was near the way last
};

}  // namespace mocha
