#include "benchmarks/sighted_drive.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "benchmarks/mover_sightings.h"
#include "simulation/blame.h"
#include "simulation/contact_watch.h"
#include "simulation/mover_path.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.25;
constexpr int kLeastSpeeds = 4;  // of the lattice, along an axis
constexpr double kCheck_s = 0.02;
constexpr double kHorizon_s = 5.0;
constexpr int kMostExpansions = 20000;

/// The coarsest lattice on which the robot reaches its highest speed, and can accelerate along
/// both axes at once.
LatticeUnits units_of(const MotionLimits& limits) {
  const double speeds = std::sqrt(2.0) * limits.max_speed / (limits.max_acceleration * kStep_s);
  LatticeUnits units;
  units.step_s = kStep_s;
  units.push =
      limits.max_speed / std::max(kLeastSpeeds, static_cast<int>(std::ceil(speeds))) / units.step_s;
  return units;
}

struct Rung {
  PredictionMargin margin;
  double max_acceleration;
  bool may_be_touched_standing;
};

std::vector<Rung> ladder(const RobotModel& model, double growth_mps) {
  const double usual = model.limits.max_acceleration;
  const double hard = model.emergency_acceleration;
  return {{{0.15, growth_mps, 1.0}, usual, false},
          {{0.1, 0.3 * growth_mps, 0.3}, usual, false},
          {{0.02, 0.0, 0.0}, hard, false},
          {{0.02, 0.0, 0.0}, hard, true}};
}

/// Forward only where the lidar does not look back.
SolverOptions options_on_sight(const World& world, double begin_s, double limit_s) {
  SolverOptions options = solver_options(world, begin_s, limit_s);
  if (!world.robots.front().model.lidar.sees_all_round()) options.can_reverse = false;
  return options;
}

class Drive {
 public:
  Drive(const World& world, double begin_s, double limit_s, const SightOptions& sight)
      : world_(world),
        model_(world.robots.front().model),
        limit_s_(limit_s),
        replan_steps_(std::max(1, static_cast<int>(std::lround(sight.replan_s / kStep_s)))),
        solver_(problem_of(world, begin_s), options_on_sight(world, begin_s, limit_s)),
        sightings_(world),
        rungs_(ladder(model_, sight.growth_mps)),
        state_(solver_.start()),
        pose_(world.robots.front().start) {
    for (double t = 0.0; t <= begin_s; t += kStep_s) sightings_.look(t, pose_);
  }

  SightedDrive run() {
    while (!drive_.has_own_contact && solver_.lattice().time_s(state_) < limit_s_) {
      if (solver_.arrived(state_)) {
        drive_.arrival_s = solver_.lattice().time_s(state_);
        break;
      }
      for (const LatticeState& to : next()) drive_to(to);
    }
    return drive_;
  }

 private:
  /// The states up to the next search.
  std::vector<LatticeState> next() const {
    const Vector2 place = solver_.lattice().place(state_);
    const double radius_m = model_.footprint.circumscribed_radius_m();
    for (const Rung& rung : rungs_) {
      const SearchLimits limits{rung.max_acceleration,
                                solver_.lattice().time_s(state_) + kHorizon_s,
                                rung.may_be_touched_standing, kMostExpansions};
      const auto way =
          solver_.way(state_, sightings_.predicted(rung.margin, place, radius_m), limits);
      if (way.empty()) continue;
      const auto steps = std::min(replan_steps_, static_cast<int>(way.size()) - 1);
      return {way.begin() + 1, way.begin() + 1 + steps};
    }
    return braked();
  }

  std::vector<LatticeState> braked() const {
    std::vector<LatticeState> states{state_};
    for (int i = 0; i < replan_steps_; ++i) states.push_back(braked(states.back()));
    return {states.begin() + 1, states.end()};
  }

  LatticeState braked(const LatticeState& from) const {
    const double push = solver_.lattice().units().push;
    const int most = static_cast<int>(model_.emergency_acceleration / push);
    LatticeState slowest = solver_.lattice().pushed(from, 0, 0);
    const auto speed2 = [](const LatticeState& state) {
      return state.vx * state.vx + state.vy * state.vy;
    };
    for (int ax = -most; ax <= most; ++ax) {
      for (int ay = -most; ay <= most; ++ay) {
        if (push * std::hypot(ax, ay) > model_.emergency_acceleration) continue;
        const LatticeState to = solver_.lattice().pushed(from, ax, ay);
        if (speed2(to) < speed2(slowest) && solver_.lattice().turns(from, to)) slowest = to;
      }
    }
    return slowest;
  }

