// Follows what moves in the laser scans of a bag, as the node perception does, and prints, as JSON,
// the map, the hits on moving things, and after each scan what is told of these and where people
// are by the bag's labels; for scripts/bench tracking and scripts/plots tracks. Arguments: a bag,
// the map frame, and FRAME:X,Y,YAW for each lidar of which the bag has no transforms.

#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/bag_perception.h"
#include "benchmarks/world_program.h"

namespace mocha {
namespace {

using Json = nlohmann::json;

/// From "frame:x,y,yaw" [m, rad].
void add_mount(BagPerception& perception, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  std::istringstream numbers(colon == std::string::npos ? "" : text.substr(colon + 1));
  double x, y, yaw;
  char comma1, comma2;
  if (!(numbers >> x >> comma1 >> y >> comma2 >> yaw) || comma1 != ',' || comma2 != ',')
    throw std::runtime_error("a mount is FRAME:X,Y,YAW, not " + text);
  perception.mount(text.substr(0, colon), {{x, y}, yaw});
}

/// Times count from the first scan.
Json to_json(const BagScan& scan, double begin_s) {
  Json json{{"time_s", rounded(scan.end_s - begin_s)},
            {"sensor",
             {rounded(scan.sensor.position.x()), rounded(scan.sensor.position.y()),
              rounded(scan.sensor.yaw_rad)}},
            {"things", Json::array()},
            {"labels", Json::array()}};
  for (const TrackedObstacle& thing : scan.things) {
    if (!thing.is_mover) continue;
    json["things"].push_back({thing.id, rounded(thing.position.x()), rounded(thing.position.y()),
                              rounded(thing.velocity.x()), rounded(thing.velocity.y()),
                              rounded(thing.radius_m), thing.is_seen});
  }
  for (const PersonLabel& label : scan.labels)
    json["labels"].push_back({label.person, rounded(label.place.x()), rounded(label.place.y()),
                              rounded(label.time_s - begin_s), rounded(label.bearing_rad)});
  return json;
}

Json measure(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) throw std::runtime_error("usage: BAG MAP_FRAME [FRAME:X,Y,YAW ...]");
  const rosbag::Bag bag(arguments[0]);
  BagPerception perception(bag, arguments[1]);
  for (std::size_t i = 2; i < arguments.size(); ++i) add_mount(perception, arguments[i]);
  const std::vector<BagScan> scans = perception.run();
  if (scans.empty()) throw std::runtime_error("no scan of the bag has a place in the map frame");
  Json result{{"scans", Json::array()}, {"hits", Json::array()}, {"walls", Json::array()}};
  for (const BagScan& scan : scans) {
    result["scans"].push_back(to_json(scan, scans[0].begin_s));
    for (const Beam& hit : scan.moving_hits)
      result["hits"].push_back(
          {rounded(hit.time_s - scans[0].begin_s), rounded(hit.end.x()), rounded(hit.end.y())});
  }
  for (const Eigen::Vector3f& cell : perception.map().occupied_voxels())
    result["walls"].push_back({rounded(cell.x()), rounded(cell.y())});
  return result;
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  try {
    std::cout << mocha::measure({argv + 1, argv + argc}).dump() << "\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
