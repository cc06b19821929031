#pragma once

#include <map>
#include <vector>

#include "benchmarks/space_time_solver.h"
#include "simulation/ray_grid.h"
#include "world/world_file.h"

namespace mocha {

/// What is kept from a mover beyond its true disc, on top of what the solver keeps.
struct PredictionMargin {
  double now_m;       ///< from where it is seen
  double growth_mps;  ///< by so much more with each second since then
  double most_growth_m;
};

/// What the lidar of a world's first robot has seen of the movers so far, and nothing else. A
/// mover that a beam meets is known at once with its true place, radius and velocity. One that is
/// out of view is taken to go on at the velocity last seen, until the lidar sees that it is not
/// there, or for 3 s.
class MoverSightings {
 public:
  explicit MoverSightings(const World& world);

  /// Looks, at times that ascend.
  void look(double time_s, const Pose& base);
  /// The movers known, for a robot of `robot_radius_m` at `place` at the time of the last look. Of
  /// one that is already nearer than the margin it only has to keep as it is.
  std::vector<MovingDisc> predicted(const PredictionMargin& margin, const Vector2& place,
                                    double robot_radius_m) const;
  /// By their number in the world.
  bool knows(int mover) const { return known_.count(mover) > 0; }

 private:
  struct Sighting {
    double time_s;
    Vector2 centre;
    Vector2 velocity;
    double radius_m;

    Vector2 centre_at(double t) const { return centre + (t - time_s) * velocity; }
  };
  struct Beam {
    Vector2 direction;
    double range_m;
  };

  std::vector<Beam> sweep(double time_s, const Pose& base, const Vector2& sensor);
  void forget(double time_s, const Vector2& sensor, const std::vector<Beam>& beams);

  const World& world_;
  const LidarModel& lidar_;
  RayGrid walls_;
  double looked_s_ = 0.0;
  std::map<int, Sighting> known_;
};

}  // namespace mocha
