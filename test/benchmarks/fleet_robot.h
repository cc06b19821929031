#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "benchmarks/one_phase.h"
#include "fleet/commitment.h"
#include "fleet/datagram_link.h"
#include "planning/global_planner.h"
#include "planning/local_replanner.h"
#include "planning/pursuit.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// What a robot knows of its surroundings from the beginning on.
struct FleetMap {
  explicit FleetMap(const OccupancyGrid& grid);

  std::shared_ptr<const DistanceField> obstacles;
  std::shared_ptr<const DistanceField> unseen;
  std::shared_ptr<const Terrain> terrain;
};

struct FleetAgent {
  Pose start;
  Vector2 goal;
  std::shared_ptr<const FleetMap> map;
};

enum class Protocol { kOnePhase, kTwoPhase };

/// How a fleet runs; whatever is not named here is as config/ says.
struct FleetRules {
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

  FleetRobot(std::string name, const FleetAgent& agent, const FleetRules& rules);

  // Each returns the datagrams for all others.
  std::vector<Bytes> hear(const Bytes& datagram, double now_s);
  std::vector<Bytes> tick(double now_s);
  /// A step of the local replanner.
  std::vector<Bytes> propose(double now_s);
  /// A step of the global planner.
  std::vector<Bytes> pursue(double now_s);

  /// Where it really is, and how it moves. Brakes from here on where its lease has expired.
  RobotState state(double now_s);

  bool reached() const { return reached_; }
  const PlanningRecord& record() const { return record_; }
  const std::string& name() const { return name_; }

 private:
  std::vector<Bytes> apply(const CommitmentActions& actions, double now_s);
  void report(const CommitmentEvent& event, double now_s);
  void adopt(std::uint32_t sequence, const Motion& committed, double now_s);
  void refresh_peers(double now_s);
  PlanResult plan(const PlanQuery& query);
  const PeerTable& peers() const;
  const PromiseChain& binding() const;
  template <typename Call>
  auto timed(double& took_s, Call call) const;
  template <typename Call>
  std::vector<Bytes> with_protocol(double now_s, Call call);

  const std::string name_;
  const RobotModel robot_;
  const FleetAgent agent_;
  const FleetRules rules_;
  const GlobalPlanner planner_;
  Pursuit pursuit_;
  LocalReplanner replanner_;
  std::variant<Commitment, OnePhase> protocol_;
  DatagramLink link_;
  const double lease_s_;
  Motion driven_;  // what the tracker follows
  double leased_until_s_ = 0.0;
  bool brakes_ = false;  // since the lease expired, until the next motion
  std::uint32_t proposed_ = 0;
  std::map<std::string, PromiseId> known_;
  std::vector<std::shared_ptr<const MovingObstacle>> others_;
  double refresh_at_s_ = 0.0;
  bool reached_ = false;
  PlanningRecord record_;
};

}  // namespace mocha
