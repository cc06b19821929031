#include "benchmarks/bitstar.h"

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <memory>

namespace mocha {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

Eigen::Vector2d position(const ob::State* state) {
  const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1]};
}

ob::SpaceInformationPtr information_of(const PathTask& task) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);
  for (int axis = 0; axis < 2; ++axis) {
    bounds.setLow(axis, task.bounds.min()[axis]);
    bounds.setHigh(axis, task.bounds.max()[axis]);
  }
  space->setBounds(bounds);
  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([&task](const ob::State* state) {
    const Eigen::Vector2d p = position(state);
    return task.obstacles.clear({p, p}, task.clearance_m);
  });
  information->setStateValidityCheckingResolution(task.resolution_m / space->getMaximumExtent());
  information->setup();
  return information;
}

}  // namespace

void set_up_ompl() {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(1);
}

std::vector<Eigen::Vector2d> path_by_bitstar(const PathTask& task, std::optional<double> budget_s,
                                             double patience_s) {
  const ob::SpaceInformationPtr information = information_of(task);
  const auto problem = std::make_shared<ob::ProblemDefinition>(information);
  ob::ScopedState<ob::RealVectorStateSpace> start(information);
  ob::ScopedState<ob::RealVectorStateSpace> goal(information);
  for (int i = 0; i < 2; ++i) {
    start[i] = task.start[i];
    goal[i] = task.goal[i];
  }
  problem->setStartAndGoalStates(start, goal);
  const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(information);
  if (!budget_s) objective->setCostThreshold(objective->infiniteCost());
  problem->setOptimizationObjective(objective);
  og::BITstar planner(information);
  planner.setProblemDefinition(problem);
  const auto end = ob::timedPlannerTerminationCondition(budget_s.value_or(patience_s));
  if (planner.solve(end) != ob::PlannerStatus::EXACT_SOLUTION) return {};
  auto& path = *problem->getSolutionPath()->as<og::PathGeometric>();
  og::PathSimplifier(information, problem->getGoal()).simplifyMax(path);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < path.getStateCount(); ++i)
    points.push_back(position(path.getState(i)));
  return points;
}

}  // namespace mocha
