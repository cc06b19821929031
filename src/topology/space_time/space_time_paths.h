#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "topology/signatures/h_signature.h"
#include "topology/space_time/timed_path.h"
#include "topology/static_map/static_map.h"
#include "world/moving/moving_obstacle.h"

namespace mocha {

struct SpaceTimeQuery {
  TimedPoint start;
  TimedPoint goal;
  std::vector<MovingThing> moving;
  /// What is being driven; may begin before the start and end elsewhere than at the goal, or be
  /// empty.
  TimedPath driven;
};

struct SpaceTimeOptions {
  double max_speed;             ///< [m/s], above 0
  double required_clearance_m;  ///< to static obstacles, at least 0
  /// Around the start, places that are no closer to static obstacles than the start itself are
  /// allowed.
  double escape_radius_m;
  int samples;           ///< of the roadmap
  std::uint64_t seed;    ///< of the samples
  int classes;           ///< at most this many paths, at least 1
  double longest_ratio;  ///< a path longer than the shortest by this is none, at least 1
};

/// A path of one class, as short as that class allows.
struct SpaceTimePath {
  TimedPath points;  ///< from the start to the goal
  /// Root mean square of the speed, times the duration: the length of a uniform path, more for one
  /// that stands and hurries.
  double length_m;
  Signature signature;  ///< static groups near by first, then what moves in the query's order
  bool driven;          ///< of the class of what is being driven
};

struct SpaceTimePaths {
  enum class Outcome { kFound, kStartBlocked, kGoalBlocked, kNoPath };

  Outcome outcome = Outcome::kNoPath;
  std::vector<SpaceTimePath> paths;  ///< of pairwise different classes, shortest first
};

/// Paths from here and now to there and then, of pairwise different classes, past what stands and
/// what moves (paper V-C; see SpaceTime). The straight line, if it is free, is among them, and so
/// is a path of the class that is being driven, if what is driven, led on to the goal, is free
/// still. All are as short in space-time as their class allows, so their speed is as uniform as can
/// be. Between absolute times, speeds are up to max_speed but for the rounding of the times.
///
/// Where the start or the goal, or their times, are not finite: blocked. Nowhere else do values of
/// the query that are not finite make more of a difference than that their thing is in the way
/// throughout. Throws std::invalid_argument for options out of range.
SpaceTimePaths find_space_time_paths(const StaticMap& static_map, const SpaceTimeQuery& query,
                                     const SpaceTimeOptions& options);

/// The same with cuts that serve several queries: of what stands in the reach of all of them.
SpaceTimePaths find_space_time_paths(const StaticMap& static_map, const Cuts<2>& cuts,
                                     const SpaceTimeQuery& query, const SpaceTimeOptions& options);

/// Around all that can be visited from the start on the way to the goal; empty without time for
/// that.
Eigen::AlignedBox2d reach_of(const SpaceTimeQuery& query, double max_speed);

/// Of the groups of obstacles within reach that paths from `start` are told apart by.
Cuts<2> cuts_within(const StaticMap& static_map, const Eigen::AlignedBox2d& reach,
                    const Vector2& start, const SpaceTimeOptions& options);

}  // namespace mocha
