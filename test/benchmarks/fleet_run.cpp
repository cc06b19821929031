#include "benchmarks/fleet_run.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace mocha {
namespace {

constexpr double kBegin_s = 1.7e9;
constexpr int kStep_ms = 10;  // of the network and of what is watched
constexpr int kTick_ms = 20;  // as the nodes' periods
constexpr int kExecutive_ms = 50;
constexpr int kProposal_ms = 100;
constexpr int kSample_ms = 100;
constexpr double kStanding_mps = 1e-3;

}  // namespace

FleetSimulation::FleetSimulation(FleetScene scene)
    : scene_(std::move(scene)),
      radius_m_(load_robot_model("config", "rover").footprint.circumscribed_radius_m()),
      network_(scene_.seed, scene_.link),
      random_(scene_.seed) {
  const int digits = static_cast<int>(std::to_string(scene_.agents.size()).size());
  for (std::size_t i = 0; i < scene_.agents.size(); ++i) {
    std::string number = std::to_string(i + 1);
    number.insert(0, digits - number.size(), '0');
    robots_.emplace_back("ugv" + number, scene_.agents[i], scene_.options);
    // Robots do not all look at the same moment.
    late_ms_.push_back(static_cast<int>(random_() % (kProposal_ms / kStep_ms)) * kStep_ms);
  }
  for (const FleetAgent& agent : scene_.agents) places_.push_back(agent.start.position);
  run_.agents.resize(robots_.size());
}

bool FleetSimulation::is_over() const {
  return run_.time_s >= scene_.longest_s ||
         std::all_of(robots_.begin(), robots_.end(),
                     [](const FleetRobot& robot) { return robot.reached(); });
}

void FleetSimulation::step() {
  ms_ += kStep_ms;
  run_.time_s = 1e-3 * ms_;
  deliver();
  for (int i = 0; i < size(); ++i) work(i);
  watch();
}

FleetRun FleetSimulation::run() const {
  FleetRun run = run_;
  for (int i = 0; i < size(); ++i) {
    run.agents[i].reached = robots_[i].reached();
    run.agents[i].planning = robots_[i].record();
  }
  return run;
}

double FleetSimulation::now_s() const { return kBegin_s + 1e-3 * ms_; }

double FleetSimulation::now_s(int i) const {
  if (i >= static_cast<int>(scene_.clocks.size())) return now_s();
  return now_s() + scene_.clocks[i].ahead_s + 1e-3 * ms_ * scene_.clocks[i].drift;
}

void FleetSimulation::deliver() {
  for (const auto& delivery : network_.receive(now_s())) {
    send(delivery.to, robots_[delivery.to].hear(*delivery.message, now_s(delivery.to)));
  }
}

void FleetSimulation::work(int i) {
  FleetRobot& robot = robots_[i];
  const int ms = ms_ + late_ms_[i];
  const bool was_there = robot.reached();
  if (ms % kTick_ms == 0) send(i, robot.tick(now_s(i)));
  if (ms % kExecutive_ms == 0) send(i, robot.pursue(now_s(i)));
  if (ms % kProposal_ms == 0 || robot.breached()) send(i, robot.propose(now_s(i)));
  if (!was_there) run_.agents[i].time_s = run_.time_s;
}

void FleetSimulation::send(int from, std::vector<FleetRobot::Bytes> datagrams) {
  FleetAgentRun& agent = run_.agents[from];
  for (FleetRobot::Bytes& datagram : datagrams) {
    agent.bytes += datagram.size();
    agent.largest_datagram = std::max(agent.largest_datagram, datagram.size());
    const auto shared = std::make_shared<const FleetRobot::Bytes>(std::move(datagram));
    for (int to = 0; to < size(); ++to) {
      const bool hears = (places_[to] - places_[from]).norm() <= scene_.reach_m;
      const double later_s = (from < to ? 1.0 : -1.0) * scene_.asymmetry * scene_.link.min_delay_s;
      if (to != from && hears) network_.send(from, to, shared, now_s() + later_s);
    }
  }
}

void FleetSimulation::watch() {
  std::vector<RobotState> states;
  for (int i = 0; i < size(); ++i) states.push_back(robots_[i].state(now_s(i)));
  for (int i = 0; i < size(); ++i) {
    places_[i] = states[i].pose.position;
    if (ms_ % kSample_ms == 0) run_.agents[i].places.push_back(states[i].pose.position);
    for (int k = 0; k < i; ++k) watch_pair(i, k, states[i], states[k]);
  }
}

void FleetSimulation::watch_pair(int i, int k, const RobotState& a, const RobotState& b) {
  const double apart_m = (a.pose.position - b.pose.position).norm();
  for (const int one : {i, k}) {
    double& least_m = run_.agents[one].least_separation_m;
    least_m = std::min(least_m, apart_m);
  }
  run_.min_separation_m = std::min(run_.min_separation_m, apart_m);
  if (apart_m >= 2.0 * radius_m_) {
    touching_.erase({i, k});
    return;
  }
  const bool moving =
      std::abs(a.twist.speed) > kStanding_mps || std::abs(b.twist.speed) > kStanding_mps;
  if (moving && touching_.insert({i, k}).second) ++run_.contacts;
}

bool FleetRun::all_reached() const {
  return std::all_of(agents.begin(), agents.end(),
                     [](const FleetAgentRun& agent) { return agent.reached; });
}

FleetRun run_fleet(const FleetScene& scene) {
  FleetSimulation fleet(scene);
  while (!fleet.is_over()) fleet.step();
  return fleet.run();
}

}  // namespace mocha
