#include "planning/local/local_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planning/candidates/exposure.h"
#include "planning/candidates/parallel.h"
#include "planning/candidates/path_clearance.h"
#include "planning/candidates/pipeline.h"
#include "safety/certifier.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kLittle_s = 0.5;  // a detour that loses no more is good enough

/// Arrivals later than the plan's, and rejoin points farther along it, in shares of mu. A detour
/// takes a little longer than the straight line; a robot that waits comes much later; and what
/// stands on the rejoin point is passed.
struct Attempt {
  double later;
  double farther;
};
constexpr Attempt kAttempts[] = {{0.2, 0.0}, {0.6, 0.0}, {0.3, 0.6}, {1.2, 0.0}};

SpaceTimeOptions space_time_options(const RobotModel& robot, const LocalOptions& options) {
  constexpr std::uint64_t kSeed = 1;
  return {robot.limits.max_speed, path_clearance_m(robot), kEscapeRadius_m, options.samples, kSeed,
          options.classes,        options.longest_ratio};
}

/// What is driven, up to where it is nearest to the rejoin point; empty where that is not near.
TimedPath driven_to(const RejoinPoint& rejoin_point, const LocalQuery& query) {
  constexpr double kStep_s = 0.25;
  constexpr double kNear_m = 1.0;
  TimedPath path;
  const Vector2 place = rejoin_point.place();
  const auto until_s = progress_on(query.driven, place, query.start_time_s, kNear_m);
  if (!until_s) return path;
  for (double t = query.start_time_s; t < *until_s; t += kStep_s)
    path.push_back({query.driven.position(t), t});
  path.push_back({place, std::max(*until_s, query.start_time_s + kStep_s)});
  return path;
}

/// Whether `other` gains as much as a change of class has to. Their rejoin points may differ, and
/// so their costs may not be compared, but the time that they lose.
bool is_worth_a_switch(const LocalPlan& other, const LocalPlan& kept, const LocalOptions& options) {
  const auto loss = [&options](const LocalPlan& plan) {
    return options.weight_delay * std::pow(std::max(0.0, plan.delay_s), 3);
  };
  const double kept_loss = loss(kept);
  return loss(other) <
         std::min((1.0 - options.switch_margin) * kept_loss, kept_loss - options.switch_gain);
}

