#include "planning/global/global_planner.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "planning/candidates/path_clearance.h"
#include "planning/global/global_rules.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kAtGoal_m = 0.03;
constexpr double kStand_s = 0.1;
constexpr double kFarthest_m = 1e6;  // from the origin: farther away, paths are not searched

PlanResult failure(PlanReason reason, const std::string& message) {
  PlanResult result;
  result.reason = reason;
  result.message = message;
  return result;
}

std::string place(const Vector2& p) {
  std::ostringstream text;
  text.precision(2);
  text << std::fixed << "(" << p.x() << ", " << p.y() << ")";
  return text.str();
}

/// What was not solved, though not all that could be was tried, is not said to have failed.
PlanResult unless_stopped(const PlanQuery& query, PlanResult result) {
  if (!query.should_stop()) return result;
  result.reason = PlanReason::kBudgetExhausted;
  result.message = "planning was stopped before it found a motion to " + place(result.goal);
  return result;
}

/// Only the heading is left.
bool is_at_goal(const MotionState& start, const PlanQuery& query) {
  return start.at_rest && (start.pose.position - query.goal).norm() < kAtGoal_m;
}

}  // namespace

GlobalPlanner::GlobalPlanner(RobotModel robot, const PlannerOptions& options)
    : robot_(std::move(robot)),
      options_(options),
      optimizer_(robot_, options_, MarginBudget::of(robot_).static_margin()),
      front_end_(robot_, options_) {}

std::optional<Vector2> GlobalPlanner::free_goal(const Vector2& goal, const Vector2& from,
                                                const ObstacleField<2>& obstacles) const {
  constexpr double kStep_m = 0.05;
  constexpr double kShare = 0.05;  // of the radius, where that is a longer step
  constexpr double kShareOfWay = 0.25;
  const double needed_m = front_end_.required_clearance_m();
  // What was seen there from far may have gone, or be no wall, when the robot is near.
  const double farthest_m =
      std::max(options_.goal_search_radius_m, kShareOfWay * (goal - from).norm());
  for (double radius_m = 0.0; radius_m <= farthest_m;) {
    const double step_m = std::max(kStep_m, kShare * radius_m);
    const int directions =
        radius_m == 0.0 ? 1 : std::max(8, static_cast<int>(2 * M_PI * radius_m / step_m));
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * M_PI * i / directions;
      const Vector2 place = goal + radius_m * Vector2(std::cos(angle), std::sin(angle));
      if (obstacles.distance_bound(place) >= needed_m) return place;
    }
    radius_m += step_m;
  }
  return std::nullopt;
}

PlanResult GlobalPlanner::turn_only(const PlanQuery& query, const PlanningScene& scene) const {
  const Pose pose = query.committed.at(query.start_time_s).pose;
  std::vector<Phase> phases;
  const double yaw_rad = query.goal_yaw_rad.value_or(pose.yaw_rad);
  if (const auto turn = turn_in_place(pose, yaw_rad, robot_.limits)) {
    phases.emplace_back(*turn);
  } else {
    phases.emplace_back(StandPhase{pose, kStand_s});
  }
  Motion motion(query.start_time_s, std::move(phases));
  PlanResult result;
  result.goal = query.goal;
  result.violation = certify_plan(motion, robot_, scene, query.start_time_s);
  if (result.violation) {
    result.reason = PlanReason::kNotCertified;
    result.message = describe(result.violation);
    return result;
  }
  result.reason = PlanReason::kSolved;
  result.message = "turns at the goal";
  result.motion = std::move(motion);
  return result;
}

std::string GlobalPlanner::obstruction(const Vector2& goal, const PlanQuery& query,
                                       const StaticMap& static_map) const {
  const Vector2 start = query.committed.at(query.start_time_s).pose.position;
  std::ostringstream text;
  text.precision(2);
  text << std::fixed;
  if (const auto narrow = front_end_.narrowest(start, goal, static_map, query.should_stop)) {
    text << "; the narrowest place of the widest way is " << place(narrow->place) << ", "
         << narrow->width_m << " m wide there, and the robot needs " << passable_gap_m(robot_)
         << " m";
  }
  text << "; the nearest place in reach is "
       << place(front_end_.nearest_reachable(start, goal, static_map, query.should_stop));
  return text.str();
}

