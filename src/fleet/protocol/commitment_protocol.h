#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fleet/protocol/commitment_options.h"
#include "fleet/protocol/heartbeat_lines.h"
#include "fleet/protocol/meetings.h"
#include "fleet/protocol/neighbourhood.h"
#include "fleet/protocol/settling_protocol.h"

namespace mocha {

/// The propose / settle protocol of one robot, as a state machine: time is an argument, messages go
/// in and come out.
///
/// Rules. A proposal is sent to all. It becomes binding after delta_dc, as soon as every near peer
/// (Neighbourhood) in reach (a heartbeat heard within reach_timeout) has endorsed it in a
/// heartbeat, if it meets nothing: two motions meet where their centres come closer than the two
/// radii plus peer_clearance at any time from now on, or (with stops) where one robot, braking
/// along its path at some moment, and the other, braking along its own after the reaction time,
/// would come closer than the radii plus stop_clearance. It must be settled before it starts, and
/// must begin where the binding motion will be then (5 cm). A binding promise is never displaced.
/// Of two pending proposals that meet, the lower in rank (priority, then name) is withdrawn; the
/// other waits for the news of that, or loses to it if it became binding first. A robot endorses a
/// proposal that it has seen unless that meets its own binding promise or its own pending proposal
/// of higher rank; it says so at once, or within kAnswerPeriod_s of the last time, together with
/// whatever else it endorses until then: a fleet of N robots that all plan anew sends N heartbeats
/// more in that time, not N^2. Emergency motions bind at once.
///
/// A model checker tries all that can happen to two and three robots within bounds, room to brake
/// aside: test/fleet/model.
///
/// Why two motions a and b that meet never both settle while their robots A and B are in reach of
/// each other, whatever is lost, late or out of order: suppose they did. When A endorsed b, A had
/// not promised a, nor was a pending (A would have withdrawn a, or not endorsed b). So A proposed a
/// after it endorsed b, hence after b was proposed. By the same argument b was proposed after a.
/// Both robots decide alike because only the lower in rank gives way, and the rank is in the
/// messages. An endorsement that waits to be sent is one that the network delays. One always
/// wins, because waiting follows the rank, which has no cycles, and ends at the start of the
/// motion. Why it also holds without endorsements (peers not yet known to be in reach) where
/// messages take less than delta_dc: of two checks that overlap, one robot at least hears of the
/// other's proposal before the end of its own check, and then yields or waits for the other's
/// outcome; of two that do not, the later one starts after the earlier motion is binding, and hears
/// so before it ends.
///
/// Why peers that are not near need not be asked: at any moment, all that two robots have promised
/// or proposed lies within their promise reaches of where they are (Reach). Where both settle
/// without having asked, they are not near as the later one settles, and so the motions do not
/// meet. Where A has asked B, and B endorsed a, B had not settled b then, or it would have
/// objected. Where b was pending, B withdrew it or objected. Where B proposed b later, it held b
/// against a, which it had endorsed.
///
/// What a robot may assume: while two robots keep their binding promises, their centres stay radii
/// plus clearance apart, less the tracking errors of both. So a robot that keeps its promise is not
/// hit by another that does. With stops, it is not hit either by a robot that brakes along its
/// promised path, if it hears of that and brakes within the reaction time, each as it promised to
/// brake. Assumed are: one map frame (its errors belong into the margins), clocks that agree as
/// ClockOptions say or were measured (PeerTable; nothing is endorsed or settled with a peer in
/// reach whose clock is not known), a robot that after a restart makes binding, before it hears or
/// says anything, what it is driving (its peers keep the former epoch's promise until then, but
/// where they have not heard of that, only this robot can object), unique names, true radii and
/// braking, and robots that hear each other within a reach timeout where they are closer than the
/// radio range, and while they settle, or messages faster than delta_dc. An emergency motion breaks
/// a promise. It is sent to all at once, and a robot whose own promise meets it is told (kBreached)
/// and has to brake in turn; until it stands, those two have only their planners' margins. Robots
/// that already are closer than demanded (after braking, or set down so) may move as long as they
/// come no closer.
class CommitmentProtocol : public SettlingProtocol {
 public:
  enum class State {
    kListening,  ///< since the start, for one reach_timeout: nothing may be proposed
    kIdle,       ///< nothing binding, nothing pending
    kProposing,  ///< nothing binding, a proposal pending
    kBound,      ///< a binding motion, nothing pending
    kRevising,   ///< a binding motion, and a proposal to follow it
  };

