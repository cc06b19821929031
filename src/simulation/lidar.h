#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "simulation/ray_grid.h"
#include "simulation/sensor_fault.h"
#include "world/robot_model.h"

namespace mocha {

/// One sweep: beam i was measured at start_time_s + i * the lidar's time increment.
struct Scan {
  double start_time_s;
  std::vector<float>
      ranges_m;  ///< infinity: no return; 0: something nearer than the lidar can measure
};

/// A planar lidar that sweeps counter-clockwise, from the smallest angle to the largest.
class Lidar {
 public:
  /// What the lidar needs to know about the time of a sweep.
  struct Scene {
    const RayGrid& walls;
    std::function<Pose(double time_s)> base_at;  ///< of the robot that carries the lidar
    std::function<std::vector<Obstacle>(double time_s)>
        moving_at;  ///< everything else that the beams may meet
  };

  Lidar(const LidarModel& model, std::uint64_t seed);

  double angle_min_rad() const { return angle_min_; }
  double angle_increment_rad() const { return angle_increment_; }
  double time_increment_s() const { return time_increment_; }

  /// How it lies from the next sweep on.
  void set_fault(const LidarFault& fault) { fault_ = fault; }

  /// The sweep that begins at `start_time_s`.
  Scan sweep(double start_time_s, const Scene& scene);

 private:
  Scan measure(double start_time_s, const Scene& scene);
  float measured(double length_m);

  LidarModel model_;
  LidarFault fault_;
  std::vector<float> newest_m_;  // ranges of the newest sweep; empty before
  double angle_min_;
  double angle_increment_;
  double time_increment_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_;
  std::uniform_real_distribution<double> chance_;
};

}  // namespace mocha
