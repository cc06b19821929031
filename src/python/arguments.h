#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "config/parameter_table.h"
#include "world/goal.h"
#include "world/moving/tube.h"
#include "world/occupancy_grid.h"

namespace mocha {

// What callers in Python hand over, checked. All throw std::invalid_argument, of which pybind11
// makes a ValueError, naming the argument and what is wrong with it.

/// `cells`: a 2-D array of integers, as nav_msgs/OccupancyGrid has them: -1, or 0 to 100 per cent;
/// its first row is the lowest one. `origin`: (x, y) of its lower left corner.
OccupancyGrid to_grid(const pybind11::object& cells, double resolution_m,
                      const pybind11::object& origin);
/// Of (x, y, yaw).
Pose to_start(const pybind11::object& start);
/// Of (x, y) or (x, y, yaw).
Goal to_goal(const pybind11::object& goal);
/// Of (x, y, z), the argument `name`.
Eigen::Vector3d to_place(const char* name, const pybind11::object& place);
/// Of (x, y, z, vx, vy, vz, radius), in the argument `name`.
Tube<3> to_ball(const char* name, const pybind11::object& ball);
/// Sets the values of a dictionary by name. What the table refuses, it throws as ParameterError.
void assign(const pybind11::dict& parameters, ParameterTable& values);

}  // namespace mocha
