#include "benchmarks/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

Vector2 centre(const std::vector<Pose>& poses) {
  Vector2 sum = Vector2::Zero();
  for (const Pose& pose : poses) sum += pose.position;
  return sum / static_cast<double>(poses.size());
}

}  // namespace

std::vector<double> absolute_errors_m(const std::vector<Pose>& estimate,
                                      const std::vector<Pose>& reference) {
  if (estimate.empty()) return {};
  const Vector2 from = centre(estimate);
  const Vector2 to = centre(reference);
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Vector2 a = estimate[i].position - from;
    const Vector2 b = reference[i].position - to;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Eigen::Rotation2Dd turn(std::atan2(across, along));
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Vector2 aligned = to + turn * (estimate[i].position - from);
    errors_m.push_back((aligned - reference[i].position).norm());
  }
  return errors_m;
}

RelativeErrors relative_errors(const std::vector<Pose>& estimate,
                               const std::vector<Pose>& reference, double length_m) {
  RelativeErrors errors;
  std::size_t end = 0;
  double driven_m = 0.0;  // from `begin` to `end`
  const auto step_m = [&](std::size_t i) {
    return (reference[i + 1].position - reference[i].position).norm();
  };
  for (std::size_t begin = 0; begin < reference.size(); ++begin) {
    while (driven_m < length_m && end + 1 < reference.size()) driven_m += step_m(end++);
    if (driven_m < length_m) break;
    const Pose off = relative(relative(reference[begin], reference[end]),
                              relative(estimate[begin], estimate[end]));
    errors.off_m.push_back(off.position.norm());
    errors.off_rad.push_back(std::abs(off.yaw_rad));
    driven_m -= step_m(begin);
  }
  return errors;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double rms(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace mocha
