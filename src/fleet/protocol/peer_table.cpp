#include "fleet/protocol/peer_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mocha {
namespace {

constexpr double kNever_s = std::numeric_limits<double>::infinity();

template <typename Drop>
void drop_if(std::vector<CommittedTrajectory>& trajectories, Drop drop) {
  trajectories.erase(std::remove_if(trajectories.begin(), trajectories.end(), drop),
                     trajectories.end());
}

}  // namespace

const CommittedTrajectory* Peer::unanswered() const {
  if (open.empty()) return nullptr;
  const CommittedTrajectory& proposal = open.back();
  const bool current = proposal.id.epoch == epoch && proposal.id == newest;
  return current && endorsed < proposal.id ? &proposal : nullptr;
}

bool Peer::bound_by_former_epoch() const {
  return binding.empty() || binding.newest().id.epoch < epoch;
}

Reservation Peer::reservation_of_open(const CommittedTrajectory& proposal) const {
  Reservation reservation = reservation_of(proposal);
  for (const Reservation& bound : binding.reservations()) {
    if (proposal.id < bound.trajectory.id) {
      reservation.until_s = std::min(reservation.until_s, bound.trajectory.motion->start_time());
    }
  }
  return reservation;
}

PeerTable::PeerTable(std::string own_name, std::uint32_t own_epoch, double reach_timeout_s,
                     ClockOptions clocks)
    : own_name_(std::move(own_name)),
      own_epoch_(own_epoch),
      reach_timeout_s_(reach_timeout_s),
      clocks_(clocks) {
  if (!(reach_timeout_s_ > 0.0)) {
    throw std::invalid_argument("reach_timeout = " + std::to_string(reach_timeout_s_) +
                                " s, allowed is above 0");
  }
}

PeerTable::Verdict PeerTable::count(Verdict verdict) {
  duplicates_ += verdict == Verdict::kDuplicate;
  old_ += verdict == Verdict::kOld;
  crowded_ += verdict == Verdict::kCrowded;
  return verdict;
}

Peer* PeerTable::find(const std::string& name) {
  const bool crowded = peers_.size() >= kMostPeers && peers_.count(name) == 0;
  return crowded ? nullptr : &peers_[name];
}

bool PeerTable::is_former(Peer& peer, std::uint32_t epoch, double now) {
  if (epoch < peer.epoch) {
    peer.last_old_s = now;
    return true;
  }
  if (epoch > peer.epoch) {
    peer.epoch = epoch;
    peer.of_us.reset();  // it has forgotten
    peer.stamp_s = -kNever_s;
  }
  peer.last_heard_s = std::max(peer.last_heard_s, now);
  return false;
}

PeerTable::Verdict PeerTable::receive(const CommittedTrajectory& trajectory, double now) {
  Peer* peer = find(trajectory.agent);
  if (peer == nullptr) return count(Verdict::kCrowded);
  const bool former = is_former(*peer, trajectory.id.epoch, now);
  if (former && !(is_binding(trajectory.state) && peer->bound_by_former_epoch()))
    return count(Verdict::kOld);
  return count(take(*peer, reclocked(trajectory, -peer->clock.ahead_s()), now));
}

PeerTable::Verdict PeerTable::take(Peer& peer, const CommittedTrajectory& trajectory, double now) {
  const TrajectoryId former = peer.newest;
  if (is_binding(trajectory.state)) {
    const bool known = peer.binding.holds(trajectory.id);
    const bool bound = !known && bind(peer, trajectory);
    if ((known || bound) && peer.binding.newest().id == trajectory.id) peer.placed_s = now;
    if (known) return Verdict::kDuplicate;
    return bound ? Verdict::kNews : Verdict::kOld;
  }
  peer.newest = std::max(peer.newest, trajectory.id);
  if (trajectory.state == TrajectoryState::kWithdrawn) {
    const std::size_t before = peer.open.size();
    drop_if(peer.open, [&](const CommittedTrajectory& open) { return open.id == trajectory.id; });
    if (peer.open.size() < before || former < trajectory.id) return Verdict::kNews;
    return former == trajectory.id ? Verdict::kDuplicate : Verdict::kOld;
  }
  if (!(former < trajectory.id))
    return former == trajectory.id ? Verdict::kDuplicate : Verdict::kOld;
  peer.open.push_back(trajectory);
  return Verdict::kNews;
}

bool PeerTable::bind(Peer& peer, const CommittedTrajectory& trajectory) {
  peer.newest = std::max(peer.newest, trajectory.id);
  if (!(trajectory.id < peer.endorsed)) {
    peer.endorsed = trajectory.id;
    peer.endorsed_state = trajectory.state;
  }
  drop_if(peer.open, [&](const CommittedTrajectory& open) { return open.id == trajectory.id; });
  return peer.binding.bind(trajectory);
}

PeerTable::Verdict PeerTable::receive(const Heartbeat& heartbeat, double now) {
  Peer* peer = find(heartbeat.agent);
  if (peer == nullptr) return count(Verdict::kCrowded);
  if (is_former(*peer, heartbeat.epoch, now)) {
    const bool tells = peer->bound_by_former_epoch() && resolve(*peer, heartbeat, now);
    return count(tells ? Verdict::kNews : Verdict::kOld);
  }
  peer->last_heartbeat_s = std::max(peer->last_heartbeat_s, now);
  peer->promise_reach_m = heartbeat.promise_reach_m;
  const bool reclocked = read_clock(*peer, heartbeat, now);
  for (const Acknowledgement& line : heartbeat.acknowledgements) {
    if (line.agent != own_name_) continue;
    hear_of_own_epoch(line.id.epoch);
    if (line.id.epoch != own_epoch_) continue;
    if (!peer->of_us || !(line.id < peer->of_us->id)) peer->of_us = line;
  }
  const bool resolved = resolve(*peer, heartbeat, now);
  return reclocked || resolved ? Verdict::kNews : Verdict::kAlive;
}

