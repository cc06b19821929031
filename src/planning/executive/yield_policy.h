#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "control/robot_state.h"
#include "planning/executive/executive_state.h"
#include "planning/executive/planner_interface.h"
#include "planning/executive/yield_asking.h"
#include "planning/executive/yielding.h"

namespace mocha {

/// Where a robot leaves the way to a team-mate of higher rank.
struct PullOverPoint {
  Vector2 position;  ///< map frame
  Rank whose;
};

/// What a robot does, as far as it matters to its team-mates.
struct RobotIntent {
  RobotState state;
  const Motion* motion = nullptr;          ///< that it drives; none where it stays
  std::optional<PullOverPoint> pull_over;  ///< where it makes room or waits
};

/// What the requests of team-mates ask of a robot: kPullOver, kPullOverHere, kNowhereToPullOver or
/// kWayIsClear.
struct YieldAdvice {
  ExecutiveEvent event;
  std::optional<PullOverPoint> pull_over;  ///< of kPullOver and kPullOverHere
};

/// When a robot makes room for its team-mates and where, and when it asks them to make room. The
/// goal executive decides through this class alone.
class YieldPolicy {
 public:
  /// Places that are no farther than `tolerance_m` apart are the same.
  YieldPolicy(Yielding yielding, double tolerance_m)
      : yielding_(std::move(yielding)), tolerance_m_(tolerance_m) {}
  void set_options(const PlannerOptions& options, double tolerance_m);

  /// What a team-mate asks for.
  void hear(const YieldRequest& request, double now_s) { yielding_.hear(request, now_s); }

  /// The robot has another goal, or none. While it is parked, it makes room for all.
  void begin_goal(bool parked);
  /// The robot is to go another way: what it asked for before is withdrawn.
  void begin_path() { asking_.stop(); }
  /// The robot has no place to pull over to: the others are to make room, whatever their rank.
  void set_stuck(bool stuck) { yielding_.set_stuck(stuck); }

  /// Whether it is time for another look at the requests; says so once.
  bool due(double now_s);
  /// What they ask of a robot that comes to rest at `stop` if it brakes now; nothing where it can
  /// go on.
  std::optional<YieldAdvice> advise(const RobotIntent& intent, const Vector2& stop,
                                    const SceneSource& scene, double now_s) const;
  /// Where the robot leaves the way to `whose`; nothing where that is at `present`, its pull-over
  /// point already.
  std::optional<YieldAdvice> pull_over(const Rank& whose,
                                       const std::optional<PullOverPoint>& present,
                                       const Vector2& stop, const SceneSource& scene,
                                       double now_s) const;
  /// The highest rank whose way `motion` would get into; none: it may be driven.
  std::optional<Rank> in_way_of(const Motion& motion, double now_s) const {
    return yielding_.in_way_of(motion, now_s);
  }

  /// What to ask of the team-mates of a robot on its way to `there`, if it is time to.
  std::optional<YieldRequest> ask(const RobotIntent& intent, const Vector2& there,
                                  const SceneSource& scene, double now_s);
  /// The end of what was asked for, once.
  std::optional<YieldRequest> withdrawal();

 private:
  std::optional<Rank> in_way_of(const RobotIntent& intent, double now_s) const;
  std::vector<Vector2> wanted_path(const RobotIntent& intent, const Vector2& there,
                                   const PlanningScene& scene, double now_s) const;

  Yielding yielding_;
  double tolerance_m_;
  YieldAsking asking_;
  double looked_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace mocha
