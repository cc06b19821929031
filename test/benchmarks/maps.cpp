// Plans through a map of a building. Prints JSON. Arguments: a kind of map (see maps_building.h),
// its side in m, a seed; or `log` and a file (see maps_log.h).

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "benchmarks/bitstar.h"
#include "benchmarks/maps_building.h"
#include "benchmarks/maps_log.h"
#include "planning/global/global_planner.h"
#include "stack/freed_memory.h"
#include "stack/known_map.h"
#include "topology/paths/grid_path.h"
#include "world/margin_budget.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

constexpr double kReplan_s = 4.0;    // so long it has been under way
constexpr double kPatience_s = 5.0;  // with BIT*
constexpr double kSeen_m = 12.0;     // as far as a lidar sees
constexpr double kShut_m = 0.9;      // radius of what closes a door

double seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double length_m(const std::vector<Vector2>& path) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum_m += (path[i] - path[i - 1]).norm();
  return sum_m;
}

/// One case: a map and what is asked of the planner.
struct Case {
  const char* name;
  const OccupancyGrid grid;
  PlanQuery query;
};

struct Times {
  double map_s;
  double plan_s;
  double astar_s;
  std::optional<double> bitstar_s;  // of a solution
};

class Bench {
 public:
  Bench(std::string kind, Building building)
      : kind_(std::move(kind)),
        building_(std::move(building)),
        robot_(load_robot_model("config", "rover")),
        planner_(robot_,
                 PlannerOptions::from(ParameterTable::from_schema("config/global_planner.yaml"))) {}

  void run() {
    const PlanQuery from_rest = at_start();
    const Motion first = row({"first", building_.grid, from_rest});
    if (!first.empty()) {
      PlanQuery under_way = from_rest;
      under_way.start_time_s = first.switch_time(kReplan_s);
      under_way.committed = under_way.driven = first;
      row({"replan", with_noise(first.position(under_way.start_time_s)), under_way});
      OccupancyGrid shut = building_.grid;
      fill_disc(shut, narrowest(first), kShut_m, OccupancyGrid::kOccupied);
      row({"door_closed", shut, from_rest});
    }
    row({"unreachable", walled_in(building_.grid, building_.goal), from_rest});
  }

 private:
  PlanQuery at_start() const {
    const Vector2 ahead = building_.goal - building_.start;
    PlanQuery query;
    query.committed =
        Motion(-1.0, {StandPhase{{building_.start, std::atan2(ahead.y(), ahead.x())}, 0.1}});
    query.goal = building_.goal;
    return query;
  }

  /// As a scan changes a map: here and there a cell of the walls around has changed.
  OccupancyGrid with_noise(const Vector2& here) const {
    OccupancyGrid grid = building_.grid;
    std::mt19937 random(1);
    for (int y = 1; y + 1 < grid.height; ++y) {
      for (int x = 1; x + 1 < grid.width; ++x) {
        const bool at_wall = building_.grid.at(x, y) == OccupancyGrid::kOccupied &&
                             building_.grid.at(x + 1, y) == OccupancyGrid::kFree;
        if (at_wall && (grid.cell_centre(x, y) - here).norm() < kSeen_m && random() % 50 == 0)
          grid.at(x, y) = OccupancyGrid::kFree;
      }
    }
    return grid;
  }

  /// Where the middle of a motion is closest to obstacles.
  Vector2 narrowest(const Motion& motion) const {
    const DistanceField field(building_.grid, DistanceField::Solid::kOccupied);
    const double begin_s = motion.start_time();
    const double lasts_s = motion.end_time() - begin_s;
    Vector2 place = motion.position(begin_s + 0.5 * lasts_s);
    for (double share = 0.2; share < 0.8; share += 0.001) {
      const Vector2 here = motion.position(begin_s + share * lasts_s);
      if (field.distance_bound(here) < field.distance_bound(place)) place = here;
    }
    return place;
  }

  Motion row(const Case& asked) {
    std::shared_ptr<const StaticMap> static_map;
    std::shared_ptr<const DistanceField> unseen;
    const double map_s = seconds([&] {
      known_.take(asked.grid);
      static_map = known_.static_map({}, 0.0);
      unseen = known_.field(DistanceField::Solid::kOccupiedOrUnknown, {}, 0.0);
    });
    const PlanningScene scene{static_map, {}, [&] { return unseen; }};
    PlanResult plan;
    const double plan_s = seconds([&] { plan = planner_.plan(asked.query, scene); });
    GridPath shortest;
    const double needs_m = robot_.footprint.circumscribed_radius_m() +
                           MarginBudget::of(robot_).static_margin().still_m;
    const Vector2 start = asked.query.committed.at(asked.query.start_time_s).pose.position;
    const double astar_s = seconds([&] {
      const TravelCost cost(*static_map, start, {}, {needs_m, needs_m, 0.0, 0.0});
      shortest = find_grid_path(*static_map, start, building_.goal, cost, kLatticeStep_m);
    });
    std::vector<Vector2> peer;
    const double bitstar_s = seconds([&] {
      if (shortest.points.empty()) return;  // it would search for all of its patience
      peer = path_by_bitstar({static_map->field(), needs_m, static_map->bounds(), start,
                              building_.goal, static_map->detail_m()},
                             std::nullopt, kPatience_s);
    });
    print(asked, {map_s, plan_s, astar_s, peer.empty() ? std::nullopt : std::optional(bitstar_s)},
          plan, length_m(shortest.points));
    return plan.motion;
  }

  void print(const Case& asked, const Times& times, const PlanResult& plan, double shortest_m) {
    std::printf(
        "%s{\"map\": \"%s\", \"cells\": %zu, \"case\": \"%s\", \"t_map_s\": %.4f, "
        "\"t_plan_s\": %.4f, \"t_astar_s\": %.4f, \"classes\": %zu, \"reason\": \"%s\"",
        first_ ? "" : ",\n  ", kind_.c_str(), asked.grid.cells.size(), asked.name, times.map_s,
        times.plan_s, times.astar_s, plan.candidates.size(),
        plan.motion.empty() ? plan.message.c_str() : "solved");
    if (times.bitstar_s) std::printf(", \"t_bitstar_s\": %.4f", *times.bitstar_s);
    if (!plan.motion.empty()) {
      const double T_s = plan.motion.end_time() - asked.query.start_time_s;
      std::printf(", \"T_s\": %.3f", T_s);
      if (shortest_m > 0.0)
        std::printf(", \"T_over_shortest\": %.4f", T_s * robot_.limits.max_speed / shortest_m);
    }
    std::printf("}");
    std::fflush(stdout);
    first_ = false;
  }

  const std::string kind_;
  const Building building_;
  const RobotModel robot_;
  const GlobalPlanner planner_;
  KnownMap known_;
  bool first_ = true;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  using mocha::Building;
  std::optional<Building> building;
  if (argc == 3 && std::string(argv[1]) == "log") {
    std::ifstream log(argv[2]);
    building = mocha::building_of_log(log);
  } else if (argc == 4) {
    building = mocha::building(argv[1], std::atof(argv[2]), std::atoi(argv[3]));
  }
  if (!building) return 2;
  mocha::keep_freed_memory();  // as the nodes do
  mocha::set_up_ompl();
  std::printf("{\"rows\": [");
  mocha::Bench(argv[1], std::move(*building)).run();
  std::printf("]}\n");
}
