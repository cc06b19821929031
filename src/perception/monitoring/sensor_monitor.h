#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/parameter_table.h"
#include "perception/mapping/occupancy_map.h"
#include "perception/monitoring/frozen_scan.h"
#include "perception/monitoring/motion_comparison.h"
#include "perception/monitoring/scan_motion.h"
#include "perception/sensor/planar_scan.h"

namespace mocha {

struct SensorMonitorOptions {
  double lidar_noise_m;        ///< what the lidar is said to have
  double frozen_travel_m;      ///< the scan repeats itself while the robot moves farther
  double max_blind_rad;        ///< a wider sector without returns is not driven with
  double max_noise_ratio;      ///< of the lidar's noise to what is said
  double max_lag_s;            ///< older scans are not driven with
  double max_turn_rad;         ///< of the lidar against its mount
  double max_slip;             ///< share of the travel
  double max_unreported_m;     ///< by the scans, while the odometry stands
  double comparison_travel_m;  ///< over which scans and odometry are compared
  double hold_s;               ///< for so long a robot stands that cannot be driven

  /// From the parameters of config/perception.yaml and the model's `lidar_noise`.
  static SensorMonitorOptions from(const ParameterTable& values, double lidar_noise_m);
};

/// What can lie.
enum class SensorLie {
  kScanFrozen,
  kScanBlind,
  kScanLate,
  kOdometryFrozen,
  kScanNoisy,
  kScanTurned,
  kOdometrySlips,
};

/// Whether such a lie is too dangerous to drive with.
bool stops_the_robot(SensorLie lie);

/// What one scan says.
struct SensorReading {
  const PlanarScan& scan;
  const std::vector<Beam>& beams;  ///< the same in the map frame
  Pose base;                       ///< base_link in the map frame at the time of the last beam
  std::optional<Pose> odometry;    ///< the same in the odometry's; nothing: is not known
};

/// Notices which sensor of a robot lies, from what scans, odometry and the map say of each other,
/// and by how much.
///
/// A lidar that repeats itself while the robot moves; beams that meet nothing where walls of the
/// map are; scatter of the ranges; and the motion from scan to scan against that of the odometry,
/// which shows scans that are older than they say, a lidar that is turned, wheels that slip and an
/// odometry that stands.
class SensorMonitor {
 public:
  explicit SensorMonitor(const SensorMonitorOptions& options)
      : options_(options), comparison_(options.comparison_travel_m) {}

  /// Takes the next scan, before it enters the map.
  void add(const SensorReading& reading, const OccupancyMap& map);

  /// What lies, in words with values.
  const std::map<SensorLie, std::string>& lies() const { return lies_; }
  /// The words of those that the robot must not drive with; empty: it may.
  std::string stop() const;

  // Of the newest comparison, for people.
  const std::optional<MotionDifference>& difference() const { return difference_; }
  double noise_m() const { return noise_m_; }  ///< 0: not known yet
  double blind_rad() const { return blind_rad_; }

  /// Time has begun anew.
  void clear();

 private:
  void check_frozen(const SensorReading& reading, double now_s);
  void check_blind(const SensorReading& reading, const OccupancyMap& map, double now_s);
  void check_noise(const PlanarScan& scan);
  void check_motion(const SensorReading& reading, double now_s);
  void judge_difference(double now_s);
  bool lasts(SensorLie lie, bool is_shown);
  void begin(SensorLie lie, double now_s, const std::string& words);
  void end(SensorLie lie);
  void end_held(double now_s);

  SensorMonitorOptions options_;
  FrozenScan frozen_;
  ScanMotion motion_;
  MotionComparison comparison_;
  std::optional<MotionDifference> difference_;
  double noise_m_ = 0.0;
  double blind_rad_ = 0.0;
  std::optional<double> begun_s_;  // the first scan's time
  int blind_scans_ = 0;
  std::map<SensorLie, int> shown_;  // in a row of scans, by the comparison
  double newest_lag_s_ = 0.0;
  std::map<SensorLie, std::string> lies_;
  std::map<SensorLie, double> seen_s_;  // when they were seen last
};

}  // namespace mocha