std::optional<PlanResult> GlobalPlanner::refusal(const PlanQuery& query,
                                                 const PlanningScene& scene) const {
  if (!scene.static_map) return failure(PlanReason::kNoMap, "there is no map yet");
  const Eigen::AlignedBox2d& map = scene.static_map->bounds();
  if (!(std::max(-map.min().minCoeff(), map.max().maxCoeff()) <= kFarthest_m))
    return failure(PlanReason::kNoMap, "the map reaches farther than 1e6 m from its origin");
  if (query.committed.empty())
    return failure(PlanReason::kNoPose, "the robot's state is not known yet");
  if (!query.goal.allFinite() || !std::isfinite(query.goal_yaw_rad.value_or(0.0)))
    return failure(PlanReason::kInvalidInput, "the goal is not finite");
  if (!std::isfinite(query.start_time_s))
    return failure(PlanReason::kInvalidInput, "the time to start at is not finite");
  return std::nullopt;
}

void GlobalPlanner::run(const PlanQuery& query, const GlobalSeeds& seeds,
                        const PlanningScene& scene, PlanResult& result) const {
  const GlobalRules rules(robot_, options_, query, scene);
  const SwitchRule rule{options_.switch_margin, 0.0};
  const CandidatePipeline pipeline(optimizer_, scene.static_map->field(), rules);
  result.candidates = pipeline.race(seeds.list, rule, options_.threads, query.should_stop);
  for (PlanCandidate& candidate : result.candidates) {
    if (candidate.motion.empty()) continue;
    // An optimiser may leave its class.
    candidate.signature = signature_of<2>(
        seeds.cuts, path_of(candidate.motion, query.start_time_s, robot_.limits.max_speed));
  }
  const PlanCandidate* chosen = select(rule, result);
  result.switches_class = chosen && seeds.driven && chosen->signature != *seeds.driven;
}

void GlobalPlanner::search(const PlanQuery& query, const PlanningScene& scene, const Vector2& goal,
                           PlanResult& result) const {
  for (const auto& found : {&FrontEnd::promising, &FrontEnd::seeds, &FrontEnd::after_braking,
                            &FrontEnd::after_parking_out}) {
    const GlobalSeeds seeds = (front_end_.*found)(query, scene, goal);
    if (!seeds.list.empty()) run(query, seeds, scene, result);
    if (result.reason == PlanReason::kSolved || query.should_stop()) return;
  }
}

PlanResult GlobalPlanner::plan(const PlanQuery& query, const PlanningScene& scene) const {
  if (auto refused = refusal(query, scene)) return *refused;
  const MotionState start = query.committed.at(query.start_time_s);
  if (is_at_goal(start, query)) return turn_only(query, scene);
  const ObstacleField<2>& obstacles = scene.static_map->field();
  if (obstacles.distance_bound(start.pose.position) <= 0.0) {
    return failure(PlanReason::kStartOccupied, "the robot at " + place(start.pose.position) +
                                                   " is inside an obstacle of the map");
  }
  const auto goal = free_goal(query.goal, start.pose.position, obstacles);
  if (!goal) {
    return failure(PlanReason::kGoalOccupied, "the goal " + place(query.goal) +
                                                  " is occupied, and so is everything around it");
  }
  PlanResult result = failure(PlanReason::kNoPath, "no path from " + place(start.pose.position) +
                                                       " to " + place(*goal) + " on the map");
  result.goal = *goal;
  const StaticMap& static_map = *scene.static_map;
  const bool may_reach = front_end_.may_reach(start.pose.position, *goal, static_map);
  if (may_reach) search(query, scene, *goal, result);
  if (result.reason == PlanReason::kSolved) {
    if (*goal != query.goal)
      result.message += ", to " + place(*goal) + " near the goal, which is occupied";
    return result;
  }
  if (!result.candidates.empty() || query.should_stop()) return unless_stopped(query, result);
  if (may_reach && !scene.peers.empty() &&
      front_end_.reaches(start.pose.position, *goal, static_map, query.should_stop)) {
    result.reason = PlanReason::kPeerConflict;
    result.message = "team-mates stand on every path to " + place(*goal);
  } else {
    result.message += obstruction(*goal, query, static_map);
  }
  return unless_stopped(query, result);
}

}  // namespace mocha
