#include "topology/space/landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "topology/space/voxel_thinning.h"

namespace mocha {
namespace {

constexpr double kLeastSpacingCells = 2.0;

/// What remains of the open voxels, widest first.
std::vector<int> middle_voxels(const SolidVoxels& voxels) {
  SolidVoxels thinned = voxels;
  thin_open(thinned);
  std::vector<int> middle;
  for (int number = 0; number < static_cast<int>(thinned.solid.size()); ++number) {
    if (thinned.solid[number] == 0) middle.push_back(number);
  }
  std::stable_sort(middle.begin(), middle.end(),
                   [&](int a, int b) { return voxels.distance_m[a] > voxels.distance_m[b]; });
  return middle;
}

/// Places by the cube that they are in.
class PlaceIndex {
 public:
  explicit PlaceIndex(double cube_m) : cube_m_(cube_m) {}

  void add(const Eigen::Vector3d& place, int number) { cubes_[key(cube(place))].push_back(number); }

  /// Calls visit(number) for all places that are within `radius_m`, and others, until it returns
  /// false.
  template <typename Visit>
  void around(const Eigen::Vector3d& place, double radius_m, const Visit& visit) const {
    const Eigen::Vector3i low = cube(place - Eigen::Vector3d::Constant(radius_m));
    const Eigen::Vector3i high = cube(place + Eigen::Vector3d::Constant(radius_m));
    Eigen::Vector3i at;
    for (at.z() = low.z(); at.z() <= high.z(); ++at.z()) {
      for (at.y() = low.y(); at.y() <= high.y(); ++at.y()) {
        for (at.x() = low.x(); at.x() <= high.x(); ++at.x()) {
          const auto found = cubes_.find(key(at));
          if (found == cubes_.end()) continue;
          for (const int number : found->second) {
            if (!visit(number)) return;
          }
        }
      }
    }
  }

 private:
  Eigen::Vector3i cube(const Eigen::Vector3d& place) const {
    return (place / cube_m_).array().floor().matrix().cast<int>();
  }
  static std::int64_t key(const Eigen::Vector3i& cube) {
    return (static_cast<std::int64_t>(cube.x()) * 2097152 + cube.y()) * 2097152 + cube.z();
  }

  const double cube_m_;
  std::unordered_map<std::int64_t, std::vector<int>> cubes_;
};

}  // namespace

Landmarks landmarks(const SolidVoxels& voxels, double clearance_m) {
  Landmarks found;
  const std::vector<int> middle = middle_voxels(voxels);
  if (middle.empty()) return found;
  const double least_m = kLeastSpacingCells * voxels.resolution_m;
  const double most_m = std::max(voxels.distance_m[middle.front()] - clearance_m, least_m);
  PlaceIndex index(most_m);
  std::vector<double> spare_m;  // room beyond the clearance, of each place
  for (const int number : middle) {
    const Eigen::Vector3d place = voxels.centre(voxels.voxel(number));
    const double own_m = std::max(voxels.distance_m[number] - clearance_m, least_m);
    bool is_apart = true;
    index.around(place, own_m, [&](int other) {
      return is_apart = (found.places[other] - place).norm() > own_m;
    });
    if (!is_apart) continue;
    const int next = static_cast<int>(found.places.size());
    index.around(place, own_m + most_m + least_m, [&](int other) {
      const double away_m = (found.places[other] - place).norm();
      if (away_m <= own_m + spare_m[other] + least_m) found.neighbours.emplace_back(other, next);
      return true;
    });
    index.add(place, next);
    found.places.push_back(place);
    spare_m.push_back(own_m);
  }
  return found;
}

}  // namespace mocha
