#include "benchmarks/fleet_robot.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "safety/margin_budget.h"
#include "topology/map_terrain.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kBraking = 0.6;          // of the acceleration limit
constexpr double kRefreshPeriod_s = 0.5;  // of fleet/trajectories
constexpr double kErrorTurn_radps = 0.7;  // of the tracking error's direction

/// Of this thread's work alone where there is no other; else of the wall clock.
double clock_s(bool one_thread) {
  timespec now;
  clock_gettime(one_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

ParameterTable global_values(const FleetRules& rules) {
  ParameterTable values = ParameterTable::from_schema("config/global_planner.yaml");
  YAML::Node changes;
  // Planning, the wait for the next step of the local replanner, and settling, as in config/.
  changes["planning_time"] = rules.settle_s + 0.2;
  changes["planning_threads"] = rules.planning_threads;
  values.assign(changes, "fleet rules");
  return values;
}

ParameterTable local_values(const FleetRules& rules) {
  ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  YAML::Node changes;
  changes["settle_time"] = rules.settle_s;
  changes["answer_timeout"] = rules.settle_s + 0.3;
  changes["planning_threads"] = rules.planning_threads;
  values.assign(changes, "fleet rules");
  return values;
}

CommitmentSettings commitment_settings(const std::string& name, const RobotModel& robot,
                                       const FleetRules& rules) {
  const auto values = ParameterTable::from_schema("config/trajectory_broadcaster.yaml");
  CommitmentSettings settings;
  settings.agent = name;
  settings.delta_dc_s = rules.delta_dc_s;
  settings.reach_timeout_s = values.number("reach_timeout");
  settings.peer_clearance_m = robot.peer_clearance_m + MarginBudget::of(robot).peer_margin_m();
  settings.heartbeat_period_s = 1.0 / values.number("heartbeat_rate");
  settings.resend_period_s = 1.0 / values.number("resend_rate");
  return settings;
}

std::variant<Commitment, OnePhase> protocol(const CommitmentSettings& settings,
                                            const FleetRules& rules) {
  if (rules.protocol == Protocol::kOnePhase) return OnePhase(settings);
  return Commitment(settings);
}

}  // namespace

FleetMap::FleetMap(const OccupancyGrid& grid)
    : obstacles(std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupied)),
      unseen(std::make_shared<DistanceField>(grid, DistanceField::Solid::kOccupiedOrUnknown)),
      terrain(std::make_shared<MapTerrain>(obstacles)) {}

FleetRobot::FleetRobot(std::string name, const FleetAgent& agent, const FleetRules& rules)
    : name_(std::move(name)),
      robot_(load_robot_model("config", "rover")),
      agent_(agent),
      rules_(rules),
      planner_(robot_, PlannerRules::from(global_values(rules))),
      pursuit_(PursuitRules::from(global_values(rules)), kBraking * robot_.limits.max_acceleration,
               RightOfWay({false, 0, name_}, robot_, PlannerRules::from(global_values(rules)))),
      replanner_(robot_, LocalReplannerRules::from(local_values(rules), robot_),
                 LocalRules::from(local_values(rules))),
      protocol_(protocol(commitment_settings(name_, robot_, rules), rules)),
      link_(name_, std::nullopt),
      lease_s_(local_values(rules).number("lease")) {}

const PeerTable& FleetRobot::peers() const {
  return std::visit([](const auto& each) -> const PeerTable& { return each.peers(); }, protocol_);
}

const PromiseChain& FleetRobot::binding() const {
  return std::visit([](const auto& each) -> const PromiseChain& { return each.binding(); },
                    protocol_);
}

template <typename Call>
auto FleetRobot::timed(double& took_s, Call call) const {
  const double begin_s = clock_s(rules_.planning_threads == 1);
  auto result = call();
  took_s = clock_s(rules_.planning_threads == 1) - begin_s;
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
    if (const auto* request = std::get_if<WayRequest>(&*heard)) {
      pursuit_.hear(*request, now_s);
      return CommitmentActions();
    }
    if (const auto* promise = std::get_if<Promise>(&*heard))
      return protocol.receive(*promise, now_s);
    return protocol.receive(std::get<Beat>(*heard), now_s);
  });
}

std::vector<FleetRobot::Bytes> FleetRobot::tick(double now_s) {
  return with_protocol(now_s, [&](auto& protocol) { return protocol.tick(now_s); });
}

