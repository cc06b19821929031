#include "stack/goal_planning.h"

#include <utility>

namespace mocha {
namespace {

PlanningScene scene_of(const PlanQuery& query, const SceneSource& scene) {
  return scene({query.committed.at(query.start_time_s).pose.position, query.goal});
}

}  // namespace

GoalPlanning::GoalPlanning(const RobotModel& robot, const ParameterTable& values, const Rank& rank)
    : robot_(robot),
      planner_(std::make_unique<GlobalPlanner>(robot, PlannerOptions::from(values))),
      executive_(GoalExecutiveOptions::from(values), robot,
                 Yielding(rank, robot, PlannerOptions::from(values))) {}

void GoalPlanning::set_options(const ParameterTable& values) {
  planner_ = std::make_unique<GlobalPlanner>(robot_, PlannerOptions::from(values));
  executive_.set_options(GoalExecutiveOptions::from(values), PlannerOptions::from(values));
}

GoalPlanning::StopNews GoalPlanning::heed(bool stopped, int stops) {
  const bool was_reset = stopped_ && !stopped;
  stopped_ = stopped;
  if (stops != heeded_) {
    heeded_ = stops;
    executive_.drop();
    return StopNews::kStopped;
  }
  return was_reset ? StopNews::kReset : StopNews::kNone;
}

GoalExecutive::Output GoalPlanning::step(double now_s, const RobotState& measured,
                                         const Motion& committed, const SceneSource& scene) {
  PlannerInterface planner;
  if (scene) {
    planner.plan = [&](const PlanQuery& query) { return plan(query, scene); };
    planner.leads_on = [&](const PlanQuery& query, const Motion& motion) {
      return planner_->leads_on(motion, query, scene_of(query, scene));
    };
    planner.scene = scene;
  }
  return executive_.step(now_s, measured, committed, planner);
}

PlanResult GoalPlanning::plan(const PlanQuery& query, const SceneSource& scene) const {
  return planner_->plan(query, scene_of(query, scene), [] { return false; });
}

}  // namespace mocha
