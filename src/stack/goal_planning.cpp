#include "stack/goal_planning.h"

#include <sstream>
#include <utility>

namespace mocha {
namespace {

PlanningScene scene_of(const PlanQuery& query, const SceneSource& scene) {
  return scene({query.committed.at(query.start_time_s).pose.position, query.goal});
}

std::string no_progress_for(double time_s) {
  std::ostringstream text;
  text << "no progress for " << time_s << " s: ";
  return text.str();
}

}  // namespace

GoalPlanning::GoalPlanning(const RobotModel& robot, const ParameterTable& values,
                           const std::string& name, int priority, double handover_s,
                           PlanRunner& runner, std::string map_name)
    : robot_(robot),
      handover_s_(handover_s),
      map_name_(std::move(map_name)),
      runner_(runner),
      planner_(std::make_shared<GlobalPlanner>(robot, PlannerOptions::from(values))),
      executive_(GoalExecutiveOptions::from(values, handover_s), robot,
                 PassingPolicy(name, priority, robot, PlannerOptions::from(values))),
      planning_time_s_(values.number("planning_time")),
      goal_timeout_s_(GoalOptions::from(values).timeout_s) {}

void GoalPlanning::set_options(const ParameterTable& values) {
  planner_ = std::make_shared<GlobalPlanner>(robot_, PlannerOptions::from(values));
  executive_.set_options(GoalExecutiveOptions::from(values, handover_s_),
                         PlannerOptions::from(values));
  goal_timeout_s_ = GoalOptions::from(values).timeout_s;
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
  planner.answer = [&] { return runner_.answer(); };
  planner.scene = scene;
  if (scene) {
    planner.ask = [&](const PlanQuery& query) {
      runner_.begin(work_on(query, scene), query.time_limit_s);
    };
  }
  const bool has_plan = !executive_.plan().empty();
  GoalExecutive::Output output = executive_.step(now_s, measured, committed, planner);
  if (output.report && output.report->reason == PlanReason::kNoMap && !scene)
    output.report->message = "no map on " + map_name_ + " yet: does perception run?";
  if (output.planned) cause_.hear_planning_time(output.planned->result.took_s, planning_time_s_);
  if (output.report) cause_.hear_planner(*output.report);
  explain(has_plan, now_s, output);
  return output;
}

GoalExecutive::Output GoalPlanning::wait_for_pose(double now_s, const std::string& missing) {
  GoalExecutive::Output output;
  if (executive_.idle()) return output;
  output = executive_.wait_for_pose(now_s);
  const bool gives_up = output.ending != GoalExecutive::Ending::kNone;
  output.report.emplace();
  output.report->reason = PlanReason::kNoPose;
  output.report->message = (gives_up ? no_progress_for(goal_timeout_s_) : "") + missing;
  return output;
}

GoalExecutive::Report GoalPlanning::cause(bool has_plan, double now_s) const {
  if (executive_.state() == ExecutiveState::kPaused)
    return {PlanReason::kPaused, {}, "stays where it is until it is resumed"};
  return cause_.cause(has_plan, now_s);
}

void GoalPlanning::explain(bool has_plan, double now_s, GoalExecutive::Output& output) {
  using Ending = GoalExecutive::Ending;
  const bool gives_up = output.ending != Ending::kNone && output.ending != Ending::kReached;
  if (executive_.idle() && !gives_up && executive_.state() != ExecutiveState::kPaused) return;
  GoalExecutive::Report report = cause(has_plan, now_s);
  if (output.ending == Ending::kNoProgress) {
    const bool solved = report.reason == PlanReason::kSolved;
    report.message = no_progress_for(goal_timeout_s_) +
                     (solved ? "it has a plan, and neither planner objects to it" : report.message);
  }
  const bool news = report.reason != said_.reason || report.message != said_.message;
  if (output.report || news) output.report = report;
  said_ = std::move(report);
}

PlanRunner::Work GoalPlanning::work_on(const PlanQuery& query, const SceneSource& scene) const {
  return [planner = planner_, query, scene](const std::function<bool()>& should_stop) {
    PlanQuery bounded = query;
    bounded.should_stop = [&] { return query.should_stop() || should_stop(); };
    return planner->plan(bounded, scene_of(query, scene));
  };
}

}  // namespace mocha
