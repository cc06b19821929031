#pragma once

#include "planning/local_planner.h"
#include "ros/markers.h"

namespace mocha {

/// Draws how a plan is left and come back to: each candidate's way thin and dashed in the colour of
/// its class, the chosen swerve up to the anchor broad and whole, and the anchor as a red square
/// (as in Fig. 10).
void draw_local_plan(const LocalPlan& plan, Drawing& drawing);

}  // namespace mocha
