#include "world/robot_values.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace mocha {
namespace {

LidarModel read_lidar(const ParameterTable& values) {
  LidarModel lidar;
  lidar.mount.position = {values.number("lidar_x"), values.number("lidar_y")};
  lidar.mount.yaw_rad = values.number("lidar_yaw");
  lidar.height_m = values.number("lidar_z");
  lidar.field_of_view_rad = values.number("lidar_field_of_view");
  lidar.beams = values.integer("lidar_beams");
  lidar.min_range_m = values.number("lidar_min_range");
  lidar.max_range_m = values.number("lidar_max_range");
  lidar.rate_hz = values.number("lidar_rate");
  lidar.sweep_time_s = values.number("lidar_sweep_time");
  lidar.noise_m = values.number("lidar_noise");
  lidar.dropout = values.number("lidar_dropout");
  return lidar;
}

/// "[[x, y], ...]", as costmap_2d takes it. Throws std::invalid_argument.
std::vector<Vector2> read_corners(const std::string& text) {
  try {
    std::vector<Vector2> corners;
    for (const auto& corner : YAML::Load(text).as<std::vector<std::array<double, 2>>>())
      corners.emplace_back(corner[0], corner[1]);
    return corners;
  } catch (const YAML::Exception&) {
    throw std::invalid_argument("expected \"[[x, y], [x, y], ...]\"");
  }
}

Footprint read_footprint(const ParameterTable& values) {
  if (values.text("footprint") == "disc") return Footprint::disc(values.number("footprint_radius"));
  if (values.text("footprint") == "rectangle")
    return Footprint::rectangle(values.number("footprint_length"),
                                values.number("footprint_width"));
  return Footprint::polygon(read_corners(values.text("footprint_corners")));
}

void check_turning_in_place(const ParameterTable& values, const std::string& path) {
  const double radius_m = values.number("min_turning_radius");
  if (radius_m == 0.0) return;
  std::ostringstream message;
  message << path << ": min_turning_radius = " << radius_m
          << " m: mocha_ugv plans for bases that turn in place (0 m); car-like bases are not "
             "supported";
  throw ParameterError(message.str());
}

void check_margins(const ParameterTable& values, const std::string& source) {
  const auto check = [&](const char* name, double still_m, double fast_m) {
    if (still_m <= fast_m) return;
    std::ostringstream message;
    message << source << ": " << name << "_still = " << still_m << " m is above " << name << " = "
            << fast_m << " m";
    throw ParameterError(message.str());
  };
  check("margin_tracking", values.number("margin_tracking_still"),
        values.number("margin_tracking"));
  check("margin_map", values.number("margin_map_still"), values.number("margin_map"));
}

void check_wheels(const RobotModel& model, const std::string& path) {
  const MotionLimits& limits = model.limits;
  const auto check = [&](const char* name, double needed) {
    if (needed <= limits.max_wheel_speed) return;
    std::ostringstream message;
    message << path << ": " << name << " needs wheels of " << needed
            << " m/s, but max_wheel_speed = " << limits.max_wheel_speed;
    throw ParameterError(message.str());
  };
  check("max_speed", limits.max_speed);
  check("max_yaw_rate", 0.5 * limits.track_m * limits.max_yaw_rate);
}

void check_emergency(const RobotModel& model, const std::string& path) {
  const double least = model.limits.max_acceleration;
  const double most = model.max_wheel_acceleration;
  if (model.emergency_acceleration >= least && model.emergency_acceleration <= most) return;
  std::ostringstream message;
  message << path << ": emergency_acceleration = " << model.emergency_acceleration
          << " m/s^2 is not between max_acceleration = " << least
          << " and max_wheel_acceleration = " << most;
  throw ParameterError(message.str());
}

void check_lidar(const LidarModel& lidar, const std::string& path) {
  std::ostringstream message;
  if (lidar.min_range_m >= lidar.max_range_m) {
    message << path << ": lidar_min_range = " << lidar.min_range_m
            << " m is not below lidar_max_range = " << lidar.max_range_m << " m";
    throw ParameterError(message.str());
  }
  constexpr double kRounding_s = 1e-6;
  if (lidar.sweep_time_s > 1.0 / lidar.rate_hz + kRounding_s) {
    message << path << ": lidar_sweep_time = " << lidar.sweep_time_s
            << " s is longer than a sweep may take at lidar_rate = " << lidar.rate_hz << " Hz";
    throw ParameterError(message.str());
  }
}

}  // namespace

bool is_path_of_model(const std::string& model) {
  constexpr std::string_view kEnding = ".yaml";
  return model.size() > kEnding.size() &&
         model.compare(model.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
}

std::string robot_values_file(const std::string& config_directory, const std::string& model) {
  if (is_path_of_model(model)) return model;
  return config_directory + "/robots/" + model + ".yaml";
}

ParameterTable load_robot_values(const std::string& config_directory, const std::string& model) {
  ParameterTable values = ParameterTable::from_schema(config_directory + "/robot.yaml");
  values.assign_file(robot_values_file(config_directory, model));
  return values;
}

RobotModel robot_model_of(const ParameterTable& values, const std::string& name,
                          const std::string& source) {
  check_turning_in_place(values, source);
  check_margins(values, source);
  RobotModel robot;
  robot.name = name;
  robot.limits = {values.number("max_speed"),       values.number("max_acceleration"),
                  values.number("max_yaw_rate"),    values.number("max_yaw_acceleration"),
                  values.number("max_wheel_speed"), values.number("track"),
                  values.flag("can_reverse")};
  robot.max_wheel_acceleration = values.number("max_wheel_acceleration");
  robot.emergency_acceleration = values.number("emergency_acceleration");
  robot.actuator_lag_s = values.number("actuator_lag");
  robot.cmd_timeout_s = values.number("cmd_timeout");
  try {
    robot.footprint = read_footprint(values);
  } catch (const std::invalid_argument& error) {
    throw ParameterError(source + ": footprint_corners = " + values.text("footprint_corners") +
                         ": " + error.what());
  }
  robot.lidar = read_lidar(values);
  robot.margins = {values.number("margin_tracking"),
                   values.number("margin_localisation"),
                   values.number("margin_map"),
                   values.number("margin_clock"),
                   values.number("margin_tracking_still"),
                   values.number("margin_map_still")};
  robot.peer_clearance_m = values.number("peer_clearance");
  robot.stops_checked = values.flag("stops_checked");
  robot.peer_reaction_s = values.number("peer_reaction");
  robot.moving_clearance_m = values.number("moving_clearance");
  robot.map_resolution_m = values.number("map_resolution");
  robot.odometry_noise_distance = values.number("odometry_noise_distance");
  robot.odometry_noise_yaw = values.number("odometry_noise_yaw");
  check_wheels(robot, source);
  check_emergency(robot, source);
  check_lidar(robot.lidar, source);
  return robot;
}

}  // namespace mocha
