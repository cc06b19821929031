#include "planning/local_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "planning/candidate_race.h"
#include "planning/escape_proof.h"
#include "planning/parallel.h"
#include "planning/way_out.h"
#include "safety/margin_budget.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kSooner_s = 0.2;    // by less, a farther anchor or a later arrival is not better
constexpr double kLatest = 1.6;      // times mu, after the least time: later, a drive is none
constexpr double kHeavier = 8.0;     // what is violated, in the second effort
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

std::vector<Vector2> places_of(const TimedPath& way) {
  std::vector<Vector2> places;
  for (const TimedPoint& point : way) places.push_back(point.position);
  return places;
}

/// What is driven, up to where it is nearest to the anchor; empty where that is not near.
TimedPath driven_to(const RejoiningPoint& anchor, const LocalQuery& query) {
  constexpr double kStep_s = 0.25;
  constexpr double kNear_m = 1.0;
  TimedPath path;
  const Vector2 place = anchor.state.col(0);
  const auto until_s = progress_on(query.driven, place, query.start_time_s, kNear_m);
  if (!until_s) return path;
  for (double t = query.start_time_s; t < *until_s; t += kStep_s)
    path.push_back({query.driven.position(t), t});
  path.push_back({place, std::max(*until_s, query.start_time_s + kStep_s)});
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

const Violation& earlier(const Violation& a, const Violation& b) {
  return !b || (a && a.time_s <= b.time_s) ? a : b;
}

const std::vector<MovingThing>& likely(const LocalScene& scene) {
  return scene.expected.empty() ? scene.moving : scene.expected;
}

/// Whether heavier penalties may mend it: of 200 scenes' optimisations, none that missed by more
/// came out right.
bool is_nearly_kept(const Violation& violation) {
  constexpr double kLack_m = 0.2;
  constexpr double kExcess = 1.1;
  switch (violation.term) {
    case ViolatedTerm::kSeparation:
      return violation.limit - violation.value < kLack_m;
    case ViolatedTerm::kSpeed:
    case ViolatedTerm::kAcceleration:
      return violation.value < kExcess * violation.limit;
    default:
      return true;
  }
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
      robot_(robot),
      emergency_limits_(WayOut::hardened(robot).limits),
      rules_(rules),
      space_time_rules_(space_time_rules(robot, rules)),
      margin_m_(MarginBudget::of(robot).static_margin_m()),
      optimizer_(robot, rules, margin_m_),
      openings_(robot.limits, rules.smooth_start_rad, optimizer_.rest_acceleration()) {}

double LocalPlanner::earliest_s(const LocalQuery& query, const RejoiningPoint& anchor) const {
  const double speed = query.committed.at(query.start_time_s).speed;
  const double plan_speed = query.plan.velocity(query.progress_s).norm();
  return anchor.drive_s + catching_up_s(speed, plan_speed, optimizer_.rest_acceleration());
}

std::vector<LocalPlanner::Task> LocalPlanner::tasks(const LocalQuery& query,
                                                    const LocalScene& scene) const {
  const MotionState start = query.committed.at(query.start_time_s);
  std::vector<Task> tasks;
  for (const Attempt& tried : kAttempts) {
    const auto anchor =
        rejoining_point(query.plan, query.progress_s, (1.0 + tried.farther) * rules_.mu_s);
    if (!anchor) break;
    if (tried.farther > 0.0 && anchor->plan_time_s >= query.plan.end_time()) continue;
    const double earliest_s = this->earliest_s(query, *anchor);
    SpaceTimeQuery ways;
    ways.start = {start.pose.position, query.start_time_s};
    ways.goal = {anchor->state.col(0), query.start_time_s + earliest_s + tried.later * rules_.mu_s};
    ways.moving = foreseen(scene.moving);
    for (MovingThing& thing : ways.moving) thing.keep_m += kSlack_m;
    ways.driven = driven_to(*anchor, query);
    tasks.push_back({*anchor, earliest_s, std::move(ways)});
  }
  return tasks;
}

Cuts<2> LocalPlanner::cuts_for(const std::vector<Task>& tasks, const LocalScene& scene) const {
  Eigen::AlignedBox2d reach;
  for (const Task& task : tasks) reach.extend(reach_of(task.ways, robot_.limits.max_speed));
  return cuts_within(*scene.terrain, reach, tasks.front().ways.start.position, space_time_rules_);
}

Violation LocalPlanner::certify(const Motion& motion, const std::vector<MovingThing>& moving,
                                double from_s) const {
  Violation first;
  const double radius_m = robot_.footprint.circumscribed_radius_m();
  for (const MovingThing& thing : moving) {
    if (thing.until_s <= from_s) continue;
    first =
        earlier(first, check_separation_or_leaving(motion, radius_m, *thing.obstacle,
                                                   thing.keep_m - radius_m, from_s, thing.until_s));
  }
  return first;
}

LocalProof LocalPlanner::proof_of(const Motion& motion, const LocalScene& scene, double from_s,
                                  double until_s, Violation& violation) const {
  const auto kept = [until_s](const Violation& each) { return !each || each.time_s >= until_s; };
  const Violation limits = check_limits(motion, robot_.limits, from_s);
  const Violation still = check_clearance_or_leaving(motion, robot_.footprint,
                                                     scene.terrain->field(), margin_m_, from_s);
  violation = earlier(earlier(limits, still), certify(motion, scene.moving, from_s));
  if (kept(violation)) return LocalProof::kAsked;
  if (!kept(still) || !kept(certify(motion, likely(scene), from_s))) return LocalProof::kNone;
  if (kept(limits)) return LocalProof::kLikely;
  return kept(check_limits(motion, emergency_limits_, from_s)) ? LocalProof::kEmergency
                                                               : LocalProof::kNone;
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
    LocalCandidate tried = candidate;
    tried.terms = found.terms;
    tried.cost = found.cost;
    tried.rejoins_s = drive.start_time_s + found.curve.duration();
    tried.motion = rejoined(query.start_time_s, std::move(phases), query.plan, task.anchor);
    tried.proof =
        proof_of(tried.motion, scene, query.start_time_s, tried.rejoins_s, tried.violation);
    const double late_s = tried.rejoins_s - query.start_time_s - task.earliest_s;
    if (late_s > kLatest * rules_.mu_s) return;  // to brake and wait is better
    const Violation violation = tried.violation;
    if (tried.proof <= candidate.proof) candidate = std::move(tried);
    if (candidate.proof == LocalProof::kAsked || !is_nearly_kept(violation)) return;
    effort = raised(effort, violation, kHeavier);
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
    } catch (const std::invalid_argument&) {
      continue;  // what the optimiser found is no motion
    }
    if (candidate.proof == LocalProof::kAsked) break;
  }
  return candidate;
}