  /// Endorsements that come up within this time of the last ones wait, and go together. Well below
  /// any useful delta_dc, so that no proposal settles later than it would anyway.
  static constexpr double kAnswerPeriod_s = 0.025;

  /// Throws std::invalid_argument for options out of range.
  explicit CommitmentProtocol(CommitmentOptions options);

  // Every call moves the protocol on to `now` [s], which must not decrease.

  /// Offers a motion; one that is pending is withdrawn. Throws std::invalid_argument for what
  /// cannot be promised at all (validate()), without any effect.
  CommitmentActions propose(const Proposal& proposal, double now) override;
  /// Makes a braking motion binding at once. Throws like propose().
  CommitmentActions brake(const Proposal& proposal, double now) override;
  /// A validated message of another robot. One that carries our own name is ignored and counted.
  CommitmentActions receive(const CommittedTrajectory& trajectory, double now) override;
  CommitmentActions receive(const Heartbeat& heartbeat, double now) override;
  CommitmentActions tick(double now) override;

  State state() const;
  std::uint32_t epoch() const override { return options_.epoch; }
  const CommitmentOptions& options() const { return options_; }
  const PeerTable& peers() const override { return peers_; }
  const ReservationChain& binding() const override { return binding_; }
  int impostors() const { return impostors_; }

 private:
  friend class ProtocolFingerprint;  // of test/fleet/model

  struct Pending {
    CommittedTrajectory trajectory;
    Proposal proposal;
    double since_s;
  };

  CommittedTrajectory trajectory_of(const Proposal& proposal, TrajectoryState state) const;
  CommittedTrajectory send(CommittedTrajectory trajectory, CommitmentActions& actions);
  void listen(double now);
  void heed(const std::string& name, double now, CommitmentActions& actions);
  void advance(double now, CommitmentActions& actions);
  void carry_on(double now, CommitmentActions& actions);
  void settle(double now, CommitmentActions& actions);
  void bind_pending(CommitmentActions& actions);
  void drop_pending(CommitmentEvent::Kind kind, Refusal refusal, const Conflict& conflict,
                    CommitmentActions& actions);
  void answer(double now);
  void answer(const std::string& name, const Peer& peer, double now);
  void keep_in_touch(double now, CommitmentActions& actions);
  void send_again(double now, CommitmentActions& actions);
  void report_breach(const std::string& name, double now, CommitmentActions& actions) const;

  Meetings meetings(double now) const { return {options_, binding_, now}; }
  Neighbourhood neighbourhood(double now) const { return {options_, binding_, now}; }
  /// Throws std::invalid_argument where it leads farther than the robot may promise.
  void require_in_reach(const Motion& motion, double now) const;
  Refusal refusal_by_itself(const Motion& motion, double now) const;
  /// The name of a near peer in reach that has not acknowledged the promise; empty if there is
  /// none.
  std::string unaware_peer(TrajectoryId id, double now) const;
  std::string unclocked_peer(double now) const;

  CommitmentOptions options_;
  PeerTable peers_;
  ReservationChain binding_;
  std::optional<Pending> pending_;
  Acknowledgement last_sent_;
  std::uint32_t sequence_ = 0;
  std::optional<double> listen_until_s_;
  bool listening_ = true;
  std::vector<Acknowledgement> answers_;  // endorsed, not said yet
  double next_answer_s_ = 0.0;
  HeartbeatLines lines_;
  double next_heartbeat_s_ = 0.0;
  double next_resend_s_ = 0.0;
  int impostors_ = 0;
};

}  // namespace mocha
