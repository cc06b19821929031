#include "planning/front_end.h"

#include <algorithm>
#include <utility>

#include "planning/peer_discs.h"
#include "safety/margin_budget.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kSlack_m = 0.01;  // over the proved margin, for the optimiser to work in
constexpr double kSameGoal_m = 0.5;

bool is_under_way(const PlanQuery& query, const Vector2& goal) {
  return !query.driven.empty() && query.driven.end_time() > query.start_time_s &&
         (query.driven.end_pose().position - goal).norm() < kSameGoal_m;
}

}  // namespace

WayRules way_rules(const RobotModel& robot, const PlannerRules& rules) {
  double radius_m = 0.0;
  for (const auto& disc : robot.footprint.cover()) radius_m = std::max(radius_m, disc.radius_m);
  WayRules ways;
  ways.travel.required_clearance_m =
      radius_m + MarginBudget::of(robot).static_margin_m() + kSlack_m;
  ways.travel.preferred_clearance_m =
      ways.travel.required_clearance_m + rules.preferred_clearance_m;
  ways.travel.clearance_weight = rules.clearance_weight;
  ways.roadmap = rules.roadmap;
  ways.classes = rules.classes;
  ways.longest_ratio = rules.longest_ratio;
  ways.prm_samples = rules.prm_samples;
  return ways;
}

std::vector<Vector2> path_of(const Motion& motion, double from_s, double max_speed) {
  const double step_s = 0.2 / max_speed;
  std::vector<Vector2> points = {motion.position(from_s)};
  double start_s = motion.start_time();
  for (const Phase& phase : motion.phases()) {
    if (const auto* drive = std::get_if<DrivePhase>(&phase)) {
      const double end_s = drive->path.duration();
      for (double t = std::max(0.0, from_s - start_s) + step_s; t < end_s; t += step_s)
        points.push_back(drive->path.position(t));
    }
    start_s += duration_s(phase);
  }
  points.push_back(motion.end_pose().position);
  return points;
}

FrontEnd::FrontEnd(const RobotModel& robot, const PlannerRules& rules, double rest_acceleration)
    : robot_(robot),
      rules_(way_rules(robot, rules)),
      openings_(robot.limits, rules.smooth_start_rad, rest_acceleration),
      rest_acceleration_(rest_acceleration) {}

Ways FrontEnd::ways(std::vector<Vector2> lead_in, const PlanQuery& query,
                    const PlanningScene& scene, const Vector2& goal) const {
  WayQuery ways;
  ways.lead_in = std::move(lead_in);
  ways.goal = goal;
  for (const auto& peer : scene.peers) {
    if (!stands(*peer, query.start_time_s)) continue;
    const BlockedDisc disc = kept_from(*peer, query.start_time_s, robot_, kSlack_m);
    // A team-mate on the goal will hardly stay.
    if ((disc.centre - goal).norm() > disc.radius_m) ways.blocked.push_back(disc);
  }
  if (is_under_way(query, goal)) {
    ways.driven = path_of(query.driven, query.start_time_s, robot_.limits.max_speed);
    ways.driven.front() = ways.lead_in.front();
    ways.driven.back() = goal;
  }
  return find_ways(*scene.terrain, ways, rules_);
}

Approaches FrontEnd::approaches(const PlanQuery& query, const PlanningScene& scene,
                                const Vector2& goal) const {
  const MotionState start = query.committed.at(query.start_time_s);
  Ways found = ways({start.pose.position}, query, scene, goal);
  Approaches result{{}, std::move(found.cuts), std::move(found.driven)};
  for (const Way& way : found.ways) {
    std::vector<Opening> openings = start.at_rest ? openings_.from_rest({}, start.pose, way.points)
                                                  : openings_.rolling(start, way.points);
    if (openings.empty()) continue;
    result.list.push_back({std::move(openings), way.least_length_m, way.signature});
  }
  if (result.list.size() == found.ways.size()) return result;
  for (Approach& approach : after_braking(query, scene, goal).list) {
    const bool known =
        std::any_of(result.list.begin(), result.list.end(),
                    [&](const Approach& other) { return other.signature == approach.signature; });
    if (!known) result.list.push_back(std::move(approach));
  }
  return result;
}

Approaches FrontEnd::after_braking(const PlanQuery& query, const PlanningScene& scene,
                                   const Vector2& goal) const {
  if (query.committed.at(query.start_time_s).at_rest) return {};
  const std::vector<Phase> brake =
      brake_along(query.committed, query.start_time_s, rest_acceleration_);
  const Motion stop(query.start_time_s, brake);
  Ways found = ways(path_of(stop, query.start_time_s, robot_.limits.max_speed), query, scene, goal);
  Approaches result{{}, std::move(found.cuts), std::move(found.driven)};
  for (const Way& way : found.ways) {
    result.list.push_back({openings_.from_rest(brake, stop.end_pose(), way.points),
                           way.least_length_m, way.signature});
  }
  return result;
}

bool FrontEnd::reaches(const Vector2& start, const Vector2& goal, const Terrain& terrain) const {
  const TravelCost cost(terrain, start, {}, rules_.travel);
  return find_grid_path(terrain, start, goal, cost, rules_.lattice_step_m).outcome ==
         GridPath::Outcome::kFound;
}

}  // namespace mocha
