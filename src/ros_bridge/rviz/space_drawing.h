#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "planning/space/space_plan.h"
#include "topology/space/obstacle_curves.h"
#include "world/distances/voxel_distance_field.h"

namespace mocha {

/// Every candidate in a colour of its own with its cost: the selected one broad, what is not
/// certified faint; and dark the curves by which classes are told apart. It replaces all that was
/// published before on its topic.
visualization_msgs::MarkerArray space_markers(const SpacePlan& plan, const ObstacleCurves& curves,
                                              const VoxelDistanceField& field,
                                              const std::string& frame, ros::Time stamp);

/// The centres of the solid cells that are beside open ones.
sensor_msgs::PointCloud2 solid_cells_message(const VoxelDistanceField& field,
                                             const std::string& frame, ros::Time stamp);

}  // namespace mocha
