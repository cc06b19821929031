#pragma once

#include "benchmarks/replan_scene.h"
#include "benchmarks/space_time_solver.h"

namespace mocha {

/// What the robot of a scene has to solve, if it knows what the movers will really do. The first
/// half second goes on as it began, as no motion is driven before it is promised.
SpaceTimeProblem problem_of(const ReplanScene& scene);

}  // namespace mocha
