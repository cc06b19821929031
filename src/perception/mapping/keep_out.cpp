#include "perception/mapping/keep_out.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kForTurning_m = 0.1;  // beside the body and its margin, so that plans find room

ExitRoom room_of(const RobotModel& robot) {
  const MarginBudget margins = MarginBudget::of(robot);
  const double inscribed_m = robot.footprint.inscribed_radius_m();
  return {robot.footprint.circumscribed_radius_m() + margins.static_margin_m() +
              robot.map_resolution_m + kForTurning_m,
          inscribed_m + margins.static_margin().still_m, inscribed_m};
}

}  // namespace

KeepOut::KeepOut(const RobotModel& robot)
    : footprint_(robot.footprint),
      still_m_(MarginBudget::of(robot).static_margin().still_m + robot.map_resolution_m),
      room_(room_of(robot)) {}

void KeepOut::set(std::vector<Polygon> areas) {
  areas_ = std::move(areas);
  are_new_ = true;
  open_ = {};
  ++version_;
}

/// Between the body and the nearest area.
double KeepOut::gap_m(const Pose& pose) const {
  double least_m = std::numeric_limits<double>::infinity();
  const Obstacle body = placed(footprint_, pose);
  for (const Polygon& area : areas_) least_m = std::min(least_m, gap(body, area).distance_m);
  return least_m;
}

void KeepOut::look(const std::vector<Pose>& course, const OccupancyMap& map) {
  if (areas_.empty()) return;
  const auto is_within = [&](double distance_m) {
    return std::any_of(course.begin(), course.end(),
                       [&](const Pose& pose) { return gap_m(pose) < distance_m; });
  };
  if (std::exchange(are_new_, false)) {
    if (is_within(still_m_)) open_way(course, map);
  } else if (open_.path.empty()) {
    if (gap_m(course.front()) < 0.0) open_way({course.front()}, map);
  } else if (!is_within(still_m_)) {
    open_ = {};
    ++version_;
  } else if (!open_.covers(course.front().position) || is_blocked(map)) {
    open_way({course.front()}, map);
  }
}

void KeepOut::open_way(const std::vector<Pose>& course, const OccupancyMap& map) {
  std::vector<Vector2> places;
  for (const Pose& pose : course) places.push_back(pose.position);
  Strip strip = find_exit(areas_, map, places, room_);
  leads_out_ = strip.path.size() > places.size();
  if (strip.path == open_.path) return;
  open_ = std::move(strip);
  ++version_;
}

/// Something stands on the way now, or stood there and may have gone.
bool KeepOut::is_blocked(const OccupancyMap& map) const {
  return !leads_out_ || std::any_of(open_.path.begin(), open_.path.end(), [&](const Vector2& p) {
    return map.is_occupied_within(p, room_.least_m, false);
  });
}

}  // namespace mocha
