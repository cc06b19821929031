#pragma once

#include <vector>

#include "perception/mapping/occupancy_map.h"
#include "perception/mapping/zone_exit.h"
#include "world/robot_model.h"

namespace mocha {

/// Areas that a robot is not to enter, and the way out of those in which it is when they come into
/// force: until it has left them, a strip along that way is open, and nothing else of them.
class KeepOut {
 public:
  explicit KeepOut(const RobotModel& robot);

  /// From now on, instead of those there were.
  void set(std::vector<Polygon> areas);

  /// The robot is at the first of these poses and may come to rest at the last: it takes what lies
  /// between in any case where areas have just come into force. At least one pose.
  void look(const std::vector<Pose>& course, const OccupancyMap& map);

  const std::vector<Polygon>& areas() const { return areas_; }
  const Strip& open() const { return open_; }
  /// Whether the open strip leads out.
  bool leads_out() const { return leads_out_; }
  /// Changes whenever areas or the open strip do.
  int version() const { return version_; }

 private:
  double gap_m(const Pose& pose) const;
  void open_way(const std::vector<Pose>& course, const OccupancyMap& map);
  bool is_blocked(const OccupancyMap& map) const;

  const Footprint footprint_;
  const double still_m_;  ///< margin of a robot that stands
  const ExitRoom room_;
  std::vector<Polygon> areas_;
  bool are_new_ = false;
  Strip open_;
  bool leads_out_ = false;
  int version_ = 0;
};

}  // namespace mocha
