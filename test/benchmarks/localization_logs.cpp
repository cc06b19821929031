// A robot finds out where it is in a map of a lidar log, made at the log's poses from one part of
// its scans, by the scans of the other part and an odometry that drifts. Prints JSON. Arguments:
// the log, the odometry's seed, and the part that is localised: rest (after the first half) or odd
// (every other scan).

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "benchmarks/log_drive.h"
#include "benchmarks/trajectory_error.h"
#include "perception/localization/localisation_scene.h"
#include "perception/localization/scan_fit.h"

namespace mocha {
namespace {

constexpr double kMapSpacing_m = 0.02;
constexpr double kSpacing_m = 0.05;
constexpr double kWrong_m = 0.3;
constexpr double kWrong_rad = 0.1;
constexpr double kTolerance_m = 0.1;
constexpr double kMostUnknown = 0.3;  // share of a scan, where the map has the place
constexpr double kLikeness = 0.05;    // a place that explains so little less cannot be told apart
constexpr int kSearches = 50;
constexpr int kCarries = 10;
constexpr double kCarried_m = 5.0;
constexpr std::size_t kMostScans = 40;  // to be found
constexpr double kDegree = M_PI / 180.0;

struct Parts {
  std::vector<LogScan> mapped;
  std::vector<LogScan> driven;
};

Parts parts_of(const std::vector<LoggedScan>& log, std::uint64_t seed, bool odd) {
  std::vector<LoggedScan> mapped;
  std::vector<LoggedScan> driven;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const bool is_driven = odd ? i % 2 == 1 : 2 * i >= log.size();
    (is_driven ? driven : mapped).push_back(log[i]);
  }
  return {drive_of(mapped, seed, kMapSpacing_m), drive_of(driven, seed, kSpacing_m)};
}

OccupancyGrid map_of(const std::vector<LogScan>& drive, const RobotModel& model) {
  OccupancyMapOptions options = shipped_map_options();
  options.resolution_m = model.map_resolution_m;
  OccupancyMap map(options);
  for (const LogScan& each : drive) map.insert_scan(beams_of(each.scan, each.truth));
  return map.slice(0.5);
}

bool is_wrong(const Pose& pose, const Pose& truth) {
  return distance_m(pose, truth) > kWrong_m || turn_rad(pose, truth) > kWrong_rad;
}

/// What the map says of the places where scans were taken.
class Judge {
 public:
  explicit Judge(const OccupancyGrid& map) : walls_(map, 1.0), search_(walls_, {20000000}) {}

  bool has(const LogScan& each) const {
    const ScanFit fit = fit_of(each.scan, each.truth, walls_, kTolerance_m);
    return fit.hits() > 0 && fit.unknown <= kMostUnknown * fit.hits();
  }

  /// Whether one scan is enough to tell the place from all others.
  bool tells(const LogScan& each) const {
    const double here = fit_of(each.scan, each.truth, walls_, kTolerance_m).quality();
    for (const auto& place : search_.find(each.scan).places) {
      if (!is_wrong(place.pose, each.truth)) continue;
      if (fit_of(each.scan, place.pose, walls_, kTolerance_m).quality() > here - kLikeness)
        return false;
    }
    return true;
  }

