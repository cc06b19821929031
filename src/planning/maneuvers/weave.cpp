#include "planning/maneuvers/weave.h"

#include <algorithm>
#include <utility>

#include "planning/maneuvers/rolling_search.h"

namespace mocha {
namespace {

constexpr double kWeave_s = 3.6;
constexpr double kWayOut_s = 2.4;
// Nobody may come so long after it: a weave may turn out to be the last, a way out is not.
constexpr double kStays_s = 5.0;
constexpr double kEscapes_s = 1.5;
constexpr double kShareForWay = 0.9;  // some is left to the curve that is laid through the way
// Of the way at full speed, or to the target: what gets on by less is no way through.
constexpr double kLeastShare = 0.5;

Maneuvers whole_ways(const ManeuverStart& start, const RollingSearchOptions& options, bool at_once,
                     const char* words) {
  Maneuvers maneuvers;
  for (Motion& way : rolling_ways(start, options))
    maneuvers.push_back(whole(std::move(way), options.join_s, at_once, words));
  return maneuvers;
}

}  // namespace

Maneuvers weaves(const ManeuverStart& start) {
  const bool at_once = is_alone(start);
  MotionLimits limits = start.robot.limits;
  limits.max_speed *= kShareForWay;
  limits.max_acceleration *= kShareForWay;
  const double join_s = at_once ? start.emergency_s : start.settled_s;
  Maneuvers ways = whole_ways(start, {limits, join_s, kWeave_s, kStays_s, {{1.0, 0.2}, {1.0, 0.0}}},
                              at_once, "weaves");
  const double left_m = (start.committed.position(join_s) - start.target).norm();
  const double gain_m = kLeastShare * std::min(left_m, kWeave_s * limits.max_speed);
  const auto gets_on = [&](const Maneuver& way) {
    return (way.motion.end_pose().position - start.target).norm() <= left_m - gain_m;
  };
  ways.erase(std::stable_partition(ways.begin(), ways.end(), gets_on), ways.end());
  return ways;
}

Maneuvers ways_out(const ManeuverStart& start) {
  if (!is_alone(start)) return {};
  MotionLimits limits = start.robot.limits;
  limits.max_acceleration = start.robot.hard_braking().deceleration();
  return whole_ways(
      start,
      {limits, start.emergency_s, kWayOut_s, kEscapes_s, {{1.0, 0.2}, {0.5, 0.06}, {0.0, 0.0}}},
      true, "finds a way out, which keeps the most room");
}

}  // namespace mocha
