#include "benchmarks/stray_sight.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mocha {
namespace {

constexpr double kMapped_s = 1.0;  // of standing
constexpr double kStep_m = 0.05;
constexpr double kRounding_m = 0.01;  // so that one map does while a robot stands
constexpr std::size_t kMapsKept = 4;
// What perception's filter comes to by its measurement_noise and acceleration_psd.
constexpr PredictedDeviation kDeviation{0.03, 0.22};

}  // namespace

StraySight::StraySight(OccupancyGrid walls, int robots, double radius_m)
    : walls_(std::move(walls)),
      radius_m_(radius_m),
      map_(std::make_shared<const FleetMap>(walls_)),
      truth_(robots),
      stands_since_s_(robots, 0.0),
      strays_(robots) {}

void StraySight::look(double now_s, const std::vector<RobotState>& truth) {
  truth_ = truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!stands(truth[i])) stands_since_s_[i] = now_s;
  }
}

RobotSenses StraySight::senses(int observer, double now_s, const RobotNodes& nodes) {
  std::set<int>& strays = strays_[observer];
  std::vector<Vector2> standing;
  RobotSenses senses;
  senses.predictions.time_s = now_s;
  for (int i = 0; i < static_cast<int>(truth_.size()); ++i) {
    const RobotState& other = truth_[i];
    const Vector2& place = other.pose.position;
    if (i == observer || nodes.expects_at(place, now_s)) {
      strays.erase(i);
      continue;
    }
    if (sees(truth_[observer].pose.position, place)) strays.insert(i);
    if (strays.count(i) == 0) continue;
    if (now_s - stands_since_s_[i] >= kMapped_s) {
      standing.push_back(kRounding_m * (place / kRounding_m).array().round().matrix());
      continue;
    }
    const double yaw_rad = other.pose.yaw_rad;
    const Vector2 velocity = other.twist.speed * Vector2(std::cos(yaw_rad), std::sin(yaw_rad));
    senses.predictions.things.push_back(
        {static_cast<std::uint32_t>(i), place, velocity, radius_m_, kDeviation});
  }
  senses.map = map_with(standing);
  return senses;
}

bool StraySight::sees(const Vector2& from, const Vector2& to) const {
  const double far_m = (to - from).norm();
  for (double along_m = 0.0; along_m < far_m;) {
    const double free_m = map_->obstacles->distance_bound(from + along_m / far_m * (to - from));
    if (free_m <= 0.0) return false;
    along_m += std::max(free_m, kStep_m);
  }
  return true;
}

std::shared_ptr<const FleetMap> StraySight::map_with(const std::vector<Vector2>& standing) {
  if (standing.empty()) return map_;
  for (const Drawn& drawn : drawn_) {
    if (drawn.standing == standing) return drawn.map;
  }
  OccupancyGrid grid = walls_;
  for (const Vector2& place : standing) fill_disc(grid, place, radius_m_, OccupancyGrid::kOccupied);
  if (drawn_.size() == kMapsKept) drawn_.erase(drawn_.begin());
  drawn_.push_back({standing, std::make_shared<const FleetMap>(grid)});
  return drawn_.back().map;
}

}  // namespace mocha
