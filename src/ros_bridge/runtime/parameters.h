#pragma once

#include <ros/node_handle.h>

#include <string>

#include "config/parameter_table.h"
#include "world/robot_model.h"

namespace mocha {

/// The parameters of one node: declared in `config/<schema>.yaml` of this package, set in the
/// node's private namespace. Throws ParameterError for a private parameter that the schema does not
/// declare, has the wrong type or is out of range.
ParameterTable read_parameters(const ros::NodeHandle& private_node, const std::string& schema);

/// The same of another node of this node's robot: what is set for it so far, and defaults.
ParameterTable neighbour_parameters(const std::string& node);

/// The parameters of this node, of that schema. Throws ParameterError also where they cannot work
/// together with its neighbours', as check_timing() says.
ParameterTable checked_parameters(const std::string& node);

/// The model of a robot: config/robots/<model>.yaml, and over it what is set in the namespace
/// `values` (`/ugv1/robot`), such as the footprint that a world file gives this robot. Throws
/// ParameterError.
RobotModel read_robot_model(const ros::NodeHandle& values, const std::string& model);

/// The same of this node's robot: `robot_model` of its parameters, and `robot` in its namespace.
RobotModel own_robot_model(const ParameterTable& parameters);

/// Absolute path of a file below this package's `config/`, in devel and install space.
std::string config_path(const std::string& relative);

}  // namespace mocha
