#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planning/global/global_planner.h"
#include "planning/late_answers.h"
#include "planning/worlds.h"
#include "stack/commitment_keeping.h"
#include "stack/local_replanning.h"
#include "world/margin_budget.h"

namespace mocha {

/// How far promises lead where there is no fleet.
constexpr double kAnywhere_m = 1e6;

inline LocalReplannerOptions default_replanner_options(const RobotModel& robot) {
  return LocalReplannerOptions::from(ParameterTable::from_schema("config/local_replanner.yaml"),
                                     robot, kAnywhere_m);
}

/// The planners of one robot in simulated time, with a perfect tracker and peers that answer after
/// a step and refuse a share of the proposals.
class ClosedLoop {
 public:
  static constexpr double kStep_s = 0.1;
  static constexpr double kLease_s = 0.5;
  static constexpr double kPlanningTime_s = 0.5;
  static constexpr double kPredicted_s = 5.0;

  ClosedLoop(
      const RobotModel& robot, const OccupancyGrid& world, const Vector2& start,
      const Vector2& goal, const LocalPlanner::Watch& watch = [](LocalStage) {})
      : world(world),
        goal(goal),
        robot_(robot),
        planner_(robot, default_options()),
        replanning_(robot, ParameterTable::from_schema("config/local_replanner.yaml"), kAnywhere_m,
                    {}, watch),
        keeping_(robot, kLease_s, kAnywhere_m, answers_) {
    pose_.position = start;
  }

  void step() {
    now_s += kStep_s;
    answer();
    move();
    const LocalScene scene = this->scene();
    plan(scene);
    deliver_plan();
    const auto begin = std::chrono::steady_clock::now();
    replan(scene);
    replanner_took_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++reasons[output.reason];
    requested_ = requested_ || output.request_plan;
    if (output.lease) keeping_.renew(*output.lease);
    if (!output.proposal) return;
    ++proposals;
    emergencies += output.proposal->emergency && !committed().empty();
    propose(*output.proposal);
  }

  /// Under way on a promise that is in force, before the first step.
  void begin_with(const Motion& promised) {
    answers_.bind(
        {0, footprint_radius_m(), robot_.braking(), std::make_shared<const Motion>(promised)},
        now_s);
    pose_ = promised.at(now_s).pose;
    replanning_.set_committed({}, *answers_.binding().composed(now_s));
  }

  /// Until the robot stands at its goal; false if that takes too long.
  bool run_to_goal(double longest_s) {
    const double end_s = now_s + longest_s;
    while (now_s < end_s) {
      step();
      if ((state_.pose.position - goal).norm() < 0.15 && state_.twist.speed < 0.01) return true;
    }
    return false;
  }

  void run(double time_s) {
    for (const double end_s = now_s + time_s; now_s < end_s;) step();
  }

  LateAnswers& peers() { return answers_; }
  const LocalReplanner& replanner() const { return replanning_.replanner(); }
  const RobotState& state() const { return state_; }
  const Motion& committed() const { return replanner().committed(); }
  bool standing() const {
    return std::abs(state_.twist.speed) < 0.01 && std::abs(state_.twist.yaw_rate) < 0.01;
  }

  /// What the robot sees of the world, from where it is; all of it unless replaced.
  std::function<OccupancyGrid(const Vector2&)> see = [this](const Vector2&) { return world; };

  OccupancyGrid world;
  Vector2 goal;
  double planning_takes_s = 0.0;
  Vector2 kidnapped = Vector2::Zero();  ///< [m] added to where the motion says that the robot is
  std::vector<std::shared_ptr<const MovingObstacle>> others;
  std::vector<std::shared_ptr<const MovingObstacle>> moving;    ///< with their uncertainty
  std::vector<std::shared_ptr<const MovingObstacle>> expected;  ///< the same without

  double now_s = 1.7e9;
  LocalReplanning::Output output;
  double replanner_took_s = 0.0;  ///< wall time of its last step
  int proposals = 0;
  int emergencies = 0;  ///< but for the first promise, to stand
  int plans = 0;
  int steps_without_lease = 0;  ///< while moving
  /// Clearance beyond the static margin of the speed.
  double least_spare_m = std::numeric_limits<double>::infinity();
  double largest_jump_m =
      0.0;  ///< between where the robot is and where its speed should have brought it
  std::map<PlanReason, int> reasons;

