#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fleet/promise.h"
#include "fleet/promise_chain.h"

namespace mocha {

/// What is known of one peer.
struct Peer {
  std::uint32_t epoch = 0;
  PromiseChain binding;
  /// Proposals whose fate is not known yet, oldest first; mostly none or one. The peer may have
  /// made an older one binding although a newer one is here, where the message that says so is lost
  /// or late; heartbeats settle that.
  std::vector<Promise> open;
  PromiseId newest;    ///< highest number heard of
  PromiseId endorsed;  ///< highest number that we have seen and did not object to
  PromiseState endorsed_state = PromiseState::kProposed;
  std::optional<Seen> of_us;                                       ///< what the peer has seen of us
  double last_heard_s = -std::numeric_limits<double>::infinity();  ///< any message
  double last_beat_s = -std::numeric_limits<double>::infinity();   ///< a heartbeat

  /// Its proposal waits for our answer (an endorsement, or silence while we object).
  const Promise* unanswered() const;
  /// The stretch of time for which an open proposal may be in force.
  Claim claim_of_open(const Promise& proposal) const;
};

/// The newest promises of each peer. Messages may come late, twice, in any order, or not at all; a
/// message older than what is known changes nothing.
///
/// A peer that has been silent for the reach timeout is out of reach: nobody waits for it any more.
/// What it promised still holds to its end, and after that it is an obstacle at its last place. A
/// proposal of it that we endorsed may have become binding, and counts as promised; others are
/// dropped. A higher epoch (the peer was started anew) makes all former messages old. The former
/// promise stays until the new epoch makes one binding: the robot has not vanished.
class PeerTable {
 public:
  enum class Verdict { kNews, kDuplicate, kOld };

  /// `own_name`: whose entries in heartbeats are about us, in epoch `own_epoch`.
  PeerTable(std::string own_name, std::uint32_t own_epoch, double reach_timeout_s);

  Verdict receive(const Promise& promise, double now);
  Verdict receive(const Beat& beat, double now);

  /// Notes that we have seen the peer's proposal and do not object.
  void endorse(const std::string& peer, const Promise& proposal);

  /// Forgets what cannot matter any more.
  void prune(double now);

  bool in_reach(const Peer& peer, double now) const;
  const std::map<std::string, Peer>& peers() const { return peers_; }

  /// The lines of our heartbeat about the peers in reach.
  std::vector<Seen> seen(double now) const;

  int duplicates() const { return duplicates_; }
  int old_messages() const { return old_; }

 private:
  Verdict take(Peer& peer, const Promise& promise);
  void bind(Peer& peer, const Promise& promise);
  void resolve(Peer& peer, const Beat& beat);
  /// The peer of this name in this epoch; none if the message is of a former epoch.
  Peer* find(const std::string& name, std::uint32_t epoch, double now);

  std::string own_name_;
  std::uint32_t own_epoch_;
  double reach_timeout_s_;
  std::map<std::string, Peer> peers_;
  int duplicates_ = 0;
  int old_ = 0;
};

}  // namespace mocha
