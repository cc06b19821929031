#include "planning/global/given_path.h"

#include <cmath>

#include "planning/candidates/start_maneuver.h"
#include "planning/global/front_end.h"
#include "trajectory/plane_vectors.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kOnPath_m = 0.3;
constexpr double kComes_s = 0.5;  // before it rests, a robot moves as it comes

double off_m(const std::vector<Vector2>& path, std::size_t segment, const Vector2& from) {
  return (from - nearest_on_segment(from, path[segment - 1], path[segment])).norm();
}

/// The part of a path that a robot at `from` has not driven yet.
std::vector<Vector2> rest_of(const std::vector<Vector2>& path, const Vector2& from) {
  std::size_t next = std::min<std::size_t>(1, path.size() - 1);
  for (std::size_t i = 2; i < path.size(); ++i) {
    if (off_m(path, i, from) < off_m(path, next, from)) next = i;
  }
  std::vector<Vector2> rest = {from};
  rest.insert(rest.end(), path.begin() + static_cast<std::ptrdiff_t>(next), path.end());
  return rest;
}

/// Whether the robot is still on its way to the beginning of the given path.
bool comes_to_path(const PlanQuery& query, const Vector2& from) {
  const std::vector<Vector2>& path = query.along;
  const Vector2& promised = query.committed.end_pose().position;
  if (path.size() < 2 || (promised - path.front()).norm() > kOnPath_m) return false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (off_m(path, i, from) < kOnPath_m) return false;
  }
  return true;
}

}  // namespace

std::vector<Vector2> given_path(const PlanQuery& query, const Vector2& from, double max_speed) {
  const std::vector<Vector2>& path = query.along;
  if (!comes_to_path(query, from)) return rest_of(path, from);
  std::vector<Vector2> way = rest_of(path_of(query.committed, query.start_time_s, max_speed), from);
  way.insert(way.end(), path.begin() + 1, path.end());
  return way;
}

bool turns_back_first(const PlanQuery& query, const MotionState& start) {
  if (start.at_rest || !comes_to_path(query, start.pose.position)) return false;
  const Vector2& end = query.committed.end_pose().position;
  const Vector2 comes = end - query.committed.position(query.committed.end_time() - kComes_s);
  return std::abs(angle_between(comes, query.along[1] - end)) > kTurnsBack_rad;
}

}  // namespace mocha
