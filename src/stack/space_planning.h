#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>

#include "config/parameter_table.h"
#include "planning/space/space_planner.h"

namespace mocha {

/// A planner in the map that the parameters of config/space_planner.yaml name. Where they give no
/// bounds, the map reaches as far as the file knows, and `held` [m]. `now_s` is that of
/// SpacePlanner.
///
/// Throws MapError for a map that cannot be used, ParameterError for bounds that are none.
std::unique_ptr<SpacePlanner> make_space_planner(const ParameterTable& values,
                                                 const Eigen::AlignedBox3d& held,
                                                 std::function<double()> now_s);

}  // namespace mocha
