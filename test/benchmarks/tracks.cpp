// Follows what moves in the laser scans of a bag and prints, as JSON, the map, the hits on moving
// things and their tracks, for scripts/plots tracks.

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "perception/sensor/range_smoothing.h"
#include "perception/tracking/moving_object_filter.h"
#include "ros_bridge/messages/sensor_conversions.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

using Mounts = std::map<std::string, Eigen::Isometry3d>;

/// From "frame:x,y,yaw" [m, rad].
Mounts::value_type parse_mount(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  std::istringstream numbers(colon == std::string::npos ? "" : text.substr(colon + 1));
  double x, y, yaw;
  char comma1, comma2;
  if (!(numbers >> x >> comma1 >> y >> comma2 >> yaw) || comma1 != ',' || comma2 != ',')
    throw std::runtime_error("a mount is FRAME:X,Y,YAW, not " + text);
  return {text.substr(0, colon),
          Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())};
}

/// One row of numbers of a JSON list.
void print(bool& first, std::initializer_list<double> numbers) {
  std::cout << (first ? "" : ",\n") << "[";
  const char* comma = "";
  for (double number : numbers) {
    std::cout << comma << number;
    comma = ", ";
  }
  std::cout << "]";
  first = false;
}

struct Sighted {
  double time_s;
  Vector2 end;
};

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) throw std::runtime_error("usage: CONFIG BAG [FRAME:X,Y,YAW ...]");
  Mounts mounts;
  for (std::size_t i = 2; i < arguments.size(); ++i) mounts.insert(parse_mount(arguments[i]));
  const auto values = ParameterTable::from_schema(arguments[0] + "/perception.yaml");
  MovingObjectFilter filter(MovingObjectFilterOptions::from(values));
  OccupancyMap map(OccupancyMapOptions::from(
      values, load_robot_model(arguments[0], values.text("robot_model")).map_resolution_m));
  std::vector<Sighted> hits;
  double begin_s = 0.0;
  bool first = true;
  std::cout << "{\"tracks\": [";  // [id, time, x, y, vx, vy, radius]
  rosbag::Bag bag(arguments[1]);
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    const auto scan = message.instantiate<sensor_msgs::LaserScan>();
    if (!scan) continue;
    const auto mount = mounts.find(scan->header.frame_id);
    const Eigen::Isometry3d pose =
        mount == mounts.end() ? Eigen::Isometry3d::Identity() : mount->second;
    auto beams = to_beams(smoothed(from_message(*scan), values.number("smoothing_reach")),
                          {pose, pose}, {30.0, 10.0});
    filter.sort(beams, map);
    map.insert_scan(beams);
    const double end_s = from_message(*scan).end_time_s();
    if (begin_s == 0.0) begin_s = end_s;
    for (const Beam& beam : beams) {
      if (beam.kind == BeamEnd::kIgnored)
        hits.push_back({beam.time_s - begin_s, beam.end.head<2>()});
    }
    for (const TrackedObstacle& thing : filter.moving(end_s)) {
      print(first, {static_cast<double>(thing.id), thing.time_s - begin_s, thing.position.x(),
                    thing.position.y(), thing.velocity.x(), thing.velocity.y(), thing.radius_m});
    }
  }
  std::cout << "],\n\"hits\": [";
  first = true;
  for (const Sighted& hit : hits) print(first, {hit.time_s, hit.end.x(), hit.end.y()});
  std::cout << "],\n\"walls\": [";
  first = true;
  for (const Eigen::Vector3f& cell : map.occupied_voxels()) print(first, {cell.x(), cell.y()});
  std::cout << "],\n\"resolution\": " << map.options().resolution_m << "}\n";
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  try {
    mocha::run({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
