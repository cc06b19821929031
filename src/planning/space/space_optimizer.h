#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "optimization/trajectory_optimizer.h"
#include "planning/space/space_plan.h"
#include "planning/space/space_planner_options.h"
#include "topology/signatures/h_signature.h"
#include "world/obstacle_field.h"

namespace mocha {

/// Makes a certified trajectory from rest to rest of a path in space: camouflage, MINCO, penalties,
/// time scaling, proof.
class SpaceOptimizer {
 public:
  explicit SpaceOptimizer(const SpacePlannerOptions& options) : options_(options) {}

  /// With more effort where a proof fails, a few times. `path` has at least two points.
  SpaceCandidate optimize_path(const std::vector<Eigen::Vector3d>& path,
                               const ObstacleField<3>& field, const Cuts<3>& cuts,
                               const std::function<bool()>& should_stop) const;

 private:
  /// What is raised from one attempt to the next.
  struct Push {
    double obstacle_weight = 1.0;
    double spacing = 1.0;
    std::optional<BasicFallback<3>> fallback;  ///< why waypoints are the variables
  };

  OptimizedTrajectory<3, 3> optimized(const std::vector<Eigen::Vector3d>& path,
                                      const ObstacleField<3>& field, Push& push,
                                      const std::function<bool()>& should_stop) const;
  BasicViolation<3> first_violation(const PiecewisePolynomial<3, 3>& curve,
                                    const ObstacleField<3>& field) const;

  const SpacePlannerOptions options_;
};

}  // namespace mocha
