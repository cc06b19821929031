#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "control/robot_state.h"
#include "planning/plan_result.h"
#include "planning/promise_builder.h"

namespace mocha {

/// Times and bounds of the local replanner; each stands in config/local_replanner.yaml.
struct LocalReplannerRules {
  double settle_s;          ///< a proposal made now is binding after this time
  double emergency_s;       ///< the same for an emergency motion
  double horizon_s;         ///< promises reach about this far, then brake
  double extend_every_s;    ///< a promise is extended when this much of its horizon is used up
  double answer_timeout_s;  ///< a proposal without answer is given up after this time
  double max_error_m;       ///< actual against promised position
  double max_error_rad;     ///< the same for the heading
};

/// A motion to take over from the one in force at its start time once it is settled with the peers,
/// or at once.
struct ProposedMotion {
  std::uint32_t sequence;
  Motion motion;
  bool emergency;
};

/// Turns plans into promises: proposes certified motions that follow the newest plan, keeps the
/// promise in force under proof, and brakes when the proof fails. Pure decisions: time and
/// measurements come in, proposals go out.
class LocalReplanner {
 public:
  struct Output {
    std::optional<ProposedMotion> proposal;
    bool renew_lease = false;  ///< the motion in force was certified again
    bool request_plan = false;
    PlanReason reason = PlanReason::kSolved;
    Violation violation;
    std::string message;
  };

  LocalReplanner(const RobotModel& robot, const LocalReplannerRules& rules);

  /// The newest plan to the goal. An empty motion means there is none.
  void set_plan(Motion plan);
  /// The motion in force, as the broadcaster says. Sequences of own proposals continue after it.
  void set_committed(std::uint32_t sequence, Motion motion);
  /// The proposal was turned down.
  void on_refusal(std::uint32_t sequence);

  Output step(double now_s, const RobotState& measured, const PromiseScene& scene);

  const Motion& committed() const { return committed_; }

 private:
  /// What a promise was made from.
  struct Source {
    std::uint32_t plan = 0;  ///< 0: none
    double follows_until_s = 0.0;
  };

  void start(double now_s, const RobotState& measured, Output& output);
  bool off_track(double now_s, const RobotState& measured) const;
  void stop_here(double now_s, const RobotState& measured, Output& output);
  void shorten(double now_s, const Violation& violation, const PromiseScene& scene, Output& output);
  void extend(double now_s, const PromiseScene& scene, Output& output);
  /// A plan from rest that came too late for its own times is as good later, while the robot stands
  /// where it begins.
  void postpone_late_plan(double now_s);
  static void ask_for_plan(const Violation& violation, const std::string& why, Output& output);
  std::optional<Motion> joined(double now_s, double& join_s) const;
  void propose(double now_s, Motion motion, bool emergency, Source source, Output& output);

  PromiseBuilder builder_;
  LocalReplannerRules rules_;
  Motion plan_;
  std::uint32_t plan_id_ = 0;
  Motion committed_;
  Source committed_source_;
  std::uint32_t sequence_ = 0;
  std::map<std::uint32_t, Source> proposed_;  // by sequence, until answered
  double pending_until_s_ = 0.0;
  bool pending_brake_ = false;  // what is pending brakes for a violation
};

}  // namespace mocha
