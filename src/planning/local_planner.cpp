#include "planning/local_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planning/candidate_race.h"
#include "planning/conflict.h"
#include "planning/parallel.h"
#include "safety/margin_budget.h"

namespace mocha {
namespace {

constexpr double kSooner_s = 0.2;  // by less, a farther anchor or a later arrival is not better
constexpr double kLittle_s = 0.5;  // who loses no more need not look for better
constexpr double kSlack_m = 0.01;  // over what is proved, for the optimiser to work in

/// Arrivals later than the plan's, and anchors farther along it, in shares of mu. A swerve takes a
/// little longer than the straight way; who has to wait comes much later; and what stands on the
/// anchor is passed.
struct Attempt {
  double later;
  double farther;
};
constexpr Attempt kAttempts[] = {{0.2, 0.0}, {0.6, 0.0}, {0.3, 0.6}, {1.2, 0.0}};

double clearance_radius_m(const RobotModel& robot) {
  double radius_m = 0.0;
  for (const auto& disc : robot.footprint.cover()) radius_m = std::max(radius_m, disc.radius_m);
  return radius_m;
}

SpaceTimeRules space_time_rules(const RobotModel& robot, const LocalRules& rules) {
  SpaceTimeRules space_time;
  space_time.max_speed = robot.limits.max_speed;
  space_time.required_clearance_m =
      clearance_radius_m(robot) + MarginBudget::of(robot).static_margin_m() + kSlack_m;
  space_time.samples = rules.samples;
  space_time.classes = rules.classes;
  space_time.longest_ratio = rules.longest_ratio;
  return space_time;
}

/// What is driven, up to where it is nearest to the anchor; empty where that is not near.
TimedPath driven_to(const RejoiningPoint& anchor, const LocalQuery& query) {
  constexpr double kStep_s = 0.25;
  constexpr double kNear_m = 1.0;
  TimedPath path;
  const Vector2 place = anchor.place();
  const auto until_s = progress_on(query.driven, place, query.start_time_s, kNear_m);
  if (!until_s) return path;
  for (double t = query.start_time_s; t < *until_s; t += kStep_s)
    path.push_back({query.driven.position(t), t});
  path.push_back({place, std::max(*until_s, query.start_time_s + kStep_s)});
  return path;
}

/// Whether `other` gains as much as a change of class has to. Their anchors may differ, and so
/// their costs may not be compared, but the time that they lose.
bool is_worth_a_switch(const LocalPlan& other, const LocalPlan& kept, const LocalRules& rules) {
  const auto loss = [&rules](const LocalPlan& plan) {
    return rules.weight_duration * std::pow(std::max(0.0, plan.delay_s), 3);
  };
  const double kept_loss = loss(kept);
  return loss(other) <
         std::min((1.0 - rules.switch_margin) * kept_loss, kept_loss - rules.switch_gain);
}

/// Whether a later attempt is to be preferred to an earlier one.
bool is_better(const LocalPlan& later, const LocalPlan& earlier, const LocalRules& rules) {
  // A driven way is not given up only because it keeps from what is likely, and another from more.
  const bool good = std::max(later.proof, earlier.proof) <= LocalProof::kLikely;
  if (good && later.switches_class != earlier.switches_class) {
    return later.switches_class ? is_worth_a_switch(later, earlier, rules)
                                : !is_worth_a_switch(earlier, later, rules);
  }
  if (later.proof != earlier.proof) return later.proof < earlier.proof;
  if (later.proof == LocalProof::kNone)
    return earlier.candidates.empty() && !later.candidates.empty();
  return later.delay_s < earlier.delay_s - kSooner_s;
}

/// Of what begins at that place and time.
bool begins_inside(const std::vector<MovingThing>& things, const TimedPoint& start) {
  return std::any_of(things.begin(), things.end(), [&start](const MovingThing& thing) {
    const MovingObstacle::Disc disc = thing.obstacle->at(start.time_s);
    return thing.until_s > start.time_s &&
           (disc.centre - start.position).norm() < thing.keep_m + disc.radius_m;
  });
}

}  // namespace

LocalPlanner::LocalPlanner(const RobotModel& robot, const LocalRules& rules, Watch watch)
    : watch_(std::move(watch)),
      max_speed_(robot.limits.max_speed),
      rules_(rules),
      space_time_rules_(space_time_rules(robot, rules)),
      optimizer_(robot, rules) {}

double LocalPlanner::anchor_ahead_s(const LocalQuery& query) const {
  return std::max(rules_.mu_s, query.anchor_s - query.progress_s);
}

std::vector<LocalPlanner::Task> LocalPlanner::tasks(const LocalQuery& query,
                                                    const LocalScene& scene) const {
  const MotionState start = query.committed.at(query.start_time_s);
  std::vector<Task> tasks;
  for (const Attempt& tried : kAttempts) {
    const auto anchor = rejoining_point(query.plan, query.progress_s,
                                        anchor_ahead_s(query) + tried.farther * rules_.mu_s);
    if (!anchor) break;
    if (tried.farther > 0.0 && anchor->plan_time_s >= query.plan.end_time()) continue;
    Return back = optimizer_.return_to(*anchor, query);
    SpaceTimeQuery ways;
    ways.start = {start.pose.position, query.start_time_s};
    ways.goal = {anchor->place(), query.start_time_s + back.earliest_s + tried.later * rules_.mu_s};
    ways.moving = foreseen(scene.moving);
    for (MovingThing& thing : ways.moving) thing.keep_m += kSlack_m;
    ways.driven = driven_to(*anchor, query);
    tasks.push_back({std::move(back), std::move(ways)});
  }
  return tasks;
}

Cuts<2> LocalPlanner::cuts_for(const std::vector<Task>& tasks, const LocalScene& scene) const {
  Eigen::AlignedBox2d reach;
  for (const Task& task : tasks) reach.extend(reach_of(task.ways, max_speed_));
  return cuts_within(*scene.terrain, reach, tasks.front().ways.start.position, space_time_rules_);
}

void LocalPlanner::select(const LocalQuery& query, const LocalScene& scene, const Return& back,
                          LocalPlan& plan) const {
  for (const LocalCandidate& each : plan.candidates) plan.proof = std::min(plan.proof, each.proof);
  for (LocalCandidate& each : plan.candidates) {
    const bool good = each.proof == plan.proof && plan.proof != LocalProof::kNone;
    each.reason = good ? PlanReason::kSolved : PlanReason::kNotCertified;
  }
  const int best = winner(plan.candidates, rules_.switch_margin, rules_.switch_gain);
  if (best < 0) {
    const LocalCandidate& first = plan.candidates.front();
    plan.reason = first.reason;
    plan.violation = first.violation;
    plan.message =
        first.motion.empty() ? "the optimisation found no motion" : describe(first.violation);
    return;
  }
  LocalCandidate& chosen = plan.candidates[best];
  chosen.selected = true;
  plan.reason = PlanReason::kSolved;
  plan.message = "solved";
  plan.violation = {};
  plan.motion = chosen.motion;
  plan.rejoins_s = chosen.rejoins_s;
  const double drive_s = chosen.rejoins_s - query.start_time_s;
  plan.delay_s = drive_s - back.anchor.drive_s;
  // Against an anchor that is farther, it takes longer in any case.
  plan.late = drive_s - back.anchor.drive_s > rules_.t_epsilon_s - rules_.mu_s;
  plan.beyond = optimizer_.violation_of(plan.motion, scene, chosen.rejoins_s);
  plan.switches_class = !chosen.driven;
}

LocalPlan LocalPlanner::along(const std::vector<SpaceTimeWay>& ways, const LocalQuery& query,
                              const LocalScene& scene, const Return& back) const {
  LocalPlan plan;
  plan.message = "no way through space-time back to the plan";
  plan.anchor = back.anchor;
  if (ways.empty()) return plan;
  watch_(LocalStage::kOptimisation);
  plan.candidates.resize(ways.size());
  in_parallel(ways.size(), rules_.threads, [&](std::size_t i) {
    plan.candidates[i] = optimizer_.optimize(query, scene, back, ways[i]);
  });
  select(query, scene, back, plan);
  watch_(LocalStage::kDone);
  return plan;
}

LocalPlan LocalPlanner::attempt(const LocalQuery& query, const LocalScene& scene, const Task& task,
                                const Cuts<2>& cuts) const {
  watch_(LocalStage::kFrontEnd);
  const auto found = find_space_time_ways(*scene.terrain, cuts, task.ways, space_time_rules_);
  watch_(LocalStage::kDone);
  return along(found.ways, query, scene, task.back);
}

LocalPlan LocalPlanner::keep_on(const LocalQuery& query, const LocalScene& scene) const {
  const auto anchor = rejoining_point(query.plan, query.progress_s, anchor_ahead_s(query));
  if (query.driven.empty() || !anchor) return {};
  SpaceTimeWay way;
  way.points = driven_to(*anchor, query);
  way.driven = true;
  if (way.points.empty()) return {};
  return along({way}, query, scene, optimizer_.return_to(*anchor, query));
}

LocalPlan LocalPlanner::again(const LocalQuery& query, const LocalScene& scene,
                              const LocalPlan& failed) const {
  std::vector<SpaceTimeWay> ways;
  for (const LocalCandidate& each : failed.candidates)
    ways.push_back({each.way, 0.0, each.signature, each.driven});
  return along(ways, query, scene, optimizer_.return_to(failed.anchor, query));
}

LocalPlan LocalPlanner::search(const LocalQuery& query, const LocalScene& scene) const {
  LocalPlan kept = keep_on(query, scene);
  const bool is_kept = kept.proof == LocalProof::kAsked;
  // Costs are not negative: nothing could be cheaper by enough.
  if (is_kept && kept.candidates.front().cost < rules_.switch_gain) return kept;
  LocalPlan other = anew(query, scene);
  return is_better(other, kept, rules_) ? other : kept;
}

LocalPlan LocalPlanner::anew(const LocalQuery& query, const LocalScene& scene) const {
  const std::vector<Task> tasks = this->tasks(query, scene);
  std::vector<LocalPlan> plans(std::max<std::size_t>(1, tasks.size()));
  if (tasks.empty()) return plans.front();
  const Cuts<2> cuts = cuts_for(tasks, scene);
  // The first one is mostly good enough. Where it is not, it is urgent.
  plans[0] = attempt(query, scene, tasks[0], cuts);
  if (plans[0].proof == LocalProof::kAsked && plans[0].delay_s < kLittle_s) return plans[0];
  in_parallel(tasks.size() - 1, rules_.threads,
              [&](std::size_t i) { plans[i + 1] = attempt(query, scene, tasks[i + 1], cuts); });
  const LocalPlan* best = &plans[0];
  for (const LocalPlan& plan : plans) {
    if (is_better(plan, *best, rules_)) best = &plan;
  }
  return *best;
}

LocalPlan LocalPlanner::plan(const LocalQuery& query, const LocalScene& scene) const {
  const MotionState start = query.committed.at(query.start_time_s);
  const bool alike = scene.expected.empty();
  LocalPlan asked;
  // Who is too near already cannot keep the distance that is asked for.
  if (alike || !begins_inside(scene.moving, {start.pose.position, query.start_time_s}))
    asked = search(query, scene);
  if (alike || asked.proof <= LocalProof::kLikely) return asked;
  LocalPlan likely = search(query, {scene.terrain, scene.expected, {}});
  if (likely.proof == LocalProof::kAsked) likely.proof = LocalProof::kLikely;
  const bool better = likely.proof < asked.proof || asked.candidates.empty();
  return better ? likely : asked;
}

}  // namespace mocha
