#include "benchmarks/fleet_robot.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "safety/margin_budget.h"
#include "topology/static_map/grid_static_map.h"

namespace mocha {
namespace {

constexpr double kRefreshPeriod_s = 0.5;  // of fleet/trajectories
constexpr double kErrorTurn_radps = 0.7;  // of the tracking error's direction

/// Of this thread's work alone where there is no other; else of the wall clock.
double clock_s(bool one_thread) {
  timespec now;
  clock_gettime(one_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

ParameterTable global_values(const FleetOptions& options) {
  ParameterTable values = ParameterTable::from_schema("config/global_planner.yaml");
  YAML::Node changes;
  // Planning, the wait for the next step of the local replanner, and settling, as in config/.
  changes["planning_time"] = options.settle_s + 0.2;
  changes["planning_threads"] = options.planning_threads;
  values.assign(changes, "fleet options");
  return values;
}

ParameterTable local_values(const FleetOptions& options) {
  ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  YAML::Node changes;
  changes["settle_time"] = options.settle_s;
  changes["answer_timeout"] = options.settle_s + 0.3;
  changes["planning_threads"] = options.planning_threads;
  values.assign(changes, "fleet options");
  return values;
}

CommitmentOptions commitment_options(const std::string& name, const RobotModel& robot,
                                     const FleetOptions& options) {
  const auto values = ParameterTable::from_schema("config/trajectory_broadcaster.yaml");
  CommitmentOptions commitment;
  commitment.agent = name;
  commitment.delta_dc_s = options.delta_dc_s;
  commitment.reach_timeout_s = values.number("reach_timeout");
  commitment.peer_clearance_m = robot.peer_clearance_m + MarginBudget::of(robot).peer_margin_m();
  commitment.stops = robot.stop_options();
  commitment.stop_clearance_m = MarginBudget::of(robot).peer_margin_m();
  commitment.heartbeat_period_s = 1.0 / values.number("heartbeat_rate");
  commitment.resend_period_s = 1.0 / values.number("resend_rate");
  return commitment;
}

std::variant<CommitmentProtocol, OnePhase> protocol(const CommitmentOptions& commitment,
                                                    const FleetOptions& options) {
  if (options.protocol == Protocol::kOnePhase) return OnePhase(commitment);
  return CommitmentProtocol(commitment);
}

}  // namespace

FleetMap::FleetMap(const OccupancyGrid& grid)
    : obstacles(std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupied)),
      unseen(std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupiedOrUnknown)),
      static_map(std::make_shared<GridStaticMap>(obstacles)) {}

FleetRobot::FleetRobot(std::string name, const FleetAgent& agent, const FleetOptions& options)
    : name_(std::move(name)),
      robot_(load_robot_model("config", "rover")),
      agent_(agent),
      options_(options),
      planner_(robot_, PlannerOptions::from(global_values(options))),
      executive_(GoalExecutiveOptions::from(global_values(options)), robot_,
                 Yielding({false, 0, name_}, robot_, PlannerOptions::from(global_values(options)))),
      replanner_(robot_, LocalReplannerOptions::from(local_values(options), robot_),
                 LocalOptions::from(local_values(options))),
      protocol_(protocol(commitment_options(name_, robot_, options), options)),
      link_(name_, std::nullopt),
      lease_s_(local_values(options).number("lease")) {}

const PeerTable& FleetRobot::peers() const {
  return std::visit([](const auto& each) -> const PeerTable& { return each.peers(); }, protocol_);
}

const ReservationChain& FleetRobot::binding() const {
  return std::visit([](const auto& each) -> const ReservationChain& { return each.binding(); },
                    protocol_);
}

template <typename Call>
auto FleetRobot::timed(double& took_s, Call call) const {
  const double begin_s = clock_s(options_.planning_threads == 1);
  auto result = call();
  took_s = clock_s(options_.planning_threads == 1) - begin_s;
  return result;
}

template <typename Call>
std::vector<FleetRobot::Bytes> FleetRobot::with_protocol(double now_s, Call call) {
  double took_s = 0.0;
  auto sent = timed(took_s, [&] { return apply(std::visit(call, protocol_), now_s); });
  record_.protocol_s += took_s;
  return sent;
}

std::vector<FleetRobot::Bytes> FleetRobot::hear(const Bytes& datagram, double now_s) {
  return with_protocol(now_s, [&](auto& protocol) {
    const auto heard = link_.unpack(datagram.data(), datagram.size());
    if (!heard) return CommitmentActions();
    if (const auto* request = std::get_if<YieldRequest>(&*heard)) {
      executive_.hear(*request, now_s);
      return CommitmentActions();
    }
    if (const auto* promise = std::get_if<CommittedTrajectory>(&*heard))
      return protocol.receive(*promise, now_s);
    return protocol.receive(std::get<Heartbeat>(*heard), now_s);
  });
}

std::vector<FleetRobot::Bytes> FleetRobot::tick(double now_s) {
  const auto stop = lease_.expire(now_s, robot_.braking_deceleration());
  if (stop) ++record_.leases_lost;
  return with_protocol(now_s, [&](auto& protocol) {
    return stop ? protocol.brake(proposal(++proposed_, quantised(*stop)), now_s)
                : protocol.tick(now_s);
  });
}

std::vector<FleetRobot::Bytes> FleetRobot::apply(const CommitmentActions& actions, double now_s) {
  std::vector<Bytes> sent;
  const auto send = [&](const FleetMessage& message) {
    for (Bytes& datagram : link_.pack(message)) sent.push_back(std::move(datagram));
  };
  for (const CommittedTrajectory& promise : actions.trajectories) send(promise);
  if (actions.heartbeat) send(*actions.heartbeat);
  for (const CommitmentEvent& event : actions.events) report(event, now_s);
  return sent;
}

void FleetRobot::report(const CommitmentEvent& event, double now_s) {
  using Kind = CommitmentEvent::Kind;
  if (event.refusal != Refusal::kNone) ++record_.refusals[name_of(event.refusal)];
  switch (event.kind) {
    case Kind::kSettled:
      adopt(event.proposal.tag, *binding().composed(now_s), now_s);
      break;
    case Kind::kRejected:
      replanner_.on_refusal(event.proposal.tag);
      break;
    case Kind::kBreached:
      ++record_.breaches;
      breached_ = true;
      break;
    case Kind::kWithdrawn:  // it did so itself
      break;
  }
}

void FleetRobot::adopt(std::uint32_t sequence, const Motion& committed, double now_s) {
  replanner_.set_committed(sequence, committed);
  const Vector2 off = committed.position(now_s) - state(now_s).pose.position;
  const bool fits = off.norm() <= robot_.margins.tracking_m;
  if (!fits) return;
  driven_ = committed;
  driven_id_.sequence = sequence;
  lease_.commit(driven_id_, committed, now_s + lease_s_);
}

Proposal FleetRobot::proposal(std::uint32_t sequence, const Motion& motion) const {
  return {sequence, robot_.footprint.circumscribed_radius_m(),
          std::make_shared<const Motion>(motion)};
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

void FleetRobot::refresh_peers(double now_s) {
  std::vector<std::pair<std::string, TrajectoryId>> known;
  for (const auto& [name, peer] : peers().peers()) {
    for (const Reservation& reservation : peer.binding.reservations())
      known.emplace_back(name, reservation.trajectory.id);
  }
  if (known == known_ && now_s < refresh_at_s_) return;
  refresh_at_s_ = now_s + kRefreshPeriod_s;
  known_ = std::move(known);
  others_.clear();
  for (const auto& [name, peer] : peers().peers()) {
    for (const Reservation& part : peer.binding.parts(now_s)) {
      others_.push_back(std::make_shared<PeerObstacle>(name, part.trajectory.motion,
                                                       part.trajectory.footprint_radius_m));
    }
  }
}

std::vector<FleetRobot::Bytes> FleetRobot::propose(double now_s) {
  breached_ = false;
  refresh_peers(now_s);
  LocalScene scene = local_scene(agent_.map->static_map, agent_.map->unseen);
  scene.peers = others_;
  scene.predicted_until_s = now_s;
  record_.steps_s.emplace_back();
  const LocalReplanner::Output output =
      timed(record_.steps_s.back(), [&] { return replanner_.step(now_s, state(now_s), scene); });
  if (output.swerves || output.keeps_plan) executive_.follow(replanner_.plan());
  if (output.request_plan) executive_.request();
  if (output.renew_lease) lease_.renew(driven_id_, now_s + lease_s_);
  if (!output.proposal) return {};
  proposed_ = output.proposal->sequence;
  const Proposal wish = proposal(proposed_, output.proposal->motion);
  return with_protocol(now_s, [&](auto& protocol) {
    return output.proposal->emergency ? protocol.brake(wish, now_s) : protocol.propose(wish, now_s);
  });
}

std::vector<FleetRobot::Bytes> FleetRobot::pursue(double now_s) {
  if (!reached_ && executive_.idle()) executive_.take({Goal{agent_.goal, std::nullopt}}, now_s);
  refresh_peers(now_s);
  PlannerInterface planner;
  planner.plan = [this](const PlanQuery& query) { return plan(query); };
  planner.leads_on = [this](const PlanQuery& query, const Motion& motion) {
    return planner_.leads_on(motion, query, scene());
  };
  planner.scene = [this](const auto&) { return scene(); };
  GoalExecutive::Output output =
      executive_.step(now_s, state(now_s), replanner_.committed(), planner);
  reached_ = reached_ || output.ending == GoalExecutive::Ending::kReached;
  if (!output.plan.empty()) replanner_.set_plan(output.plan);
  if (!output.request) return {};
  output.request->epoch = CommitmentOptions().epoch;
  return link_.pack(*output.request);
}

PlanResult FleetRobot::plan(const PlanQuery& query) {
  record_.plans_s.emplace_back();
  PlanResult result = timed(record_.plans_s.back(),
                            [&] { return planner_.plan(query, scene(), [] { return false; }); });
  record_.paths = std::max(record_.paths, static_cast<int>(result.candidates.size()));
  return result;
}

}  // namespace mocha
