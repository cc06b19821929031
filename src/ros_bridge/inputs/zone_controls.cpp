#include "ros_bridge/inputs/zone_controls.h"

#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/zone_conversions.h"
#include "ros_bridge/rviz/zone_drawing.h"
#include "trajectory/stopping.h"
#include "world/world_file.h"

namespace mocha {
namespace {

constexpr double kLook_s = 0.5;      // between looks at where the robot is and at the file
constexpr double kReaction_s = 0.7;  // until a robot begins to brake for a zone
constexpr double kStep_s = 0.05;     // between poses of its braking
constexpr double kOff_m = 0.5;       // farther from its promise, it brakes from where it is

std::filesystem::file_time_type time_of(const std::string& file) {
  std::error_code error;
  return std::filesystem::last_write_time(file, error);
}

}  // namespace

ZoneControls::ZoneControls(ros::NodeHandle& node, const RobotIdentity& robot,
                           const RobotModel& model, const ParameterTable& values)
    : robot_(robot),
      braking_(model.braking()),
      file_(values.text("keep_out_file")),
      written_(time_of(file_)),
      keep_out_(model),
      committed_(node, robot.name),
      states_(node.advertise<mocha_ugv::Zones>("zones", 1, true)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("zone_markers", 2, true)),
      calls_(node.advertiseService("set_zones", &ZoneControls::on_set, this)) {
  const std::string& in_force = values.text("zones_in_force");
  if (!in_force.empty()) {
    zones_ = parse_zones(in_force, "zones_in_force");
  } else if (!file_.empty()) {
    zones_ = load_zones(file_);
  }
  keep_out_.set(kept_out_of(zones_));
}

bool ZoneControls::on_set(mocha_ugv::SetZones::Request& request,
                          mocha_ugv::SetZones::Response& response) {
  try {
    if (!request.path.empty() && !request.zones.empty())
      throw std::invalid_argument("a path and a list of zones: give either");
    const auto written = time_of(request.path);
    set(request.path.empty() ? from_message(request.zones) : load_zones(request.path));
    file_ = request.path;
    written_ = written;
    response.success = true;
    response.message = std::to_string(zones_.size()) + " zones in force";
  } catch (const std::exception& error) {
    response.success = false;
    response.message = error.what();
    ROS_ERROR("%s: zones are refused, those before stay in force: %s", robot_.name.c_str(),
              error.what());
  }
  return true;
}

void ZoneControls::set(Zones zones) {
  zones_ = std::move(zones);
  keep_out_.set(kept_out_of(zones_));
  ros::NodeHandle("~").setParam("zones_in_force", to_yaml(zones_));
  inside_ = nullptr;
  are_new_ = true;
  ROS_INFO("%s: %zu zones in force", robot_.name.c_str(), zones_.size());
}

/// What is written to the file comes into force; what is wrong there is said once.
void ZoneControls::follow_file() {
  const auto written = time_of(file_);
  if (file_.empty() || written == written_) return;
  written_ = written;
  try {
    set(load_zones(file_));
    trouble_.clear();
  } catch (const std::exception& error) {
    trouble_ = error.what();
    ROS_ERROR("%s: zones are refused, those before stay in force: %s", robot_.name.c_str(),
              error.what());
  }
}

/// From where the robot is to where it can stop.
std::vector<Pose> ZoneControls::course_from(const Pose& base, ros::Time now) const {
  const Motion& committed = committed_.motion();
  std::vector<Pose> course = {base};
  const double now_s = now.toSec();
  if (committed.empty() || (committed.position(now_s) - base.position).norm() > kOff_m)
    return course;
  const double brakes_s = committed.switch_time(now_s + kReaction_s);
  const Motion stop(brakes_s, brake_along(committed, brakes_s, braking_));
  for (double t = now_s; t < brakes_s; t += kStep_s) course.push_back(committed.at(t).pose);
  for (double t = brakes_s; t < stop.end_time(); t += kStep_s) course.push_back(stop.at(t).pose);
  course.push_back(stop.end_pose());
  return course;
}

void ZoneControls::step(ros::Time now, const std::optional<Pose>& base, const OccupancyMap& map,
                        MapOutputs& maps) {
  const bool looks = are_new_ || now < looked_ || (now - looked_).toSec() >= kLook_s;
  if (!looks) return;
  looked_ = now;
  follow_file();
  if (base) {
    keep_out_.look(course_from(*base, now), map);
    inside_ = keep_out_zone_at(zones_, base->position);
  }
  if (std::exchange(are_new_, false)) since_ = now;
  if (keep_out_.version() == shown_) return;
  shown_ = keep_out_.version();
  maps.mark(keep_out_.areas(), keep_out_.open());
  publish();
}

void ZoneControls::publish() {
  mocha_ugv::Zones message;
  message.header.stamp = since_;
  message.header.frame_id = robot_.map_frame;
  to_message(zones_, message);
  std::vector<Vector2> exit;
  if (keep_out_.leads_out()) exit = keep_out_.open().path;
  for (const Vector2& place : exit) {
    message.exit.emplace_back();
    message.exit.back().x = place.x();
    message.exit.back().y = place.y();
  }
  states_.publish(message);
  Drawing drawing(robot_.map_frame, ros::Time());
  draw_zones(zones_, exit, drawing);
  drawings_.publish(drawing.markers());
}

void ZoneControls::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const bool is_open = !keep_out_.open().path.empty();
  const std::string zone = inside_ ? "keep-out zone `" + inside_->name + "`" : "a keep-out zone";
  if (!trouble_.empty()) {
    status.summary(DiagnosticStatus::ERROR, "those before stay in force: " + trouble_);
  } else if (is_open && !keep_out_.leads_out()) {
    status.summary(DiagnosticStatus::ERROR, "the robot is in " + zone + ", and has no way out");
  } else if (is_open) {
    status.summary(DiagnosticStatus::WARN, "the robot is in " + zone + ", and is to leave it");
  } else {
    status.summary(DiagnosticStatus::OK, zones_.empty() ? "no zones" : "in force");
  }
  for (const Zone& each : zones_)
    status.add(each.name, each.keeps_out() ? "keep out" : std::to_string(each.max_speed) + " m/s");
}

}  // namespace mocha
