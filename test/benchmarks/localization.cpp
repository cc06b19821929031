// A robot drives through a world and back, by lidar and drifting odometry, and localises itself in
// a map that was made in another drive; once all the way, and once carried away on the way. Prints
// JSON. Arguments: a world file, a robot model, first seed, number of seeds, way points x,y ...

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/median.h"
#include "perception/localization/localisation_scene.h"
#include "perception/localization/scan_localizer.h"

namespace mocha {
namespace {

constexpr double kCarried_m = 5.0;
constexpr double kFound_m = 0.1;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Run {
  std::vector<double> off_m;  // while localised
  std::vector<double> off_deg;
  std::vector<double> scan_ms;
  double found_s =
      -1.0;  // from the first scan, or from the carrying, until it is localised within kFound_m
  double wrong_s = 0.0;  // localised, but farther off than kFound_m
};

/// Follows the drive from sweep `from` on.
Run follow(ScanLocalizer& localizer, const std::vector<DriveScan>& drive, const LidarModel& lidar,
           std::size_t from) {
  Run run;
  const double period_s = 1.0 / lidar.rate_hz;
  for (std::size_t i = from; i < drive.size(); ++i) {
    const ScanHits scan = hits_of(drive[i], lidar);
    const auto begun = std::chrono::steady_clock::now();
    const Localization& now = localizer.add(scan, drive[i].odometry);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
    run.scan_ms.push_back(took.count());
    if (now.state != Localization::State::kLocalized) continue;
    const double off_m = distance_m(now.base.pose, drive[i].truth);
    if (off_m > kFound_m) run.wrong_s += period_s;
    if (off_m > kFound_m && run.found_s < 0.0) continue;  // not yet aware of being carried
    if (run.found_s < 0.0) run.found_s = static_cast<double>(i - from + 1) * period_s;
    run.off_m.push_back(off_m);
    run.off_deg.push_back(turn_rad(now.base.pose, drive[i].truth) * 180.0 / M_PI);
  }
  return run;
}

void print_run(const char* kind, int seed, const Run& run, bool first) {
  std::printf("%s\n  {\"kind\": \"%s\", \"seed\": %d, \"scans\": %zu, \"localized\": %zu",
              first ? "" : ",", kind, seed, run.scan_ms.size(), run.off_m.size());
  std::printf(", \"median_m\": %.4f, \"worst_m\": %.4f, \"median_deg\": %.3f, \"worst_deg\": %.3f",
              median(run.off_m), quantile(run.off_m, 1.0), median(run.off_deg),
              quantile(run.off_deg, 1.0));
  std::printf(", \"found_s\": %.2f, \"wrong_s\": %.2f, \"scan_ms\": %.3f, \"longest_ms\": %.2f}",
              run.found_s, run.wrong_s, median(run.scan_ms), quantile(run.scan_ms, 1.0));
  std::fflush(stdout);
}

void print_rows(const std::string& world_path, const std::string& model_name, int first, int count,
                const std::vector<Vector2>& path) {
  World world = one_robot_world(world_path, {path[0], 0.0}, model_name);
  world.moving.clear();
  const RobotModel& model = world.robots[0].model;
  const auto options =
      ScanLocalizerOptions::from(ParameterTable::from_schema("config/scan_localizer.yaml"), model);
  const OccupancyGrid map = map_of(drive_through(world, path, 1000), model);
  std::printf("{\"rows\": [");
  for (int seed = first; seed < first + count; ++seed) {
    const std::vector<DriveScan> drive = drive_through(world, path, seed);
    ScanLocalizer localizer(options);
    localizer.set_map(map);
    print_run("drive", seed, follow(localizer, drive, model.lidar, 0), seed == first);
    const Kidnapping carried = kidnap(drive, drive.size() / 4, kCarried_m);
    localizer.forget();
    const std::vector<DriveScan> before(
        carried.drive.begin(), carried.drive.begin() + static_cast<std::ptrdiff_t>(carried.when));
    follow(localizer, before, model.lidar, 0);
    print_run("carried", seed, follow(localizer, carried.drive, model.lidar, carried.when), false);
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc < 7) return 2;
  std::vector<mocha::Vector2> path;
  for (int i = 5; i < argc; ++i) {
    double x = 0.0;
    double y = 0.0;
    if (std::sscanf(argv[i], "%lf,%lf", &x, &y) != 2) return 2;
    path.emplace_back(x, y);
  }
  mocha::print_rows(argv[1], argv[2], std::atoi(argv[3]), std::atoi(argv[4]), path);
}
