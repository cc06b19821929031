#pragma once

#include <functional>
#include <random>
#include <vector>

#include "perception/room.h"
#include "perception/sensor/range_smoothing.h"
#include "perception/shipped_options.h"

namespace mocha {

/// Something round on its way.
struct Walker {
  double radius_m;
  std::function<Vector2(double)> at;  ///< of the time [s]
};

inline Walker walker(double radius_m, const Vector2& from, const Vector2& velocity,
                     double start_s = 0.0, double stop_s = 1e9) {
  return {radius_m, [=](double t) {
            return Vector2(from + std::clamp(t - start_s, 0.0, stop_s - start_s) * velocity);
          }};
}

/// A lidar with its faults: range noise, beams without return, and a pose that is slightly wrong.
struct Senses {
  double noise_m = 0.01;
  double dropout = 0.002;
  double jitter_m = 0.0;
  double jitter_rad = 0.0;
  int beams = 720;
  double range_max_m = 20.0;
};

/// A robot in a room with walkers that maps and tracks, ten scans a second.
class Watch {
 public:
  explicit Watch(Room room, std::uint64_t seed = 1, Senses senses = {},
                 MovingObjectFilterOptions options = shipped_sorter_options())
      : room(std::move(room)), senses(senses), filter(options), random_(seed) {}

  /// The next scan, from `pose`.
  void look(const Pose& pose = {}) { take(scan(pose)); }

  void take(std::vector<Beam> beams) {
    filter.sort(beams, map);
    newest = beams;
    map.insert_scan(beams);
    time_s += 0.1;
  }

  /// What the sensor measures now.
  std::vector<Beam> scan(const Pose& pose) {
    Room now = room;
    for (const Walker& walker : walkers)
      now.circles.push_back({walker.at(time_s), walker.radius_m});
    PlanarScan sweep = mocha::sweep(
        now, [&](double) { return pose; }, senses.range_max_m, senses.beams);
    for (float& range : sweep.ranges_m) {
      range += static_cast<float>(senses.noise_m * normal_(random_));
      if (chance_(random_) < senses.dropout) range = INFINITY;
    }
    Pose believed = pose;
    believed.position += senses.jitter_m * Vector2(normal_(random_), normal_(random_));
    believed.yaw_rad += senses.jitter_rad * normal_(random_);
    auto beams = to_beams(smoothed(sweep, smoothing_m_),
                          {sensor_pose(believed), sensor_pose(believed)}, {30.0, 10.0});
    for (Beam& beam : beams) beam.time_s = time_s;
    return beams;
  }

  void look_for(double seconds, const Pose& pose = {}) {
    for (double end_s = time_s + seconds - 0.05; time_s < end_s;) look(pose);
  }

  /// Of the newest scan.
  std::vector<TrackedObstacle> tracks() const { return filter.moving(time_s - 0.1); }

  int occupied_within(const Vector2& centre, double radius_m) const {
    int cells = 0;
    for (const auto& voxel : map.occupied_voxels())
      cells += (voxel.head<2>().cast<double>() - centre).norm() <= radius_m ? 1 : 0;
    return cells;
  }

  Room room;
  std::vector<Walker> walkers;
  Senses senses;
  OccupancyMap map{shipped_map_options()};
  MovingObjectFilter filter;
  double time_s = 100.0;  ///< of the next scan
  std::vector<Beam> newest;

 private:
  const double smoothing_m_ = shipped_smoothing_m();
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> chance_{0.0, 1.0};
};

/// One scan from the origin of a room with some things in it.
inline std::vector<Beam> scan_of(Room room, const std::vector<Room::Circle>& things) {
  room.circles.insert(room.circles.end(), things.begin(), things.end());
  return Watch(room).scan({});
}

}  // namespace mocha
