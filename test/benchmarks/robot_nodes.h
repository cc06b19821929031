#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/broadcaster_node.h"
#include "benchmarks/fleet_options.h"
#include "benchmarks/fleet_robot.h"
#include "control/trajectory_tracker.h"
#include "perception/tracking/peer_tracks.h"
#include "stack/goal_planning.h"
#include "stack/local_replanning.h"
#include "world/moving/prediction.h"

namespace mocha {

enum class RobotNode { kGlobalPlanner, kLocalReplanner, kBroadcaster, kTracker };
constexpr std::array<RobotNode, 4> kRobotNodes = {RobotNode::kGlobalPlanner,
                                                  RobotNode::kLocalReplanner,
                                                  RobotNode::kBroadcaster, RobotNode::kTracker};

/// What a robot's sensors and its perception say.
struct RobotSenses {
  RobotState measured;
  std::shared_ptr<const FleetMap> map;
  Predictions predictions;
};

/// The planning nodes of one robot, without ROS and in simulated time, any of which may end and
/// start anew at any time. What a node knows ends with it; started again it knows what is latched
/// by the others that run, and the broadcaster counts its epochs, as src/nodes/*_node.cpp have it.
/// Messages between them take no time; to a node that does not run they are lost.
class RobotNodes {
 public:
  using Bytes = DatagramLink::Bytes;
  using Datagrams = BroadcasterNode::Datagrams;

  /// What became of its promises, over all restarts.
  struct Counts {
    int breaches = 0;
    int lease_stops = 0;
    int refusals = 0;
  };

  /// None of them runs yet.
  RobotNodes(std::string name, const FleetOptions& options);

  void start(RobotNode node, double now_s);
  void end(RobotNode node);
  bool runs(RobotNode node) const;

  // Each returns the datagrams for all others.
  Datagrams hear(const Bytes& datagram, double now_s);
  /// trajectory_broadcaster, in each of its periods, and so on.
  Datagrams settle(double now_s);
  Datagrams pursue(double now_s, const RobotSenses& senses);
  Datagrams replan(double now_s, const RobotSenses& senses);
  /// What trajectory_tracker commands; nothing where it does not run.
  std::optional<UnicycleState> drive(double now_s, const RobotState& measured);

  /// The local replanner has news for which it does not wait for its period.
  bool replanning_is_due() const { return replanner_ && replanner_->replanning.step_is_due(); }

  /// A goal for the global planner, which has to run.
  void go_to(const Vector2& goal, double now_s);
  /// The global planner runs and has no goal.
  bool is_idle() const { return planner_ && planner_->planning.executive().idle(); }
  /// How the goal ended in the last pursue().
  GoalExecutive::Ending ending() const { return ending_; }

  /// Whether perception takes a robot that is seen there for a team-mate: one has promised that.
  bool expects_at(const Vector2& place, double now_s) const;

  /// For people: what each of the planners is about.
  std::string words() const;
  Counts counts() const;
  const std::string& name() const { return name_; }

 private:
  struct Plan {
    Motion motion;
    PlanKind kind;
  };
  /// `fleet/trajectories`, as the nodes make use of it.
  struct Fleet {
    double stamp_s;
    std::vector<std::shared_ptr<const MovingObstacle>> obstacles;
    std::vector<PeerMotion> motions;
  };
  struct Planner {
    Planner(const RobotNodes& robot);
    InlinePlanRunner runner;
    GoalPlanning planning;
    Motion committed;
    std::shared_ptr<const Fleet> fleet;
  };
  struct Replanner {
    Replanner(const RobotNodes& robot);
    LocalReplanning replanning;
    std::shared_ptr<const Fleet> fleet;
  };
  Datagrams apply(BroadcasterNode::Output output, double now_s);
  void propose(const ProposedMotion& proposal, double now_s, Datagrams& sent);
  void answer(const Answer& answer);
  void renew(const Lease& lease);
  void commit(const MotionInForce& in_force, bool gives_lease);
  void publish_fleet(const std::vector<CommittedTrajectory>& promises, double now_s);
  void report(const LocalReplanning::Output& output, double now_s);
  void tell_driven();

  const std::string name_;
  const RobotModel robot_;
  const FleetOptions options_;
  const ParameterTable global_values_;
  const ParameterTable local_values_;
  std::uint32_t epoch_ = 0;  // in its file

  std::unique_ptr<Planner> planner_;
  std::unique_ptr<Replanner> replanner_;
  std::unique_ptr<BroadcasterNode> broadcaster_;
  std::unique_ptr<TrajectoryTracker> tracker_;

  // Latched topics, while their node runs.
  std::optional<Plan> plan_;
  std::optional<GoalExecutive::Report> report_;  // of the local replanner
  std::optional<OwnMotion> committed_;
  std::optional<OwnMotion> driven_;
  std::shared_ptr<const Fleet> fleet_;

  const double peer_margin_m_;
  PeerTracks peer_tracks_;  // of perception, which does not end
  GoalExecutive::Ending ending_ = GoalExecutive::Ending::kNone;
  std::string words_;
  std::string local_words_;
  int driven_motions_ = 0;
  Counts former_;  // of former epochs
};

}  // namespace mocha
