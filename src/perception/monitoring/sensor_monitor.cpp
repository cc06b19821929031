#include "perception/monitoring/sensor_monitor.h"

#include <cmath>
#include <sstream>

#include "perception/monitoring/blind_beams.h"
#include "perception/monitoring/range_noise.h"
#include "perception/monitoring/wide_hits.h"

namespace mocha {
namespace {

constexpr double kSettling_s = 3.0;  // of the map, before it shows what is blind
constexpr int kFewestRepeats = 2;
constexpr int kBlindScans = 2;
// A wheel that begins to slip looks like a lag that grows from scan to scan.
constexpr int kFewestShown = 5;
constexpr double kSameLag_s = 0.06;
constexpr double kSomeTravel_m = 0.04;  // unreported; what else differs is not to be told then
constexpr double kNoiseShare = 0.1;     // of the newest scan in the mean of the noise
constexpr double kEnd = 0.7;          // a lie ends below this share of the value at which it begins
constexpr double kSure = 3.0;         // standard deviations
constexpr double kShortHold_s = 1.0;  // after the last sign of what shows in each scan
constexpr double kDegrees = 180.0 / M_PI;

template <class... Words>
std::string text(int digits, const Words&... words) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(digits);
  (text << ... << words);
  return text.str();
}

bool shows_in_each_scan(SensorLie lie) {
  return lie == SensorLie::kScanFrozen || lie == SensorLie::kScanBlind;
}

}  // namespace

SensorMonitorOptions SensorMonitorOptions::from(const ParameterTable& values,
                                                double lidar_noise_m) {
  SensorMonitorOptions options;
  options.lidar_noise_m = lidar_noise_m;
  options.frozen_travel_m = values.number("frozen_scan_travel");
  options.max_blind_rad = values.number("max_blind_sector");
  options.max_noise_ratio = values.number("max_noise_ratio");
  options.max_lag_s = values.number("max_scan_delay");
  options.max_turn_rad = values.number("max_lidar_turn");
  options.max_slip = values.number("max_slip");
  options.max_unreported_m = values.number("max_unreported_travel");
  options.comparison_travel_m = values.number("comparison_travel");
  options.hold_s = values.number("sensor_fault_hold");
  return options;
}

bool stops_the_robot(SensorLie lie) {
  return lie == SensorLie::kScanFrozen || lie == SensorLie::kScanBlind ||
         lie == SensorLie::kScanLate || lie == SensorLie::kOdometryFrozen ||
         lie == SensorLie::kOdometrySlips;
}

void SensorMonitor::begin(SensorLie lie, double now_s, const std::string& words) {
  lies_[lie] = words;
  seen_s_[lie] = now_s;
}

/// Whether the comparison has shown it long enough to believe it.
bool SensorMonitor::lasts(SensorLie lie, bool is_shown) {
  shown_[lie] = is_shown ? shown_[lie] + 1 : 0;
  return shown_[lie] >= kFewestShown;
}

void SensorMonitor::end(SensorLie lie) { lies_.erase(lie); }

void SensorMonitor::add(const SensorReading& reading, const OccupancyMap& map) {
  const double now_s = reading.scan.end_time_s();
  check_frozen(reading, now_s);
  check_blind(reading, map, now_s);
  check_noise(reading.scan);
  check_motion(reading, now_s);
  end_held(now_s);
}

void SensorMonitor::check_frozen(const SensorReading& reading, double now_s) {
  frozen_.add(reading.scan.ranges_m, reading.odometry.value_or(Pose{}));
  if (frozen_.repeats() < kFewestRepeats || frozen_.moved_m() < options_.frozen_travel_m) return;
  begin(SensorLie::kScanFrozen, now_s,
        text(2, "the scan is frozen: ", frozen_.repeats() + 1,
             " scans are the same to the last digit, though the odometry has moved ",
             frozen_.moved_m(), " m"));
}

void SensorMonitor::check_blind(const SensorReading& reading, const OccupancyMap& map,
                                double now_s) {
  // The first scans map everything, also people who walk by.
  if (!begun_s_) begun_s_ = now_s;
  if (now_s - *begun_s_ < kSettling_s) return;
  const BlindBeams blind = blind_beams(reading.beams, reading.scan.angle_increment_rad, map);
  blind_rad_ = blind.width_rad;
  blind_scans_ = blind_rad_ > options_.max_blind_rad ? blind_scans_ + 1 : 0;
  if (blind_scans_ < kBlindScans) return;
  begin(SensorLie::kScanBlind, now_s,
        text(0, "the lidar is blind: beams over ", kDegrees * blind_rad_,
             " degrees return nothing where the map has walls, most about the heading ",
             kDegrees * blind.middle_rad, " degrees of the map"));
}

