#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "safety/certificate.h"
#include "safety/drive_piece.h"
#include "safety/worst_value.h"

namespace mocha {
namespace {

constexpr double kResolution_m =
    1e-3;  // nearer to the limit than this is refused, so that every step has a length

/// An upper bound on the speed of the own base until a time.
struct SpeedBound {
  double until_s;
  double speed;
};

std::vector<SpeedBound> speed_bounds(const Motion& motion, double from_s) {
  std::vector<SpeedBound> bounds;
  for (int i = 0; i < static_cast<int>(motion.phases().size()); ++i) {
    const double end = motion.phase_start_time(i) + duration_s(motion.phases()[i]);
    if (end <= from_s) continue;
    if (std::holds_alternative<DrivePhase>(motion.phases()[i])) {
      for (const DrivePiece& piece : drive_pieces(motion, i, from_s)) {
        bounds.push_back({piece.end_s(), piece.max_speed()});
      }
    } else {
      bounds.push_back({end, 0.0});
    }
  }
  bounds.push_back({std::numeric_limits<double>::infinity(), 0.0});
  return bounds;
}

}  // namespace

Violation check_separation(const Motion& motion, double own_radius_m,
                           const MovingObstacle& obstacle, double clearance_m, double from_s,
                           double until_s) {
  const double end = std::min(until_s, std::max({motion.end_time(), obstacle.rest_time(), from_s}));
  if (!std::isfinite(end)) {
    throw std::invalid_argument("check_separation: " + obstacle.name() +
                                " never rests and no end of the check is given");
  }
  const double apart_m = motion.box().exteriorDistance(obstacle.box());
  if (apart_m > own_radius_m + clearance_m + kResolution_m) return {};
  const auto distance_m = [&](double t) {
    const MovingObstacle::Disc disc = obstacle.at(t);
    return (motion.position(t) - disc.centre).norm() - own_radius_m - disc.radius_m;
  };
  const std::vector<SpeedBound> bounds = speed_bounds(motion, from_s);
  auto bound = bounds.begin();
  for (double t = from_s;;) {
    while (bound->until_s <= t) ++bound;
    const double slack = distance_m(t) - clearance_m;
    const double closing = std::max(0.0, bound->speed + obstacle.max_closing_speed(t));
    const double proved = t + slack / closing;  // infinite where nothing moves
    // So fast that a step is shorter than the tick of the clock, nothing is proved.
    if (!(slack >= kResolution_m && proved > t)) {
      const double least =
          worst_value(distance_m, std::less<>(), clearance_m + kResolution_m, t, end);
      return {
          ViolatedTerm::kSeparation, t, motion.position(t), least, clearance_m, obstacle.name()};
    }
    if (t >= end) return {};
    t = std::min({proved, bound->until_s, end});
  }
}

}  // namespace mocha
