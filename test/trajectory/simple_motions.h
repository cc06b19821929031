#pragma once

#include <algorithm>
#include <cmath>

#include "trajectory/minco.h"
#include "trajectory/motion.h"

namespace mocha {

inline Motion standing(double start_s, const Vector2& position, double yaw_rad) {
  return Motion(start_s, {StandPhase{{position, yaw_rad}, 0.1}});
}

/// Along x from rest to rest, with the long stretch between at an even 0.9 m/s.
inline Motion long_drive(double start_s, double length_m) {
  constexpr double kSpeed = 0.9;
  constexpr double kRamp_s = 2.0;
  const double whole_s = length_m / kSpeed + kRamp_s;
  const int pieces = static_cast<int>(whole_s);
  PlanarMinco::Knots knots = PlanarMinco::Knots::Zero(2, pieces - 1);
  for (int k = 1; k < pieces; ++k) {
    const double t = whole_s * k / pieces;
    const double begun_s = std::min(t, kRamp_s);
    const double ended_s = std::max(0.0, t - whole_s + kRamp_s);
    knots(0, k - 1) = kSpeed * (t - begun_s + 0.5 * begun_s * begun_s / kRamp_s -
                                0.5 * ended_s * ended_s / kRamp_s);
  }
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  start(0, 2) = 0.3;
  end(0, 0) = length_m;
  end(0, 2) = -0.3;
  PlanarMinco minco;
  minco.resize(pieces);
  minco.solve(start, end, knots, Eigen::VectorXd::Constant(pieces, whole_s / pieces));
  return Motion(start_s, {DrivePhase{1, minco.curve()}});
}

/// Straight ahead from rest to rest at a trapezoidal profile, smoothed by MINCO.
inline Motion straight_drive(double start_s, const Vector2& from, double yaw_rad, double length_m,
                             double speed, double acceleration) {
  const Vector2 ahead(std::cos(yaw_rad), std::sin(yaw_rad));
  const double ramp_s = speed / acceleration;
  const double cruise_s = std::max(0.2, length_m / speed - ramp_s);
  Eigen::VectorXd durations(6);
  durations << 0.5 * ramp_s, 0.5 * ramp_s, 0.5 * cruise_s, 0.5 * cruise_s, 0.5 * ramp_s,
      0.5 * ramp_s;
  const double ramp_m = 0.5 * speed * ramp_s;
  const double whole_m = 2.0 * ramp_m + speed * cruise_s;
  const double places[] = {0.25 * ramp_m, ramp_m, 0.5 * whole_m, whole_m - ramp_m,
                           whole_m - 0.25 * ramp_m};
  PlanarMinco::Knots knots(2, 5);
  for (int k = 0; k < 5; ++k) knots.col(k) = from + ahead * places[k] * (length_m / whole_m);
  PlanarMinco::State start;
  PlanarMinco::State end;
  start << from, Vector2::Zero(), 0.7 * acceleration * ahead;
  end << from + length_m * ahead, Vector2::Zero(), -0.7 * acceleration * ahead;
  PlanarMinco minco;
  minco.resize(6);
  minco.solve(start, end, knots, durations);
  return Motion(start_s, {DrivePhase{1, minco.curve()}});
}

/// A motion of one drive, so many times as slow.
inline Motion slowed(const Motion& motion, double factor) {
  const DrivePhase& drive = std::get<DrivePhase>(motion.phases().front());
  return Motion(motion.start_time(), {DrivePhase{drive.direction, drive.path.stretched(factor)}});
}

/// Round a circle to the left of the origin, from rest to rest, at about `speed` [m/s] between.
inline Motion round_a_circle(double radius_m, double speed) {
  constexpr int kPieces = 24;
  PlanarMinco::Knots points(2, kPieces + 1);
  for (int i = 0; i <= kPieces; ++i) {
    const double angle = 0.25 * i;
    points.col(i) = radius_m * Vector2(std::sin(angle), 1.0 - std::cos(angle));
  }
  Eigen::VectorXd durations = Eigen::VectorXd::Constant(kPieces, 0.25 * radius_m / speed);
  durations[0] *= 2.0;
  durations[kPieces - 1] *= 2.0;
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  end.col(0) = points.col(kPieces);
  PlanarMinco minco;
  minco.resize(kPieces);
  minco.solve(start, end, points.middleCols(1, kPieces - 1), durations);
  return Motion(0.0, {DrivePhase{1, minco.curve()}});
}

}  // namespace mocha