 private:
  LocalScene scene() {
    const OccupancyGrid seen = see(state_.pose.position);
    if (!scene_.obstacles || seen.cells != seen_.cells) {
      seen_ = seen;
      scene_ = scene_of(seen);
    }
    scene_.peers = others;
    scene_.confident = moving;
    scene_.likely = expected;
    scene_.predicted_until_s = now_s + kPredicted_s;
    return scene_;
  }

  /// Of the true footprint to the true world.
  double clearance_m() {
    if (!true_field_ || world.cells != true_cells_) {
      true_cells_ = world.cells;
      true_field_ = occupied_field(world);
    }
    return mocha::clearance_m(pose_, robot_.footprint, *true_field_);
  }

  double footprint_radius_m() const { return robot_.footprint.circumscribed_radius_m(); }

  void replan(const LocalScene& scene) {
    LocalKnowledge known;
    known.measured = state_;
    known.map_age_s = known.fleet_age_s = known.prediction_age_s = 0.0;
    known.scene = [&scene](const Vector2&) { return scene; };
    output = replanning_.step(now_s, known);
  }

  void propose(const ProposedMotion& proposal) {
    CommittedTrajectory wish;
    wish.agent = LateAnswers::kAgent;
    wish.id.sequence = proposal.sequence;
    wish.state = proposal.emergency ? TrajectoryState::kEmergency : TrajectoryState::kProposed;
    wish.footprint_radius_m = footprint_radius_m();
    wish.braking = robot_.braking();
    wish.motion = std::make_shared<const Motion>(proposal.motion);
    keeping_.propose(proposal.sequence, wish, now_s);
  }

  void answer() {
    for (const Settled& settled : keeping_.tick(now_s).settled) {
      if (settled.in_force) {
        const auto& [trajectory, lease] = *settled.in_force;
        replanning_.set_committed(lease.id, *trajectory.motion);
      } else {
        replanning_.hear({Answer::Kind::kRefused, settled.sequence, ""});
      }
    }
  }

  void move() {
    const Vector2 expected = predict(state_, now_s).position;
    const bool moving = !standing();
    if (!committed().empty()) {
      const MotionState promised = committed().at(now_s);
      pose_ = promised.pose;
      state_.twist = {promised.speed, promised.yaw_rate};
    }
    state_.pose = pose_;
    state_.pose.position += kidnapped;
    state_.stamp_s = now_s;
    if (plans > 0) largest_jump_m = std::max(largest_jump_m, (pose_.position - expected).norm());
    steps_without_lease += moving && now_s > keeping_.lease_end_s();
    const SpeedMargin margin = MarginBudget::of(robot_).static_margin();
    least_spare_m =
        std::min(least_spare_m, clearance_m() - margin.at(std::abs(state_.twist.speed)));
  }

  void plan(const LocalScene& scene) {
    if (committed().empty() || !plan_.empty()) return;
    const bool has_plan = now_s < plan_end_s_ + 0.5;
    const double wait_s = requested_ ? 0.2 : has_plan ? kForever_s : 0.5;
    if (now_s < planned_s_ + wait_s - 1e-6) return;
    PlanQuery query;
    query.committed = committed();
    query.start_time_s = committed().switch_time(now_s + kPlanningTime_s);
    query.goal = goal;
    const PlanResult result = planner_.plan(query, {scene.static_map, scene.peers});
    planned_s_ = now_s + planning_takes_s;
    requested_ = false;
    ++plans;
    if (result.motion.empty()) return;
    plan_end_s_ = result.motion.end_time();
    plan_ = result.motion;
    plan_ready_s_ = now_s + planning_takes_s;
  }

  void deliver_plan() {
    if (plan_.empty() || now_s < plan_ready_s_) return;
    replanning_.set_plan(plan_);
    plan_ = Motion();
  }

  const RobotModel robot_;
  GlobalPlanner planner_;
  LateAnswers answers_;
  LocalReplanning replanning_;
  CommitmentKeeping keeping_;
  OccupancyGrid seen_;
  LocalScene scene_;
  std::vector<int8_t> true_cells_;
  std::shared_ptr<const DistanceField> true_field_;
  RobotState state_;
  Pose pose_;
  double planned_s_ = 0.0;
  Motion plan_;  // made, but not ready yet
  double plan_ready_s_ = 0.0;
  double plan_end_s_ = 0.0;
  bool requested_ = false;
};

}  // namespace mocha
