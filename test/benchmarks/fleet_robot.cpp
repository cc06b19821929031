#include "benchmarks/fleet_robot.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "benchmarks/one_phase.h"
#include "fleet/protocol/commitment_protocol.h"
#include "topology/static_map/grid_static_map.h"

namespace mocha {
namespace {

constexpr std::uint32_t kEpoch = 1;
constexpr double kErrorTurn_radps = 0.7;  // of the tracking error's direction

/// Of this thread's work alone where there is no other; else of the wall clock.
double clock_s(bool one_thread) {
  timespec now;
  clock_gettime(one_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::unique_ptr<SettlingProtocol> protocol_of(const CommitmentOptions& commitment,
                                              Protocol protocol) {
  if (protocol == Protocol::kOnePhase) return std::make_unique<OnePhase>(commitment);
  return std::make_unique<CommitmentProtocol>(commitment);
}

}  // namespace

FleetMap::FleetMap(const OccupancyGrid& grid)
    : obstacles(std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupied)),
      unseen(std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupiedOrUnknown)),
      static_map(std::make_shared<GridStaticMap>(obstacles)) {}

TimedProtocol::TimedProtocol(std::unique_ptr<SettlingProtocol> protocol, bool one_thread)
    : protocol_(std::move(protocol)), one_thread_(one_thread) {}

template <typename Call>
CommitmentActions TimedProtocol::timed(Call call) {
  const double begin_s = clock_s(one_thread_);
  CommitmentActions actions = call();
  took_s_ += clock_s(one_thread_) - begin_s;
  return actions;
}

CommitmentActions TimedProtocol::propose(const Proposal& proposal, double now) {
  return timed([&] { return protocol_->propose(proposal, now); });
}

CommitmentActions TimedProtocol::brake(const Proposal& proposal, double now) {
  return timed([&] { return protocol_->brake(proposal, now); });
}

CommitmentActions TimedProtocol::receive(const CommittedTrajectory& trajectory, double now) {
  return timed([&] { return protocol_->receive(trajectory, now); });
}

CommitmentActions TimedProtocol::receive(const Heartbeat& heartbeat, double now) {
  return timed([&] { return protocol_->receive(heartbeat, now); });
}

CommitmentActions TimedProtocol::tick(double now) {
  return timed([&] { return protocol_->tick(now); });
}

FleetRobot::FleetRobot(std::string name, const FleetAgent& agent, const FleetOptions& options)
    : name_(std::move(name)),
      robot_(load_robot_model("config", "rover")),
      agent_(agent),
      options_(options),
      protocol_(protocol_of(commitment_options(name_, robot_, kEpoch, options), options.protocol),
                options.planning_threads == 1),
      stack_(name_, robot_,
             {global_values(options), local_values(options), reach_of(robot_, options)}, protocol_),
      link_(name_, std::nullopt) {}

PlanningRecord FleetRobot::record() const {
  PlanningRecord record = record_;
  record.protocol_s = protocol_.took_s();
  record.leases_lost = stack_.counts().lease_stops;
  record.breaches = stack_.counts().breaches;
  record.refusals = stack_.counts().refusals;
  return record;
}

std::vector<FleetRobot::Bytes> FleetRobot::hear(const Bytes& datagram, double now_s) {
  const auto heard = link_.unpack(datagram.data(), datagram.size());
  return heard ? apply(stack_.hear(*heard, now_s), now_s) : std::vector<Bytes>();
}

std::vector<FleetRobot::Bytes> FleetRobot::tick(double now_s) {
  return apply(stack_.tick(now_s), now_s);
}

std::vector<FleetRobot::Bytes> FleetRobot::apply(const RobotStack::Messages& messages,
                                                 double now_s) {
  std::vector<Bytes> sent;
  for (const FleetMessage& message : messages) {
    for (Bytes& datagram : link_.pack(message)) sent.push_back(std::move(datagram));
  }
  if (stack_.committed_id() == driven_id_) return sent;
  const Vector2 off = stack_.committed().position(now_s) - state(now_s).pose.position;
  if (off.norm() > robot_.margins.tracking_m) return sent;
  driven_ = stack_.committed();
  driven_id_ = stack_.committed_id();
  return sent;
}

RobotState FleetRobot::state(double now_s) const {
  RobotState state;
  state.stamp_s = now_s;
  if (driven_.empty()) {
    state.pose = agent_.start;
    return state;
  }
  const MotionState at = driven_.at(now_s);
  state.pose = at.pose;
  state.twist = {at.speed, at.yaw_rate};
  const double phase_rad = kErrorTurn_radps * now_s + static_cast<double>(name_.back());
  state.pose.position +=
      options_.tracking_error_m * Vector2(std::cos(phase_rad), std::sin(phase_rad));
  return state;
}

void FleetRobot::take_news(double now_s) {
  const bool one_thread = options_.planning_threads == 1;
  const double begin_s = clock_s(one_thread);
  stack_.refresh_peers(now_s);
  record_.news_s += clock_s(one_thread) - begin_s;
}

std::vector<FleetRobot::Bytes> FleetRobot::propose(double now_s) {
  take_news(now_s);
  LocalScene scene = local_scene(agent_.map->static_map, agent_.map->unseen);
  scene.predicted_until_s = now_s;
  const bool one_thread = options_.planning_threads == 1;
  const double begin_s = clock_s(one_thread) - protocol_.took_s();
  const auto messages = stack_.replan(now_s, state(now_s), std::move(scene));
  record_.steps_s.push_back(clock_s(one_thread) - protocol_.took_s() - begin_s);
  return apply(messages, now_s);
}

std::vector<FleetRobot::Bytes> FleetRobot::pursue(double now_s) {
  if (!reached_ && stack_.idle()) stack_.take({Goal{agent_.goal, std::nullopt}}, now_s);
  take_news(now_s);
  const bool one_thread = options_.planning_threads == 1;
  const double begin_s = clock_s(one_thread);
  const auto messages = stack_.pursue(now_s, state(now_s), {agent_.map->static_map, {}, {}});
  if (const auto& planned = stack_.pursued().planned) {
    record_.plans_s.push_back(clock_s(one_thread) - begin_s);
    record_.paths = std::max(record_.paths, static_cast<int>(planned->result.candidates.size()));
  }
  reached_ = reached_ || stack_.pursued().ending == GoalExecutive::Ending::kReached;
  return apply(messages, now_s);
}

}  // namespace mocha
