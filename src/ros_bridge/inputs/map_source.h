#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "world/distance_field.h"

namespace mocha {

/// The newest of the maps that come in, and distance fields of it.
class NewestMap {
 public:
  /// Maps must be in `frame`. Unusable ones are refused and counted.
  explicit NewestMap(std::string frame);

  void on_map(const nav_msgs::OccupancyGrid& map);

  bool available() const { return grid_.width > 0; }
  /// Counts up with every map that differs from the one before.
  int revision() const { return revision_; }
  /// Since the stamp of the newest map [s]; infinity before the first.
  double age_s(ros::Time now) const;
  int refused() const { return refused_; }

  /// Distances on the newest map, grown to hold the points with a border. Points so far away that
  /// this would take tens of millions of cells are left out. The last result is kept while map,
  /// points and `solid` allow.
  std::shared_ptr<const DistanceField> field(DistanceField::Solid solid,
                                             const std::vector<Vector2>& points, double border_m);

 private:
  struct Kept {
    std::shared_ptr<const DistanceField> field;
    int revision = -1;
  };
  bool within_reach(const Vector2& point, double border_m) const;

  std::string frame_;
  OccupancyGrid grid_;
  ros::Time stamp_;
  int revision_ = 0;
  int refused_ = 0;
  Kept kept_[2];  // one for each kind of solid
};

/// The newest map of this node's robot, from `map`.
class MapSource : public NewestMap {
 public:
  MapSource(ros::NodeHandle& node, std::string frame);

 private:
  ros::Subscriber maps_;
};

}  // namespace mocha
