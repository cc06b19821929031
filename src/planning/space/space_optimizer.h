#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "optimization/adaptive_optimizer.h"
#include "planning/space/space_plan.h"
#include "planning/space/space_planner_options.h"
#include "topology/signatures/h_signature.h"
#include "topology/space/moving_paths.h"
#include "world/moving/tube.h"
#include "world/obstacle_field.h"

namespace mocha {

/// What a trajectory is optimised among.
struct SpaceScene {
  const ObstacleField<3>& field;
  const Cuts<3>& cuts;
  std::vector<Tube<3>> moving;  ///< in time since the start of the trajectory
};

/// Makes a certified trajectory from rest to rest of a path in space: adaptive camouflage, MINCO,
/// penalties, time scaling, proof.
class SpaceOptimizer {
 public:
  explicit SpaceOptimizer(const SpacePlannerOptions& options) : options_(options) {}

  /// With more effort where a proof fails, a few times. `path` has at least two points; without
  /// times, it is followed as early as the limits allow.
  SpaceCandidate optimize_path(const TimedSpacePath& path, const SpaceScene& scene,
                               const std::function<bool()>& should_stop) const;

 private:
  /// What is raised from one attempt to the next.
  struct Push {
    double weight = 1.0;  ///< of obstacles and of what moves
    double spacing = 1.0;
  };

  KnotCandidates<3> candidates_on(const TimedSpacePath& path, const SpaceScene& scene,
                                  double spacing) const;
  TrajectoryObjective<3, 3>::Options objective_options(const KnotCandidates<3>& candidates,
                                                       const SpaceScene& scene,
                                                       double weight) const;
  void optimize_once(const TimedSpacePath& path, const SpaceScene& scene, const Push& push,
                     const std::function<bool()>& should_stop, SpaceCandidate& candidate) const;
  BasicViolation<3> first_violation(const PiecewisePolynomial<3, 3>& curve,
                                    const SpaceScene& scene) const;

  const SpacePlannerOptions options_;
};

}  // namespace mocha
