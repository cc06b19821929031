#include "benchmarks/replan_problem.h"

namespace mocha {

SpaceTimeProblem problem_of(const ReplanScene& scene) {
  SpaceTimeProblem problem;
  problem.ground = {scene.low, scene.high, scene.obstacles};
  for (const SceneMover& mover : scene.movers) {
    problem.movers.push_back([mover](double time_s) {
      return std::optional<Circle>({truth(mover, time_s).centre, mover.radius_m});
    });
  }
  problem.robot_radius_m = ReplanScene::kRobotRadius_m;
  problem.start_speed = scene.start_speed;
  problem.reaction_s = 0.5;
  problem.goal = scene.goal;
  return problem;
}

}  // namespace mocha
