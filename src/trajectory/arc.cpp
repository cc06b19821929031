#include "trajectory/arc.h"

#include <cmath>

namespace mocha {
namespace {

/// Chord over arc length.
double chord_ratio(double turn_rad) {
  const double half = 0.5 * turn_rad;
  return std::abs(half) < 1e-6 ? 1.0 : std::sin(half) / half;
}

}  // namespace

Pose advanced(const Pose& pose, const Arc& arc) {
  const double chord = arc.length_m * chord_ratio(arc.turn_rad);
  const double towards = pose.yaw_rad + 0.5 * arc.turn_rad;
  return {pose.position + chord * Vector2(std::cos(towards), std::sin(towards)),
          wrap_angle(pose.yaw_rad + arc.turn_rad)};
}

Arc arc_between(const Pose& from, const Pose& to) {
  const double turn = wrap_angle(to.yaw_rad - from.yaw_rad);
  const double towards = from.yaw_rad + 0.5 * turn;
  const Vector2 direction(std::cos(towards), std::sin(towards));
  const double chord = (to.position - from.position).dot(direction);
  return {chord / chord_ratio(turn), turn};
}

}  // namespace mocha
