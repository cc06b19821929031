#include "planning/global/global_rules.h"

#include <cmath>
#include <limits>
#include <utility>

#include "planning/candidates/exposure.h"
#include "planning/candidates/peer_discs.h"
#include "planning/candidates/warm_start.h"
#include "safety/certifier.h"

namespace mocha {
namespace {

constexpr double kSetOff_m = 0.15;  // of any point of the body, after which it has seen more
constexpr double kStep_s = 0.05;
constexpr double kUnderWay_s = 10.0;
constexpr double kSpare_m = 0.005;
constexpr double kRounding_m = 0.001;
constexpr double kWorkPerSecond = 5e5;  // evaluations of single pieces, by a slow core

/// When a motion from rest has moved a point of the body, `arm_m` off the base at most, so far; not
/// within a turn in place: a plan that begins with one is to come to its end.
double set_off_s(const Motion& motion, double arm_m) {
  Pose pose = motion.at(motion.start_time()).pose;
  double t = motion.start_time();
  for (double moved_m = 0.0; moved_m < kSetOff_m && t < motion.end_time(); t += kStep_s) {
    const Pose next = motion.at(t + kStep_s).pose;
    moved_m += (next.position - pose.position).norm() +
               arm_m * std::abs(wrap_angle(next.yaw_rad - pose.yaw_rad));
    pose = next;
  }
  return motion.switch_time(t);
}

Scene still_scene(const PlanningScene& around) {
  Scene scene;
  scene.obstacles =
      std::shared_ptr<const ObstacleField<2>>(around.static_map, &around.static_map->field());
  scene.speed_zones = around.speed_zones;
  return scene;
}

/// The first violation of a plan from rest, for as long as nothing more will have been seen.
Violation certify_setting_off(const Motion& motion, const RobotModel& robot,
                              const PlanningScene& around,
                              std::shared_ptr<const ObstacleField<2>> unseen, double from_s) {
  Scene scene = still_scene(around);
  scene.unseen = std::move(unseen);
  const Requirements requirements(robot);
  Requirement required = requirements[RequirementName::kPlan];
  required.unseen_margin = requirements[RequirementName::kPromise].unseen_margin;
  const double until_s = set_off_s(motion, robot.footprint.circumscribed_radius_m());
  return certify(motion, robot.footprint, scene, required.from(from_s).until(until_s));
}

/// As far as promises do, and a little more, for what a drive is off its path.
double kept_in_turn_m(const RobotModel& robot) {
  return *Requirements(robot)[RequirementName::kPromise].peer_distance_m + kSpare_m;
}

/// The first violation of a plan by team-mates from when they rest: it goes by no other way. One
/// that is too near already may not come nearer; one that is under way may be promised more before
/// the plan gets there.
Violation certify_in_turn(const Motion& motion, const RobotModel& robot, const PlanningScene& scene,
                          double from_s) {
  const double required_m = *Requirements(robot)[RequirementName::kPromise].peer_distance_m;
  Violation first;
  for (const auto& peer : scene.peers) {
    const MovingObstacle::Disc disc = peer->at(peer->rest_time());
    const double gap_m = (disc.centre - motion.position(from_s)).norm() - disc.radius_m;
    const auto resting = std::make_shared<PredictedDisc>(peer->name(), from_s, disc.centre,
                                                         Vector2::Zero(), disc.radius_m, 0.0);
    const double rests_s = std::max(from_s, peer->rest_time());
    const double until_s = stands(*peer, from_s) ? motion.end_time() : from_s + kUnderWay_s;
    const MovingThing thing{resting, std::min(required_m, gap_m - kRounding_m), until_s};
    const Violation violation =
        conflict_of(motion, {thing}, robot.footprint.circumscribed_radius_m(), rests_s,
                    motion.end_time() - rests_s);
    if (violation && (!first || violation.time_s < first.time_s)) first = violation;
  }
  return first;
}

}  // namespace

Violation certify_plan(const Motion& motion, const RobotModel& robot, const PlanningScene& scene,
                       double from_s) {
  return certify(motion, robot.footprint, still_scene(scene),
                 Requirements(robot)[RequirementName::kPlan].from(from_s));
}

GlobalRules::GlobalRules(const RobotModel& robot, const PlannerOptions& options,
                         const PlanQuery& query, const PlanningScene& scene)
    : robot_(robot),
      options_(options),
      query_(query),
      scene_(scene),
      unseen_(scene.unseen && query.committed.at(query.start_time_s).at_rest ? scene.unseen()
                                                                             : nullptr) {}

EffortLadder GlobalRules::ladder() const {
  constexpr int kAttempts = 8;
  constexpr double kFactor = 20.0;
  return {kAttempts, kFactor, kWorkPerSecond * query_.time_limit_s};
}

DriveQuery GlobalRules::drive(const Seed& seed, const StartManeuver& start_maneuver) const {
  DriveQuery drive;
  drive.path = start_maneuver.path;
  drive.start = start_maneuver.state;
  drive.direction = start_maneuver.direction;
  drive.start_time_s = query_.start_time_s + start_maneuver.duration_s;
  drive.duration_cost = DurationCost::total(options_.weight_duration);
  drive.speed_zones = scene_.speed_zones;
  if (seed.driven)
    drive.found_before =
        remaining_knots(query_.driven, drive.start_time_s, drive.start, start_maneuver.path.back());
  for (const auto& peer : scene_.peers) {
    const bool standing = stands(*peer, query_.start_time_s);
    const BlockedDisc disc = peer_keep_out(*peer, query_.start_time_s, robot_, 0.0);
    // A team-mate that stands on the goal will hardly stay: drive up, and let the promises keep
    // apart.
    if (standing && (disc.centre - start_maneuver.path.back()).norm() <= disc.radius_m) continue;
    const bool stays = standing || !query_.along.empty();
    drive.moving.push_back(
        {peer, query_.along.empty() ? distance_to_peers_m(robot_) : kept_in_turn_m(robot_),
         stays ? std::numeric_limits<double>::infinity() : peer->rest_time()});
  }
  return drive;
}

bool GlobalRules::assemble(const StartManeuver& start_maneuver, const PlanarPath& curve,
                           PlanCandidate& candidate) const {
  std::vector<Phase> phases = start_maneuver.phases;
  const DrivePhase drive{start_maneuver.direction, curve};
  phases.emplace_back(drive);
  if (query_.goal_yaw_rad) {
    const double end_s = curve.duration();
    const Pose end{curve.position(end_s), heading(drive, end_s)};
    if (const auto turn = turn_in_place(end, *query_.goal_yaw_rad, robot_.limits))
      phases.emplace_back(*turn);
  }
  MotionOrFault motion = Motion::make(query_.start_time_s, std::move(phases));
  if (!motion) return false;
  candidate.motion = std::move(motion.motion);
  const double beside_s =
      candidate.motion.end_time() - candidate.motion.start_time() - curve.duration();
  candidate.terms.emplace_back("beside_drive", options_.weight_duration * beside_s);
  candidate.cost += candidate.terms.back().second;
  return true;
}

void GlobalRules::certify(PlanCandidate& candidate) const {
  const double from_s = query_.start_time_s;
  candidate.violation = certify_plan(candidate.motion, robot_, scene_, from_s);
  if (!candidate.violation && !query_.along.empty())
    candidate.violation = certify_in_turn(candidate.motion, robot_, scene_, from_s);
  if (!candidate.violation && unseen_) {
    candidate.violation = certify_setting_off(candidate.motion, robot_, scene_, unseen_, from_s);
  }
  candidate.met = candidate.violation ? RequirementName::kNone : wanted();
}

}  // namespace mocha
