#pragma once

#include <limits>
#include <vector>

#include "topology/static_map/static_map.h"
#include "topology/static_map/travel_options.h"

namespace mocha {

/// A disc that must not be entered by the robot's centre, such as a standing team-mate with its
/// margins.
struct BlockedDisc {
  Vector2 centre;
  double radius_m;
};

/// Cost of paths of the robot's centre, per metre at least 1; infinite where it must not be.
class TravelCost {
 public:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  /// `static_map` must live longer. Discs off the map are passed over: no path comes there.
  TravelCost(const StaticMap& static_map, const Vector2& start, std::vector<BlockedDisc> blocked,
             const TravelOptions& options);

  /// Per metre at p, whose distance to obstacles is known.
  double at(const Vector2& p, double distance_m) const;
  double at(const Vector2& p) const { return at(p, static_map_.field().sample(p).distance_m); }

  /// Whether p lies in a blocked disc: in one that holds the start, only closer to its centre.
  bool is_blocked(const Vector2& p) const;

  /// How far p is from the blocked discs [m]; negative inside.
  double blocked_room_m(const Vector2& p) const;

  /// Of the straight line; infinite if it meets a forbidden place.
  double of_line(const Vector2& a, const Vector2& b) const;

  const Vector2& start() const { return start_; }
  const StaticMap& static_map() const { return static_map_; }
  const TravelOptions& options() const { return options_; }
  const std::vector<BlockedDisc>& blocked() const { return blocked_; }

 private:
  bool may_escape(const Vector2& p, double distance_m) const;

  const StaticMap& static_map_;
  const Vector2 start_;
  const double start_clearance_m_;
  const std::vector<BlockedDisc> blocked_;
  const TravelOptions options_;
};

}  // namespace mocha
