#pragma once

#include <Eigen/Core>
#include <vector>

#include "perception/tracking/detection.h"

namespace mocha {

/// Where one scan shows the centre of a disc.
struct DiscFit {
  Vector2 centre;              ///< [m]
  Eigen::Matrix2d covariance;  ///< of its error [m^2]
};

/// The disc of a known radius that fits a detection best, by least squares over the distances of
/// its hits from the circle and of the edges of its sector that are not hidden from the tangents.
/// A part that is seen tells in its direction of sight, and less across; what does not look like a
/// disc, such as two legs, tells less. `hit_noise_m` is the standard deviation of hits on a disc.
DiscFit fit_disc(const Detection& detection, double radius_m, double hit_noise_m);

/// Where a person is whose legs, or one of them, a detection shows: between them. Throws
/// std::invalid_argument for a detection that does not look like legs.
DiscFit fit_legs(const Detection& detection);

}  // namespace mocha
