#include "benchmarks/table2_mocha.h"

#include <chrono>
#include <memory>

#include "planning/global_planner.h"
#include "topology/primitive_terrain.h"

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
PlannerRules rules() {
  PlannerRules rules{};
  rules.weight_effort = 0.01;
  rules.weight_duration = 1.0;
  rules.weight_obstacle = 200.0;
  rules.weight_dynamics = 5000.0;
  rules.weight_turning = 5000.0;
  rules.samples_per_piece = 12;
  rules.knot_spacing_m = 6.0;
  rules.open_knot_spacing_m = 8.0;
  rules.knot_travel_m = 4.0;
  rules.soft_margin_m = 0.1;
  rules.preferred_clearance_m = 0.1;
  rules.clearance_weight = 3.0;
  rules.max_evaluations = 300;
  rules.smooth_start_rad = 1.5;
  rules.goal_search_radius_m = 0.4;
  rules.back_out_m = 1.0;
  rules.roadmap = roadmap_kind("best");
  rules.classes = 5;
  rules.longest_ratio = 2.0;
  rules.switch_margin = 0.0;
  return rules;
}

PlanarPath drive_of(const Motion& motion) {
  for (const Phase& phase : motion.phases()) {
    if (const auto* drive = std::get_if<DrivePhase>(&phase)) return drive->path;
  }
  return {};
}

}  // namespace

Table2Plan plan_with_mocha(const Table2World& world, const Vector2& target) {
  static const GlobalPlanner planner(robot(), rules());
  const Vector2 ahead = target - world.start;
  PlanQuery query;
  query.committed =
      Motion(-1.0, {StandPhase{{world.start, std::atan2(ahead.y(), ahead.x())}, 0.1}});
  query.goal = target;
  const Vector2 border = Vector2::Constant(Table2World::kBorder_m);
  const Eigen::AlignedBox2d bounds(-border, Vector2::Constant(Table2World::kSide_m) + border);
  const auto begin = std::chrono::steady_clock::now();
  const auto field = std::make_shared<PrimitiveField<2>>(obstacle_field(world));
  const PlanningScene scene{std::make_shared<PrimitiveTerrain>(field, bounds), {}};
  const PlanResult found = planner.plan(query, scene, [] { return false; });
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
