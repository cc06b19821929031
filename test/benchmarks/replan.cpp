// Local replanning in seeded scenes with movers, in closed loop, and whether each of them can be
// solved at all. Prints JSON. Arguments: the numbers of the scenes, or --trace and one of them for
// all that is to be drawn of it.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "benchmarks/curve_json.h"
#include "benchmarks/replan_problem.h"
#include "benchmarks/replan_run.h"
#include "planning/worlds.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kLongestUndisturbed_s = 60.0;
constexpr double kLongestLost_s = 30.0;  // by the planners
constexpr double kSolverLost_s = 15.0;

/// One scene: with its movers, without them, and what the solver says.
struct Case {
  explicit Case(int number) : scene(replan_scene(number)) {
    ReplanScene empty = scene;
    empty.movers.clear();
    undisturbed = run_closed_loop(empty, kLongestUndisturbed_s);
    run = run_closed_loop(scene, undisturbed.time_s + kLongestLost_s);
  }

  ReplanScene scene;
  ReplanRun undisturbed;
  ReplanRun run;
};

SolverOptions solver_options(double undisturbed_s) {
  const RobotModel robot = rover();
  const MarginBudget margins = MarginBudget::of(robot);
  SolverOptions options;
  options.to_walls_m = margins.static_margin_m();
  options.to_movers_m = robot.moving_clearance_m + margins.own_margin_m();
  options.max_speed = robot.limits.max_speed;
  options.max_acceleration = robot.limits.max_acceleration;
  options.max_yaw_rate = robot.limits.max_yaw_rate;
  options.longest_s = undisturbed_s + kSolverLost_s;
  return options;
}

const char* text(bool value) { return value ? "true" : "false"; }

void print_number(const char* key, double value, bool known) {
  if (known && std::isfinite(value)) {
    std::printf(", \"%s\": %.4g", key, value);
  } else {
    std::printf(", \"%s\": null", key);
  }
}

void print_row(int number) {
  const Case found(number);
  const auto solved_s =
      arrival_time_s(problem_of(found.scene), solver_options(found.undisturbed.time_s));
  double worst_s = 0.0;
  for (const Replan& replan : found.run.replans) worst_s = std::max(worst_s, replan.t_plan_s);
  std::printf("\n  {\"scene\": %d, \"group\": \"%s\", \"solvable\": %s, \"contact\": %s", number,
              found.scene.group.c_str(), text(solved_s.has_value()), text(found.run.contact));
  print_number("min_clearance_m", found.run.min_clearance_m, true);
  print_number("time_lost_s", found.run.time_s - found.undisturbed.time_s,
               found.run.reached && found.undisturbed.reached);
  print_number("t_plan_s", worst_s, !found.run.replans.empty());
  std::printf(", \"switches\": %d, \"kind\": \"%s\", \"place\": \"%s\", \"movers\": %zu",
              found.run.switches, found.scene.kind.c_str(), found.scene.place.c_str(),
              found.scene.movers.size());
  std::printf(", \"reached\": %s, \"would_meet\": %s", text(found.run.reached),
              text(would_meet(found.undisturbed, found.scene)));
  print_number("undisturbed_s", found.undisturbed.time_s, found.undisturbed.reached);
  print_number("solver_s", solved_s.value_or(0.0), solved_s.has_value());
  const auto taken = std::count_if(found.run.replans.begin(), found.run.replans.end(),
                                   [](const Replan& replan) { return replan.taken; });
  std::printf(", \"replans\": %zu, \"taken\": %td", found.run.replans.size(), taken);
  print_number("front_end_s", found.run.front_end_s, true);
  print_number("optimisation_s", found.run.optimisation_s, true);
  std::printf(", \"replans_s\": [");
  for (const Replan& replan : found.run.replans) {
    std::printf("%s%.4g", &replan == &found.run.replans.front() ? "" : ", ", replan.t_plan_s);
  }
  std::printf("]}");
  std::fflush(stdout);
}

/// Time, x, y, speed, clearance to walls, clearance to movers.
void print_samples(const char* key, const ReplanRun& run) {
  Eigen::MatrixXd columns(6, run.samples.size());
  for (int i = 0; i < columns.cols(); ++i) {
    const RunSample& sample = run.samples[i];
    columns.col(i) << sample.t, sample.pose.position, sample.speed, sample.to_walls_m,
        sample.to_movers_m;
  }
  print_columns(key, columns);
}

