#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/fleet_options.h"
#include "fleet/wire/datagram_link.h"
#include "stack/robot_stack.h"
#include "world/distances/distance_field.h"
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

/// What planning of one robot came to. Times are of the wall clock, or where one thread does all,
/// of its work.
struct PlanningRecord {
  std::vector<double> plans_s;  ///< of each global plan
  std::vector<double> steps_s;  ///< of each step of the local replanner
  double protocol_s = 0.0;      ///< of everything that the protocol did
  double news_s = 0.0;          ///< of taking over what the peers have promised
  int paths = 0;                ///< most that were optimised for one plan
  int leases_lost = 0;          ///< the robot had to brake because nothing was proved in time
  int breaches = 0;             ///< promises of others that met the own binding one
  std::map<std::string, int> refusals;
};

/// Measures the time that a protocol takes.
class TimedProtocol : public SettlingProtocol {
 public:
  /// `one_thread`: its work alone is measured, else the wall clock.
  TimedProtocol(std::unique_ptr<SettlingProtocol> protocol, bool one_thread);

  CommitmentActions propose(const Proposal& proposal, double now) override;
  CommitmentActions brake(const Proposal& proposal, double now) override;
  CommitmentActions receive(const CommittedTrajectory& trajectory, double now) override;
  CommitmentActions receive(const Heartbeat& heartbeat, double now) override;
  CommitmentActions tick(double now) override;
  std::uint32_t epoch() const override { return protocol_->epoch(); }
  const PeerTable& peers() const override { return protocol_->peers(); }
  const ReservationChain& binding() const override { return protocol_->binding(); }

  double took_s() const { return took_s_; }

 private:
  template <typename Call>
  CommitmentActions timed(Call call);

  const std::unique_ptr<SettlingProtocol> protocol_;
  const bool one_thread_;
  double took_s_ = 0.0;
};

/// The stack of one robot with its datagrams and a tracker, in simulated time, and what planning
/// came to.
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
  bool breached() const { return stack_.step_is_due(); }

  bool reached() const { return reached_; }
  PlanningRecord record() const;
  const std::string& name() const { return name_; }

 private:
  /// In good time before a plan: that is no part of it.
  void take_news(double now_s);
  /// Follows what is in force, if it fits, and packs what is to be said.
  std::vector<Bytes> apply(const RobotStack::Messages& messages, double now_s);

  const std::string name_;
  const RobotModel robot_;
  const FleetAgent agent_;
  const FleetOptions options_;
  TimedProtocol protocol_;
  RobotStack stack_;
  DatagramLink link_;
  Motion driven_;  // what the tracker follows
  MotionId driven_id_;
  bool reached_ = false;
  PlanningRecord record_;
};

}  // namespace mocha
