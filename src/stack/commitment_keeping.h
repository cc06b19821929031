#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/lease.h"
#include "fleet/protocol/settling_protocol.h"
#include "fleet/wire/wire_format.h"
#include "world/robot_model.h"

namespace mocha {

/// How often the promises of the peers are told to the planners, though they are the same.
constexpr double kFleetPeriod_s = 0.5;

/// What is driven from now on: a new promise and, until it starts, the one before it. The lease is
/// the first one; its id has the proposer's number.
struct MotionInForce {
  CommittedTrajectory trajectory;
  Lease lease;
};

/// What became of a proposal, or of the motion in force.
struct Settled {
  CommitmentEvent event;
  std::uint32_t sequence = 0;             ///< the proposer's number of that motion
  std::optional<MotionInForce> in_force;  ///< where the proposal is binding
};

/// What follows from a call, in this order.
struct CommitmentNews {
  std::optional<std::uint32_t> lease_ended;  ///< of that motion: the robot brakes, and promises so
  std::string unsaid;                        ///< why the others cannot be told of that stop
  std::vector<FleetMessage> messages;        ///< to all peers
  std::vector<Settled> settled;
};

/// Keeps the promises of one robot: has its proposals settled, numbers what is in force as the
/// proposer did, follows its lease, and promises the stop that the tracker makes when the lease
/// ends.
class CommitmentKeeping {
 public:
  struct Counts {
    std::map<std::string, int> refusals;  ///< by reason
    int breaches = 0;
    int lease_stops = 0;
  };

  /// `first_lease_s`: of each newly binding motion. Of peers beyond `radio_range_m`, which mostly
  /// are not heard, the planners are not told. The protocol must outlive this.
  CommitmentKeeping(const RobotModel& robot, double first_lease_s, double radio_range_m,
                    SettlingProtocol& protocol);

  /// A motion that the robot wants to drive, kProposed or kEmergency, under the proposer's number,
  /// rounded as the others hear it. `stop`: why emergency motions alone are promised; empty: all
  /// are. Throws std::invalid_argument for what cannot be promised.
  CommitmentNews propose(std::uint32_t sequence, const CommittedTrajectory& wish, double now_s,
                         const std::string& stop = "");
  /// After a start, first of all: promises what is left of the motion that the tracker drives
  /// already, which a former epoch may have promised. It keeps its number. Throws like propose().
  CommitmentNews resume(const CommittedTrajectory& driven, double now_s);
  CommitmentNews receive(const CommittedTrajectory& promise, double now_s);
  CommitmentNews receive(const Heartbeat& heartbeat, double now_s);
  void renew(const Lease& lease) { lease_.renew(lease.id, lease.end_s); }
  CommitmentNews tick(double now_s);

  /// What the peers have promised, from now on, where the planners are to hear of it: it has
  /// changed, or kFleetPeriod_s is over.
  std::optional<std::vector<CommittedTrajectory>> fleet_news(double now_s);

  double lease_end_s() const { return lease_.end_s(); }
  const Counts& counts() const { return counts_; }

 private:
  void stop_where_the_lease_ended(double now_s, CommitmentNews& news);
  void add(const CommitmentActions& actions, double now_s, CommitmentNews& news);
  Settled settled(const CommitmentEvent& event, double now_s);
  bool matters(const Peer& peer, double now_s) const;
  MotionInForce commit(const CommitmentEvent& event, double now_s);

  const RobotModel robot_;
  const double first_lease_s_;
  const double radio_range_m_;
  SettlingProtocol& protocol_;
  LeaseWatch lease_;
  std::uint32_t committed_sequence_ = 0;
  std::uint32_t stop_sequence_ = 0;                    // of the newest stop without a lease
  std::uint32_t newest_sequence_ = 0;                  // proposed, or given to a stop
  std::vector<std::pair<TrajectoryId, double>> told_;  // the peers' promises, and their starts
  double tell_again_s_ = 0.0;
  Counts counts_;
};

}  // namespace mocha
