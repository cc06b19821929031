#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "benchmarks/one_phase.h"
#include "control/lease.h"
#include "fleet/protocol/commitment_protocol.h"
#include "fleet/wire/datagram_link.h"
#include "planning/executive/goal_executive.h"
#include "planning/global/global_planner.h"
#include "planning/replanner/local_replanner.h"
#include "world/distance_field.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// What a robot knows of its surroundings from the beginning on.
struct FleetMap {
  explicit FleetMap(const OccupancyGrid& grid);

  std::shared_ptr<const DistanceField> obstacles;
  std::shared_ptr<const DistanceField> unseen;
  std::shared_ptr<const StaticMap> static_map;
};

struct FleetAgent {
  Pose start;
  Vector2 goal;
  std::shared_ptr<const FleetMap> map;
};

enum class Protocol { kOnePhase, kTwoPhase };

/// How a fleet runs; whatever is not named here is as config/ says.
struct FleetOptions {
  Protocol protocol = Protocol::kTwoPhase;
  double delta_dc_s = 0.06;
  double settle_s = 0.3;          ///< settle_time of the local replanner
  double tracking_error_m = 0.0;  ///< of the true place off the promised one, in turning directions
  int planning_threads = 0;       ///< 0: one on each core
};

/// What planning of one robot came to. Times are of the wall clock, or where one thread does all,
/// of its work.
struct PlanningRecord {
  std::vector<double> plans_s;  ///< of each global plan
  std::vector<double> steps_s;  ///< of each step of the local replanner
  double protocol_s = 0.0;      ///< of everything that the protocol did
  int paths = 0;                ///< most that were optimised for one plan
  int leases_lost = 0;          ///< the robot had to brake because nothing was proved in time
  int breaches = 0;             ///< promises of others that met the own binding one
  std::map<std::string, int> refusals;
};

/// The three planning nodes of one robot and a tracker, in simulated time: plans, proposals,
/// promises and leases go from one to the next as they do over topics, without delay.
class FleetRobot {
 public:
  using Bytes = std::vector<std::uint8_t>;

  FleetRobot(std::string name, const FleetAgent& agent, const FleetOptions& options);

  // Each returns the datagrams for all others.
  std::vector<Bytes> hear(const Bytes& datagram, double now_s);
  std::vector<Bytes> tick(double now_s);
  /// A step of the local replanner.
  std::vector<Bytes> propose(double now_s);
  /// A step of the global planner.
  std::vector<Bytes> pursue(double now_s);

  /// Where it really is, and how it moves.
  RobotState state(double now_s) const;
  /// It has heard of a promise that meets its own since its last step: another is due at once.
  bool breached() const { return breached_; }

  bool reached() const { return reached_; }
  const PlanningRecord& record() const { return record_; }
  const std::string& name() const { return name_; }

 private:
  std::vector<Bytes> apply(const CommitmentActions& actions, double now_s);
  void report(const CommitmentEvent& event, double now_s);
  void adopt(std::uint32_t sequence, const Motion& committed, double now_s);
  Proposal proposal(std::uint32_t sequence, const Motion& motion) const;
  void refresh_peers(double now_s);
  PlanResult plan(const PlanQuery& query);
  PlanningScene scene() const { return {agent_.map->static_map, others_}; }
  const PeerTable& peers() const;
  const ReservationChain& binding() const;
  template <typename Call>
  auto timed(double& took_s, Call call) const;
  template <typename Call>
  std::vector<Bytes> with_protocol(double now_s, Call call);

  const std::string name_;
  const RobotModel robot_;
  const FleetAgent agent_;
  const FleetOptions options_;
  const GlobalPlanner planner_;
  GoalExecutive executive_;
  LocalReplanner replanner_;
  std::variant<CommitmentProtocol, OnePhase> protocol_;
  DatagramLink link_;
  const double lease_s_;
  Motion driven_;  // what the tracker follows
  MotionId driven_id_;
  LeaseWatch lease_;
  bool breached_ = false;
  std::uint32_t proposed_ = 0;
  std::vector<std::pair<std::string, TrajectoryId>> known_;
  std::vector<std::shared_ptr<const MovingObstacle>> others_;
  double refresh_at_s_ = 0.0;
  bool reached_ = false;
  PlanningRecord record_;
};

}  // namespace mocha
