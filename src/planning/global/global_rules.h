#pragma once

#include "planning/candidates/pipeline.h"
#include "planning/candidates/planning_scene.h"
#include "planning/global/planner_options.h"
#include "safety/requirement.h"

namespace mocha {

/// The first violation of a plan on the map from a time on; no violation if it may be driven.
Violation certify_plan(const Motion& motion, const RobotModel& robot, const PlanningScene& scene,
                       double from_s);

/// How plans to the goal are made of drives: from rest or under way to rest at the goal, with a
/// turn there if a heading is asked for, certified on the map (kPlan). A robot that rests sets off
/// over ground that was seen free: where it stands, it would never see more.
class GlobalRules : public CandidateRules {
 public:
  /// All must live longer.
  GlobalRules(const RobotModel& robot, const PlannerOptions& options, const PlanQuery& query,
              const PlanningScene& scene);

  RequirementName wanted() const override { return RequirementName::kPlan; }
  EffortLadder ladder() const override;
  DriveQuery drive(const Seed& seed, const StartManeuver& start_maneuver) const override;
  bool assemble(const StartManeuver& start_maneuver, const PlanarPath& drive,
                PlanCandidate& candidate) const override;
  void certify(PlanCandidate& candidate) const override;
  bool may_be_mended(const Violation&) const override { return true; }

 private:
  const RobotModel& robot_;
  const PlannerOptions& options_;
  const PlanQuery& query_;
  const PlanningScene& scene_;
  const std::shared_ptr<const ObstacleField<2>> unseen_;  ///< where it sets off; else null
};

}  // namespace mocha
