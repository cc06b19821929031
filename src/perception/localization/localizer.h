#pragma once

#include "perception/localization/scan_matcher.h"
#include "perception/sensor/scan_hits.h"

namespace mocha {

/// What is known of the robot's place.
struct Localization {
  enum class State {
    kLost,       ///< no place in the map explains the scans
    kAmbiguous,  ///< several do, or one that has not proved itself yet
    kLocalized,
  };
  State state = State::kLost;
  double time_s = 0.0;   ///< of the scan
  PoseEstimate base{};   ///< of base_link; the most likely place where the state is not kLocalized
  Pose odom_in_map;      ///< the odometry frame in the map, by that
  double quality = 0.0;  ///< of that place, 0 to 1
  int places = 0;        ///< that explain the scans
  bool searched_in_vain = false;  ///< the map was too large or too uniform for the last search
};

/// Says where a robot is, from its scans and its odometry.
class Localizer {
 public:
  virtual ~Localizer() = default;

  /// Takes the next scan, and the pose of base_link in the odometry frame at its time. Throws
  /// std::invalid_argument, and changes nothing, for times that do not increase and for what
  /// check_measured() refuses.
  virtual const Localization& add(const ScanHits& scan, const Pose& odometry) = 0;

  /// Takes a hint where the robot is at the next scan, more or less. Throws std::invalid_argument
  /// for an estimate with a fault.
  virtual void expect(const PoseEstimate& base) = 0;

  /// Begins anew.
  virtual void forget() = 0;

  virtual const Localization& localization() const = 0;
};

}  // namespace mocha
