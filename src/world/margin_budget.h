#pragma once

#include <string>
#include <utility>
#include <vector>

#include "world/robot_model.h"
#include "world/speed_margin.h"

namespace mocha {

/// Where a robot may be besides where its motion says: every contribution once, and the sums that
/// planning and proofs use. The body itself is not in it: it is the footprint.
struct MarginBudget {
  double tracking_m = 0.0;        ///< base off its motion at max_speed, until the tracker brakes
  double localisation_m = 0.0;    ///< pose off the truth, in the shared map
  double map_m = 0.0;             ///< obstacle nearer than the map says, met at max_speed
  double clock_s = 0.0;           ///< own clock against the peers'
  double max_speed = 0.0;         ///< [m/s]
  double tracking_still_m = 0.0;  ///< as tracking_m, at rest
  double map_still_m = 0.0;       ///< as map_m, at rest

  static MarginBudget of(const RobotModel& robot);

  /// Throws std::invalid_argument naming the contribution that is negative or not finite.
  void validate() const;

  /// Of the base off its motion.
  SpeedMargin tracking() const { return between(tracking_still_m, tracking_m); }

  /// To keep from static obstacles by a promise in force: the map's part may be used up.
  SpeedMargin without_map() const {
    return between(tracking_still_m + localisation_m, tracking_m + localisation_m);
  }

  /// To keep from static obstacles.
  SpeedMargin static_margin() const {
    return between(tracking_still_m + localisation_m + map_still_m, static_margin_m());
  }
  /// The same at max_speed.
  double static_margin_m() const { return tracking_m + localisation_m + map_m; }

  /// To keep from things that are seen but promise nothing, on top of what their prediction leaves
  /// open; the map has no part in it.
  double own_margin_m() const { return tracking_m + localisation_m; }

  /// To keep from a peer's footprint on its promised motion, on top of both bodies; the map has no
  /// part in it.
  double peer_margin_m(const MarginBudget& peer) const;
  /// To keep from a peer like oneself.
  double peer_margin_m() const { return peer_margin_m(*this); }

  /// Every contribution and the sums by name, for diagnostics; the unit ends the name.
  std::vector<std::pair<std::string, double>> listed() const;

 private:
  SpeedMargin between(double still_m, double fast_m) const {
    return {still_m, max_speed > 0.0 ? (fast_m - still_m) / (max_speed * max_speed) : 0.0};
  }
};

}  // namespace mocha
