#include "simulation/lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mocha {
namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();
constexpr float kTooNear = 0.0f;

Pose composed(const Pose& base, const Pose& mount) {
  const double c = std::cos(base.yaw_rad);
  const double s = std::sin(base.yaw_rad);
  const Vector2& p = mount.position;
  return {base.position + Vector2(c * p.x() - s * p.y(), s * p.x() + c * p.y()),
          base.yaw_rad + mount.yaw_rad};
}

double nearest(const std::vector<Obstacle>& obstacles, const Vector2& origin,
               const Vector2& direction) {
  double length = std::numeric_limits<double>::infinity();
  for (const Obstacle& obstacle : obstacles) {
    const double here = std::visit(
        [&](const auto& shape) { return ray_length(origin, direction, shape); }, obstacle);
    length = std::min(length, here);
  }
  return length;
}

}  // namespace

Lidar::Lidar(const LidarModel& model, std::uint64_t seed)
    : model_(model),
      angle_min_(-0.5 * model.field_of_view_rad),
      angle_increment_(2.0 * M_PI / model.beams),
      time_increment_(model.sweep_time_s / (model.beams - 1)),
      random_(seed) {
  if (!model.sees_all_round()) {
    angle_increment_ = model.field_of_view_rad / (model.beams - 1);
  }
}

Scan Lidar::sweep(double start_time_s, const Scene& scene) {
  if (fault_.frozen && !newest_m_.empty()) return {start_time_s, newest_m_};
  newest_m_ = measure(start_time_s - fault_.delay_s, scene).ranges_m;
  return {start_time_s, newest_m_};
}

Scan Lidar::measure(double start_time_s, const Scene& scene) {
  Scan scan{start_time_s, {}};
  scan.ranges_m.reserve(model_.beams);
  Pose sensor;
  std::vector<Obstacle> moving;
  for (int i = 0; i < model_.beams; ++i) {
    if (i == 0 || time_increment_ > 0.0) {
      const double time_s = start_time_s + i * time_increment_;
      sensor = composed(scene.base_at(time_s), model_.mount);
      moving = scene.moving_at(time_s);
    }
    const double bearing = angle_min_ + i * angle_increment_;
    if (fault_.blind_rad > 0.0 && std::abs(bearing) <= 0.5 * fault_.blind_rad) {
      scan.ranges_m.push_back(kNoReturn);
      continue;
    }
    const double angle = sensor.yaw_rad + fault_.turn_rad + bearing;
    const Vector2 direction(std::cos(angle), std::sin(angle));
    const double wall = scene.walls.ray_length(sensor.position, direction, model_.max_range_m);
    scan.ranges_m.push_back(measured(std::min(wall, nearest(moving, sensor.position, direction))));
  }
  return scan;
}

float Lidar::measured(double length_m) {
  if (chance_(random_) < model_.dropout || length_m > model_.max_range_m) return kNoReturn;
  const double range = length_m + fault_.noise_factor * model_.noise_m * noise_(random_);
  if (range > model_.max_range_m) return kNoReturn;
  return range < model_.min_range_m ? kTooNear : static_cast<float>(range);
}

}  // namespace mocha
