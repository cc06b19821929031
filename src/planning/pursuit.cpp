#include "planning/pursuit.h"

#include <cmath>
#include <utility>

#include "planning/front_end.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kSoonest_s = 0.2;  // between two plans, whoever asks
constexpr double kSamePlace_m = 0.5;
constexpr double kSameGoal_m = 0.05;
constexpr double kAfterEnd_s = 0.5;   // a plan that ended this long ago without arrival has failed
constexpr double kRounding_s = 1e-6;  // of differences of times
constexpr double kLook_s = 0.25;      // between two looks whether it is in anybody's way
constexpr double kNear_m = 1.0;       // beside its way, somebody may come into it again
constexpr double kOnPlan_m = 0.5;     // farther off its plan, a robot drives something else
constexpr double kSampleSpeed_mps = 1.0;
constexpr double kStanding_mps = 0.03;
constexpr double kStanding_radps = 0.03;

bool at_rest(const RobotState& state) {
  return std::abs(state.twist.speed) < kStanding_mps &&
         std::abs(state.twist.yaw_rate) < kStanding_radps;
}

}  // namespace

PursuitRules PursuitRules::from(const ParameterTable& values) {
  return {values.number("planning_time"),         values.number("replan_period"),
          values.number("retry_period"),          values.number("better_by"),
          values.number("occupied_goal_timeout"), GoalRules::from(values)};
}

Pursuit::Pursuit(const PursuitRules& rules, double deceleration, RightOfWay right_of_way)
    : rules_(rules),
      deceleration_(deceleration),
      right_of_way_(std::move(right_of_way)),
      goals_(rules.goals) {}

void Pursuit::set_rules(const PursuitRules& rules, const PlannerRules& planner) {
  right_of_way_.set_rules(planner);
  rules_ = rules;
  goals_.set_rules(rules.goals);
}

void Pursuit::take(std::deque<Goal> goals, double now_s) {
  goals_.set(std::move(goals), now_s);
  parked_ = false;
  right_of_way_.set_parked(false);
  begin_goal();
}

void Pursuit::begin_goal() {
  refuge_.reset();
  right_of_way_.set_stuck(false);
  begin_way();
}

void Pursuit::begin_way() {
  plan_ = Motion();
  retreats_ = false;
  way_is_new_ = true;
  occupied_since_s_.reset();
  asking_.stop();
}

void Pursuit::follow(Motion followed) {
  if (!has_errand() || way_is_new_ || retreats_) return;
  const Vector2 end = followed.end_pose().position;
  const Vector2 there = makes_room() ? refuge_->place : goals_.current().position;
  if ((end - there).norm() < kSamePlace_m) plan_ = std::move(followed);
}

Motion Pursuit::brake(const Motion& committed, double now_s) const {
  const double from_s = committed.switch_time(now_s + rules_.planning_time_s);
  return Motion(from_s, brake_along(committed, from_s, deceleration_));
}

void Pursuit::drop() {
  goals_.clear();
  parked_ = false;
  begin_goal();
}

Motion Pursuit::stop(const Motion& committed, double now_s) {
  drop();
  if (!committed.empty()) plan_ = brake(committed, now_s);
  return plan_;
}

Pursuit::Output Pursuit::step(double now_s, const RobotState& state, const Motion& committed,
                              const Outlook& outlook) {
  Output output;
  trail_.add(state);
  if (refuge_) goals_.wait(now_s);
  output.ending = ending_of(goals_.update(now_s, state));
  if (output.ending == Ending::kNoProgress) output.plan = stop(committed, now_s);
  if (outlook.scene && !committed.empty()) make_room(now_s, state, committed, outlook, output);
  if (has_errand() && due(now_s)) plan(now_s, committed, outlook, output);
  if (has_errand() && outlook.scene) ask(now_s, state, outlook, output);
  if (asking_.take_withdrawal())
    output.request = right_of_way_.request_for({}, right_of_way_.own());
  return output;
}

Pursuit::Ending Pursuit::ending_of(GoalQueue::Event event) {
  switch (event) {
    case GoalQueue::Event::kAllReached:
      parked_ = true;
      right_of_way_.set_parked(true);
      begin_goal();
      return Ending::kReached;
    case GoalQueue::Event::kReached:
      begin_goal();
      return Ending::kNone;
    case GoalQueue::Event::kTimedOut:
      return Ending::kNoProgress;
    case GoalQueue::Event::kNone:
      break;
  }
  return Ending::kNone;
}

