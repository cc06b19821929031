#include "planning/local_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "planning/candidate_race.h"
#include "planning/escape_proof.h"
#include "planning/parallel.h"
#include "safety/margin_budget.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kLatest = 1.6;      // times mu, after the least time: later, a drive is none
constexpr int kEfforts = 2;          // of one optimisation
constexpr double kSlack_m = 0.01;    // over what is proved, for the optimiser to work in
constexpr double kLeastShare = 0.5;  // of mu that is left for the drive after a turn in place

/// Arrivals later than the plan's, and anchors farther along it, in shares of mu. A swerve takes a
/// little longer than the straight way; who has to wait comes much later; and what stands on the
/// anchor is passed.
struct Attempt {
  double later;
  double farther;
};
constexpr Attempt kAttempts[] = {{0.2, 0.0}, {0.6, 0.0}, {0.3, 0.6}, {1.2, 0.0}};

/// Time lost against the plan by a robot that is slower than the plan is there.
double catching_up_s(double speed, double plan_speed, double acceleration) {
  const double slower = plan_speed - std::clamp(speed, 0.0, plan_speed);
  return slower > 0.0 ? slower * slower / (2.0 * acceleration * plan_speed) : 0.0;
}

double clearance_radius_m(const RobotModel& robot) {
  double radius_m = 0.0;
  for (const auto& disc : robot.footprint.cover()) radius_m = std::max(radius_m, disc.radius_m);
  return radius_m;
}

std::vector<Vector2> places_of(const TimedPath& way) {
  std::vector<Vector2> places;
  for (const TimedPoint& point : way) places.push_back(point.position);
  return places;
}

TimedPath timed_path_of(const Motion& motion, double from_s, double until_s) {
  constexpr double kStep_s = 0.25;
  TimedPath path;
  if (motion.empty()) return path;
  for (double t = from_s; t < until_s + kStep_s; t += kStep_s)
    path.push_back({motion.position(t), t});
  return path;
}

/// Things that never rest count for good in the search for a motion, though nothing about them is
/// proved so far ahead: else it would pay to wait until they are forgotten.
std::vector<MovingThing> foreseen(std::vector<MovingThing> things) {
  for (MovingThing& thing : things) {
    if (std::isinf(thing.obstacle->rest_time())) thing.until_s = thing.obstacle->rest_time();
  }
  return things;
}

bool only_after(const Violation& violation, double time_s) {
  return !violation || violation.time_s >= time_s;
}

}  // namespace

LocalPlanner::LocalPlanner(const RobotModel& robot, const LocalRules& rules)
    : robot_(robot),
      rules_(rules),
      margin_m_(MarginBudget::of(robot).static_margin_m()),
      optimizer_(robot, rules, margin_m_),
      openings_(robot.limits, rules.smooth_start_rad, optimizer_.rest_acceleration()) {}

std::optional<LocalPlanner::Task> LocalPlanner::next_task(const LocalQuery& query,
                                                          const LocalScene& scene,
                                                          int& attempt) const {
  const MotionState start = query.committed.at(query.start_time_s);
  for (; attempt < static_cast<int>(std::size(kAttempts)); ++attempt) {
    const Attempt& tried = kAttempts[attempt];
    const auto anchor =
        rejoining_point(query.plan, query.progress_s, (1.0 + tried.farther) * rules_.mu_s);
    if (!anchor) return std::nullopt;
    const bool farther = tried.farther > 0.0;
    if (farther && anchor->plan_time_s >= query.plan.end_time()) continue;
    Task task{*anchor, anchor->drive_s, {}};
    task.earliest_s += catching_up_s(start.speed, query.plan.velocity(query.progress_s).norm(),
                                     optimizer_.rest_acceleration());
    SpaceTimeQuery ways;
    ways.start = {start.pose.position, query.start_time_s};
    ways.goal = {anchor->state.col(0),
                 query.start_time_s + task.earliest_s + tried.later * rules_.mu_s};
    ways.moving = foreseen(scene.moving);
    for (MovingThing& thing : ways.moving) thing.keep_m += kSlack_m;
    ways.driven = timed_path_of(query.driven, query.start_time_s, ways.goal.time_s);
    SpaceTimeRules rules;
    rules.max_speed = robot_.limits.max_speed;
    rules.required_clearance_m = clearance_radius_m(robot_) + margin_m_ + kSlack_m;
    rules.samples = rules_.samples;
    rules.classes = rules_.classes;
    rules.longest_ratio = rules_.longest_ratio;
    task.ways = find_space_time_ways(*scene.terrain, ways, rules);
    if (task.ways.ways.empty()) continue;
    ++attempt;
    return task;
  }
  return std::nullopt;
}

