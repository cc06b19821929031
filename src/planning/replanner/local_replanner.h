#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "control/robot_state.h"
#include "planning/candidates/plan_kind.h"
#include "planning/local/detour.h"
#include "planning/replanner/certified_part.h"
#include "planning/replanner/ladder.h"
#include "planning/replanner/local_replanner_options.h"
#include "planning/replanner/proposals.h"

namespace mocha {

/// Turns plans into promises. In each step it certifies the promise in force again, says in what
/// situation the robot is, and goes down the ladder of that situation (ladder.h): the first motion
/// that is certified is proposed. Pure decisions: time and measurements come in, proposals go out.
class LocalReplanner {
 public:
  struct Output {
    Row row = Row::kKeep;
    std::optional<ProposedMotion> proposal;
    bool renew_lease = false;  ///< the motion in force was certified again, or is the last resort
    bool request_plan = false;
    PlanReason reason = PlanReason::kSolved;
    Violation violation;
    std::string message;
    std::optional<LocalPlan> local;  ///< what local planning found, if there was need for it
    bool swerves = false;            ///< that is the plan now, and proposed
    bool keeps_plan = false;         ///< an offered plan was no improvement
  };

  LocalReplanner(
      const RobotModel& robot, const LocalReplannerOptions& options,
      const LocalOptions& local_options, const LocalPlanner::Watch& watch = [](LocalStage) {});

  /// The newest plan to the goal. An empty motion means that there is nothing to drive to: what is
  /// in force is left by braking along it, at once. A plan that leads to where the one at hand
  /// leads is passed over where it meets something that moves, and that one does not or later.
  void set_plan(Motion plan, PlanKind kind = PlanKind::kFree);
  /// The motion in force, as the broadcaster says. Sequences of own proposals continue after it.
  void set_committed(std::uint32_t sequence, Motion motion);
  /// The proposal was turned down.
  void on_refusal(std::uint32_t sequence);

  Output step(double now_s, const RobotState& measured, const LocalScene& scene);
  /// Instead, while data without which nothing can be certified are missing: what is in force is
  /// left by braking along it, at once.
  Output stop_blind(double now_s);
  /// Instead, while the robot is stopped for an emergency: the plan is dropped, and what is
  /// promised is what the robot does: it stops as hard as its wheels can and stands, wherever it is
  /// pushed.
  Output halt(double now_s, const RobotState& measured);

  const Motion& committed() const { return committed_; }
  /// What is being followed: the newest plan, or what local planning made of it.
  const Motion& plan() const { return plan_; }
  /// How many steps ended in that row.
  int count(Row row) const { return counts_[static_cast<std::size_t>(row)]; }

 private:
  /// One step's data and result.
  struct Step {
    ManeuverStart start;
    Situation situation = Situation::kHolds;
    Violation violation;         ///< of the promise in force
    bool plan_is_clear = false;  ///< it is not what is in the way, but that no more is promised
    bool pending = false;        ///< a proposal waits for its answer
    bool searched = false;       ///< for detours
    Output output;
  };
  enum class Climb { kProposed, kNext, kKeep };

  Output decide(double now_s, const RobotState& measured, const LocalScene& scene);
  Output counted(Output output);
  ManeuverStart start_at(double now_s, const LocalScene& scene) const;
  Vector2 target_at(double now_s) const;
  void take_offer(double now_s, const LocalScene& scene, Output& output);
  void replace_plan(Motion plan, PlanKind kind = PlanKind::kFree);
  /// The plan leads farther than what is in force.
  bool under_way() const;
  Violation conflict(const Motion& plan, double now_s, const LocalScene& scene,
                     RequirementName trigger, double horizon_s) const;
  bool waits_for_answer(const Step& step) const;
  void assess(Step& step) const;
  /// Whether anything came of it.
  bool go_down_the_ladder(Situation situation, Step& step);
  Climb try_rung(const Rung& rung, Step& step);
  Climb try_follow(Step& step);
  Maneuvers maneuvers(const Rung& rung, Step& step);
  Maneuvers stops(const Step& step) const;
  Maneuvers detours(const Rung& rung, Step& step);
  Maneuvers rejoining_sooner(Step& step);
  Maneuvers emergency_detours(Step& step);
  Maneuvers detour(const Step& step, const char* words) const;
  Detour::Start detour_start(const Step& step) const;
  /// The plan, from where it meets what is committed; nothing where no more of it is due.
  std::optional<Maneuver> following(Step& step);
  /// What of it may be promised. In turn, a robot that rests waits until its way is free, and
  /// nothing is taken back because of a team-mate: others count on it.
  std::optional<CertifiedPart> certified_of(Maneuver& maneuver, const Step& step);
  /// Whether less of the plan's way would be promised than is.
  bool takes_back(const CertifiedPart& part) const;
  /// Makes what local planning found the plan.
  void take_detour(const Rung& rung, Step& step);
  void propose(const Rung& rung, const Maneuver& maneuver, const CertifiedPart& part, Step& step);
  void report(const Rung& rung, const char* words, Step& step) const;
  /// Says why no more is promised.
  static void object(const Violation& violation, const std::string& why, Output& output);
  static void ask_for_plan(const Violation& violation, const std::string& why, Output& output);

  bool off_track(double now_s, const RobotState& measured) const;
  /// How far off its promise the robot may be [m].
  double max_error_m(double now_s) const;
  void stand_or_stop(double now_s, const RobotState& measured, Output& output);
  void stop_here(double now_s, const RobotState& measured, Output& output);
  /// What is in force is where the robot is, and at rest no later than it will be.
  bool is_promised(const Motion& stop, double now_s) const;
  bool announced_stop(double now_s) const;
  /// Braking along what is in force, at once, or standing where that has not begun to move;
  /// nothing where it, or what is proposed, comes to rest as soon.
  std::optional<Motion> sooner_stop(double now_s) const;
  bool has_nothing_to_drive_to() const { return plan_id_ > 0 && plan_.empty(); }
  /// Says what the robot does in any case.
  void announce(double now_s, const Motion& motion, bool brakes, Row row, Output& output);

  bool follows_plan_at(double t) const {
    return committed_source_.plan == plan_id_ && committed_source_.follows_until_s >= t;
  }

  const RobotModel robot_;
  const Requirements requirements_;
  const LocalReplannerOptions options_;
  Detour detour_;
  struct Offer {
    Motion plan;
    PlanKind kind;
  };
  std::optional<Offer> offered_;
  Motion plan_;  // what is followed: the newest plan, or a detour
  PlanKind kind_ = PlanKind::kFree;
  std::uint32_t plan_id_ = 0;
  RequirementName plan_required_ = RequirementName::kPromise;  // what its promises are held to
  Motion committed_;
  PromiseSource committed_source_;
  Proposals proposals_;
  std::array<int, static_cast<std::size_t>(Row::kLastResort) + 1> counts_ = {};
};

}  // namespace mocha