void LocalPlanner::select(const LocalQuery& query, const LocalScene& scene, const Task& task,
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
  plan.delay_s = drive_s - task.anchor.drive_s;
  // Against an anchor that is farther, it takes longer in any case.
  plan.late = drive_s - task.anchor.drive_s > rules_.t_epsilon_s - rules_.mu_s;
  proof_of(plan.motion, scene, chosen.rejoins_s, kForever, plan.beyond);
  plan.switches_class = !chosen.driven;
}

LocalPlan LocalPlanner::along(const std::vector<SpaceTimeWay>& ways, const LocalQuery& query,
                              const LocalScene& scene, const Task& task) const {
  LocalPlan plan;
  plan.message = "no way through space-time back to the plan";
  plan.anchor = task.anchor;
  if (ways.empty()) return plan;
  watch_(LocalStage::kOptimisation);
  plan.candidates.resize(ways.size());
  in_parallel(ways.size(), rules_.threads,
              [&](std::size_t i) { plan.candidates[i] = candidate(query, scene, task, ways[i]); });
  select(query, scene, task, plan);
  watch_(LocalStage::kDone);
  return plan;
}

LocalPlan LocalPlanner::attempt(const LocalQuery& query, const LocalScene& scene, const Task& task,
                                const Cuts<2>& cuts) const {
  watch_(LocalStage::kFrontEnd);
  const auto found = find_space_time_ways(*scene.terrain, cuts, task.ways, space_time_rules_);
  watch_(LocalStage::kDone);
  return along(found.ways, query, scene, task);
}

LocalPlan LocalPlanner::keep_on(const LocalQuery& query, const LocalScene& scene) const {
  const auto anchor = rejoining_point(query.plan, query.progress_s, rules_.mu_s);
  if (query.driven.empty() || !anchor) return {};
  SpaceTimeWay way;
  way.points = driven_to(*anchor, query);
  way.driven = true;
  if (way.points.empty()) return {};
  return along({way}, query, scene, {*anchor, earliest_s(query, *anchor), {}});
}

LocalPlan LocalPlanner::again(const LocalQuery& query, const LocalScene& scene,
                              const LocalPlan& failed) const {
  std::vector<SpaceTimeWay> ways;
  for (const LocalCandidate& each : failed.candidates)
    ways.push_back({each.way, 0.0, each.signature, each.driven});
  return along(ways, query, scene, {failed.anchor, earliest_s(query, failed.anchor), {}});
}

LocalPlan LocalPlanner::search(const LocalQuery& query, const LocalScene& scene) const {
  LocalPlan kept = keep_on(query, scene);
  const bool is_kept = kept.proof == LocalProof::kAsked;
  // Costs are not negative: nothing could be cheaper by enough.
  if (is_kept && kept.candidates.front().cost < rules_.switch_gain) return kept;
  LocalPlan other = anew(query, scene);
  // A driven way is not given up only because it keeps from what is likely, and another from more.
  if (std::max(kept.proof, other.proof) > LocalProof::kLikely)
    return kept.proof < other.proof ? kept : other;
  // Their anchors may differ, and so their costs may not be compared, but the time that they lose.
  const auto loss = [this](const LocalPlan& plan) {
    return rules_.weight_duration * std::pow(std::max(0.0, plan.delay_s), 3);
  };
  const double to_beat =
      std::min((1.0 - rules_.switch_margin) * loss(kept), loss(kept) - rules_.switch_gain);
  return !other.switches_class || loss(other) < to_beat ? other : kept;
}

LocalPlan LocalPlanner::anew(const LocalQuery& query, const LocalScene& scene) const {
  const std::vector<Task> tasks = this->tasks(query, scene);
  std::vector<LocalPlan> plans(std::max<std::size_t>(1, tasks.size()));
  if (tasks.empty()) return plans.front();
  const Cuts<2> cuts = cuts_for(tasks, scene);
  // The first one mostly succeeds. If it does not, it is urgent.
  plans[0] = attempt(query, scene, tasks[0], cuts);
  if (plans[0].proof == LocalProof::kAsked) return plans[0];
  in_parallel(tasks.size() - 1, rules_.threads,
              [&](std::size_t i) { plans[i + 1] = attempt(query, scene, tasks[i + 1], cuts); });
  const auto is_better = [](const LocalPlan& a, const LocalPlan& b) {
    if (a.proof != b.proof) return a.proof < b.proof;
    if (a.proof == LocalProof::kNone) return b.candidates.empty() && !a.candidates.empty();
    return a.delay_s < b.delay_s - kSooner_s;
  };
  return *std::min_element(plans.begin(), plans.end(), is_better);
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