bool Pursuit::has_plan(double now_s) const {
  return !plan_.empty() && now_s < plan_.end_time() + kAfterEnd_s;
}

bool Pursuit::due(double now_s) const {
  const double since_s = now_s - planned_at_s_ + kRounding_s;
  if (way_is_new_) return true;
  if (makes_room() && has_plan(now_s) && !requested_ && !retreats_) return false;
  const bool retreat_ends = retreats_ && now_s > plan_.end_time() - rules_.planning_time_s;
  if (requested_ || retreat_ends) return since_s >= kSoonest_s;
  if (retreats_) return false;
  return since_s >= (has_plan(now_s) ? rules_.replan_period_s : rules_.retry_period_s);
}

PlanQuery Pursuit::query_to(const Goal& goal, const Motion& committed, double now_s) const {
  PlanQuery query;
  query.committed = committed;
  query.start_time_s = committed.switch_time(now_s + rules_.planning_time_s);
  query.goal = goal.position;
  query.goal_yaw_rad = goal.yaw_rad;
  query.trail = trail_.points();
  return query;
}

Goal Pursuit::target() const {
  return makes_room() ? Goal{refuge_->place, std::nullopt} : goals_.asked();
}

void Pursuit::plan(double now_s, const Motion& committed, const Outlook& outlook, Output& output) {
  if (!outlook.plan || committed.empty()) {
    output.report = Report();
    output.report->reason = outlook.plan ? PlanReason::kNoPose : PlanReason::kNoMap;
    output.report->message =
        outlook.plan ? "nothing is committed yet that a plan could start from" : "no map yet";
    return;
  }
  PlanQuery query = query_to(target(), committed, now_s);
  if (!way_is_new_ && !retreats_) query.driven = plan_;
  output.planned = Planned{target(), outlook.plan(query)};
  const PlanResult& result = output.planned->result;
  const bool improvement = !way_is_new_ && !requested_ && !retreats_ && has_plan(now_s);
  planned_at_s_ = now_s;
  requested_ = false;
  if (waits_for_others(result, committed, now_s, output)) return;
  if (improvement && (result.motion.empty() || !much_better(result, now_s))) return;
  output.report = Report{result.reason, result.violation, result.message};
  way_is_new_ = false;
  if (result.motion.empty()) {
    on_failure(result, committed, now_s, output);
    return;
  }
  adopt(result, output);
}

void Pursuit::adopt(const PlanResult& result, Output& output) {
  occupied_since_s_.reset();
  retreats_ = result.reason == PlanReason::kBackingOut;
  if (makes_room()) {
    output.report->message = "makes room for " + refuge_->whose.agent + ": " + result.message;
  } else {
    refuge_.reset();
    if (!retreats_) goals_.move_current(result.goal);
  }
  plan_ = result.motion;
  output.plan = plan_;
}

/// A plan to the goal that would get into the way of a higher one is not driven; where there is no
/// other, the robot waits where it is, which is in nobody's way.
bool Pursuit::waits_for_others(const PlanResult& result, const Motion& committed, double now_s,
                               Output& output) {
  if (makes_room() || result.motion.empty()) return false;
  const auto whose = right_of_way_.in_way_of(result.motion, now_s);
  if (!whose) return false;
  if (!refuge_ && has_plan(now_s)) return true;
  way_is_new_ = false;
  refuge_ = Refuge{committed.end_pose().position, *whose};
  output.report = Report();
  output.report->reason = PlanReason::kPeerConflict;
  output.report->message = "waits until " + whose->agent + " has passed";
  return true;
}

/// Quicker by far; or it leads to the goal itself, or farther, than where it was occupied before.
bool Pursuit::much_better(const PlanResult& result, double now_s) const {
  const Vector2& asked = goals_.asked().position;
  const double nearer_m = (goals_.current().position - asked).norm() - (result.goal - asked).norm();
  if (std::abs(nearer_m) > kSameGoal_m) return nearer_m > 0.0;
  const double remaining_s = plan_.end_time() - now_s;
  return result.motion.end_time() < plan_.end_time() - rules_.better_by * remaining_s;
}