std::vector<FleetRobot::Bytes> FleetRobot::apply(const CommitmentActions& actions, double now_s) {
  std::vector<Bytes> sent;
  const auto send = [&](const FleetMessage& message) {
    for (Bytes& datagram : link_.pack(message)) sent.push_back(std::move(datagram));
  };
  for (const Promise& promise : actions.promises) send(promise);
  if (actions.beat) send(*actions.beat);
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
      replanner_.on_refusal(proposed_);
      break;
    case Kind::kBreached:
      ++record_.breaches;
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
  brakes_ = false;
  leased_until_s_ = now_s + lease_s_;
}

RobotState FleetRobot::state(double now_s) {
  const bool leased = now_s <= leased_until_s_;
  if (!leased && !brakes_ && !driven_.empty() && driven_.end_time() > now_s) {
    brakes_ = true;
    ++record_.leases_lost;
    driven_ = with_brake(driven_, driven_.cut_time(now_s), driven_.switch_time(now_s),
                         kBraking * robot_.limits.max_acceleration);
  }
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
      rules_.tracking_error_m * Vector2(std::cos(phase_rad), std::sin(phase_rad));
  return state;
}

void FleetRobot::refresh_peers(double now_s) {
  std::map<std::string, PromiseId> known;
  for (const auto& [name, peer] : peers().peers()) {
    if (!peer.binding.empty()) known[name] = peer.binding.newest().id;
  }
  if (known == known_ && now_s < refresh_at_s_) return;
  refresh_at_s_ = now_s + kRefreshPeriod_s;
  known_ = std::move(known);
  others_.clear();
  for (const auto& [name, peer] : peers().peers()) {
    if (peer.binding.empty()) continue;
    others_.push_back(std::make_shared<PeerObstacle>(name, peer.binding.composed(now_s),
                                                     peer.binding.newest().footprint_radius_m));
  }
}

std::vector<FleetRobot::Bytes> FleetRobot::propose(double now_s) {
  refresh_peers(now_s);
  PromiseScene scene;
  scene.obstacles = agent_.map->obstacles;
  scene.unseen = agent_.map->unseen;
  scene.others = others_;
  scene.predicted_until_s = now_s;
  record_.steps_s.emplace_back();
  const LocalReplanner::Output output =
      timed(record_.steps_s.back(), [&] { return replanner_.step(now_s, state(now_s), scene); });
  if (output.swerves || output.keeps_plan) pursuit_.follow(replanner_.plan());
  if (output.request_plan) pursuit_.request();
  if (output.renew_lease) leased_until_s_ = now_s + lease_s_;
  if (!output.proposal) return {};
  proposed_ = output.proposal->sequence;
  const Proposal proposal{proposed_, robot_.footprint.circumscribed_radius_m(),
                          std::make_shared<const Motion>(output.proposal->motion)};
  return with_protocol(now_s, [&](auto& protocol) {
    return output.proposal->emergency ? protocol.brake(proposal, now_s)
                                      : protocol.propose(proposal, now_s);
  });
}

std::vector<FleetRobot::Bytes> FleetRobot::pursue(double now_s) {
  if (!reached_ && pursuit_.idle()) pursuit_.take({Goal{agent_.goal, std::nullopt}}, now_s);
  refresh_peers(now_s);
  Pursuit::Output output = pursuit_.step(now_s, state(now_s), replanner_.committed(),
                                         {[this](const PlanQuery& query) { return plan(query); },
                                          [this](const auto&) {
                                            return PlanningScene{agent_.map->terrain, others_};
                                          }});
  reached_ = reached_ || output.ending == Pursuit::Ending::kReached;
  if (!output.plan.empty()) replanner_.set_plan(output.plan);
  if (!output.request) return {};
  output.request->epoch = CommitmentSettings().epoch;
  return link_.pack(*output.request);
}

PlanResult FleetRobot::plan(const PlanQuery& query) {
  record_.plans_s.emplace_back();
  const PlanningScene scene{agent_.map->terrain, others_};
  PlanResult result = timed(record_.plans_s.back(),
                            [&] { return planner_.plan(query, scene, [] { return false; }); });
  record_.paths = std::max(record_.paths, static_cast<int>(result.candidates.size()));
  return result;
}

}  // namespace mocha
