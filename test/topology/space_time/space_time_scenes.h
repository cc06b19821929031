#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "topology/space_time/space_time_paths.h"
#include "topology/static_map/primitive_static_map.h"

namespace mocha {

inline PrimitiveStaticMap static_map_of(std::vector<Obstacle> obstacles) {
  return {std::make_shared<PrimitiveField<2>>(std::move(obstacles), 1.0),
          Eigen::AlignedBox2d(Vector2(-20.0, -20.0), Vector2(20.0, 20.0))};
}

/// Two walls along x.
inline std::vector<Obstacle> corridor(double half_width_m) {
  std::vector<Obstacle> walls;
  for (const double side : {-1.0, 1.0}) {
    const double near = side * half_width_m;
    const double far = side * (half_width_m + 0.2);
    walls.push_back(Polygon{{{-19.0, near}, {19.0, near}, {19.0, far}, {-19.0, far}}});
  }
  return walls;
}

inline MovingThing person(double now_s, const Vector2& centre, const Vector2& velocity,
                          double keep_m = 0.5, double until_s = 1e18) {
  return {std::make_shared<PredictedDisc>("person", now_s, centre, velocity, 0.25, 0.02), keep_m,
          until_s};
}

/// How much room a path has, less what is required, sampled every `step_s`: from the static map,
/// and from the true discs.
struct Room {
  double still_m = 1e9;
  double moving_m = 1e9;
};
inline Room sampled_room(const TimedPath& path, const StaticMap& static_map,
                         const std::vector<MovingThing>& moving, double required_m,
                         double step_s = 0.01) {
  Room room;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double span_s = path[i].time_s - path[i - 1].time_s;
    const int steps = 1 + static_cast<int>(span_s / step_s);
    for (int k = 0; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      const Vector2 p = path[i - 1].position + share * (path[i].position - path[i - 1].position);
      const double t = path[i - 1].time_s + share * span_s;
      room.still_m = std::min(room.still_m, static_map.field().sample(p).distance_m - required_m);
      for (const MovingThing& thing : moving) {
        if (t > thing.until_s) continue;
        const auto disc = thing.obstacle->at(t);
        room.moving_m =
            std::min(room.moving_m, (p - disc.centre).norm() - disc.radius_m - thing.keep_m);
      }
    }
  }
  return room;
}

/// From start to goal, forward in time, and never too fast.
inline void expect_drivable(const TimedPath& path, const SpaceTimeQuery& query, double max_speed) {
  ASSERT_GE(path.size(), 2u);
  EXPECT_EQ(path.front().position, query.start.position);
  EXPECT_EQ(path.front().time_s, query.start.time_s);
  EXPECT_EQ(path.back().position, query.goal.position);
  EXPECT_EQ(path.back().time_s, query.goal.time_s);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double span_s = path[i].time_s - path[i - 1].time_s;
    ASSERT_GT(span_s, 0.0);
    EXPECT_LE((path[i].position - path[i - 1].position).norm(),
              (1.0 + 1e-6) * max_speed * span_s + 1e-6);
  }
}

}  // namespace mocha
