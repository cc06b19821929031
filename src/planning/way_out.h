#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planning/promise_builder.h"

namespace mocha {

/// What is left to a robot whose promise does not hold any more and for which no swerve is found.
class WayOut {
 public:
  /// When what is chosen now takes over, absolute.
  struct Times {
    double now_s;
    double emergency_s;  ///< as an emergency
    double settled_s;    ///< after settling with the peers
  };

  struct Choice {
    std::string what;              ///< for a human
    Motion motion;                 ///< empty: to go on with what is in force
    bool emergency = false;        ///< binds at once
    double follows_until_s = 0.0;  ///< until then it is what was in force
  };

  explicit WayOut(const RobotModel& robot);

  /// To brake, to step aside, or to brake hard; each is proved with the confidence that is asked
  /// for, or else on the most likely course of what moves. Nothing where none can be proved. It
  /// brakes at once for something that moves, and else in time.
  std::optional<Choice> proved(const Motion& committed, const Times& times,
                               const PromiseScene& scene, bool something_moves) const;

  /// To brake where need be and to step aside, proved.
  std::optional<Choice> aside(const Motion& committed, const Times& times,
                              const PromiseScene& scene) const;

  /// Where nothing can be proved: to dodge, to step aside, to go on or to brake at once, whichever
  /// keeps the most room to the likely course of what moves; to brake where it is not something
  /// that moves that is in the way. Dodging binds at once, and so is done only where no team-mate
  /// is near.
  Choice least_bad(const Motion& committed, const Times& times, const PromiseScene& scene,
                   bool something_moves) const;

  /// The robot, accelerating as hard as it brakes in an emergency.
  static RobotModel hardened(RobotModel robot);

 private:
  std::vector<Motion> evasions_from(const Motion& committed, double start_time_s,
                                    double deceleration, const RobotModel& robot,
                                    const PromiseScene& scene) const;
  /// What an escape keeps clear of: who is in the way, for long; all others as long as they are
  /// predicted, for where they walk then is a guess.
  std::vector<MovingThing> looked_at(const Motion& committed, double from_s,
                                     const PromiseScene& scene) const;
  bool is_alone(const Motion& committed, const Times& times, const PromiseScene& scene) const;
  std::vector<Choice> escapes(const Motion& committed, const Times& times,
                              const PromiseScene& likely) const;
  std::optional<Choice> braking(const Motion& committed, const Times& times,
                                const PromiseScene& scene, bool soon) const;
  std::optional<Choice> aside_in(const Motion& committed, const Times& times,
                                 const PromiseScene& scene) const;
  Motion hard_stop(const Motion& committed, const Times& times) const;

  const RobotModel robot_;
  const RobotModel hard_robot_;
  MotionLimits escape_limits_;
  const PromiseBuilder builder_;
};

}  // namespace mocha
