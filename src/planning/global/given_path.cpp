#include "planning/global/given_path.h"

#include <cmath>

#include "planning/candidates/start_maneuver.h"
#include "planning/global/front_end.h"
#include "trajectory/plane_vectors.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kAtBeginning_m = 0.3;
constexpr double kSame_m = 0.01;
constexpr double kLastStretch_m = 0.1;
constexpr double kLook_s = 0.1;

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

/// Whether a robot at `from` is still on its way to the beginning of the given path, where its
/// promise ends. It may come the way that it is to go back.
bool comes_to_path(const PlanQuery& query, const Vector2& from) {
  const std::vector<Vector2>& path = query.along;
  if (path.size() < 2 || query.committed.end_time() <= query.start_time_s) return false;
  const Vector2& promised = query.committed.end_pose().position;
  return (promised - path.front()).norm() < kAtBeginning_m && (from - promised).norm() > kSame_m;
}

/// Returns the last stretch of a motion, from a place shortly before its end to the end [m].
Vector2 last_stretch(const Motion& motion, double from_s) {
  const Vector2& end = motion.end_pose().position;
  double t = motion.end_time();
  while (t > from_s && (end - motion.position(t)).norm() < kLastStretch_m) t -= kLook_s;
  return end - motion.position(t);
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
  if (!comes_to_path(query, start.pose.position)) return false;
  const Vector2 comes = last_stretch(query.committed, query.start_time_s);
  const Vector2 goes = query.along[1] - query.along[0];
  return std::abs(angle_between(comes, goes)) > kTurnsBack_rad;
}

}  // namespace mocha
