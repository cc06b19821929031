#pragma once

#include <mocha_ugv/LoadMap.h>
#include <mocha_ugv/SaveMap.h>
#include <ros/node_handle.h>
#include <std_srvs/Empty.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>
#include <vector>

#include "perception/mapping/occupancy_map.h"

namespace mocha {

/// The services `save_map`, `load_map`, `clear_map` and `move_base/clear_costmaps`, which is the
/// same as move_base has it. Relative paths count from where the node runs, which its user does not
/// know: answers name whole ones.
class MapFiles {
 public:
  /// `replaced` is told of another map; `is_cleared`: of an empty one. The map must outlive this.
  MapFiles(ros::NodeHandle& node, OccupancyMap& map, std::function<void(bool is_cleared)> replaced);

  /// Returns in words what was done. Throws MapError.
  std::string load(const std::string& path);

 private:
  bool on_save(mocha_ugv::SaveMap::Request& request, mocha_ugv::SaveMap::Response& response);
  bool on_load(mocha_ugv::LoadMap::Request& request, mocha_ugv::LoadMap::Response& response);
  bool on_clear(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_clear_costmaps(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);

  OccupancyMap& map_;
  std::function<void(bool)> replaced_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace mocha
