#include "benchmarks/skid_odometry.h"

#include <algorithm>
#include <cmath>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kDistanceSigma = 0.03;
constexpr double kTurnSigma = 0.05;
constexpr double kSwerveSigma_rad_per_m = 0.01;
constexpr double kDistanceNoise = 0.03;  // [m/sqrt(m)]
constexpr double kTurnNoise = 0.05;      // [rad/sqrt(rad)]
constexpr double kSwerveNoise = 0.01;    // [rad/sqrt(m)]
constexpr int kStepsPerSlip = 100;
constexpr double kSlip = 0.3;  // of the distance

}  // namespace

SkidOdometry::SkidOdometry(std::uint64_t seed) : random_(seed) {
  distance_factor_ = 1.0 + kDistanceSigma * normal_(random_);
  turn_factor_ = 1.0 + kTurnSigma * normal_(random_);
  swerve_rad_per_m_ = kSwerveSigma_rad_per_m * normal_(random_);
}

const Pose& SkidOdometry::add(const Pose& step) {
  const double driven_m = step.position.norm();
  const bool slips = random_() % kStepsPerSlip == 0;
  const double wrong_rad = (turn_factor_ - 1.0) * step.yaw_rad + swerve_rad_per_m_ * driven_m +
                           kTurnNoise * std::sqrt(std::abs(step.yaw_rad)) * normal_(random_) +
                           kSwerveNoise * std::sqrt(driven_m) * normal_(random_);
  // Wheels that slip turn on: more is reported than was driven.
  const double factor = distance_factor_ * (slips ? 1.0 / (1.0 - kSlip) : 1.0) +
                        kDistanceNoise / std::sqrt(std::max(driven_m, 1e-6)) * normal_(random_);
  pose_ = composed(pose_, {Eigen::Rotation2Dd(0.5 * wrong_rad) * (factor * step.position),
                           step.yaw_rad + wrong_rad});
  return pose_;
}

}  // namespace mocha
