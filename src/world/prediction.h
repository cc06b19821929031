#pragma once

#include <Eigen/Core>

namespace mocha {

/// How much larger than the thing itself a disc must be that holds it in spite of what is not known
/// about its place and velocity.
struct RadiusGrowth {
  double radius_m;  ///< now
  double rate;      ///< [m/s] from now on
};

/// From the covariance of (x, y, vx, vy) [m, m/s], for a disc about the predicted place that holds
/// the true one with the probability `confidence` in [0, 0.9999] at any one time. Linear, and never
/// less than what the covariance, propagated at constant velocity, asks for: sigma_p + sigma_v t
/// bounds its largest standard deviation whatever place and velocity have in common. Throws
/// std::invalid_argument for a confidence out of range and for what is not a covariance.
RadiusGrowth growth_of(const Eigen::Matrix4d& covariance, double confidence);

}  // namespace mocha
