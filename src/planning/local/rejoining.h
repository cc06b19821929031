#pragma once

#include <optional>
#include <vector>

#include "trajectory/minco.h"
#include "trajectory/motion.h"

namespace mocha {

/// Where a local drive meets the plan that it left, paper (38): the paper's anchor.
struct RejoinPoint {
  double plan_time_s = 0.0;  ///< absolute time of the plan at which it is there
  /// Position, velocity, acceleration of the plan there.
  PlanarMinco::State state = PlanarMinco::State::Zero();
  double drive_s = 0.0;  ///< what the plan itself drives from the progress to there [s]

  Vector2 place() const { return state.col(0); }
};

/// The time of a plan, not before `from_s`, at which it is nearest to `p`; nothing where that is
/// farther than `within_m` > 0. Of places about as near, the earliest.
std::optional<double> progress_on(const Motion& plan, const Vector2& p, double from_s,
                                  double within_m);

/// `ahead_s` > 0 after the progress on the plan, or where its drive forward ends before. Turns in
/// place that the plan would begin with are left out: the local drive sees to its own start.
/// Nothing where the plan drives backward next, or not at all.
std::optional<RejoinPoint> find_rejoin_point(const Motion& plan, double progress_s, double ahead_s);

}  // namespace mocha
