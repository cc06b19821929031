// Maps a lidar log in CARMEN's format from its scans and an odometry that drifts, and compares with
// the log's poses. Prints JSON. Arguments: the log, the odometry's seed, and where the map is saved
// (- for nowhere).

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "benchmarks/log_drive.h"
#include "benchmarks/trajectory_error.h"
#include "perception/pose_graph/graph_file.h"
#include "perception/pose_graph/graph_mapper.h"
#include "trajectory/frame_change.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

constexpr double kSpacing_m = 0.02;
constexpr double kLengths_m[] = {1.0, 10.0, 100.0};
constexpr double kDegree = M_PI / 180.0;

/// Of this program alone; getrusage() would count what was there before it began.
double peak_memory_mib() {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kib = 0.0;
  while (status >> word && word != "VmHWM:") continue;
  status >> kib;
  return kib / 1024.0;
}

/// Where a scan was taken, as seen from the keyframe that was the newest then.
struct Attached {
  int keyframe;
  Pose from_keyframe;
};

void print(const char* name, const std::vector<Pose>& poses, const std::vector<Pose>& truth) {
  std::vector<double> off_m = absolute_errors_m(poses, truth);
  std::printf(", \"%s\": {\"median_m\": %.4f, \"p95_m\": %.4f, \"worst_m\": %.4f, \"rms_m\": %.4f",
              name, quantile(off_m, 0.5), quantile(off_m, 0.95), quantile(off_m, 1.0), rms(off_m));
  for (const double length_m : kLengths_m) {
    const RelativeErrors errors = relative_errors(poses, truth, length_m);
    std::printf(", \"relative_%.0f\": {\"pairs\": %zu, \"m\": %.4f, \"deg\": %.3f}", length_m,
                errors.off_m.size(), mean(errors.off_m), mean(errors.off_rad) / kDegree);
  }
  std::printf("}");
}

void map_log(const char* path, int seed, const std::string& saved) {
  std::ifstream file(path);
  const std::vector<LogScan> drive = drive_of(read_carmen_log(file), seed, kSpacing_m);
  const auto values = ParameterTable::from_schema("config/scan_localizer.yaml");
  GraphMapper mapper(
      GraphMapperOptions::from(values, load_robot_model("config", "waveshare_rover")));
  std::vector<Attached> attached;
  std::vector<double> scan_ms;
  const auto begun = std::chrono::steady_clock::now();
  for (const LogScan& each : drive) {
    const auto before = std::chrono::steady_clock::now();
    const Pose pose = mapper.add(each.scan, each.odometry).pose;
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - before;
    scan_ms.push_back(took.count());
    const PoseGraph& graph = mapper.graph();
    attached.push_back({graph.size() - 1, relative(graph.poses().back(), pose)});
  }
  mapper.finish();
  const std::chrono::duration<double, std::milli> all = std::chrono::steady_clock::now() - begun;
  std::vector<Pose> truth;
  std::vector<Pose> odometry;
  std::vector<Pose> mapped;
  double driven_m = 0.0;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (i > 0) driven_m += (drive[i].truth.position - drive[i - 1].truth.position).norm();
    truth.push_back(drive[i].truth);
    odometry.push_back(drive[i].odometry);
    mapped.push_back(
        composed(mapper.graph().poses()[attached[i].keyframe], attached[i].from_keyframe));
  }
  std::printf(
      "{\"seed\": %d, \"scans\": %zu, \"driven_m\": %.1f, \"keyframes\": %d, "
      "\"loops_closed\": %d, \"loops_tried\": %d",
      seed, drive.size(), driven_m, mapper.graph().size(), mapper.loops_closed(),
      mapper.loops_tried());
  print("odometry", odometry, truth);
  print("mapped", mapped, truth);
  std::printf(
      ", \"scan_ms\": %.3f, \"median_ms\": %.3f, \"longest_ms\": %.1f, "
      "\"memory_mib\": %.1f}\n",
      all.count() / static_cast<double>(drive.size()), quantile(scan_ms, 0.5),
      quantile(scan_ms, 1.0), peak_memory_mib());
  if (saved != "-") save_driven_map({mapper.graph(), mapper.keyframes()}, saved);
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  mocha::map_log(argv[1], std::atoi(argv[2]), argv[3]);
}
