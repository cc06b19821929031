#pragma once

#include <string>
#include <vector>

#include "planning/candidates/plan_result.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {

/// Draws every candidate in a colour of its own with its cost (as in Fig. 14), each label where its
/// line is farthest from the others. The selected one is broad; what is not certified is dashed and
/// says why; what was given up because it cannot win shows what it costs at least (> 12.3).
void draw_candidates(const std::string& name, const std::vector<PlanCandidate>& candidates,
                     Drawing& drawing);

/// Where a candidate leads [m]: along its motion, or along its way on the map where there is no
/// motion. Evenly spaced, for drawing.
std::vector<Vector2> drawn_path(const PlanCandidate& candidate);

}  // namespace mocha
