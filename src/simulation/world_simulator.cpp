#include "simulation/world_simulator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "simulation/mover_path.h"
#include "simulation/time_slack.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMovingSpeed = 1e-3;    // [m/s] and [rad/s]; less is standing
constexpr double kSpareHistory_s = 1.0;  // beyond the longest sweep and delay; more than any step

bool is_moving(const SimulatedRobot& robot) {
  const Twist twist = robot.vehicle.twist();
  return std::abs(twist.speed) > kMovingSpeed || std::abs(twist.yaw_rate) > kMovingSpeed;
}

/// A contact with a body at `centre`, counted. What stands is touched in the direction of travel.
ContactEvent blamed(SimulatedRobot& robot, const std::string& other, const Gap& between,
                    const Vector2& centre, const Vector2& velocity) {
  const Pose& base = robot.vehicle.pose();
  Touch touch{between.place, velocity_at(between.place, base, robot.vehicle.twist()), velocity, {}};
  touch.towards = other == "static" ? touch.own_velocity : centre - between.place;
  touch.towards.normalize();
  const Blame blame = blame_of(touch, base, robot.setup.model.lidar);
  ++robot.contacts;
  if (blame == Blame::kOwn) ++robot.own_contacts;
  return {robot.setup.name, other, -between.distance_m, touch, blame};
}

/// Independent generators from one seed.
std::uint64_t derived_seed(std::uint64_t seed, std::uint32_t robot, std::uint32_t use) {
  std::seed_seq mixer{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                      robot, use};
  std::uint32_t words[2];
  mixer.generate(words, words + 2);
  return (static_cast<std::uint64_t>(words[0]) << 32) | words[1];
}

}  // namespace

WorldSimulator::WorldSimulator(World world, double start_time_s, std::uint64_t seed)
    : world_(std::move(world)),
      start_time_s_(start_time_s),
      time_s_(start_time_s),
      walls_(world_.circles, world_.polygons) {
  double longest_sweep_s = 0.0;
  for (const WorldRobot& setup : world_.robots) {
    longest_sweep_s = std::max(longest_sweep_s, setup.model.lidar.sweep_time_s);
  }
  const Arrival arrival = world_.optimal_time_s ? Arrival::kNear : Arrival::kStanding;
  for (const WorldRobot& setup : world_.robots) {
    const auto index = static_cast<std::uint32_t>(robots_.size());
    const RobotModel& model = setup.model;
    robots_.push_back(
        {setup, Vehicle(model, setup.start),
         Odometry(model.odometry_noise_distance, model.odometry_noise_yaw,
                  derived_seed(seed, index, 0)),
         Lidar(model.lidar, derived_seed(seed, index, 1)),
         RunRecord(setup.start, setup.goal, arrival),
         PoseHistory(longest_sweep_s + SensorFault::kLongestDelay_s + kSpareHistory_s),
         start_time_s, kInfinity});
    robots_.back().past.add(time_s_, setup.start);
  }
  std::vector<ContactEvent> none;
  for (SimulatedRobot& robot : robots_) check_obstacles(robot, none);
}

void WorldSimulator::command(int robot, const Twist& twist) {
  robots_.at(robot).vehicle.command(time_s_, twist);
}

void WorldSimulator::set_fault(const std::string& robot, const SensorFault& fault) {
  bool found = robot.empty();
  for (const SimulatedRobot& one : robots_) found |= one.setup.name == robot;
  if (!found) throw std::invalid_argument("WorldSimulator: there is no robot " + robot);
  for (SimulatedRobot& one : robots_) {
    const bool lies = robot.empty() || one.setup.name == robot;
    one.lidar.set_fault(lies ? fault.lidar : LidarFault());
    one.odometry.set_fault(lies ? fault.odometry : OdometryFault());
  }
}

WorldSimulator::StepResult WorldSimulator::step_to(double time_s) {
  const double dt_s = time_s - time_s_;
  if (!(dt_s > 0.0))
    throw std::invalid_argument("WorldSimulator: a step must lead forward in time");
  for (SimulatedRobot& robot : robots_) {
    const Arc arc = robot.vehicle.step(time_s_, dt_s);
    robot.odometry.add(arc, robot.vehicle.twist());
    robot.past.add(time_s, robot.vehicle.pose());
    robot.record.update(time_s, robot.vehicle.pose(), robot.vehicle.twist(), arc);
  }
  time_s_ = time_s;
  StepResult result;
  for (SimulatedRobot& robot : robots_) check_obstacles(robot, result.contacts);
  check_robots(result.contacts);
  for (std::size_t i = 0; i < robots_.size(); ++i) sweep(i, result.scans);
  return result;
}

