#include "planning/global/global_rules.h"

#include <limits>
#include <utility>

#include "planning/candidates/peer_discs.h"
#include "safety/certifier.h"

namespace mocha {

Violation certify_plan(const Motion& motion, const RobotModel& robot,
                       const ObstacleField<2>& obstacles, double from_s) {
  Scene scene;
  scene.obstacles = std::shared_ptr<const ObstacleField<2>>(&obstacles, [](const auto*) {});
  return certify(motion, robot.footprint, scene,
                 Requirements(robot)[RequirementName::kPlan].from(from_s));
}

EffortLadder GlobalRules::ladder() const {
  constexpr int kAttempts = 8;
  constexpr double kFactor = 20.0;
  return {kAttempts, kFactor};
}

DriveQuery GlobalRules::drive(const Seed&, const StartManeuver& start_maneuver) const {
  DriveQuery drive;
  drive.path = start_maneuver.path;
  drive.start = start_maneuver.state;
  drive.start_time_s = query_.start_time_s + start_maneuver.duration_s;
  drive.duration_cost = DurationCost::total(options_.weight_duration);
  for (const auto& peer : scene_.peers) {
    const bool standing = stands(*peer, query_.start_time_s);
    const BlockedDisc disc = peer_keep_out(*peer, query_.start_time_s, robot_, 0.0);
    // A team-mate that stands on the goal will hardly stay: drive up, and let the promises keep
    // apart.
    if (standing && (disc.centre - start_maneuver.path.back()).norm() <= disc.radius_m) continue;
    drive.moving.push_back(
        {peer, distance_to_peers_m(robot_),
         standing ? std::numeric_limits<double>::infinity() : peer->rest_time()});
  }
  return drive;
}

bool GlobalRules::assemble(const StartManeuver& start_maneuver, const PlanarPath& curve,
                           PlanCandidate& candidate) const {
  std::vector<Phase> phases = start_maneuver.phases;
  const DrivePhase drive{1, curve};
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
  candidate.violation =
      certify_plan(candidate.motion, robot_, scene_.static_map->field(), query_.start_time_s);
  candidate.met = candidate.violation ? RequirementName::kNone : wanted();
}

}  // namespace mocha
