#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "topology/static_map/connectivity.h"
#include "topology/static_map/obstacle_group.h"
#include "world/obstacle_field.h"

namespace mocha {

class MapSkeleton;
struct TravelOptions;

/// Static surroundings as searches for paths see them.
class StaticMap {
 public:
  virtual ~StaticMap() = default;

  virtual const ObstacleField<2>& field() const = 0;
  /// Paths are searched inside of it [m, map frame].
  virtual const Eigen::AlignedBox2d& bounds() const = 0;
  /// Whatever is smaller than this does not show [m]: half a cell of a map.
  virtual double detail_m() const = 0;
  /// What is connected for a centre that keeps `clearance_m` >= 0, on a map that can tell without a
  /// search.
  virtual std::optional<Connectivity> connectivity(double) const { return std::nullopt; }

  /// The skeleton of its free space for a robot, on a map that keeps one; else null.
  virtual std::shared_ptr<const MapSkeleton> skeleton(const TravelOptions&) const {
    return nullptr;
  }

  /// The obstacles, for a robot whose centre keeps `clearance_m` > 0. Nowhere can it pass between
  /// two parts of one group; whether it can pass between two groups, the field says.
  std::vector<ObstacleGroup> groups(double clearance_m) const {
    return groups_within(bounds(), clearance_m);
  }
  /// Likewise for paths that stay inside of `window`, at the cost of what is there: obstacles that
  /// only meet outside of it are two.
  virtual std::vector<ObstacleGroup> groups_within(const Eigen::AlignedBox2d& window,
                                                   double clearance_m) const = 0;
};

}  // namespace mocha
