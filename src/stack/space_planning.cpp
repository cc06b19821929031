#include "stack/space_planning.h"

#include <yaml-cpp/yaml.h>

#include <string>
#include <utility>
#include <vector>

#include "perception/mapping/voxel_map_file.h"

namespace mocha {
namespace {

/// Of "[x, y, z, x, y, z]", the lowest corner first; empty for an empty text.
Eigen::AlignedBox3d bounds_of(const std::string& text) {
  if (text.empty()) return {};
  std::vector<double> numbers;
  try {
    numbers = YAML::Load(text).as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    numbers.clear();
  }
  Eigen::AlignedBox3d box;
  if (numbers.size() == 6)
    box = {Eigen::Vector3d(numbers[0], numbers[1], numbers[2]),
           Eigen::Vector3d(numbers[3], numbers[4], numbers[5])};
  if (!box.min().allFinite() || !box.max().allFinite() || !(box.sizes().minCoeff() > 0.0))
    throw ParameterError("bounds = " + text +
                         ": expected [x, y, z, x, y, z], the lowest corner and the highest one");
  return box;
}

}  // namespace

std::unique_ptr<SpacePlanner> make_space_planner(const ParameterTable& values,
                                                 const Eigen::AlignedBox3d& held,
                                                 std::function<double()> now_s) {
  const VoxelGrid grid =
      load_voxel_map(values.text("map_file"), {bounds_of(values.text("bounds")), held});
  const auto solid = values.text("unknown") == "solid"
                         ? VoxelDistanceField::Solid::kOccupiedOrUnknown
                         : VoxelDistanceField::Solid::kOccupied;
  return std::make_unique<SpacePlanner>(std::make_shared<VoxelDistanceField>(grid, solid),
                                        SpacePlannerOptions::from(values), std::move(now_s));
}

}  // namespace mocha