void SensorMonitor::check_noise(const PlanarScan& scan) {
  const auto noise_m = range_noise_m(scan);
  if (!noise_m) return;
  noise_m_ = noise_m_ == 0.0 ? *noise_m : noise_m_ + kNoiseShare * (*noise_m - noise_m_);
  const double limit_m = options_.max_noise_ratio * options_.lidar_noise_m;
  if (noise_m_ > limit_m) {
    begin(SensorLie::kScanNoisy, scan.end_time_s(),
          text(0, "the lidar is noisy: its ranges scatter by ", 1e3 * noise_m_,
               " mm (standard deviation), lidar_noise of the model is ",
               1e3 * options_.lidar_noise_m, " mm"));
  } else if (noise_m_ < kEnd * limit_m) {
    end(SensorLie::kScanNoisy);
  }
}

void SensorMonitor::check_motion(const SensorReading& reading, double now_s) {
  // What is known to be wrong shows nothing of the rest.
  if (!reading.odometry || lies_.count(SensorLie::kScanFrozen) > 0) {
    motion_.clear();
    comparison_.clear();
    return;
  }
  const ScanHits standing = hits_of(with_wide_hits_only(reading.beams), reading.base, 0.0);
  comparison_.add(now_s, *reading.odometry, motion_.add(standing, *reading.odometry));
  const double unreported_m = comparison_.unreported_travel_m();
  if (unreported_m > options_.max_unreported_m) {
    begin(SensorLie::kOdometryFrozen, now_s,
          text(2, "the odometry is frozen: it stands, though by the scans the robot has moved ",
               unreported_m, " m"));
    comparison_.clear();
  }
  difference_ = unreported_m > kSomeTravel_m ? std::nullopt : comparison_.difference(noise_m_);
  if (difference_) judge_difference(now_s);
}

void SensorMonitor::judge_difference(double now_s) {
  const MotionDifference& found = *difference_;
  const bool is_late = found.lag_s > options_.max_lag_s;
  if (std::abs(found.lag_s - newest_lag_s_) > kSameLag_s) shown_.erase(SensorLie::kScanLate);
  newest_lag_s_ = found.lag_s;
  if (lasts(SensorLie::kScanLate, is_late)) {
    begin(SensorLie::kScanLate, now_s,
          text(2, "scans are late: by the odometry's motion they are ", found.lag_s,
               " s older than they say"));
    // It looks like them as well.
    end(SensorLie::kScanTurned);
    end(SensorLie::kOdometrySlips);
    comparison_.clear();
  }
  if (is_late) return;
  const double turn = std::abs(found.turn_rad);
  if (lasts(SensorLie::kScanTurned, turn - kSure * found.turn_error_rad > options_.max_turn_rad)) {
    begin(SensorLie::kScanTurned, now_s,
          text(1, "the lidar is turned: by the odometry's motion it looks ", kDegrees * turn,
               " degrees to the ", found.turn_rad > 0.0 ? "left" : "right",
               " of where the model has it"));
  } else if (turn < kEnd * options_.max_turn_rad && found.turn_error_rad > 0.0) {
    end(SensorLie::kScanTurned);
  }
  const double slip = std::abs(found.slip);
  if (lasts(SensorLie::kOdometrySlips, slip - kSure * found.slip_error > options_.max_slip)) {
    begin(SensorLie::kOdometrySlips, now_s,
          text(0, "the wheels slip: the odometry reports ", 100.0 * slip, " % ",
               found.slip > 0.0 ? "more" : "less", " travel than the scans show"));
  } else if (slip < kEnd * options_.max_slip && found.slip_error > 0.0) {
    end(SensorLie::kOdometrySlips);
  }
}

/// Standing, a robot cannot see whether what stopped it is over: it tries again.
void SensorMonitor::end_held(double now_s) {
  for (auto lie = lies_.begin(); lie != lies_.end();) {
    const double hold_s = shows_in_each_scan(lie->first) ? kShortHold_s : options_.hold_s;
    const bool is_over = stops_the_robot(lie->first) && now_s - seen_s_[lie->first] > hold_s;
    lie = is_over ? lies_.erase(lie) : std::next(lie);
  }
}

std::string SensorMonitor::stop() const {
  std::string words;
  for (const auto& [lie, what] : lies_) {
    if (stops_the_robot(lie)) words += (words.empty() ? "" : "; ") + what;
  }
  return words;
}

void SensorMonitor::clear() { *this = SensorMonitor(options_); }

}  // namespace mocha
