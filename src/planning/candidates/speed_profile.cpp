#include "planning/candidates/speed_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "camouflage/bounded_maps.h"
#include "trajectory/polyline.h"

namespace mocha {
namespace {

constexpr double kStep_m = 0.05;      // of the sampled path, at least
constexpr double kSteps = 25.0;       // in the window that rounds corners
constexpr double kMostSamples = 2e4;  // very long paths are sampled more coarsely
constexpr int kMostPieces = 2000;
constexpr double kProfileAcceleration = 0.6;  // leaves room for the curve's own shape
constexpr double kStraight = 1e-12;           // squared tangent of a turn that is none
constexpr double kSlowest_mps = 0.01;         // [m/s] of the profile, so that times stay finite

template <int D>
using Points = std::vector<Eigen::Matrix<double, D, 1>>;

template <int D>
Points<D> resample(const Points<D>& points, double step_m) {
  Points<D> samples = {points.front()};
  samples.reserve(points.size() + static_cast<std::size_t>(length_of<D>(points) / step_m));
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Matrix<double, D, 1> step = points[i] - points[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(step.norm() / step_m)));
    for (int k = 1; k <= parts; ++k) {
      samples.push_back(points[i - 1] + step * (static_cast<double>(k) / parts));
    }
  }
  return samples;
}

/// Moving average over `widest` samples to both sides, fewer towards the ends, which stay.
template <int D>
Points<D> rounded(const Points<D>& samples, int widest) {
  const int last = static_cast<int>(samples.size()) - 1;
  Points<D> sums(samples.size() + 1);
  sums.front().setZero();
  for (int i = 0; i <= last; ++i) sums[i + 1] = sums[i] + samples[i];
  Points<D> means(samples.size());
  for (int i = 0; i <= last; ++i) {
    const int reach = std::min({widest, i, last - i});
    means[i] = (sums[i + reach + 1] - sums[i - reach]) * (1.0 / (2.0 * reach + 1.0));
  }
  return means;
}

/// Speed allowed by the turn of the path over `reach` >= 1 samples to both sides of each.
template <int D>
std::vector<double> corner_speeds(const Points<D>& samples, const MotionLimits& limits, int reach) {
  const int last = static_cast<int>(samples.size()) - 1;
  std::vector<double> speeds(samples.size(), limits.max_speed);
  for (int i = 1; i < last; ++i) {
    const Eigen::Matrix<double, D, 1> in = samples[i] - samples[std::max(0, i - reach)];
    const Eigen::Matrix<double, D, 1> out = samples[std::min(last, i + reach)] - samples[i];
    const double along = in.dot(out);
    const Eigen::Matrix<double, D, 1> normal = out * in.squaredNorm() - in * along;  // times |in|^2
    if (along > 0.0 && normal.squaredNorm() <= kStraight * in.squaredNorm() * along * along)
      continue;
    const double turn = std::atan2(normal.norm() / (in.norm() + 1e-9), along);
    const double curvature = turn / (0.5 * (in.norm() + out.norm()) + 1e-9);
    speeds[i] = std::min({speeds[i], limits.max_yaw_rate / curvature,
                          limits.max_wheel_speed / (1.0 + 0.5 * limits.track_m * curvature),
                          std::sqrt(kProfileAcceleration * limits.max_acceleration / curvature)});
  }
  return speeds;
}

/// Times at which the samples are reached, after limiting acceleration forward and deceleration
/// backward.
template <int D>
std::vector<double> arrival_times(const Points<D>& samples, const std::vector<double>& speeds,
                                  double start_speed, const MotionLimits& limits) {
  const double gain = 2.0 * kProfileAcceleration * limits.max_acceleration;
  const std::size_t last = samples.size() - 1;
  std::vector<double> steps_m(samples.size());  // to each from the one before
  std::vector<double> squares(samples.size());  // of the speeds
  squares[0] = std::pow(std::min(speeds[0], start_speed), 2);
  for (std::size_t i = 1; i <= last; ++i) {
    steps_m[i] = (samples[i] - samples[i - 1]).norm();
    squares[i] = std::min(speeds[i] * speeds[i], squares[i - 1] + gain * steps_m[i]);
  }
  squares[last] = 0.0;
  for (std::size_t i = last; i > 0; --i)
    squares[i - 1] = std::min(squares[i - 1], squares[i] + gain * steps_m[i]);
  std::vector<double> times(samples.size(), 0.0);
  for (std::size_t i = 1; i <= last; ++i) {
    const double mean = 0.5 * (std::sqrt(squares[i - 1]) + std::sqrt(squares[i]));
    times[i] = times[i - 1] + steps_m[i] / std::max(kSlowest_mps, mean);
  }
  return times;
}

}  // namespace

