#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "benchmarks/fleet_robot.h"
#include "simulation/lossy_network.h"

namespace mocha {

/// The clock of a robot: what it shows more than the true one.
struct FleetClock {
  double ahead_s = 0.0;
  double drift = 0.0;  ///< [s/s]
};

/// A fleet in one process: robots with all their planners, no ROS, simulated time.
struct FleetScene {
  std::vector<FleetAgent> agents;
  FleetOptions options;
  NetworkLink link;
  /// So much of the least delay is moved from one direction to the other, of each two robots: at 1
  /// messages take twice as long there, and nothing back.
  double asymmetry = 0.0;
  std::vector<FleetClock> clocks;  ///< of the robots; those that have none show the true time
  /// A robot farther away hears nothing.
  double reach_m = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 1;  ///< of the network, and of when robots look
  double longest_s = 60.0;
};

struct FleetAgentRun {
  bool reached = false;
  double time_s = 0.0;  ///< until it stood at its goal, or the end
  double least_separation_m = std::numeric_limits<double>::infinity();  ///< to any other robot
  std::size_t bytes = 0;                                                ///< sent
  std::size_t largest_datagram = 0;
  PlanningRecord planning;
  std::vector<Vector2> places;  ///< every FleetRun::kSample_s from the beginning on
};

struct FleetRun {
  static constexpr double kSample_s = 0.1;

  std::vector<FleetAgentRun> agents;
  int contacts = 0;  ///< pairs of true footprints that came to overlap while one of them moved
  double min_separation_m = std::numeric_limits<double>::infinity();
  double time_s = 0.0;  ///< until all stood at their goals, or the end

  bool all_reached() const;
};

/// A fleet that drives, in steps of simulated time. The same for the same scene, but for wall
/// times.
class FleetSimulation {
 public:
  explicit FleetSimulation(FleetScene scene);

  /// Whether all stand at their goals, or scene.longest_s is over.
  bool is_over() const;
  void step();
  /// What came of it so far.
  FleetRun run() const;

 private:
  int size() const { return static_cast<int>(robots_.size()); }
  double now_s() const;
  double now_s(int i) const;  // by the clock of robot i
  void deliver();
  void work(int i);
  void send(int from, std::vector<FleetRobot::Bytes> datagrams);
  void watch();
  void watch_pair(int i, int k, const RobotState& a, const RobotState& b);

  const FleetScene scene_;
  const double radius_m_;
  LossyNetwork<std::shared_ptr<const FleetRobot::Bytes>> network_;
  std::mt19937 random_;
  std::deque<FleetRobot> robots_;
  std::vector<int> late_ms_;
  std::vector<Vector2> places_;
  std::set<std::pair<int, int>> touching_;
  int ms_ = 0;
  FleetRun run_;
};

/// To the end.
FleetRun run_fleet(const FleetScene& scene);

}  // namespace mocha
