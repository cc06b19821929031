#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fleet/protocol/commitment_options.h"
#include "fleet/protocol/committed_trajectory.h"
#include "fleet/protocol/peer_clock.h"
#include "fleet/protocol/reservation_chain.h"

namespace mocha {

/// What is known of one peer.
struct Peer {
  std::uint32_t epoch = 0;
  ReservationChain binding;
  /// Proposals whose fate is not known yet, oldest first; mostly none or one. The peer may have
  /// made an older one binding although a newer one is here, where the message that says so is lost
  /// or late; heartbeats settle that.
  std::vector<CommittedTrajectory> open;
  TrajectoryId newest;    ///< highest number heard of
  TrajectoryId endorsed;  ///< highest number that we have seen and did not object to
  TrajectoryState endorsed_state = TrajectoryState::kProposed;
  std::optional<Acknowledgement> of_us;                            ///< what the peer has seen of us
  double last_heard_s = -std::numeric_limits<double>::infinity();  ///< any message
  double last_heartbeat_s = -std::numeric_limits<double>::infinity();  ///< a heartbeat
  double promise_reach_m = 0.0;  ///< as its newest heartbeat says
  /// When it was heard last that its newest promise is the one that is known.
  double placed_s = -std::numeric_limits<double>::infinity();
  double last_old_s = -std::numeric_limits<double>::infinity();  ///< anything of a former epoch

  /// Its newest heartbeat: the stamp, by its clock, and when it came, by ours.
  double stamp_s = -std::numeric_limits<double>::infinity();
  double stamp_heard_s = -std::numeric_limits<double>::infinity();
  PeerClock clock;

  /// Its proposal waits for our answer (an endorsement, or silence while we object).
  const CommittedTrajectory* unanswered() const;
  /// Since its last start it has made nothing binding: what it promised before is in force.
  bool bound_by_former_epoch() const;
  /// The stretch of time for which an open proposal may be in force.
  Reservation reservation_of_open(const CommittedTrajectory& proposal) const;
};

/// The newest promises of each peer, told by our clock. Messages may come late, twice, in any
/// order, or not at all; a message older than what is known changes nothing, but for a promise that
/// is in force until a known one begins.
///
/// A peer that has been silent for the reach timeout is out of reach: no robot waits for it.
/// What it promised still holds to its end, and after that it is an obstacle at its last place. A
/// proposal of it that we endorsed may have become binding, and counts as promised; others are
/// dropped. A higher epoch (the peer was started anew) makes former messages old, but not what they
/// bind: the robot has not vanished, and its tracker drives on. Until the new epoch makes something
/// binding, a former promise stays, one that comes late is taken, and a former proposal may have
/// become one: it stays to its motion's end, and if we endorsed it, longer.
///
/// A peer's promises are shifted by what echoed heartbeats say of its clock; what they leave open
/// beyond the tolerance, robots keep apart in addition (Mistiming).
class PeerTable {
 public:
  /// So many peers are known at most: a network full of invented names takes no more memory.
  static constexpr std::size_t kMostPeers = 2000;

  enum class Verdict {
    kNews,       ///< changes what the peer is taken to do
    kAlive,      ///< a heartbeat that does not
    kDuplicate,  ///< known already
    kOld,        ///< something newer is known
    kCrowded,    ///< there are too many peers
  };

  /// Entries of heartbeats under `own_name`, in epoch `own_epoch`, are about us. Throws
  /// std::invalid_argument for a timeout that is not above 0.
  PeerTable(std::string own_name, std::uint32_t own_epoch, double reach_timeout_s,
            ClockOptions clocks);

  Verdict receive(const CommittedTrajectory& trajectory, double now);
  Verdict receive(const Heartbeat& heartbeat, double now);

  /// Notes that we have seen the peer's proposal and do not object.
  void endorse(const std::string& peer, const CommittedTrajectory& proposal);

  /// Forgets what cannot matter any more.
  void prune(double now);

  bool in_reach(const Peer& peer, double now) const;
  const std::map<std::string, Peer>& peers() const { return peers_; }

  /// Its clock has been measured, and that well enough.
  bool clock_known(const Peer& peer, double now) const;
  /// It is proved that its clock and ours are farther apart than margins allow for.
  bool clock_differs(const Peer& peer, double now) const;
  /// By how much its motions may be early or late beyond what margins allow for.
  double mistimed_s(const Peer& peer, double now) const;

  /// The line of our heartbeat about a peer; nothing where there is nothing to say. One that calls
  /// itself by a former epoch is told the epoch that we know of it.
  std::optional<Acknowledgement> acknowledgement(const std::string& name, double now) const;
  std::optional<Echo> echo(const std::string& name, double now) const;

  /// The highest epoch of ourselves that any peer knows of; above our own, no peer listens to us.
  /// Never one that leaves us fewer than kMostStarts more.
  std::uint32_t known_epoch() const { return known_epoch_; }
  /// How often a peer said that it knows an epoch of ourselves that we cannot have come to.
  int unlikely_epochs() const { return unlikely_epochs_; }

  /// More starts than a robot has, were it every minute for a year: a peer that claims an epoch
  /// farther above ours is wrong, or wants us to run out of numbers.
  static constexpr std::uint32_t kMostStarts = 1'000'000;

  int duplicates() const { return duplicates_; }
  int old_messages() const { return old_; }
  int crowded_out() const { return crowded_; }

 private:
  friend class ProtocolFingerprint;  // of test/fleet/model

  Verdict take(Peer& peer, const CommittedTrajectory& trajectory, double now);
  /// False where later promises have replaced it.
  bool bind(Peer& peer, const CommittedTrajectory& trajectory);
  /// Whether the heartbeat tells the fate of open proposals.
  bool resolve(Peer& peer, const Heartbeat& heartbeat, double now);
  /// The peer of this name; none if there are too many.
  Peer* find(const std::string& name);
  /// Whether what the peer said in this epoch was said before it was started anew.
  static bool is_former(Peer& peer, std::uint32_t epoch, double now);
  void forget_unendorsed(Peer& peer);
  Verdict count(Verdict verdict);
  /// Whether the peer's promises are told by another clock from now on.
  bool read_clock(Peer& peer, const Heartbeat& heartbeat, double now);
  void hear_of_own_epoch(std::uint32_t epoch);

  std::string own_name_;
  std::uint32_t own_epoch_;
  double reach_timeout_s_;
  ClockOptions clocks_;
  std::uint32_t known_epoch_ = 0;
  int unlikely_epochs_ = 0;
  std::map<std::string, Peer> peers_;
  int duplicates_ = 0;
  int old_ = 0;
  int crowded_ = 0;
};

}  // namespace mocha
