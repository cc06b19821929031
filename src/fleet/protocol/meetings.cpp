#include "fleet/protocol/meetings.h"

#include <algorithm>

#include "fleet/protocol/stop_conflict.h"
#include "trajectory/mistiming.h"
#include "trajectory/separation.h"

namespace mocha {
namespace {

/// Robots that are too close already may come no closer than now, up to this
/// for rounding.
constexpr double kRounding_m = 1e-3;

/// Wherever it may begin and end, if its times, or those of what it is compared with, are wrong.
Reservation mistimed(Reservation reservation, double error_s) {
  reservation.from_s -= error_s;
  reservation.until_s += error_s;
  return reservation;
}

}  // namespace

std::optional<Conflict> Meetings::with_promises(const Reservation& mine, const Peer& peer) const {
  for (const Reservation& theirs : peer.binding.reservations()) {
    if (auto conflict = between(mine, peer, theirs)) return conflict;
  }
  return std::nullopt;
}

Objection Meetings::objection(const CommittedTrajectory& proposal, const std::string& name,
                              const Peer& peer) const {
  const Reservation mine = reservation_of(proposal);
  auto promised = with_promises(mine, peer);
  if (!promised) promised = by_stopping(&proposal, peer, nullptr);
  if (promised) return {Refusal::kPeerPromise, *promised, {}};
  Objection found;
  for (const CommittedTrajectory& open : peer.open) {
    auto conflict = between(mine, peer, peer.reservation_of_open(open));
    if (!conflict) conflict = by_stopping(&proposal, peer, &open);
    if (!conflict) continue;
    if (takes_precedence(open, proposal)) return {Refusal::kPeerProposal, *conflict, {}};
    found.waits_for = name;
  }
  return found;
}

Objection Meetings::objection(const CommittedTrajectory& proposal, const PeerTable& peers) const {
  Objection found;
  for (const auto& [name, peer] : peers.peers()) {
    Objection by_peer = objection(proposal, name, peer);
    if (by_peer.refusal != Refusal::kNone) return by_peer;
    if (!by_peer.waits_for.empty()) found.waits_for = name;
  }
  return found;
}

bool Meetings::objects_to(const Peer& peer, const CommittedTrajectory& proposal,
                          const CommittedTrajectory* pending) const {
  const Reservation theirs = peer.reservation_of_open(proposal);
  for (const Reservation& mine : binding_.reservations()) {
    if (between(mine, peer, theirs)) return true;
  }
  if (by_stopping(nullptr, peer, &proposal)) return true;
  return pending != nullptr && takes_precedence(*pending, proposal) &&
         (between(reservation_of(*pending), peer, theirs) || by_stopping(pending, peer, &proposal));
}

std::optional<Conflict> Meetings::between(const Reservation& mine, const Peer& peer,
                                          const Reservation& theirs) const {
  const double demanded = mine.trajectory.footprint_radius_m +
                          theirs.trajectory.footprint_radius_m + options_.peer_clearance_m;
  if (far_apart(*mine.trajectory.motion, *theirs.trajectory.motion, demanded)) return std::nullopt;
  const double required =
      std::min(demanded, closest_m(*mine.trajectory.motion, peer, *theirs.trajectory.motion));
  const double error_s = mistimed_s(peer, *theirs.trajectory.motion);
  auto conflict =
      first_conflict(mistimed(mine, error_s), mistimed(theirs, error_s), required, now_);
  const Mistiming off = mistiming(*mine.trajectory.motion, *theirs.trajectory.motion, error_s);
  if (conflict || off.loss_m == 0.0) return conflict;
  Reservation both_move = mistimed(theirs, error_s);
  both_move.from_s = std::max(both_move.from_s, off.from_s);
  both_move.until_s = std::min(both_move.until_s, off.until_s);
  return first_conflict(mistimed(mine, error_s), both_move, required + off.loss_m, now_);
}

std::optional<Conflict> Meetings::by_stopping(const CommittedTrajectory* my_proposal,
                                              const Peer& peer,
                                              const CommittedTrajectory* their_proposal) const {
  const CommittedTrajectory* mine = binding_.empty() ? my_proposal : &binding_.newest();
  const CommittedTrajectory* theirs =
      peer.binding.empty() ? their_proposal : &peer.binding.newest();
  if (!options_.stop_reaction_s || mine == nullptr || theirs == nullptr) return std::nullopt;
  const StopDemand demand{*options_.stop_reaction_s, options_.stop_clearance_m,
                          closest_m(*mine->motion, peer, *theirs->motion),
                          mistimed_s(peer, *theirs->motion)};
  return first_stop_conflict({binding_, my_proposal}, {peer.binding, their_proposal}, demand, now_);
}

/// By its end, clocks will have drifted.
double Meetings::mistimed_s(const Peer& peer, const Motion& theirs) const {
  return peer.clock.mistimed_s(options_.clocks.tolerance_s, std::max(now_, theirs.end_time()));
}

double Meetings::closest_m(const Motion& mine, const Peer& peer, const Motion& theirs) const {
  const Vector2 here = binding_.empty() ? mine.position(now_) : binding_.position(now_);
  const Vector2 there = peer.binding.empty() ? theirs.position(now_) : peer.binding.position(now_);
  return (here - there).norm() - kRounding_m;
}

}  // namespace mocha
