#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/fleet_options.h"
#include "fleet/protocol/commitment_protocol.h"
#include "fleet/wire/datagram_link.h"
#include "planning/replanner/proposals.h"
#include "stack/commitment_keeping.h"

namespace mocha {

/// A motion of the robot itself, as the topics within a robot number it.
struct OwnMotion {
  MotionId id;
  Motion motion;
};

/// What trajectory_broadcaster does, without ROS. It is silent until it knows what is driven.
class BroadcasterNode {
 public:
  using Datagrams = std::vector<DatagramLink::Bytes>;

  /// What follows from a call.
  struct Output {
    struct Result {
      Settled settled;
      bool gives_lease = true;  ///< else whether it is driven on is for the replanner to say
    };

    Datagrams sent;  ///< to all others
    std::vector<Result> results;
    std::optional<PassingMessage> passing;                  ///< heard, for the global planner
    std::optional<std::vector<CommittedTrajectory>> fleet;  ///< what the others have promised
  };

  BroadcasterNode(const std::string& name, const RobotModel& robot, std::uint32_t epoch,
                  double first_lease_s, const FleetOptions& options);

  /// What the tracker says that it drives; empty: nothing.
  void hear_driven(const OwnMotion& driven) { driven_ = driven; }
  void renew(const Lease& lease) { keeping_.renew(lease); }
  Output hear(const DatagramLink::Bytes& datagram, double now_s);
  /// Throws std::invalid_argument for what cannot be promised.
  Output propose(const ProposedMotion& proposal, double now_s);
  /// In each period.
  Output settle(double now_s);
  /// What the own global planner says to the others.
  Datagrams relay(PassingMessage message);

  const CommitmentKeeping::Counts& counts() const { return keeping_.counts(); }

 private:
  CommittedTrajectory wish_of(std::uint32_t sequence, const Motion& motion, bool emergency) const;
  void wake_up(double now_s, Output& output);
  void add(const CommitmentNews& news, Output& output);
  void send(const FleetMessage& message, Datagrams& sent);

  const std::string name_;
  const RobotModel robot_;
  CommitmentProtocol protocol_;
  CommitmentKeeping keeping_;
  DatagramLink link_;
  bool awake_ = false;
  std::optional<double> wake_up_s_;
  std::optional<OwnMotion> driven_;
};

}  // namespace mocha
