#pragma once

#include <string>

#include "config/parameter_table.h"
#include "world/robot_model.h"

namespace mocha {

/// Whether a model is named by the path of its file, which ends in `.yaml`, and not as one of
/// `config/robots`.
bool is_path_of_model(const std::string& model);

/// Where the values of a model are: the path itself, or `<config_directory>/robots/<model>.yaml`.
std::string robot_values_file(const std::string& config_directory, const std::string& model);

/// What stands there, under the schema `<config_directory>/robot.yaml`. Throws ParameterError for
/// unknown models and keys, and for values out of range.
ParameterTable load_robot_values(const std::string& config_directory, const std::string& model);

/// The robot that such values describe; `source`, in errors, is where they came from. Throws
/// ParameterError for a speed or a yaw rate that the wheels cannot deliver, a footprint that is
/// none, sweeps that overlap, and a base that cannot turn in place (min_turning_radius): plans
/// begin, end and change course with turns in place.
RobotModel robot_model_of(const ParameterTable& values, const std::string& name,
                          const std::string& source);

}  // namespace mocha
