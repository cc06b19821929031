#pragma once

#include "fleet/model/protocol_model.h"
#include "fleet/model/state_hash.h"

namespace mocha {

/// Makes fingerprints of whole states: models that have the same one go on alike. Every class
/// whose state may change is taken apart by a structured binding, which does not compile any more
/// once a member is added or taken away: so none is forgotten.
///
/// What cannot change anything that happens in a model is left out, where a comment says why.
class ProtocolFingerprint {
 public:
  static test::Fingerprint of(const test::ProtocolModel& model);

 private:
  explicit ProtocolFingerprint(double now_s) : now_s_(now_s) {}

  void add(const test::RobotState& robot);
  void add(const test::MessageUnderWay& message);
  void add(const test::Message& message);
  void add(const test::DrivenPromises& driven);
  void add(const CommitmentProtocol& protocol);
  void add(const CommitmentProtocol::Pending& pending);
  void add(const PeerTable& peers);
  void add(const Peer& peer, double reach_timeout_s);
  void add(const PeerClock& clock);
  void add(const ReservationChain& chain);
  void add(const CommittedTrajectory& trajectory);
  void add(const Heartbeat& heartbeat);
  void add(const Acknowledgement& line);
  void add(TrajectoryId id);
  void add(const Motion& motion);
  void add(const Phase& phase);
  void add(const Pose& pose);
  /// A moment after which something happens: only whether it has passed matters, once it has.
  void add_next(double time_s);
  /// A moment that counts for a while: not any more once that is over.
  void add_last(double time_s, double lasts_s);
  template <typename Range>
  void add_each(const Range& range);

  double now_s_;  // by the clock of whose state it is
  test::StateHash hash_;
};

}  // namespace mocha
