#pragma once

#include "planning/local/local_planner.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {

/// Draws how a plan is left and come back to: each candidate's way thin and dashed in the colour of
/// its class, the chosen detour up to the rejoin point broad and whole, and the rejoin point as a
/// red square (as in Fig. 10).
void draw_local_plan(const LocalPlan& plan, Drawing& drawing);

}  // namespace mocha