  void drive_to(const LatticeState& to) {
    if (drive_.has_own_contact) return;
    const SpaceTimeLattice& lattice = solver_.lattice();
    const Vector2 velocity = lattice.velocity(state_);
    const Vector2 acceleration = (lattice.velocity(to) - velocity) / kStep_s;
    const double begin_s = lattice.time_s(state_);
    const Vector2 begin = lattice.place(state_);
    const int checks = static_cast<int>(std::ceil(kStep_s / kCheck_s));
    for (int i = 1; i <= checks && !drive_.has_own_contact; ++i) {
      const double t = i * kStep_s / checks;
      const Twist twist = advance(begin + t * velocity + 0.5 * t * t * acceleration,
                                  velocity + t * acceleration, kStep_s / checks);
      check_contacts(begin_s + t, twist);
    }
    state_ = to;
    sightings_.look(lattice.time_s(state_), pose_);
    if (state_.stands()) {
      state_.heading = static_cast<std::int8_t>(lattice.heading_of(pose_.yaw_rad));
    }
  }

  /// The body turns with its direction of travel, front or back ahead; at rest it stays.
  Twist advance(const Vector2& place, const Vector2& velocity, double dt_s) {
    pose_.position = place;
    const double speed = velocity.norm();
    if (speed < 1e-6) return {};
    double turned_rad = wrap_angle(std::atan2(velocity.y(), velocity.x()) - pose_.yaw_rad);
    const bool reverses = std::abs(turned_rad) > 0.5 * M_PI && model_.limits.can_reverse;
    if (reverses) turned_rad = wrap_angle(turned_rad + M_PI);
    pose_.yaw_rad += turned_rad;
    const double most = model_.limits.max_yaw_rate;  // a turn at rest before is not drawn out
    return {reverses ? -speed : speed, std::clamp(turned_rad / dt_s, -most, most)};
  }

  void check_contacts(double time_s, const Twist& twist) {
    const Obstacle body = placed(model_.footprint, pose_);
    for (std::size_t i = 0; i < world_.moving.size(); ++i) {
      const auto mover = mover_state(world_.moving[i], time_s);
      Gap between{1.0, Vector2::Zero()};  // to what is not there
      if (mover) between = gap(body, Circle{mover->centre, world_.moving[i].radius_m});
      if (!watch_.begins("robot", std::to_string(i), between.distance_m, true)) continue;
      Touch touch{between.place, velocity_at(between.place, pose_, twist), mover->velocity, {}};
      touch.towards = (mover->centre - between.place).normalized();
      const Blame blame = blame_of(touch, pose_, model_.lidar);
      drive_.contacts.push_back(
          {time_s, between.place, to_text(blame), sightings_.knows(static_cast<int>(i))});
      if (blame == Blame::kOwn) drive_.has_own_contact = true;
    }
  }

  const World& world_;
  const RobotModel& model_;
  const double limit_s_;
  const int replan_steps_;
  const SpaceTimeSolver solver_;
  MoverSightings sightings_;
  const std::vector<Rung> rungs_;
  LatticeState state_;
  Pose pose_;
  ContactWatch watch_;
  SightedDrive drive_;
};

}  // namespace

SpaceTimeProblem problem_of(const World& world, double begin_s) {
  const WorldRobot& robot = world.robots.front();
  SpaceTimeProblem problem;
  problem.ground = {world.bounds.min(), world.bounds.max(), {}};
  for (const Circle& circle : world.circles) problem.ground.obstacles.push_back(circle);
  for (const Polygon& polygon : world.polygons) problem.ground.obstacles.push_back(polygon);
  for (const Polygon& polygon : kept_out_of(world.zones))
    problem.ground.obstacles.push_back(polygon);
  for (const Mover& mover : world.moving) {
    problem.movers.push_back([&mover](double time_s) -> std::optional<Circle> {
      const auto state = mover_state(mover, time_s);
      if (!state) return std::nullopt;
      return Circle{state->centre, mover.radius_m};
    });
  }
  problem.robot_radius_m = robot.model.footprint.circumscribed_radius_m();
  problem.start = robot.start;
  problem.start_time_s = begin_s;
  problem.goal = robot.goal.value().position;
  return problem;
}

SolverOptions solver_options(const World& world, double begin_s, double limit_s) {
  const MotionLimits& limits = world.robots.front().model.limits;
  SolverOptions options;
  options.to_walls_m = 0.02;
  options.to_movers_m = 0.02;
  options.max_speed = limits.max_speed;
  options.max_acceleration = limits.max_acceleration;
  options.max_yaw_rate = limits.max_yaw_rate;
  options.can_reverse = limits.can_reverse;
  options.longest_s = limit_s - begin_s;
  options.units = units_of(limits);
  return options;
}

SightedDrive drive_on_sight(const World& world, double begin_s, double limit_s,
                            const SightOptions& sight) {
  return Drive(world, begin_s, limit_s, sight).run();
}

}  // namespace mocha
