#include "simulation/odometry.h"

#include <cmath>

namespace mocha {

Odometry::Odometry(double noise_distance, double noise_yaw, std::uint64_t seed)
    : noise_distance_(noise_distance), noise_yaw_(noise_yaw), random_(seed) {}

void Odometry::add(const Arc& arc) {
  const double along = noise_distance_ * std::sqrt(std::abs(arc.length_m)) * normal_(random_);
  const double turn = noise_yaw_ * std::sqrt(std::abs(arc.turn_rad)) * normal_(random_);
  pose_ = advanced(pose_, {arc.length_m + along, arc.turn_rad + turn});
}

}  // namespace mocha
