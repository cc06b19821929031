#include "benchmarks/table2_mocha.h"

#include <chrono>
#include <memory>

#include "planning/global/global_planner.h"
#include "topology/static_map/primitive_static_map.h"

namespace mocha {
namespace {

/// Margins of a perfect base: like its peers, the planner keeps the true circles only.
RobotModel robot() {
  RobotModel robot{};
  robot.name = "table2";
  robot.limits.max_speed = Table2Robot::kMaxSpeed;
  robot.limits.max_acceleration = Table2Robot::kMaxAcceleration;
  robot.limits.max_yaw_rate = 20.0;  // the peers turn as they like
  robot.footprint = Footprint::disc(Table2Robot::kRadius_m);
  return robot;
}

/// The planner's defaults, but for sizes that belong to a robot of 3 m/s among circles of 1 to 4 m.
PlannerOptions options() {
  PlannerOptions options{};
  options.weight_effort = 0.01;
  options.weight_duration = 1.0;
  options.weight_obstacle = 200.0;
  options.weight_dynamics = 5000.0;
  options.weight_turning = 5000.0;
  options.samples_per_piece = 12;
  options.knot_spacing_m = 6.0;
  options.open_knot_spacing_m = 8.0;
  options.knot_travel_m = 4.0;
  options.soft_margin_m = 0.1;
  options.preferred_clearance_m = 0.1;
  options.clearance_weight = 3.0;
  options.max_evaluations = 300;
  options.smooth_start_rad = 1.5;
  options.goal_search_radius_m = 0.4;
  options.roadmap = roadmap_kind("best");
  options.classes = 5;
  options.longest_ratio = 2.0;
  options.switch_margin = 0.0;
  return options;
}

PlanarPath drive_of(const Motion& motion) {
  for (const Phase& phase : motion.phases()) {
    if (const auto* drive = std::get_if<DrivePhase>(&phase)) return drive->path;
  }
  return {};
}

}  // namespace

Table2Plan plan_with_mocha(const Table2World& world, const Vector2& target) {
  static const GlobalPlanner planner(robot(), options());
  const Vector2 ahead = target - world.start;
  PlanQuery query;
  query.committed =
      Motion(-1.0, {StandPhase{{world.start, std::atan2(ahead.y(), ahead.x())}, 0.1}});
  query.goal = target;
  const Vector2 border = Vector2::Constant(Table2World::kBorder_m);
  const Eigen::AlignedBox2d bounds(-border, Vector2::Constant(Table2World::kSide_m) + border);
  const auto begin = std::chrono::steady_clock::now();
  const auto field = std::make_shared<PrimitiveField<2>>(obstacle_field(world));
  const PlanningScene scene{std::make_shared<PrimitiveStaticMap>(field, bounds), {}};
  const PlanResult found = planner.plan(query, scene);
  Table2Plan result;
  result.t_plan_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.curve = drive_of(found.motion);
  result.classes = static_cast<int>(found.candidates.size());
  for (const PlanCandidate& candidate : found.candidates) {
    if (!candidate.motion.empty()) result.candidates.push_back(drive_of(candidate.motion));
  }
  return result;
}

}  // namespace mocha
