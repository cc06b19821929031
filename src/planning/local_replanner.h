#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "control/robot_state.h"
#include "planning/local_replanner_rules.h"
#include "planning/promise_builder.h"
#include "planning/proposals.h"
#include "planning/swerving.h"
#include "planning/way_out.h"

namespace mocha {

/// Turns plans into promises: proposes certified motions that follow the newest plan, keeps the
/// promise in force under proof, and where the plan or the promise meets something that moves,
/// swerves around it and comes back (V). Where no swerve can be proved it brakes in time; where no
/// stop can be proved either, it does what keeps the most room. Pure decisions: time and
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
    std::optional<LocalPlan> local;  ///< what local planning found, if there was need for it
    bool swerves = false;            ///< that is the plan now, and proposed
    bool keeps_plan = false;         ///< an offered plan was no improvement
  };

  LocalReplanner(
      const RobotModel& robot, const LocalReplannerRules& rules, const LocalRules& local_rules,
      const LocalPlanner::Watch& watch = [](LocalStage) {});

  /// The newest plan to the goal. An empty motion means there is none. One that leads to where the
  /// plan at hand leads is passed over where it meets something that moves, and that one does not
  /// or later.
  void set_plan(Motion plan);
  /// The motion in force, as the broadcaster says. Sequences of own proposals continue after it.
  void set_committed(std::uint32_t sequence, Motion motion);
  /// The proposal was turned down.
  void on_refusal(std::uint32_t sequence);

  Output step(double now_s, const RobotState& measured, const PromiseScene& scene);
  /// Instead, while the robot is stopped for an emergency: the plan is dropped, and what is
  /// promised is what the robot does: it stops as hard as its wheels can and stands, wherever it is
  /// pushed.
  Output halt(double now_s, const RobotState& measured);

  const Motion& committed() const { return committed_; }
  /// What is being followed: the newest plan, or what local planning made of it.
  const Motion& plan() const { return plan_; }
  /// The promise in force cannot be proved and no other motion either.
  int least_bad() const { return least_bad_; }

 private:
  void take_offer(double now_s, const PromiseScene& scene, Output& output);
  void replace_plan(Motion plan);
  /// The plan leads farther than what is in force.
  bool under_way() const;
  Violation conflict(const Motion& plan, double now_s, const PromiseScene& scene,
                     double horizon_s) const;
  bool waits_for_answer(double now_s, const PromiseScene& scene) const;
  void start(double now_s, const RobotState& measured, Output& output);
  bool off_track(double now_s, const RobotState& measured) const;
  /// What is in force is where the robot is, and at rest no later than it will be.
  bool is_promised(const Motion& stop, double now_s) const;
  void stop_here(double now_s, const RobotState& measured, Output& output);
  Swerving::Situation situation(double now_s) const;
  bool swerve(double now_s, const PromiseScene& scene, Output& output);
  /// While swerving: where that gets it back on its plan sooner.
  bool swerve_less(double now_s, const PromiseScene& scene, Output& output);
  /// Where there was no swerve in this step, within the limits of an emergency.
  bool swerve_harder(double now_s, const PromiseScene& scene, Output& output);
  /// Makes what local planning found the plan, and proposes as much of it as can be promised; false
  /// where that is next to nothing.
  bool adopt(double now_s, const PromiseScene& scene, Output& output);
  /// Out of the way of who comes to where it stands.
  void step_aside(double now_s, const Violation& violation, const PromiseScene& scene,
                  Output& output);
  void shorten(double now_s, const Violation& violation, const PromiseScene& scene, Output& output);
  WayOut::Times times(double now_s) const;
  void take(double now_s, const WayOut::Choice& choice, Output& output);
  void do_the_least_bad(double now_s, const PromiseScene& scene, Output& output);
  /// Promises more of the plan once `every_s` of the horizon is used up.
  void extend(double now_s, const PromiseScene& scene, double every_s, Output& output);
  static void ask_for_plan(const Violation& violation, const std::string& why, Output& output);
  void propose(double now_s, const Motion& motion, bool emergency, const PromiseSource& source,
               bool brakes, Output& output);

  bool follows_plan_at(double t) const {
    return committed_source_.plan == plan_id_ && committed_source_.follows_until_s >= t;
  }

  const double own_radius_m_;
  PromiseBuilder builder_;
  WayOut way_out_;
  Swerving swerving_;
  LocalReplannerRules rules_;
  std::optional<Motion> offered_;
  Motion plan_;  // what is followed: the newest plan, or a swerve
  std::uint32_t plan_id_ = 0;
  bool squeezes_ = false;  // the plan keeps clear of the most likely course only
  Motion committed_;
  PromiseSource committed_source_;
  Proposals proposals_;
  int least_bad_ = 0;
};

}  // namespace mocha
