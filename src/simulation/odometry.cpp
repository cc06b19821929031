#include "simulation/odometry.h"

#include <cmath>

namespace mocha {

Odometry::Odometry(double noise_distance, double noise_yaw, std::uint64_t seed)
    : noise_distance_(noise_distance), noise_yaw_(noise_yaw), random_(seed) {}

void Odometry::add(const Arc& arc, const Twist& twist) {
  const double along = noise_distance_ * std::sqrt(std::abs(arc.length_m)) * normal_(random_);
  const double turn = noise_yaw_ * std::sqrt(std::abs(arc.turn_rad)) * normal_(random_);
  const Arc measured{arc.length_m + along, arc.turn_rad + turn};
  honest_pose_ = advanced(honest_pose_, measured);
  if (fault_.frozen) return;
  const double share = 1.0 + fault_.slip;
  pose_ = advanced(pose_, {share * measured.length_m, measured.turn_rad});
  twist_ = {share * twist.speed, twist.yaw_rate};
}

void Odometry::set_fault(const OdometryFault& fault) {
  fault_ = fault;
  honest_pose_ = pose_;
}

}  // namespace mocha
