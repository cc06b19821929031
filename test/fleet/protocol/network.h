#pragma once

#include <limits>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fleet/protocol/commitment_protocol.h"
#include "fleet/protocol/motions.h"
#include "fleet/protocol/shipped_options.h"
#include "simulation/lossy_network.h"
#include "trajectory/rover_braking.h"

namespace mocha::test {

/// Robots that run the protocol over a network which delays, reorders and loses; it knows the truth
/// about all of them.
class Network {
 public:
  struct Link : NetworkLink {
    bool heartbeats = true;
  };
  static constexpr double kRadius_m = 0.3;

  /// Robots hear each other over `range_m`.
  Network(int seed, const Link& link, double range_m = std::numeric_limits<double>::infinity())
      : network_(seed, link),
        range_m_(range_m),
        sends_heartbeats_(link.heartbeats),
        random_(seed) {}

  void add(const CommitmentOptions& options, const Braking& braking = kRoverBraking) {
    robots_.emplace_back(options);
    brakings_.push_back(braking);
  }
  CommitmentProtocol& robot(int i) { return robots_[i]; }
  int size() const { return static_cast<int>(robots_.size()); }
  double now() const { return now_; }
  std::mt19937& random() { return random_; }

  void propose(int i, Motion motion) {
    apply(i,
          robots_[i].propose({++tag_, kRadius_m, brakings_[i], shared(std::move(motion))}, now_));
  }
  void brake(int i, Motion motion) {
    apply(i, robots_[i].brake({++tag_, kRadius_m, brakings_[i], shared(std::move(motion))}, now_));
  }
  /// A robot that is cut off neither sends nor receives.
  void cut_off(int i, bool off) { network_.cut_off(i, off); }
  void restart(int i, const CommitmentOptions& options) {
    robots_[i] = CommitmentProtocol(options);
  }

  void run(double seconds, double step_s = 0.01) {
    for (const double until = now_ + seconds; now_ < until;) {
      now_ += step_s;
      for (const auto& delivery : network_.receive(now_)) {
        CommitmentProtocol& receiver = robots_[delivery.to];
        apply(delivery.to,
              std::visit([&](const auto& each) { return receiver.receive(each, now_); },
                         delivery.message));
      }
      for (int i = 0; i < size(); ++i) apply(i, robots_[i].tick(now_));
    }
  }

  /// Events of robot i of one kind so far.
  std::vector<CommitmentEvent> events(int i, CommitmentEvent::Kind kind) const {
    std::vector<CommitmentEvent> found;
    for (const auto& [robot, event] : events_) {
      if (robot == i && event.kind == kind) found.push_back(event);
    }
    return found;
  }
  int settled(int i) const {
    return static_cast<int>(events(i, CommitmentEvent::Kind::kSettled).size());
  }
  /// Heartbeats of all so far.
  int heartbeats() const { return heartbeats_; }
  /// How often a motion was settled that meets one already binding at another robot.
  int broken() const { return broken_; }

 private:
  using Message = std::variant<CommittedTrajectory, Heartbeat>;

  void apply(int i, const CommitmentActions& actions) {
    heartbeats_ += actions.heartbeat.has_value();
    for (const CommittedTrajectory& trajectory : actions.trajectories) send(i, trajectory);
    if (actions.heartbeat && sends_heartbeats_) send(i, *actions.heartbeat);
    for (const CommitmentEvent& event : actions.events) {
      events_.emplace_back(i, event);
      const bool settled = event.kind == CommitmentEvent::Kind::kSettled;
      if (settled && event.trajectory.state == TrajectoryState::kCommitted)
        check(i, event.trajectory);
    }
  }

  void send(int from, const Message& message) {
    for (int to = 0; to < size(); ++to) {
      if (to != from && hear_each_other(from, to)) network_.send(from, to, message, now_);
    }
  }

  bool hear_each_other(int i, int j) const {
    const ReservationChain& a = robots_[i].binding();
    const ReservationChain& b = robots_[j].binding();
    if (a.empty() || b.empty()) return true;
    return (a.position(now_) - b.position(now_)).norm() <= range_m_;
  }

  void check(int i, const CommittedTrajectory& trajectory) {
    for (int j = 0; j < size(); ++j) {
      if (j == i) continue;
      for (const Reservation& theirs : robots_[j].binding().reservations()) {
        const double required = 2.0 * kRadius_m + robots_[i].options().peer_clearance_m - 2e-3;
        if (first_conflict(reservation_of(trajectory), theirs, required, now_)) ++broken_;
      }
    }
  }

  LossyNetwork<Message> network_;
  double range_m_;
  bool sends_heartbeats_;
  std::mt19937 random_;
  double now_ = 100.0;
  std::uint32_t tag_ = 0;
  std::vector<CommitmentProtocol> robots_;
  std::vector<Braking> brakings_;
  std::vector<std::pair<int, CommitmentEvent>> events_;
  int broken_ = 0;
  int heartbeats_ = 0;
};

/// What ships, with a round clearance, without looking at stops, and without a bound of the reach:
/// tests of these ask for them.
inline CommitmentOptions options(const std::string& agent, std::uint32_t epoch = 1) {
  CommitmentOptions options = shipped_options(agent, epoch);
  options.peer_clearance_m = 0.2;
  options.stop_reaction_s.reset();
  options.stop_clearance_m = 0.0;
  options.reach = {1e4, 2.0, 1e3};
  return options;
}

}  // namespace mocha::test
