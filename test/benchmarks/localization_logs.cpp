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
#include <stdexcept>

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
constexpr int kCarries = 20;
constexpr double kCarried_m = 5.0;
constexpr std::size_t kScansBefore = 10;  // a robot is carried away
constexpr std::size_t kMostScans = 40;    // to be found
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

/// The scans from `from` on in which the robot has to be found.
std::vector<LogScan> piece(const std::vector<LogScan>& drive, std::size_t from, std::size_t most) {
  const auto begin = drive.begin() + static_cast<std::ptrdiff_t>(from);
  return {begin, begin + static_cast<std::ptrdiff_t>(std::min(most, drive.size() - from))};
}

/// The scans from `from` on, to a robot that saw `before` last and was carried there.
std::vector<LogScan> carried(const LogScan& before, const std::vector<LogScan>& drive,
                             std::size_t from) {
  std::vector<LogScan> result = piece(drive, from, kMostScans);
  const double gap_s = drive[from].scan.time_s - drive[from - 1].scan.time_s;
  const double later_s = before.scan.time_s + gap_s - drive[from].scan.time_s;
  for (LogScan& each : result) {
    each.odometry = composed(before.odometry, relative(drive[from].odometry, each.odometry));
    each.scan.time_s += later_s;
  }
  return result;
}

struct Found {
  int scans = -1;        // until it was localised where it is; -1: it was not
  double after_s = 0.0;  // the same
  double wrong_s = 0.0;  // localised elsewhere, before
  bool wrong = false;    // it was
};

Found find(ScanLocalizer& localizer, const std::vector<LogScan>& drive) {
  Found found;
  double before_s = drive.front().scan.time_s;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const LogScan& each = drive[i];
    const Localization& now = localizer.add(each.scan, each.odometry);
    const double dt_s = each.scan.time_s - before_s;
    before_s = each.scan.time_s;
    if (now.state != Localization::State::kLocalized) continue;
    if (is_wrong(now.base.pose, each.truth)) {
      found.wrong = true;
      found.wrong_s += dt_s;
      continue;
    }
    found.scans = static_cast<int>(i) + 1;
    found.after_s = each.scan.time_s - drive.front().scan.time_s;
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

void print(const char* kind, const std::vector<Found>& all, const std::vector<bool>& tells) {
  std::printf(", \"%s\": [", kind);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::printf(
        "%s\n  {\"tells\": %s, \"scans\": %d, \"s\": %.1f, \"wrong\": %s, \"wrong_s\": %.1f}",
        i == 0 ? "" : ",", tells[i] ? "true" : "false", all[i].scans, all[i].after_s,
        all[i].wrong ? "true" : "false", all[i].wrong_s);
  }
  std::printf("]");
}

/// One log, one part of it.
class Trial {
 public:
  Trial(const Parts& parts, const RobotModel& model, const OccupancyGrid& map)
      : drive_(parts.driven), judge_(map), localizer_(shipped_localizer_options(model)) {
    localizer_.set_map(map);
    for (std::size_t i = 0; i < drive_.size(); ++i) {
      if (judge_.has(drive_[i])) known_.push_back(i);
    }
  }

  /// Scans at whose places the map says something.
  const std::vector<std::size_t>& known() const { return known_; }

  void follow_all() {
    expect(known_.front());
    Account account;
    follow(localizer_, piece(drive_, known_.front(), drive_.size()), judge_, account);
    print(account);
  }

  /// From nothing.
  void search() {
    std::vector<Found> all;
    std::vector<bool> tells;
    for (int i = 0; i < kSearches; ++i) {
      const std::size_t from = known_[i * known_.size() / kSearches];
      localizer_.forget();
      all.push_back(find(localizer_, piece(drive_, from, kMostScans)));
      tells.push_back(judge_.tells(drive_[from]));
    }
    print("searches", all, tells);
  }

  /// Lifted, and put down farther along the drive.
  void carry() {
    std::vector<Found> all;
    std::vector<bool> tells;
    for (int i = 0; i < kCarries; ++i) {
      const std::size_t from = known_[i * known_.size() / kCarries];
      const std::vector<LogScan> before = piece(drive_, from, kScansBefore);
      const auto to = std::find_if(known_.begin(), known_.end(), [&](std::size_t j) {
        return j >= from + kScansBefore &&
               distance_m(drive_[j].truth, before.back().truth) >= kCarried_m;
      });
      if (to == known_.end()) break;
      expect(from);
      for (const LogScan& each : before) localizer_.add(each.scan, each.odometry);
      all.push_back(find(localizer_, carried(before.back(), drive_, *to)));
      tells.push_back(judge_.tells(drive_[*to]));
    }
    print("carries", all, tells);
  }

 private:
  /// Knows where it is at that scan.
  void expect(std::size_t scan) {
    localizer_.forget();
    localizer_.expect({drive_[scan].truth, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()});
  }

  const std::vector<LogScan> drive_;
  const Judge judge_;
  ScanLocalizer localizer_;
  std::vector<std::size_t> known_;
};

void run(const char* path, int seed, bool odd) {
  std::ifstream file(path);
  const Parts parts = parts_of(read_carmen_log(file), seed, odd);
  const RobotModel model = load_robot_model("config", "waveshare_rover");
  Trial trial(parts, model, map_of(parts.mapped, model));
  std::printf("{\"seed\": %d, \"scans\": %zu, \"known\": %zu, ", seed, parts.driven.size(),
              trial.known().size());
  if (trial.known().empty()) throw std::runtime_error("the map has none of the scans' places");
  trial.follow_all();
  trial.search();
  trial.carry();
  std::printf("}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  mocha::run(argv[1], std::atoi(argv[2]), std::strcmp(argv[3], "odd") == 0);
}
