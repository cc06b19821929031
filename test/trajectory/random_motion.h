#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "trajectory/minco.h"
#include "trajectory/motion.h"

namespace mocha {

struct Peaks {
  double speed = 0.0;
  double acceleration = 0.0;
  double yaw_rate = 0.0;
};

/// Largest values over dense samples.
inline Peaks sampled_peaks(const Motion& motion, double from_s, int samples = 4000) {
  Peaks peaks;
  for (int i = 0; i <= samples; ++i) {
    const double t = from_s + (motion.end_time() - from_s) * i / samples;
    const MotionState state = motion.at(t);
    peaks.speed = std::max(peaks.speed, state.velocity.norm());
    peaks.acceleration = std::max(peaks.acceleration, state.acceleration.norm());
    peaks.yaw_rate = std::max(peaks.yaw_rate, std::abs(state.yaw_rate));
  }
  return peaks;
}

/// A winding MINCO drive from rest to rest, starting in the origin.
inline DrivePhase random_drive(int seed, int pieces, int direction = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  PlanarMinco::Knots points(2, pieces + 1);
  points.col(0).setZero();
  double course = 3.0 * unit(random);
  double bend = 0.0;
  for (int i = 1; i <= pieces; ++i) {
    bend = 0.5 * bend + 0.5 * unit(random);
    course += bend;
    const double step = 0.9 + 0.3 * unit(random);
    points.col(i) = points.col(i - 1) + step * Vector2(std::cos(course), std::sin(course));
  }
  Eigen::VectorXd durations(pieces);
  for (int i = 0; i < pieces; ++i) durations[i] = 0.8 + 0.2 * unit(random);
  durations[0] *= 1.8;
  durations[pieces - 1] *= 1.8;
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  start.col(0) = points.col(0);
  end.col(0) = points.col(pieces);
  PlanarMinco minco;
  minco.resize(pieces);
  minco.solve(start, end, points.middleCols(1, pieces - 1), durations);
  return {direction, minco.curve()};
}

/// The same drive, stretched in time until samples keep the limits, with the tightest of them just
/// touched.
inline Motion within(const DrivePhase& drive, const Peaks& limits, double start_s) {
  const Peaks peaks = sampled_peaks(Motion(start_s, {drive}), start_s);
  const double factor =
      1.0001 * std::max({peaks.speed / limits.speed, peaks.yaw_rate / limits.yaw_rate,
                         std::sqrt(peaks.acceleration / limits.acceleration)});
  return Motion(start_s, {DrivePhase{drive.direction, drive.path.stretched(factor)}});
}

}  // namespace mocha
