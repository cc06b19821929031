#include "benchmarks/mover_sightings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/mover_path.h"

namespace mocha {
namespace {

constexpr double kRemembered_s = 3.0;
constexpr double kAbsent_m = 0.2;  // a beam that goes on so far into a disc shows that it has left

}  // namespace

MoverSightings::MoverSightings(const World& world)
    : world_(world),
      lidar_(world.robots.front().model.lidar),
      walls_(world.circles, world.polygons) {}

void MoverSightings::look(double time_s, const Pose& base) {
  looked_s_ = time_s;
  const Vector2 sensor = base.position + Eigen::Rotation2Dd(base.yaw_rad) * lidar_.mount.position;
  forget(time_s, sensor, sweep(time_s, base, sensor));
}

std::vector<MoverSightings::Beam> MoverSightings::sweep(double time_s, const Pose& base,
                                                        const Vector2& sensor) {
  std::map<int, Sighting> there;
  for (std::size_t i = 0; i < world_.moving.size(); ++i) {
    const auto state = mover_state(world_.moving[i], time_s);
    const double radius_m = world_.moving[i].radius_m;
    if (!state || (state->centre - sensor).norm() - radius_m > lidar_.max_range_m) continue;
    there[static_cast<int>(i)] = {time_s, state->centre, state->velocity, radius_m};
  }
  const double field_rad = lidar_.field_of_view_rad;
  const double apart_rad = field_rad / (lidar_.sees_all_round() ? lidar_.beams : lidar_.beams - 1);
  std::vector<Beam> beams;
  for (int i = 0; i < lidar_.beams; ++i) {
    const double angle_rad = base.yaw_rad + lidar_.mount.yaw_rad - 0.5 * field_rad + i * apart_rad;
    const Vector2 direction(std::cos(angle_rad), std::sin(angle_rad));
    double nearest_m =
        std::min(lidar_.max_range_m, walls_.ray_length(sensor, direction, lidar_.max_range_m));
    int met = -1;
    for (const auto& [mover, here] : there) {
      const double length_m = ray_length(sensor, direction, Circle{here.centre, here.radius_m});
      if (length_m >= nearest_m) continue;
      nearest_m = length_m;
      met = mover;
    }
    if (met >= 0) known_[met] = there.at(met);
    beams.push_back({direction, nearest_m});
  }
  return beams;
}

void MoverSightings::forget(double time_s, const Vector2& sensor, const std::vector<Beam>& beams) {
  for (auto it = known_.begin(); it != known_.end();) {
    const Sighting& last = it->second;
    const Circle disc{last.centre_at(time_s), last.radius_m};
    const auto passes = [&](const Beam& beam) {
      return ray_length(sensor, beam.direction, disc) + kAbsent_m < beam.range_m;
    };
    const bool is_out_of_view = last.time_s < time_s;
    const bool has_left =
        time_s - last.time_s > kRemembered_s || std::any_of(beams.begin(), beams.end(), passes);
    it = is_out_of_view && has_left ? known_.erase(it) : std::next(it);
  }
}

std::vector<MovingDisc> MoverSightings::predicted(const PredictionMargin& margin,
                                                  const Vector2& place,
                                                  double robot_radius_m) const {
  std::vector<MovingDisc> discs;
  for (const auto& [mover, last] : known_) {
    const auto radius_m = [margin, last = last](double t) {
      const double growth_m = margin.growth_mps * (t - last.time_s);
      return last.radius_m + margin.now_m + std::min(margin.most_growth_m, growth_m);
    };
    const double room_m = (last.centre_at(looked_s_) - place).norm() - robot_radius_m;
    const double most_m = room_m < radius_m(looked_s_) ? std::max(0.0, room_m)
                                                       : std::numeric_limits<double>::infinity();
    discs.push_back([last = last, radius_m, most_m](double t) {
      return std::optional<Circle>({last.centre_at(t), std::min(most_m, radius_m(t))});
    });
  }
  return discs;
}

}  // namespace mocha