Violation LocalPlanner::certify(const Motion& motion, const LocalScene& scene,
                                double from_s) const {
  Violation first = check_limits(motion, robot_.limits, from_s);
  const auto keep_earlier = [&first](const Violation& other) {
    if (other && (!first || other.time_s < first.time_s)) first = other;
  };
  keep_earlier(check_clearance_or_leaving(motion, robot_.footprint, scene.terrain->field(),
                                          margin_m_, from_s));
  const double radius_m = robot_.footprint.circumscribed_radius_m();
  for (const MovingThing& thing : scene.moving) {
    if (thing.until_s <= from_s) continue;
    keep_earlier(check_separation_or_leaving(motion, radius_m, *thing.obstacle,
                                             thing.keep_m - radius_m, from_s, thing.until_s));
  }
  return first;
}

void LocalPlanner::drive(const LocalQuery& query, const LocalScene& scene, const Task& task,
                         const Opening& opening, LocalCandidate& candidate) const {
  DriveQuery drive;
  drive.path = opening.path;
  drive.start = opening.state;
  drive.start_time_s = query.start_time_s + opening.duration_s;
  drive.moving = foreseen(scene.moving);
  for (const TimedPoint& point : candidate.way)
    drive.times_s.push_back(point.time_s - query.start_time_s);
  const double mu_s = task.earliest_s - opening.duration_s;
  drive.anchor = Anchor{task.anchor.state, std::max(kLeastShare * task.earliest_s, mu_s)};
  Effort effort;
  for (int i = 0; i < kEfforts; ++i) {
    const auto found =
        optimizer_.optimize_drive(drive, scene.terrain->field(), effort, [] { return false; });
    if (found.curve.pieces() == 0) return;
    std::vector<Phase> phases = opening.phases;
    phases.emplace_back(DrivePhase{1, found.curve});
    candidate.terms = found.terms;
    candidate.cost = found.cost;
    candidate.rejoins_s = drive.start_time_s + found.curve.duration();
    candidate.motion = rejoined(query.start_time_s, std::move(phases), query.plan, task.anchor);
    candidate.violation = certify(candidate.motion, scene, query.start_time_s);
    const double late_s = candidate.rejoins_s - query.start_time_s - task.earliest_s;
    if (late_s > kLatest * rules_.mu_s) return;  // to brake and wait is better
    if (only_after(candidate.violation, candidate.rejoins_s)) {
      candidate.reason = PlanReason::kSolved;
      return;
    }
    effort = raised(effort, candidate.violation);
  }
}

std::vector<Opening> LocalPlanner::openings(const LocalQuery& query,
                                            std::vector<Vector2> path) const {
  const MotionState start = query.committed.at(query.start_time_s);
  if (start.at_rest) return openings_.from_rest({}, start.pose, path);
  std::vector<Opening> rolling = openings_.rolling(start, path);
  if (!rolling.empty()) return rolling;
  const std::vector<Phase> brake =
      brake_along(query.committed, query.start_time_s, optimizer_.rest_acceleration());
  const Pose stop = Motion(query.start_time_s, brake).end_pose();
  path.front() = stop.position;
  return openings_.from_rest(brake, stop, path);
}

LocalCandidate LocalPlanner::candidate(const LocalQuery& query, const LocalScene& scene,
                                       const Task& task, const SpaceTimeWay& way) const {
  LocalCandidate candidate;
  candidate.way = way.points;
  candidate.signature = way.signature;
  candidate.driven = way.driven;
  for (const Opening& opening : openings(query, places_of(way.points))) {
    try {
      drive(query, scene, task, opening, candidate);
    } catch (const std::invalid_argument&) {  // what the optimiser found is no motion
      candidate.motion = Motion();
    }
    if (candidate.reason == PlanReason::kSolved) break;
  }
  return candidate;
}

std::vector<LocalCandidate> LocalPlanner::optimised(const LocalQuery& query,
                                                    const LocalScene& scene,
                                                    const Task& task) const {
  std::vector<LocalCandidate> candidates(task.ways.ways.size());
  in_parallel(candidates.size(), rules_.threads, [&](std::size_t i) {
    candidates[i] = candidate(query, scene, task, task.ways.ways[i]);
  });
  return candidates;
}

void LocalPlanner::select(const LocalQuery& query, const LocalScene& scene, const Task& task,
                          LocalPlan& plan) const {
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
  plan.anchor = task.anchor.state.col(0);
  plan.rejoins_s = chosen.rejoins_s;
  const double drive_s = chosen.rejoins_s - query.start_time_s;
  plan.delay_s = drive_s - task.anchor.drive_s;
  plan.late = drive_s > rules_.t_epsilon_s;
  plan.beyond = certify(plan.motion, scene, chosen.rejoins_s);
  plan.switches_class = !chosen.driven;
}

LocalPlan LocalPlanner::plan(const LocalQuery& query, const LocalScene& scene) const {
  LocalPlan plan;
  plan.message = "no way through space-time back to the plan";
  int attempt = 0;
  while (auto task = next_task(query, scene, attempt)) {
    plan.candidates = optimised(query, scene, *task);
    select(query, scene, *task, plan);
    if (plan.reason == PlanReason::kSolved) break;
  }
  return plan;
}

}  // namespace mocha