/// Whether a later attempt is to be preferred to an earlier one.
bool is_better(const LocalPlan& later, const LocalPlan& earlier, const LocalOptions& options) {
  // A driven path is not given up only because it keeps from what is likely, and another from more.
  const bool good = std::max(later.met, earlier.met) <= RequirementName::kDetourLikely;
  if (good && later.switches_class != earlier.switches_class) {
    return later.switches_class ? is_worth_a_switch(later, earlier, options)
                                : !is_worth_a_switch(earlier, later, options);
  }
  if (later.met != earlier.met) return later.met < earlier.met;
  if (later.met == RequirementName::kNone)
    return earlier.candidates.empty() && !later.candidates.empty();
  return later.delay_s < earlier.delay_s - kSoonerArrival_s;
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

LocalPlanner::LocalPlanner(const RobotModel& robot, const LocalOptions& options, Watch watch)
    : watch_(std::move(watch)),
      requirements_(robot),
      footprint_(robot.footprint),
      options_(options),
      space_time_options_(space_time_options(robot, options)),
      optimizer_(robot, options, MarginBudget::of(robot).static_margin()) {}

double LocalPlanner::rejoin_ahead_s(const LocalQuery& query) const {
  return std::max(options_.mu_s, query.rejoin_point_s - query.progress_s);
}

std::vector<LocalPlanner::Task> LocalPlanner::tasks(const LocalQuery& query,
                                                    const LocalScene& scene) const {
  const MotionState start = query.committed.at(query.start_time_s);
  std::vector<Task> tasks;
  for (const Attempt& tried : kAttempts) {
    const auto rejoin_point = find_rejoin_point(
        query.plan, query.progress_s, rejoin_ahead_s(query) + tried.farther * options_.mu_s);
    if (!rejoin_point) break;
    if (tried.farther > 0.0 && rejoin_point->plan_time_s >= query.plan.end_time()) continue;
    Return back = return_to(*rejoin_point, query, limits_of(query));
    SpaceTimeQuery paths;
    paths.start = {start.pose.position, query.start_time_s};
    paths.goal = {rejoin_point->place(),
                  query.start_time_s + back.earliest_s + tried.later * options_.mu_s};
    paths.moving = foreseen(moving(query, scene));
    for (MovingThing& thing : paths.moving) thing.keep_m += kPathSlack_m;
    paths.driven = driven_to(*rejoin_point, query);
    tasks.push_back({std::move(back), std::move(paths)});
  }
  return tasks;
}

std::vector<MovingThing> LocalPlanner::moving(const LocalQuery& query,
                                              const LocalScene& scene) const {
  return kept_apart(scene, requirements_[query.wanted].from(query.start_time_s));
}

Cuts<2> LocalPlanner::cuts_for(const std::vector<Task>& tasks, const LocalScene& scene) const {
  Eigen::AlignedBox2d reach;
  for (const Task& task : tasks) reach.extend(reach_of(task.paths, space_time_options_.max_speed));
  return cuts_within(*scene.static_map, reach, tasks.front().paths.start.position,
                     space_time_options_);
}

void LocalPlanner::finish(const LocalQuery& query, const LocalScene& scene, const Return& back,
                          LocalPlan& plan) const {
  const PlanCandidate* chosen = select({options_.switch_margin, options_.switch_gain}, plan);
  if (!chosen) return;
  plan.met = chosen->met;
  plan.rejoins_s = chosen->drive_ends_s;
  plan.delay_s = plan.rejoins_s - query.start_time_s - back.rejoin_point.drive_s;
  // Against a rejoin point that is farther, it takes longer in any case.
  plan.late = plan.delay_s > options_.t_epsilon_s - options_.mu_s;
  plan.beyond =
      certify(plan.motion, footprint_, scene, requirements_[query.wanted].from(plan.rejoins_s));
  plan.switches_class = !chosen->driven;
}

LocalPlan LocalPlanner::along(std::vector<SpaceTimePath> paths, const LocalQuery& query,
                              const LocalScene& scene, const Return& back) const {
  LocalPlan plan;
  plan.message = "no path through space-time back to the plan";
  plan.rejoin_point = back.rejoin_point;
  plan.paths = std::move(paths);
  if (plan.paths.empty()) return plan;
  watch_(LocalStage::kOptimisation);
  std::vector<Seed> seeds;
  for (const SpaceTimePath& path : plan.paths)
    seeds.push_back(seed_of(path, query, limits_of(query), options_.smooth_start_rad));
  const LocalRules rules(requirements_, footprint_, options_, query, scene, back);
  const CandidatePipeline pipeline(optimizer_, scene.static_map->field(), rules);
  plan.candidates = pipeline.race(seeds, {options_.switch_margin, options_.switch_gain},
                                  options_.threads, [] { return false; });
  finish(query, scene, back, plan);
  watch_(LocalStage::kDone);
  return plan;
}

LocalPlan LocalPlanner::attempt(const LocalQuery& query, const LocalScene& scene, const Task& task,
                                const Cuts<2>& cuts) const {
  watch_(LocalStage::kFrontEnd);
  auto found = find_space_time_paths(*scene.static_map, cuts, task.paths, space_time_options_);
  watch_(LocalStage::kDone);
  return along(std::move(found.paths), query, scene, task.back);
}

LocalPlan LocalPlanner::keep_on(const LocalQuery& query, const LocalScene& scene) const {
  const auto rejoin_point = find_rejoin_point(query.plan, query.progress_s, rejoin_ahead_s(query));
  if (query.driven.empty() || !rejoin_point) return {};
  SpaceTimePath path;
  path.points = driven_to(*rejoin_point, query);
  path.driven = true;
  if (path.points.empty()) return {};
  return along({path}, query, scene, return_to(*rejoin_point, query, limits_of(query)));
}

LocalPlan LocalPlanner::again(const LocalQuery& query, const LocalScene& scene,
                              const LocalPlan& failed) const {
  return along(failed.paths, query, scene, return_to(failed.rejoin_point, query, limits_of(query)));
}

LocalPlan LocalPlanner::search(const LocalQuery& query, const LocalScene& scene) const {
  LocalPlan kept = keep_on(query, scene);
  const bool is_kept = kept.met == query.wanted;
  // Costs are not negative: nothing could be cheaper by enough.
  if (is_kept && kept.candidates.front().cost < options_.switch_gain) return kept;
  LocalPlan other = anew(query, scene);
  return is_better(other, kept, options_) ? other : kept;
}

LocalPlan LocalPlanner::anew(const LocalQuery& query, const LocalScene& scene) const {
  const std::vector<Task> tasks = this->tasks(query, scene);
  std::vector<LocalPlan> plans(std::max<std::size_t>(1, tasks.size()));
  if (tasks.empty()) return plans.front();
  const Cuts<2> cuts = cuts_for(tasks, scene);
  // The first one is mostly good enough. Where it is not, it is urgent.
  plans[0] = attempt(query, scene, tasks[0], cuts);
  if (plans[0].met == query.wanted && plans[0].delay_s < kLittle_s) return plans[0];
  in_parallel(tasks.size() - 1, options_.threads,
              [&](std::size_t i) { plans[i + 1] = attempt(query, scene, tasks[i + 1], cuts); });
  const LocalPlan* best = &plans[0];
  for (const LocalPlan& plan : plans) {
    if (is_better(plan, *best, options_)) best = &plan;
  }
  return *best;
}

LocalPlan LocalPlanner::plan(const LocalQuery& query, const LocalScene& scene) const {
  const MotionState start = query.committed.at(query.start_time_s);
  const bool alike = scene.likely.empty();
  LocalQuery wanted = query;
  wanted.wanted = RequirementName::kDetour;
  LocalPlan confident;
  // A robot that is too near already cannot keep the distance that is asked for.
  if (alike || !begins_inside(moving(wanted, scene), {start.pose.position, query.start_time_s}))
    confident = search(wanted, scene);
  if (alike || confident.met <= RequirementName::kDetourLikely) return confident;
  wanted.wanted = RequirementName::kDetourLikely;
  LocalPlan likely = search(wanted, scene);
  const bool better = likely.met < confident.met || confident.candidates.empty();
  return better ? likely : confident;
}

}  // namespace mocha
