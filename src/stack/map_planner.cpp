#include "stack/map_planner.h"

#include "stack/known_map.h"

namespace mocha {
namespace {

constexpr double kStand_s = 0.1;
constexpr double kMapBorder_m = 2.0;

}  // namespace

PlanQuery from_standing(const Pose& start, const Goal& goal) {
  PlanQuery query;
  query.committed = Motion(-kStand_s, {StandPhase{start, kStand_s}});
  query.goal = goal.position;
  query.goal_yaw_rad = goal.yaw_rad;
  return query;
}

std::shared_ptr<const StaticMap> static_map_of(const OccupancyGrid& map,
                                               const std::vector<Vector2>& places) {
  KnownMap known;
  known.take(map);
  return known.static_map(places, kMapBorder_m);
}

PlanResult MapPlanner::plan(const OccupancyGrid& map, const Pose& start, const Goal& goal) const {
  const PlanQuery query = from_standing(start, goal);
  return planner_.plan(query, {static_map_of(map, {start.position, goal.position}), {}});
}

}  // namespace mocha
