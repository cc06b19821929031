#include "ros_bridge/inputs/map_files.h"

#include <utility>

#include "ros_bridge/runtime/file_service.h"

namespace mocha {

MapFiles::MapFiles(ros::NodeHandle& node, OccupancyMap& map, std::function<void(bool)> replaced)
    : map_(map),
      replaced_(std::move(replaced)),
      services_{
          node.advertiseService("save_map", &MapFiles::on_save, this),
          node.advertiseService("load_map", &MapFiles::on_load, this),
          node.advertiseService("clear_map", &MapFiles::on_clear, this),
          node.advertiseService("move_base/clear_costmaps", &MapFiles::on_clear_costmaps, this)} {}

std::string MapFiles::load(const std::string& path) {
  const std::string whole = absolute(path);
  const std::string notes = map_.load(whole);
  if (!notes.empty()) ROS_WARN("loaded %s%s", whole.c_str(), notes.c_str());
  replaced_(false);
  return "loaded " + whole + notes;
}

bool MapFiles::on_save(mocha_ugv::SaveMap::Request& request,
                       mocha_ugv::SaveMap::Response& response) {
  return answer(response, [&] {
    const std::string whole = absolute(request.path);
    map_.save(whole);
    return "saved " + whole;
  });
}

bool MapFiles::on_load(mocha_ugv::LoadMap::Request& request,
                       mocha_ugv::LoadMap::Response& response) {
  return answer(response, [&] { return load(request.path); });
}

bool MapFiles::on_clear(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answer(response, [&]() -> std::string {
    map_.clear();
    replaced_(true);
    return "cleared";
  });
}

bool MapFiles::on_clear_costmaps(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  std_srvs::Trigger call;
  return on_clear(call.request, call.response) && call.response.success;
}

}  // namespace mocha
