#pragma once

#include "planning/candidates/local_scene.h"
#include "planning/candidates/pipeline.h"
#include "planning/local/local_options.h"
#include "planning/local/local_plan.h"

namespace mocha {

/// Where on the plan a local drive is to end, and about how soon at the earliest.
struct Return {
  RejoinPoint rejoin_point;
  double earliest_s;  ///< after the start of the drive
};

/// Back at the rejoin point, at about the least time within the limits.
Return return_to(const RejoinPoint& rejoin_point, const LocalQuery& query,
                 const MotionLimits& limits);

/// The path as a seed: at once, or after braking and turning.
Seed seed_of(const SpaceTimePath& path, const LocalQuery& query, const MotionLimits& limits,
             double smooth_start_rad);

/// How local plans are made of drives: out of the motion in force, past what moves in the time of
/// the path, and back into the plan, paper (38); certified up to there.
class LocalRules : public CandidateRules {
 public:
  /// All must live longer.
  LocalRules(const Requirements& requirements, const Footprint& footprint,
             const LocalOptions& options, const LocalQuery& query, const LocalScene& scene,
             const Return& back)
      : requirements_(requirements),
        footprint_(footprint),
        options_(options),
        query_(query),
        scene_(scene),
        back_(back) {}

  RequirementName wanted() const override { return query_.wanted; }
  EffortLadder ladder() const override;
  DriveQuery drive(const Seed& seed, const StartManeuver& start_maneuver) const override;
  bool assemble(const StartManeuver& start_maneuver, const PlanarPath& drive,
                PlanCandidate& candidate) const override;
  void certify(PlanCandidate& candidate) const override;
  bool may_be_mended(const Violation& violation) const override;

 private:
  const Requirements& requirements_;
  const Footprint& footprint_;
  const LocalOptions& options_;
  const LocalQuery& query_;
  const LocalScene& scene_;
  const Return& back_;
};

}  // namespace mocha