void Pursuit::on_failure(const PlanResult& result, const Motion& committed, double now_s,
                         Output& output) {
  if (makes_room()) {
    refuge_->out_of_reach = true;
    plan_ = brake(committed, now_s);
    output.plan = plan_;
    return;
  }
  if (result.reason != PlanReason::kGoalOccupied) {
    occupied_since_s_.reset();
    return;
  }
  if (!occupied_since_s_) occupied_since_s_ = now_s;
  if (now_s - *occupied_since_s_ < rules_.occupied_goal_timeout_s) return;
  output.ending = Ending::kGoalOccupied;
  output.plan = stop(committed, now_s);
}

/// For whom another place is to be found: whose way it stands or drives in, or will stand in where
/// it is going to wait; or for whom it cannot get there.
std::optional<Rank> Pursuit::in_way_of(double now_s, const RobotState& state) const {
  if (makes_room() && refuge_->out_of_reach) return refuge_->whose;
  if (refuge_) return right_of_way_.in_way_of(refuge_->place, now_s);
  if (!goals_.empty() && has_plan(now_s)) return right_of_way_.in_way_of(plan_, now_s);
  return right_of_way_.in_way_of(state.pose.position, now_s);
}

void Pursuit::make_room(double now_s, const RobotState& state, const Motion& committed,
                        const Outlook& outlook, Output& output) {
  if (goals_.empty() && !parked_) return;
  const double close_m = rules_.goals.tolerance_m;
  if (refuge_) {
    refuge_->there = at_rest(state) && (state.pose.position - refuge_->place).norm() < close_m;
    if (goals_.empty() && refuge_->there) begin_goal();
  }
  if (now_s < looked_s_ + kLook_s) return;
  looked_s_ = now_s;
  if (refuge_ && !right_of_way_.yields(now_s)) begin_goal();
  const auto whose = in_way_of(now_s, state);
  if (!whose) return;
  const Motion braking = brake(committed, now_s);
  const Vector2 from = braking.end_pose().position;
  const auto place = right_of_way_.refuge(from, outlook.scene({from}), now_s);
  if (place && makes_room() && (*place - refuge_->place).norm() < close_m) {
    refuge_->out_of_reach = false;  // there is none but this: whoever stands in between is asked
    return;
  }
  begin_way();
  refuge_.reset();
  if (!place) {
    right_of_way_.set_stuck(!goals_.empty());
    return;
  }
  refuge_ = Refuge{*place, *whose};
  if ((*place - from).norm() > close_m) return;
  way_is_new_ = false;
  planned_at_s_ = now_s;
  plan_ = braking;
  output.plan = plan_;
}

/// The way of the plan that is being driven, or else that on the map.
std::vector<Vector2> Pursuit::wanted_way(double now_s, const RobotState& state,
                                         const PlanningScene& scene) const {
  const Vector2& here = state.pose.position;
  const Vector2 there = makes_room() ? refuge_->place : goals_.current().position;
  const bool on_plan = has_plan(now_s) && !retreats_ &&
                       (plan_.position(now_s) - here).norm() < kOnPlan_m &&
                       (plan_.end_pose().position - there).norm() < kSamePlace_m;
  if (!on_plan) return right_of_way_.way(here, there, scene);
  std::vector<Vector2> way = path_of(plan_, now_s, kSampleSpeed_mps);
  way.insert(way.begin(), here);
  return way;
}

void Pursuit::ask(double now_s, const RobotState& state, const Outlook& outlook, Output& output) {
  if (refuge_ && refuge_->there) {
    asking_.stop();
    return;
  }
  if (!asking_.due(now_s, at_rest(state))) return;
  const PlanningScene scene = outlook.scene({state.pose.position, target().position});
  const std::vector<Vector2> way = wanted_way(now_s, state, scene);
  const bool on_it = right_of_way_.is_near(way, scene, now_s, 0.0);
  if (!asking_.look(now_s, on_it, right_of_way_.is_near(way, scene, now_s, kNear_m))) return;
  if (way.empty()) return;
  const bool for_another = makes_room() && outranks(refuge_->whose, right_of_way_.own());
  output.request =
      right_of_way_.request_for(way, for_another ? refuge_->whose : right_of_way_.own());
}

}  // namespace mocha
