// Maps the two halves of a lidar log in CARMEN's format, each as a drive of its own with an
// odometry that drifts, merges the maps, and compares with the log's poses. Prints JSON. Arguments:
// the log, the odometries' seed, and where the map is saved (- for nowhere).

#include "perception/pose_graph/map_merging.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "benchmarks/log_drive.h"
#include "benchmarks/trajectory_error.h"
#include "perception/pose_graph/graph_mapper.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

constexpr double kSpacing_m = 0.02;
constexpr const char* kFaults[] = {"none", "nothing in common", "ambiguous"};

DrivenMap mapped(const std::vector<LogScan>& drive, const GraphMapperOptions& options) {
  GraphMapper mapper(options);
  for (const LogScan& each : drive) mapper.add(each.scan, each.odometry);
  mapper.finish();
  return {mapper.graph(), mapper.keyframes()};
}

/// Of the keyframes, after the map is moved to fit best.
std::vector<double> errors_m(const DrivenMap& map, const std::map<double, Pose>& truth_at) {
  std::vector<Pose> truth;
  for (const ScanKeyframe& keyframe : map.keyframes)
    truth.push_back(truth_at.at(keyframe.scan.time_s));
  return absolute_errors_m(map.graph.poses(), truth);
}

void merge_halves(const char* path, int seed, const std::string& saved) {
  std::ifstream file(path);
  const std::vector<LoggedScan> log = read_carmen_log(file);
  const auto middle = log.begin() + static_cast<std::ptrdiff_t>(log.size() / 2);
  const std::vector<LogScan> one = drive_of({log.begin(), middle}, 2 * seed, kSpacing_m);
  std::vector<LogScan> two = drive_of({middle, log.end()}, 2 * seed + 1, kSpacing_m);
  std::map<double, Pose> truth_at;
  for (LogScan& each : two) each.scan.time_s += one.back().scan.time_s + 1.0;
  for (const LogScan& each : one) truth_at[each.scan.time_s] = each.truth;
  for (const LogScan& each : two) truth_at[each.scan.time_s] = each.truth;
  const auto options =
      GraphMapperOptions::from(ParameterTable::from_schema("config/scan_localizer.yaml"),
                               load_robot_model("config", "waveshare_rover"));
  const DrivenMap first = mapped(one, options);
  const DrivenMap second = mapped(two, options);
  const auto begun = std::chrono::steady_clock::now();
  const MergedMaps both = merged(first, second, options.loops, options.hits);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  std::printf("{\"keyframes\": [%d, %d], \"apart_m\": [%.4f, %.4f], \"fault\": \"%s\", \"s\": %.2f",
              first.graph.size(), second.graph.size(), quantile(errors_m(first, truth_at), 0.5),
              quantile(errors_m(second, truth_at), 0.5), kFaults[static_cast<int>(both.fault)],
              took.count());
  if (both.fault == MapMatch::Fault::kNone) {
    const std::vector<double> off_m = errors_m(both.map, truth_at);
    std::printf(", \"median_m\": %.4f, \"worst_m\": %.4f", quantile(off_m, 0.5),
                quantile(off_m, 1.0));
    if (saved != "-") save_driven_map(both.map, saved);
  }
  std::printf("}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  mocha::merge_halves(argv[1], std::atoi(argv[2]), argv[3]);
}