void print_obstacles(const ReplanScene& scene) {
  std::printf(",\n\"circles\": [");
  const char* comma = "";
  for (const Obstacle& obstacle : scene.obstacles) {
    const auto* circle = std::get_if<Circle>(&obstacle);
    if (!circle) continue;
    std::printf("%s[%g, %g, %g]", comma, circle->centre.x(), circle->centre.y(), circle->radius_m);
    comma = ", ";
  }
  std::printf("],\n\"polygons\": [");
  comma = "";
  for (const Obstacle& obstacle : scene.obstacles) {
    const auto* polygon = std::get_if<Polygon>(&obstacle);
    if (!polygon) continue;
    std::printf("%s[", comma);
    for (std::size_t i = 0; i < polygon->corners.size(); ++i) {
      std::printf("%s[%g, %g]", i == 0 ? "" : ", ", polygon->corners[i].x(),
                  polygon->corners[i].y());
    }
    std::printf("]");
    comma = ", ";
  }
  std::printf("]");
}

/// Of each mover its radius, and where it is at the times of the run's samples.
void print_movers(const ReplanScene& scene, const ReplanRun& run) {
  std::printf(",\n\"movers\": [");
  for (const SceneMover& mover : scene.movers) {
    std::printf("%s{\"radius\": %g", &mover == &scene.movers.front() ? "" : ",\n", mover.radius_m);
    Eigen::MatrixXd columns(2, run.samples.size());
    for (int i = 0; i < columns.cols(); ++i) columns.col(i) = truth(mover, run.samples[i].t).centre;
    print_columns("places", columns);
    std::printf("}");
  }
  std::printf("]");
}

Eigen::MatrixXd columns_of(const std::vector<Vector2>& places) {
  Eigen::MatrixXd columns(2, places.size());
  for (int i = 0; i < columns.cols(); ++i) columns.col(i) = places[i];
  return columns;
}

/// Of each local plan that was taken, the drive up to the rejoin point, and the paths of the front
/// end.
void print_replans(const ReplanRun& run) {
  constexpr int kPlaces = 80;
  std::printf(",\n\"replans\": [");
  const char* comma = "";
  for (const Replan& replan : run.replans) {
    if (!replan.taken) continue;
    std::printf("%s{\"t\": %g, \"rejoin_point\": [%g, %g]", comma, replan.t,
                replan.rejoin_point.x(), replan.rejoin_point.y());
    comma = ",\n";
    std::vector<Vector2> path;
    const double begin_s = replan.motion.start_time();
    for (int i = 0; i <= kPlaces; ++i) {
      const double t = begin_s + i * (replan.rejoins_s - begin_s) / kPlaces;
      path.push_back(replan.motion.at(t).pose.position);
    }
    print_columns("path", columns_of(path));
    std::printf(", \"paths\": [");
    for (const auto& path : replan.paths) {
      std::printf("%s{\"points\": %zu", &path == &replan.paths.front() ? "" : ", ", path.size());
      print_columns("path", columns_of(path));
      std::printf("}");
    }
    std::printf("]}");
  }
  std::printf("]");
}

void print_trace(int number) {
  const Case found(number);
  const SolverOptions options = solver_options(found.undisturbed.time_s);
  std::printf("{\"scene\": %d, \"group\": \"%s\", \"kind\": \"%s\", \"robot_radius\": %g", number,
              found.scene.group.c_str(), found.scene.kind.c_str(), ReplanScene::kRobotRadius_m);
  std::printf(
      ", \"max_speed\": %g, \"required_m\": %g, \"wall_margin_m\": %g, \"contact\": %s, "
      "\"reached\": %s",
      options.max_speed, options.to_movers_m, options.to_walls_m, text(found.run.contact),
      text(found.run.reached));
  std::printf(", \"goal\": [%g, %g]", found.scene.goal.x(), found.scene.goal.y());
  print_obstacles(found.scene);
  print_samples("undisturbed", found.undisturbed);
  print_samples("run", found.run);
  print_movers(found.scene, found.run);
  print_replans(found.run);
  std::printf("}\n");
}

void run(int count, char** arguments) {
  if (count == 2 && std::strcmp(arguments[0], "--trace") == 0) {
    print_trace(std::atoi(arguments[1]));
    return;
  }
  std::printf("{\"rows\": [");
  for (int i = 0; i < count; ++i) {
    if (i > 0) std::printf(",");
    print_row(std::atoi(arguments[i]));
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { mocha::run(argc - 1, argv + 1); }
