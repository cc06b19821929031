#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "stack/commitment_keeping.h"
#include "stack/goal_planning.h"
#include "stack/local_replanning.h"

namespace mocha {

/// What the local replanner is told of a settlement.
Answer answer_of(const Settled& settled);

/// The brain of one robot between the map and the wheels: goal planning, local replanning and
/// commitment keeping, wired as the nodes are by topics, but without delay. Each call returns what
/// is to be said to all peers.
class RobotStack {
 public:
  using Messages = std::vector<FleetMessage>;

  /// Values of config/global_planner.yaml and config/local_replanner.yaml, and what follows from
  /// them for the fleet.
  struct Parameters {
    ParameterTable global_planner;
    ParameterTable local_replanner;
    Reach reach;
  };

  /// The protocol must outlive this.
  RobotStack(std::string name, const RobotModel& robot, const Parameters& parameters,
             SettlingProtocol& protocol);

  void take(std::deque<Goal> goals, double now_s);
  /// Drops all goals. The robot brakes at once: a step is due.
  void stop();
  /// The same, but the goals are kept until it is resumed.
  void pause();
  void resume() { planning_.executive().resume(); }
  Messages hear(const FleetMessage& message, double now_s);
  /// As often as trajectory_broadcaster: follows leases and settles.
  Messages tick(double now_s);
  /// Takes over what the peers have promised, where there is news of it; both calls below begin
  /// with it.
  void refresh_peers(double now_s);
  /// As often as local_replanner, and where step_is_due(). The peers are added to the scene.
  Messages replan(double now_s, const RobotState& measured, LocalScene scene);
  /// As often as global_planner. The peers are added to the scene.
  Messages pursue(double now_s, const RobotState& measured, const PlanningScene& scene);

  bool step_is_due() const { return replanning_.step_is_due(); }
  /// The motion in force, which the tracker follows, and its number.
  const Motion& committed() const { return replanning_.replanner().committed(); }
  const MotionId& committed_id() const { return replanning_.committed_id(); }

  bool idle() const { return planning_.executive().idle(); }
  ExecutiveState state() const { return planning_.executive().state(); }
  /// What the last pursue() came to.
  const GoalExecutive::Output& pursued() const { return pursued_; }
  /// What the last replan() came to.
  const LocalReplanning::Output& replanned() const { return replanned_; }
  const CommitmentKeeping::Counts& counts() const { return keeping_.counts(); }

 private:
  Messages propose(const ProposedMotion& proposal, double now_s);
  Messages apply(CommitmentNews news);

  const std::string name_;
  const double radius_m_;
  const Braking braking_;
  SettlingProtocol& protocol_;
  InlinePlanRunner runner_;
  GoalPlanning planning_;
  LocalReplanning replanning_;
  CommitmentKeeping keeping_;
  std::vector<std::shared_ptr<const MovingObstacle>> peers_;
  GoalExecutive::Output pursued_;
  LocalReplanning::Output replanned_;
};

}  // namespace mocha
