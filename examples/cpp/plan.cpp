// Plans for a rover on a floor with a table, and prints every way that was looked at.

#include <mocha_ugv/stack/map_planner.h>

#include <cstdio>
#include <exception>

/// 10 m x 6 m in cells of 5 cm, free but for the table. A saved map: see
/// perception/mapping/map_image.h.
mocha::OccupancyGrid floor_with_table() {
  mocha::OccupancyGrid map;
  map.resolution_m = 0.05;
  map.width = 200;
  map.height = 120;
  map.cells.assign(200 * 120, mocha::OccupancyGrid::kFree);
  fill_polygon(map, {{{4.0, 1.5}, {6.0, 1.5}, {6.0, 4.0}, {4.0, 4.0}}},
               mocha::OccupancyGrid::kOccupied);
  return map;
}

int main() {
  try {
    const mocha::RobotModel rover = mocha::load_robot_model(CONFIG, "rover");
    const auto parameters = mocha::ParameterTable::from_schema(CONFIG "/global_planner.yaml");
    const mocha::MapPlanner planner(rover, mocha::PlannerOptions::from(parameters));

    const mocha::Pose start{{1.0, 3.0}, 0.0};        // m and rad
    const mocha::Goal goal{{9.0, 3.0}, M_PI / 2.0};  // the heading may be left out
    const mocha::PlanResult plan = planner.plan(floor_with_table(), start, goal);

    std::printf("%s\n", plan.message.c_str());
    for (const mocha::PlanCandidate& way : plan.candidates)
      std::printf("%s cost %.2f: %s\n", way.selected ? "->" : "  ", way.cost, outcome(way).c_str());
    if (plan.motion.empty()) return 1;
    std::printf("%.2f m in %.2f s\n", plan.motion.length_m(), plan.motion.end_time());
    for (double t = 0.0; t < plan.motion.end_time(); t += 1.0) {
      const mocha::MotionState state = plan.motion.at(t);
      std::printf("%4.1f s: (%.2f, %.2f), %.2f m/s\n", t, state.pose.position.x(),
                  state.pose.position.y(), state.speed);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
