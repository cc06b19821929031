#include "benchmarks/lidar_robot.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "topology/static_map/grid_static_map.h"

namespace mocha {
namespace {

constexpr double kBegin_s = 1.7e9;
constexpr double kMapBorder_m = 3.0;  // as the nodes have it
constexpr double kLease_s = 0.5;
// Nearly all time goes into planning in vain where a robot cannot leave; a quarter of it will do.
constexpr double kRetry_s = 2.0;
// Of the nodes, in ticks.
constexpr int kFast = 2;  // simulator, tracker, broadcaster
constexpr int kPursuit = 5;
constexpr int kReplanning = 10;
constexpr int kReplanningLate = 3;  // the nodes do not all look at the same moment

ParameterTable schema(const std::string& node) {
  return ParameterTable::from_schema("config/" + node + ".yaml");
}

ParameterTable global_values() {
  ParameterTable values = schema("global_planner");
  YAML::Node changes;
  changes["planning_threads"] = 1;  // several robots are run beside each other
  changes["retry_period"] = kRetry_s;
  values.assign(changes, "lidar robot");
  return values;
}

ParameterTable local_values() {
  ParameterTable values = schema("local_replanner");
  YAML::Node changes;
  changes["planning_threads"] = 1;
  values.assign(changes, "lidar robot");
  return values;
}

/// The lidar sweeps no more often than scans enter the map: the others would be dropped.
World with_needed_scans_only(World world, double rate_hz) {
  world.robots.resize(1);
  LidarModel& lidar = world.robots[0].model.lidar;
  lidar.rate_hz = std::min(lidar.rate_hz, rate_hz);
  return world;
}

/// The same where it holds all places, as the nodes have it.
OccupancyGrid holding(const OccupancyGrid& grid, const std::vector<Vector2>& places) {
  const Vector2 size = grid.resolution_m * Vector2(grid.width, grid.height);
  const auto is_in = [&](const Vector2& place) {
    const Vector2 at = place - grid.origin;
    return at.minCoeff() >= grid.resolution_m && (size - at).minCoeff() >= 2.0 * grid.resolution_m;
  };
  if (std::all_of(places.begin(), places.end(), is_in)) return grid;
  return grown_to_hold(grid, places, kMapBorder_m);
}

}  // namespace

LidarRobot::LidarRobot(const World& world, std::uint64_t seed)
    : robot_(world.robots.at(0).model),
      simulator_(with_needed_scans_only(world, schema("perception").number("integration_rate")),
                 kBegin_s, seed),
      perception_(robot_),
      reach_(
          Reach::from(schema("trajectory_broadcaster"), robot_, local_values().number("horizon"))),
      protocol_(
          CommitmentOptions::from(schema("trajectory_broadcaster"), robot_, reach_, "ugv1", 1)),
      stack_("ugv1", robot_, {global_values(), local_values(), reach_}, protocol_),
      tracker_(TrackerParameters::from(schema("trajectory_tracker")), robot_),
      places_{truth().setup.start.position} {}

double LidarRobot::now_s() const { return kBegin_s + kTick_s * ticks_; }

void LidarRobot::go_to(const Vector2& goal) {
  places_ = {truth().vehicle.pose().position, goal};
  stack_.take({Goal{goal, std::nullopt}}, now_s());
}

void LidarRobot::tick() {
  ++ticks_;
  contacts_.clear();
  if (ticks_ % kFast == 0) simulate();
  if (!static_map_) return;
  if (ticks_ % kFast == 0) stack_.tick(now_s());
  if (ticks_ % kPursuit == 0) pursue();
  if (ticks_ % kReplanning == kReplanningLate || stack_.step_is_due()) replan();
  if (ticks_ % kFast == 0) drive();
}

void LidarRobot::simulate() {
  auto result = simulator_.step_to(now_s());
  contacts_ = std::move(result.contacts);
  for (const auto& [robot, scan] : result.scans) perceive(scan);
  if (const auto grid = perception_.publish(now_s())) take_map(*grid);
}

void LidarRobot::perceive(const Scan& scan) {
  const PlanarScan planar = planar_scan(scan, truth());
  perception_.take(planar, truth().past.at(planar.start_time_s),
                   truth().past.at(planar.end_time_s()));
  predictions_ = perception_.predictions();
}

void LidarRobot::take_map(const OccupancyGrid& grid) {
  places_[0] = truth().vehicle.pose().position;
  const OccupancyGrid held = holding(grid, places_);
  static_map_ = std::make_shared<GridStaticMap>(
      std::make_shared<DistanceField>(held, DistanceField::Solid::kOccupied));
  unseen_ = std::make_shared<DistanceField>(held, DistanceField::Solid::kOccupiedOrUnknown);
}

void LidarRobot::pursue() {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  stack_.pursue(now_s(), measured(), {static_map_, {}, [this] { return unseen_; }});
  if (stack_.pursued().planned) {
    slowest_plan_s_ =
        std::max(slowest_plan_s_, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  if (ending_ == GoalExecutive::Ending::kNone) ending_ = stack_.pursued().ending;
  note();
}

void LidarRobot::note() {
  const auto& report = stack_.pursued().report;
  if (!report || report->reason == PlanReason::kNoGoal) return;
  words_ = report->reason == PlanReason::kSolved ? "solved" : report->message;
}

void LidarRobot::replan() { stack_.replan(now_s(), measured(), scene()); }

Discs LidarRobot::confident() const {
  const RiskOptions options = RiskOptions::from(local_values_, robot_);
  const double confidence =
      confidence_of_each(predictions_, truth().vehicle.pose().position, options);
  return confident_discs(predictions_, confidence, options);
}

LocalScene LidarRobot::scene() const {
  LocalScene scene = local_scene(static_map_, unseen_);
  scene.confident = confident();
  scene.likely = likely_discs(predictions_);
  scene.predicted_until_s = now_s() + local_values_.number("prediction_horizon");
  return scene;
}

/// The stack ends leases itself, by a promise to stop.
void LidarRobot::drive() {
  if (stack_.committed().empty()) return;
  if (!(stack_.committed_id() == offered_)) {
    offered_ = stack_.committed_id();
    tracker_.offer(offered_, stack_.committed(), now_s() + kLease_s);
  }
  tracker_.renew(offered_, now_s() + kLease_s);
  const UnicycleState command = tracker_.step(now_s(), measured());
  simulator_.command(0, {command.speed, command.yaw_rate});
}

RobotState LidarRobot::measured() const {
  const Twist twist = truth().vehicle.twist();
  return {now_s(), truth().vehicle.pose(), {twist.speed, twist.yaw_rate}};
}

}  // namespace mocha
