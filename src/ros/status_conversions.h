#pragma once

#include <mocha_ugv/Candidates.h>
#include <mocha_ugv/PlannerStatus.h>

#include <string>

#include "planning/plan_result.h"

namespace mocha {

mocha_ugv::PlannerStatus to_message(PlanReason reason, const Violation& violation,
                                    const std::string& text, const std::string& frame,
                                    ros::Time stamp);

mocha_ugv::Candidate to_message(const PlanCandidate& candidate, const std::string& frame,
                                ros::Time stamp);

/// The reason in a word, such as "goal occupied".
const char* to_text(PlanReason reason);

}  // namespace mocha