 private:
  LikelihoodField walls_;
  BranchAndBoundMatcher search_;
};

struct Account {
  std::vector<double> off_m;
  std::vector<double> off_deg;
  std::vector<double> scan_ms;
  double all_s = 0.0;        // where the map has the place
  double localized_s = 0.0;  // of that
  double claimed_s = 0.0;    // localised, anywhere
  double wrong_s = 0.0;      // of that
};

void follow(ScanLocalizer& localizer, const std::vector<LogScan>& drive, const Judge& judge,
            Account& account) {
  double before_s = 0.0;
  for (const LogScan& each : drive) {
    const double dt_s = each.scan.time_s - before_s;
    before_s = each.scan.time_s;
    const auto begun = std::chrono::steady_clock::now();
    const Localization& now = localizer.add(each.scan, each.odometry);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
    account.scan_ms.push_back(took.count());
    const bool is_known = judge.has(each);
    if (is_known) account.all_s += dt_s;
    if (now.state != Localization::State::kLocalized) continue;
    account.claimed_s += dt_s;
    if (is_wrong(now.base.pose, each.truth)) account.wrong_s += dt_s;
    if (!is_known) continue;
    account.localized_s += dt_s;
    account.off_m.push_back(distance_m(now.base.pose, each.truth));
    account.off_deg.push_back(turn_rad(now.base.pose, each.truth) / kDegree);
  }
}

struct Found {
  bool tells = false;
  int scans = -1;  // until it was localised; -1: it was not
  double after_s = 0.0;
  bool wrong = false;
};

/// From scan `from` on.
Found find(ScanLocalizer& localizer, const std::vector<LogScan>& drive, std::size_t from) {
  Found found;
  const std::size_t end = std::min(drive.size(), from + kMostScans);
  for (std::size_t i = from; i < end; ++i) {
    const Localization& now = localizer.add(drive[i].scan, drive[i].odometry);
    if (now.state != Localization::State::kLocalized) continue;
    found.scans = static_cast<int>(i - from) + 1;
    found.after_s = drive[i].scan.time_s - drive[from].scan.time_s;
    found.wrong = is_wrong(now.base.pose, drive[i].truth);
    break;
  }
  return found;
}

void print(const Account& account) {
  std::printf(
      "\"median_m\": %.4f, \"p95_m\": %.4f, \"worst_m\": %.3f, \"median_deg\": %.3f, "
      "\"p95_deg\": %.3f, \"worst_deg\": %.2f, \"localized\": %.4f, \"wrong\": %.4f, "
      "\"scan_ms\": %.3f, \"median_ms\": %.3f, \"longest_ms\": %.1f",
      quantile(account.off_m, 0.5), quantile(account.off_m, 0.95), quantile(account.off_m, 1.0),
      quantile(account.off_deg, 0.5), quantile(account.off_deg, 0.95),
      quantile(account.off_deg, 1.0), account.localized_s / std::max(1e-9, account.all_s),
      account.wrong_s / std::max(1e-9, account.claimed_s), mean(account.scan_ms),
      quantile(account.scan_ms, 0.5), quantile(account.scan_ms, 1.0));
}

void run(const char* path, int seed, bool odd) {
  std::ifstream file(path);
  const Parts parts = parts_of(read_carmen_log(file), seed, odd);
  const RobotModel model = load_robot_model("config", "waveshare_rover");
  const OccupancyGrid map = map_of(parts.mapped, model);
  const Judge judge(map);
  ScanLocalizer localizer(shipped_localizer_options(model));
  localizer.set_map(map);
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < parts.driven.size(); ++i) {
    if (judge.has(parts.driven[i])) known.push_back(i);
  }
  std::printf("{\"seed\": %d, \"scans\": %zu, \"known\": %zu, ", seed, parts.driven.size(),
              known.size());
  Account account;
  if (!known.empty()) {
    const LogScan& first = parts.driven[known.front()];
    localizer.expect({first.truth, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()});
    follow(localizer,
           {parts.driven.begin() + static_cast<std::ptrdiff_t>(known.front()), parts.driven.end()},
           judge, account);
  }
  print(account);
  std::printf(", \"searches\": [");
  for (int i = 0; i < kSearches && !known.empty(); ++i) {
    const std::size_t from = known[i * known.size() / kSearches];
    localizer.forget();
    Found found = find(localizer, parts.driven, from);
    found.tells = judge.tells(parts.driven[from]);
    std::printf("%s\n  {\"scan\": %zu, \"tells\": %s, \"scans\": %d, \"s\": %.1f, \"wrong\": %s}",
                i == 0 ? "" : ",", from, found.tells ? "true" : "false", found.scans, found.after_s,
                found.wrong ? "true" : "false");
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  mocha::run(argv[1], std::atoi(argv[2]), std::strcmp(argv[3], "odd") == 0);
}
