// Plans on a world file or a saved map and prints, as JSON, the paths of all classes, for
// scripts/plots classes.

#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "perception/mapping/map_image.h"
#include "planning/global/global_rules.h"
#include "stack/map_planner.h"
#include "topology/static_map/primitive_static_map.h"
#include "world/margin_budget.h"
#include "world/world_file.h"

namespace mocha {
namespace {

struct Task {
  std::shared_ptr<const StaticMap> static_map;
  RobotModel robot;
  Pose start;
  Vector2 goal;
};

Task world_task(const std::string& path, const std::string& config) {
  const World world = load_world(path, config);
  if (world.robots.empty() || !world.robots.front().goal)
    throw std::runtime_error(path + ": has no robot with a goal");
  std::vector<Obstacle> obstacles(world.circles.begin(), world.circles.end());
  obstacles.insert(obstacles.end(), world.polygons.begin(), world.polygons.end());
  const std::vector<Polygon> keep_out = kept_out_of(world.zones);
  obstacles.insert(obstacles.end(), keep_out.begin(), keep_out.end());
  const auto field = std::make_shared<PrimitiveField<2>>(std::move(obstacles), 1.0);
  const WorldRobot& robot = world.robots.front();
  return {std::make_shared<PrimitiveStaticMap>(field, world.bounds), robot.model, robot.start,
          robot.goal->position};
}

Task map_task(const std::string& path, const std::string& config, const Vector2& start,
              const Vector2& goal) {
  const Vector2 ahead = goal - start;
  return {static_map_of(load_map_image(path), {start, goal}),
          load_robot_model(config, "rover"),
          {start, std::atan2(ahead.y(), ahead.x())},
          goal};
}

std::vector<PlanCandidate> plan_all(const Task& task, const PlannerOptions& options) {
  return GlobalPlanner(task.robot, options)
      .plan(from_standing(task.start, {task.goal, {}}), {task.static_map, {}})
      .candidates;
}

/// What is found from the straight line, as planners do that know one class only.
PlanCandidate plan_straight(const Task& task, const PlannerOptions& options) {
  const std::vector<Vector2> line = {task.start.position, task.goal};
  const StartManeuvers start_maneuvers(task.robot.limits, options.smooth_start_rad);
  const Seed straight{start_maneuvers.from_rest({}, task.start, line), {}, {}, 0.0, false};
  const PlanQuery query = from_standing(task.start, {task.goal, {}});
  const PlanningScene scene{task.static_map, {}};
  const DriveOptimizer optimizer(task.robot, options, MarginBudget::of(task.robot).static_margin());
  const GlobalRules rules(task.robot, options, query, scene);
  return CandidatePipeline(optimizer, task.static_map->field(), rules)
      .optimise_and_certify(straight, [] { return false; });
}

void print(const std::vector<Vector2>& path) {
  std::cout << "[";
  for (std::size_t i = 0; i < path.size(); ++i)
    std::cout << (i == 0 ? "[" : ", [") << path[i].x() << ", " << path[i].y() << "]";
  std::cout << "]";
}

void print(const char* key, const std::vector<PlanCandidate>& candidates) {
  std::cout << "\"" << key << "\": [";
  bool first = true;
  for (const PlanCandidate& candidate : candidates) {
    std::cout << (first ? "" : ",") << "\n{\"cost\": " << candidate.cost
              << ", \"solved\": " << (candidate.reason == PlanReason::kSolved ? "true" : "false")
              << ", \"cannot_win\": "
              << (candidate.reason == PlanReason::kCannotWin ? "true" : "false")
              << ", \"T\": " << (candidate.motion.empty() ? 0.0 : candidate.motion.end_time())
              << ", \"selected\": " << (candidate.selected ? "true" : "false") << ", \"path\": ";
    print(candidate.motion.empty() ? candidate.path : path_of(candidate.motion, 0.0, 1.0));
    std::cout << "}";
    first = false;
  }
  std::cout << "]";
}

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 3 && arguments.size() != 7)
    throw std::runtime_error("usage: CONFIG CLASSES FILE [START_X START_Y GOAL_X GOAL_Y]");
  const auto number = [&](std::size_t i) { return std::stod(arguments[i]); };
  const std::string& config = arguments[0];
  const Task task = arguments.size() == 3 ? world_task(arguments[2], config)
                                          : map_task(arguments[2], config, {number(3), number(4)},
                                                     {number(5), number(6)});
  PlannerOptions options =
      PlannerOptions::from(ParameterTable::from_schema(config + "/global_planner.yaml"));
  options.classes = std::stoi(arguments[1]);
  options.threads = 1;  // which of them are cut short does not depend on the machine
  std::cout << "{\"start\": [" << task.start.position.x() << ", " << task.start.position.y()
            << "], \"goal\": [" << task.goal.x() << ", " << task.goal.y() << "], ";
  print("candidates", plan_all(task, options));
  std::cout << ", ";
  print("straight", {plan_straight(task, options)});
  std::cout << "}\n";
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  try {
    mocha::run({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