double WorldSimulator::min_separation_m() const {
  double least = kInfinity;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    for (std::size_t j = i + 1; j < robots_.size(); ++j) {
      const Vector2 between =
          robots_[i].vehicle.pose().position - robots_[j].vehicle.pose().position;
      least = std::min(least, between.norm());
    }
  }
  return least;
}

std::vector<Circle> WorldSimulator::moving_discs(double time_s) const {
  std::vector<Circle> discs;
  for (const Mover& mover : world_.moving) {
    if (const auto state = mover_state(mover, time_s - start_time_s_))
      discs.push_back({state->centre, mover.radius_m});
  }
  return discs;
}

std::vector<Obstacle> WorldSimulator::seen_by(std::size_t robot, double time_s) const {
  std::vector<Obstacle> seen;
  for (const Circle& disc : moving_discs(time_s)) seen.push_back(disc);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (i == robot) continue;
    seen.push_back(placed(robots_[i].setup.model.footprint, robots_[i].past.at(time_s)));
  }
  return seen;
}

Gap WorldSimulator::static_gap(const Obstacle& body, const Footprint& footprint,
                               const Vector2& centre) const {
  Gap nearest{kInfinity, centre};
  const auto consider = [&](const auto& shape) {
    // No part of the robot is farther from its centre than its circumscribed radius.
    const double bound = gap(centre, shape).distance_m - footprint.circumscribed_radius_m();
    if (bound >= nearest.distance_m) return;
    const Gap here = gap(body, shape);
    if (here.distance_m < nearest.distance_m) nearest = here;
  };
  for (const Circle& circle : world_.circles) consider(circle);
  for (const Polygon& polygon : world_.polygons) consider(polygon);
  return nearest;
}

void WorldSimulator::check_obstacles(SimulatedRobot& robot, std::vector<ContactEvent>& events) {
  const Gap between =
      static_gap(robot.body(), robot.setup.model.footprint, robot.vehicle.pose().position);
  robot.clearance_m = between.distance_m;
  if (watch_.begins(robot.setup.name, "static", between.distance_m, is_moving(robot)))
    events.push_back(blamed(robot, "static", between, Vector2::Zero(), Vector2::Zero()));
  check_movers(robot, events);
}

void WorldSimulator::check_movers(SimulatedRobot& robot, std::vector<ContactEvent>& events) {
  for (std::size_t i = 0; i < world_.moving.size(); ++i) {
    const auto state = mover_state(world_.moving[i], time_s_ - start_time_s_);
    Gap between{kInfinity, Vector2::Zero()};  // to what is not there
    if (state) between = gap(robot.body(), Circle{state->centre, world_.moving[i].radius_m});
    robot.clearance_m = std::min(robot.clearance_m, between.distance_m);
    const bool moving = is_moving(robot) || (state && state->velocity.norm() > kMovingSpeed);
    if (watch_.begins(robot.setup.name, "moving " + std::to_string(i), between.distance_m, moving))
      events.push_back(blamed(robot, "moving", between, state->centre, state->velocity));
  }
}

void WorldSimulator::check_robots(std::vector<ContactEvent>& events) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    for (std::size_t j = i + 1; j < robots_.size(); ++j) {
      SimulatedRobot& first = robots_[i];
      SimulatedRobot& second = robots_[j];
      const Gap between = gap(first.body(), second.body());
      const bool moving = is_moving(first) || is_moving(second);
      if (!watch_.begins(first.setup.name, second.setup.name, between.distance_m, moving)) {
        continue;
      }
      for (auto [one, other] : {std::pair(&first, &second), std::pair(&second, &first)}) {
        const Pose& there = other->vehicle.pose();
        events.push_back(blamed(*one, other->setup.name, between, there.position,
                                velocity_at(between.place, there, other->vehicle.twist())));
      }
    }
  }
}

void WorldSimulator::sweep(std::size_t index, std::vector<RobotScan>& scans) {
  SimulatedRobot& robot = robots_[index];
  const LidarModel& lidar = robot.setup.model.lidar;
  const Lidar::Scene scene{walls_, [&](double t) { return robot.past.at(t); },
                           [&](double t) { return seen_by(index, t); }};
  while (robot.next_sweep_s + lidar.sweep_time_s <= time_s_ + kTimeSlack_s) {
    scans.push_back({static_cast<int>(index), robot.lidar.sweep(robot.next_sweep_s, scene)});
    robot.next_sweep_s += 1.0 / lidar.rate_hz;
  }
}

}  // namespace mocha
