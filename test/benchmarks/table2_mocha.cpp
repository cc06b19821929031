#include "benchmarks/table2_mocha.h"

#include <chrono>

#include "benchmarks/table_plan.h"
#include "topology/grid_path.h"

namespace mocha {
namespace {

std::vector<Vector2> front_end(const Table2World& world, const Vector2& target) {
  constexpr double kCell_m = 0.25;
  constexpr double kBorder_m = Table2World::kBorder_m;
  OccupancyGrid map;
  map.resolution_m = kCell_m;
  map.origin = {-kBorder_m, -kBorder_m};
  map.width = map.height = static_cast<int>((Table2World::kSide_m + 2.0 * kBorder_m) / kCell_m);
  map.cells.assign(static_cast<std::size_t>(map.width) * map.height, OccupancyGrid::kFree);
  for (const Circle& circle : world.circles) {
    fill_disc(map, circle.centre, circle.radius_m, OccupancyGrid::kOccupied);
  }
  GridPathRules rules;
  rules.required_clearance_m = 0.4;
  rules.step_m = 0.5;
  const DistanceField field(map, DistanceField::Solid::kOccupied);
  return find_grid_path(field, world.start, target, {}, rules).points;
}

TableRules rules() {
  TableRules rules;
  rules.max_speed = Table2Robot::kMaxSpeed;
  rules.max_acceleration = Table2Robot::kMaxAcceleration;
  rules.radius_m = Table2Robot::kRadius_m;
  rules.w_e = 1e-3;
  rules.w_o = 1e4;
  rules.d_s_m = 0.5;
  return rules;
}

}  // namespace

Table2Plan plan_with_mocha(const Table2World& world, const Vector2& target) {
  constexpr double kSpacing_m = 5.0;
  const auto begin = std::chrono::steady_clock::now();
  Table2Plan result;
  const BenchmarkWorld<2> problem{obstacle_field(world), front_end(world, target)};
  const TablePlan<2> planned = plan<2>(problem, kSpacing_m, true, rules());
  result.curve = planned.curve;
  result.candidates = {planned.curve};
  result.classes = 1;
  result.t_plan_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace mocha
