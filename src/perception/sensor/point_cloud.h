#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "perception/sensor/beam.h"

namespace mocha {

/// The beams of a cloud of points [m, sensor frame], all measured at one time from `pose` (map
/// frame). Of points closer than about `spacing_m` to each other only one is taken; points farther
/// than `reach_m` count as nothing met up to there; points that are not finite are left out.
std::vector<Beam> to_beams(const std::vector<Eigen::Vector3f>& points,
                           const Eigen::Isometry3d& pose, double time_s, double reach_m,
                           double spacing_m);

}  // namespace mocha
