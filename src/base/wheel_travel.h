#pragma once

#include <cstdint>
#include <optional>

namespace mocha {

/// How far a wheel has rolled, from two poor witnesses: its speed at moments, and an odometer that
/// counts whole centimetres, cut towards zero.
///
/// The speed is integrated between two readings, which is fine but drifts: it is of the moment,
/// from few pulses of the encoder. The odometer does not drift, but is coarse. It says within which
/// centimetre the wheel is, so the sum is held inside it: never more than 1 cm off what the encoder
/// has counted (2 cm next to its zero), however far the wheel rolls; and as one edge after the
/// other is passed, far less.
class WheelTravel {
 public:
  /// `max_speed` [m/s] tells rolling from the jump of an odometer that began again.
  explicit WheelTravel(double max_speed) : max_speed_(max_speed) {}

  /// Metres rolled in the last `dt_s`, at the end of which these were read: nothing at the first
  /// reading and where the odometer began again.
  double add(double dt_s, double speed, std::int64_t odometer_cm);

  /// How often the odometer jumped: the base was restarted.
  int restarts() const { return restarts_; }

 private:
  double max_speed_;
  std::optional<double> rolled_m_;  // since the odometer's zero
  double speed_ = 0.0;
  int restarts_ = 0;
};

}  // namespace mocha
