#pragma once

#include <optional>
#include <vector>

#include "world/obstacle_field.h"

namespace mocha {

/// Silences OMPL and fixes its seed. To be called before anything else of OMPL.
void set_up_ompl();

/// A way for a disc in the plane.
struct PathTask {
  const ObstacleField<2>& obstacles;
  double clearance_m;  ///< of its centre
  Eigen::AlignedBox2d bounds;
  Eigen::Vector2d start;
  Eigen::Vector2d goal;
  double resolution_m;  ///< of the checks for obstacles
};

/// OMPL's BIT* for `budget_s`, or without one until its first solution, but no longer than
/// `patience_s`; then PathSimplifier::simplifyMax. Empty where it found none.
std::vector<Eigen::Vector2d> path_by_bitstar(const PathTask& task, std::optional<double> budget_s,
                                             double patience_s);

}  // namespace mocha
