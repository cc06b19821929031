#pragma once

#include <mocha_ugv/Candidates.h>
#include <mocha_ugv/PlannerStatus.h>
#include <mocha_ugv/ReplannerStatus.h>

#include <string>
#include <vector>

#include "planning/executive/goal_executive.h"
#include "planning/replanner/ladder.h"
#include "stack/planning_effort.h"

namespace mocha {

mocha_ugv::PlannerStatus to_message(PlanReason reason, const Violation& violation,
                                    const std::string& text, const std::string& frame,
                                    ros::Time stamp);

/// Throws std::invalid_argument for a reason or a term that there is not.
GoalExecutive::Report from_message(const mocha_ugv::PlannerStatus& status);

/// What a step of the local replanner came to.
mocha_ugv::ReplannerStatus to_message(Row row, const mocha_ugv::PlannerStatus& status);

std::vector<mocha_ugv::CostTerm> cost_terms_message(const CostTerms& terms);

mocha_ugv::Candidate to_message(const PlanCandidate& candidate, const std::string& frame,
                                ros::Time stamp);

/// Counts no plans where it is of a candidate.
mocha_ugv::Fallback to_message(FallbackKind kind, const FallbackCount& count);

mocha_ugv::PlanningEffort to_message(const PlanningRecord& record);

/// "camouflage", "waypoints", or "nothing".
const char* to_text(Parameterisation parameterisation);

}  // namespace mocha