template <int D>
double InitialKnots<D>::metres_per_eta() const {
  const auto steps = path.rightCols(path.cols() - 1) - path.leftCols(path.cols() - 1);
  const double speed = steps.colwise().norm().sum() / durations_s.sum();
  return std::max(kSlowest_mps, speed) * duration_slope(eta_of(durations_s.mean()));
}

template <int D>
SpeedProfile<D>::SpeedProfile(const Points& points, double start_speed, const MotionLimits& limits,
                              double window_m, const SpeedAt<D>& fastest_at) {
  const double length = length_of<D>(points);
  if (points.size() < 2 || !std::isfinite(length)) {
    throw std::invalid_argument("SpeedProfile: needs at least two points, all of them finite");
  }
  if (!(limits.max_speed > 0.0) || !(limits.max_acceleration > 0.0) || !(start_speed >= 0.0)) {
    throw std::invalid_argument("SpeedProfile: limits must be above 0, the first speed at least 0");
  }
  const double step_m = std::max({kStep_m, window_m / kSteps, length / kMostSamples});
  const int half_window = static_cast<int>(std::clamp(0.5 * window_m / step_m, 0.0, kMostSamples));
  samples_ = resample<D>(points, step_m);
  for (int pass = 0; pass < 2; ++pass) samples_ = rounded<D>(samples_, half_window);
  std::vector<double> speeds = corner_speeds<D>(samples_, limits, std::max(1, half_window));
  if (fastest_at) {
    for (std::size_t i = 0; i < speeds.size(); ++i)
      speeds[i] = std::min(speeds[i], fastest_at(samples_[i]));
  }
  times_s_ = arrival_times<D>(samples_, speeds, start_speed, limits);
}

template <int D>
InitialKnots<D> SpeedProfile<D>::knots(int pieces) const {
  InitialKnots<D> knots;
  knots.path.resize(D, pieces + 1);
  knots.durations_s.setConstant(pieces, std::max(1e-2, duration_s() / pieces));
  std::size_t i = 1;
  for (int k = 0; k <= pieces; ++k) {
    const double t = duration_s() * k / pieces;
    while (i + 1 < times_s_.size() && times_s_[i] < t) ++i;
    const double span = times_s_[i] - times_s_[i - 1];
    const double share = span > 0.0 ? std::clamp((t - times_s_[i - 1]) / span, 0.0, 1.0) : 1.0;
    knots.path.col(k) = samples_[i - 1] + share * (samples_[i] - samples_[i - 1]);
  }
  return knots;
}

template <int D>
InitialKnots<D> spread_knots(const Points<D>& points, double start_speed,
                             const MotionLimits& limits, double spacing_m,
                             const SpeedAt<D>& fastest_at) {
  const SpeedProfile<D> profile(points, start_speed, limits, spacing_m, fastest_at);
  const double intervals = std::ceil(profile.duration_s() * limits.max_speed / spacing_m);
  return profile.knots(static_cast<int>(std::clamp<double>(intervals, 2, kMostPieces)));
}

template struct InitialKnots<2>;
template struct InitialKnots<3>;
template class SpeedProfile<2>;
template class SpeedProfile<3>;
template InitialKnots<2> spread_knots<2>(const Points<2>&, double, const MotionLimits&, double,
                                         const SpeedAt<2>&);
template InitialKnots<3> spread_knots<3>(const Points<3>&, double, const MotionLimits&, double,
                                         const SpeedAt<3>&);

}  // namespace mocha
