#pragma once

#include <cstdint>
#include <optional>

namespace mocha {

/// How far a wheel has rolled, from two poor witnesses: its speed at moments, and an odometer that
/// counts whole centimetres, cut towards zero.
///
/// The speed is smoothed, as one reading is of the moment, and of one pulse of the encoder or none;
/// then it is integrated, which is fine but drifts. The odometer does not drift, but is coarse. It
/// says within which centimetre the wheel is, so the sum is held inside it: never more than 1 cm
/// off what the encoder has counted (2 cm next to its zero), however far the wheel rolls; and as
/// one edge after the other is passed, far less.
class WheelTravel {
 public:
  /// From one reading to the next.
  struct Step {
    double dt_s = 0.0;
    double rolled_m = 0.0;
    bool rolls = false;  ///< either witness says so, however little
  };

  /// `max_speed` [m/s] tells rolling from the jump of an odometer that began again.
  explicit WheelTravel(double max_speed) : max_speed_(max_speed) {}

  /// Metres rolled in the last `dt_s`, at the end of which these were read: nothing at the first
  /// reading and where the odometer began again.
  double add(double dt_s, double speed, std::int64_t odometer_cm);

  const Step& last() const { return last_; }
  /// Smoothed [m/s].
  double speed() const { return speed_; }

  /// How often the odometer jumped: the base was restarted.
  int restarts() const { return restarts_; }

 private:
  double max_speed_;
  std::optional<double> rolled_m_;  // since the odometer's zero
  double speed_ = 0.0;
  std::int64_t odometer_cm_ = 0;
  Step last_;
  int restarts_ = 0;
};

}  // namespace mocha