void PeerTable::hear_of_own_epoch(std::uint32_t epoch) {
  constexpr std::uint32_t kHighest = std::numeric_limits<std::uint32_t>::max() - kMostStarts;
  const bool likely =
      epoch <= own_epoch_ || (epoch - own_epoch_ <= kMostStarts && epoch <= kHighest);
  if (likely) {
    known_epoch_ = std::max(known_epoch_, epoch);
  } else {
    ++unlikely_epochs_;
  }
}

bool PeerTable::read_clock(Peer& peer, const Heartbeat& heartbeat, double now) {
  if (heartbeat.stamp_s > peer.stamp_s) {
    peer.stamp_s = heartbeat.stamp_s;
    peer.stamp_heard_s = now;
  }
  double later_s = 0.0;
  for (const Echo& echo : heartbeat.echoes) {
    if (echo.agent != own_name_) continue;
    later_s +=
        peer.clock.add(echo.stamp_s, echo.held_s, heartbeat.stamp_s, clocks_.tolerance_s, now);
  }
  if (later_s == 0.0) return false;
  peer.binding.reclock(later_s);
  for (CommittedTrajectory& open : peer.open) open = reclocked(open, later_s);
  return true;
}

bool PeerTable::resolve(Peer& peer, const Heartbeat& heartbeat, double now) {
  TrajectoryId bound{heartbeat.epoch, 0};
  TrajectoryState bound_state = TrajectoryState::kCommitted;
  TrajectoryId latest = bound;
  TrajectoryState latest_state = TrajectoryState::kProposed;
  for (const Acknowledgement& line : heartbeat.acknowledgements) {
    if (line.agent != heartbeat.agent || line.id.epoch != heartbeat.epoch) continue;
    if (is_binding(line.state)) {
      bound = line.id;
      bound_state = line.state;
    } else {
      latest = line.id;
      latest_state = line.state;
    }
  }
  const std::size_t before = peer.open.size();
  const bool newer = peer.binding.empty() || peer.binding.newest().id < bound;
  const auto is_bound = [&](const CommittedTrajectory& open) { return newer && open.id == bound; };
  const auto found = std::find_if(peer.open.begin(), peer.open.end(), is_bound);
  if (found != peer.open.end()) {  // the message that made it binding is lost or late
    CommittedTrajectory trajectory = *found;
    trajectory.state = bound_state;
    bind(peer, trajectory);
  }
  if (!peer.binding.empty() && peer.binding.newest().id == bound) peer.placed_s = now;
  // What was replaced before the heartbeat was sent, and is not in force, never will be.
  drop_if(peer.open, [&](const CommittedTrajectory& open) {
    const bool past =
        open.id < latest || (open.id == latest && latest_state == TrajectoryState::kWithdrawn);
    return open.id.epoch == heartbeat.epoch && bound < open.id && past;
  });
  return peer.open.size() < before;
}

void PeerTable::endorse(const std::string& name, const CommittedTrajectory& proposal) {
  Peer& peer = peers_.at(name);
  peer.endorsed = proposal.id;
  peer.endorsed_state = proposal.state;
}

bool PeerTable::in_reach(const Peer& peer, double now) const {
  return now - peer.last_heartbeat_s <= reach_timeout_s_;
}

bool PeerTable::clock_known(const Peer& peer, double now) const {
  const auto error_s = peer.clock.error_s(now);
  return error_s && *error_s <= clocks_.max_error_s;
}

bool PeerTable::clock_differs(const Peer& peer, double now) const {
  const auto reading = peer.clock.reading(now);
  return reading && std::abs(reading->offset_s) > reading->uncertainty_s + clocks_.tolerance_s;
}

double PeerTable::mistimed_s(const Peer& peer, double now) const {
  return peer.clock.mistimed_s(clocks_.tolerance_s, now);
}

void PeerTable::prune(double now) {
  for (auto& [name, peer] : peers_) {
    peer.binding.prune(now);
    drop_if(peer.open, [now, &peer = peer](const CommittedTrajectory& open) {
      const bool forgotten = open.id.epoch < peer.epoch && peer.endorsed < open.id;
      const double end_s = forgotten ? open.motion->end_time() : kNever_s;
      return std::min(end_s, peer.reservation_of_open(open).until_s) <= now;
    });
    if (now - peer.last_heard_s > reach_timeout_s_) forget_unendorsed(peer);
  }
}

/// Heard again, they are news.
void PeerTable::forget_unendorsed(Peer& peer) {
  drop_if(peer.open, [&](const CommittedTrajectory& open) { return peer.endorsed < open.id; });
  peer.newest = std::min(peer.newest, peer.endorsed);
}

std::optional<Acknowledgement> PeerTable::acknowledgement(const std::string& name,
                                                          double now) const {
  const Peer& peer = peers_.at(name);
  const bool any = peer.endorsed.sequence > 0 && peer.endorsed.epoch == peer.epoch;
  if (any && in_reach(peer, now)) return Acknowledgement{name, peer.endorsed, peer.endorsed_state};
  if (now - peer.last_old_s <= reach_timeout_s_)
    return Acknowledgement{name, {peer.epoch, 0}, TrajectoryState::kProposed};
  return std::nullopt;
}

std::optional<Echo> PeerTable::echo(const std::string& name, double now) const {
  const Peer& peer = peers_.at(name);
  if (!in_reach(peer, now) || !std::isfinite(peer.stamp_s)) return std::nullopt;
  return Echo{name, peer.stamp_s, now - peer.stamp_heard_s};
}

}  // namespace mocha
