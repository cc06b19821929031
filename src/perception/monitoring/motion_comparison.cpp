#include "perception/monitoring/motion_comparison.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kOldest_s = 8.0;
constexpr double kLongestStep_s = 0.35;  // over a longer pause nothing is compared
constexpr double kMostLag_s = 0.6;
constexpr double kLagStep_s = 0.05;
constexpr std::size_t kFewestSteps = 10;
constexpr double kArm_m = 0.5;  // a turn counts as so much travel per radian
// A lag is clear where it explains this much of what is unexplained without it, and that is more
// than the noise of a step.
constexpr double kExplained = 0.65;
constexpr double kStepNoise_m = 0.006;  // at least
constexpr double kStepNoisePerRange = 0.6;
constexpr double kStanding = 0.2;  // share of the scans' motion that counts as standing
constexpr double kShown_s = 1.0;
constexpr int kFewestStanding = 3;  // steps

std::complex<double> travel(const Pose& step) { return {step.position.x(), step.position.y()}; }

double length_m(const Pose& step) { return step.position.norm() + kArm_m * std::abs(step.yaw_rad); }

}  // namespace

/// The scale and turn by which the odometry's steps explain those of the scans, as one complex
/// factor, and what is left.
struct MotionComparison::Fit {
  std::complex<double> factor{1.0, 0.0};
  double odometry_squares = 0.0;  // [m^2]
  double travel_squares = 0.0;    // left unexplained [m^2]
  double turn_squares = 0.0;      // as lengths [m^2]

  double unexplained() const { return travel_squares + turn_squares; }
};

void MotionComparison::forget_old(double now_s) {
  double travelled_m = 0.0;
  std::size_t kept = 0;
  while (kept < steps_.size()) {
    const Step& step = steps_[steps_.size() - 1 - kept];
    if (travelled_m >= travel_m_ || step.begin_s < now_s - kOldest_s) break;
    travelled_m += length_m(step.scan);
    ++kept;
  }
  steps_.erase(steps_.begin(), steps_.end() - static_cast<std::ptrdiff_t>(kept));
  while (!odometry_.empty() && odometry_.front().first < now_s - kOldest_s - 2.0 * kMostLag_s)
    odometry_.pop_front();
}

void MotionComparison::add(double time_s, const Pose& odometry, const std::optional<Pose>& step) {
  const bool follows = !odometry_.empty() && time_s - odometry_.back().first < kLongestStep_s;
  if (step && follows) steps_.push_back({odometry_.back().first, time_s, *step});
  if (!follows) {
    steps_.clear();
    odometry_.clear();
  }
  odometry_.emplace_back(time_s, odometry);
  forget_old(time_s);
}

Pose MotionComparison::odometry_at(double time_s) const {
  const auto next = std::lower_bound(odometry_.begin(), odometry_.end(), time_s,
                                     [](const auto& entry, double t) { return entry.first < t; });
  if (next == odometry_.begin()) return odometry_.front().second;
  if (next == odometry_.end()) return odometry_.back().second;
  const auto& [before_s, before] = *(next - 1);
  const double share = (time_s - before_s) / (next->first - before_s);
  const Pose step = relative(before, next->second);
  return composed(before, {share * step.position, share * step.yaw_rad});
}

Pose MotionComparison::odometry_step(const Step& step, double lag_s) const {
  return relative(odometry_at(step.begin_s - lag_s), odometry_at(step.end_s - lag_s));
}

MotionComparison::Fit MotionComparison::fit(double lag_s) const {
  Fit fit;
  std::complex<double> products = 0.0;
  double scan_squares = 0.0;
  for (const Step& step : steps_) {
    const Pose driven = odometry_step(step, lag_s);
    products += std::conj(travel(driven)) * travel(step.scan);
    fit.odometry_squares += std::norm(travel(driven));
    scan_squares += std::norm(travel(step.scan));
    const double turn_m = kArm_m * wrap_angle(step.scan.yaw_rad - driven.yaw_rad);
    fit.turn_squares += turn_m * turn_m;
  }
  if (fit.odometry_squares > 0.0) fit.factor = products / fit.odometry_squares;
  fit.travel_squares = std::max(0.0, scan_squares - std::norm(fit.factor) * fit.odometry_squares);
  return fit;
}

std::optional<MotionDifference> MotionComparison::difference(double range_noise_m) const {
  const double count = static_cast<double>(steps_.size());
  if (steps_.size() < kFewestSteps) return std::nullopt;
  double lag_s = 0.0;
  Fit best = fit(0.0);
  const double at_once = best.unexplained();
  for (double tried_s = kLagStep_s; tried_s < kMostLag_s; tried_s += kLagStep_s) {
    const Fit tried = fit(tried_s);
    if (tried.unexplained() >= best.unexplained()) continue;
    best = tried;
    lag_s = tried_s;
  }
  const double noise_m = std::max(kStepNoise_m, kStepNoisePerRange * range_noise_m);
  const bool is_bounded = lag_s < kMostLag_s - 1.5 * kLagStep_s;
  const bool is_clear = is_bounded && best.unexplained() < (1.0 - kExplained) * at_once &&
                        at_once > count * noise_m * noise_m;
  MotionDifference difference;
  if (is_clear) difference.lag_s = lag_s;
  const double scale = std::abs(best.factor);
  double travelled_m = 0.0;
  for (const Step& step : steps_) travelled_m += odometry_step(step, lag_s).position.norm();
  if (2.0 * travelled_m < travel_m_ || scale < 0.1)
    return is_clear ? std::optional(difference) : std::nullopt;
  // Scale and turn have the same uncertainty, as a share and in radians.
  const double error = std::sqrt(best.travel_squares / (2.0 * count - 2.0) / best.odometry_squares);
  // Turned to the left, it sees the robot drive to the right.
  difference.turn_rad = -std::arg(best.factor);
  difference.turn_error_rad = error / scale;
  difference.slip = 1.0 / scale - 1.0;
  difference.slip_error = error / (scale * scale);
  return difference;
}

double MotionComparison::unreported_travel_m() const {
  if (steps_.empty()) return 0.0;
  double most_m = 0.0;
  int count = 0;
  Pose shown;
  double since_s = steps_.back().end_s;
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    if (step->begin_s < steps_.back().end_s - kShown_s || step->end_s < since_s - 1e-6) break;
    shown = composed(step->scan, shown);
    since_s = step->begin_s;
    const Pose driven = relative(odometry_at(since_s), odometry_at(steps_.back().end_s));
    if (++count >= kFewestStanding && length_m(driven) < kStanding * length_m(shown))
      most_m = std::max(most_m, length_m(shown));
  }
  return most_m;
}

}  // namespace mocha
