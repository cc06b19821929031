#include "topology/space/obstacle_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "topology/space/voxel_cycles.h"
#include "topology/space/voxel_thinning.h"

namespace mocha {
namespace {

constexpr double kStepCells = 0.25;  // between the places where a straight line is looked at
constexpr double kOutside_m = 1.0;   // beyond the map, where curves go on

using Points = std::vector<Eigen::Vector3d>;

class CurveMaker {
 public:
  explicit CurveMaker(const SolidVoxels& voxels)
      : voxels_(voxels),
        highest_(voxels.origin + voxels.resolution_m * voxels.size.cast<double>()) {}

  Cuts<3>::Curve curve_of(const VoxelChain& chain) const {
    if (const auto column = column_of(chain)) return *column;
    Points points;
    for (const int number : chain.voxels) points.push_back(voxels_.centre(voxels_.voxel(number)));
    if (chain.is_closed) return Loop{straightened_loop(std::move(points))};
    Points corners = straightened(points);
    Points way_in = way_out(chain.voxels.front());
    std::reverse(way_in.begin(), way_in.end());
    corners.insert(corners.begin(), way_in.begin(), way_in.end());
    const Points last = way_out(chain.voxels.back());
    corners.insert(corners.end(), last.begin(), last.end());
    return Arch{std::move(corners)};
  }

 private:
  /// An upright line that is solid from bottom to top, and into which the chain can be moved
  /// sideways through solid matter, if it leads from one to the other.
  std::optional<Column> column_of(const VoxelChain& chain) const {
    Eigen::Vector3i low = voxels_.voxel(chain.voxels.front());
    Eigen::Vector3i high = voxels_.voxel(chain.voxels.back());
    if (low.z() > high.z()) std::swap(low, high);
    if (chain.is_closed || low.z() != 0 || high.z() != voxels_.size.z() - 1) return std::nullopt;
    for (const int number : chain.voxels) {
      Eigen::Vector3i at = voxels_.voxel(number);
      const Eigen::Vector3d foot = voxels_.centre(at);
      bool is_solid = true;
      for (at.z() = 0; is_solid && at.z() < voxels_.size.z(); ++at.z())
        is_solid = voxels_.solid[voxels_.number(at)] == 1;
      if (is_solid && is_beside(chain, foot.head<2>())) return Column{foot.head<2>()};
    }
    return std::nullopt;
  }

  bool is_beside(const VoxelChain& chain, const Eigen::Vector2d& foot) const {
    return std::all_of(chain.voxels.begin(), chain.voxels.end(), [&](int number) {
      const Eigen::Vector3d from = voxels_.centre(voxels_.voxel(number));
      return is_solid_between(from, {foot.x(), foot.y(), from.z()});
    });
  }

  /// From a voxel at the rim of the map to where no path is above or below: straight out where that
  /// is to a side or up, and below the map to the nearest side.
  Points way_out(int number) const {
    const Eigen::Vector3i voxel = voxels_.voxel(number);
    const Eigen::Vector3d from = voxels_.centre(voxel);
    if (voxel.z() == voxels_.size.z() - 1) return {{from.x(), from.y(), highest_.z() + kOutside_m}};
    Points way;
    Eigen::Vector3d below = from;
    const bool is_at_side = (voxel.head<2>().array() == 0).any() ||
                            (voxel.head<2>().array() == voxels_.size.head<2>().array() - 1).any();
    if (!is_at_side) {
      below.z() = voxels_.origin.z() - kOutside_m;
      way.push_back(below);
    }
    const std::array<double, 4> to_sides = {from.x() - voxels_.origin.x(), highest_.x() - from.x(),
                                            from.y() - voxels_.origin.y(), highest_.y() - from.y()};
    const auto side = std::min_element(to_sides.begin(), to_sides.end()) - to_sides.begin();
    const double away_m = to_sides[side] + kOutside_m;
    below[side / 2] += side % 2 == 0 ? -away_m : away_m;
    way.push_back(below);
    return way;
  }

  bool is_solid_between(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const {
    const int steps = 1 + static_cast<int>((q - p).norm() / (kStepCells * voxels_.resolution_m));
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector3d at = p + (q - p) * i / steps;
      if (voxels_.solid[voxels_.number(voxels_.voxel_at(at))] == 0) return false;
    }
    return true;
  }

  /// With fewer corners, from the first to the last of them. A corner sees all that is left out up
  /// to the next one through solid matter, so the curve can be moved there.
  Points straightened(const Points& points) const {
    Points corners = {points.front()};
    for (std::size_t at = 0; at + 1 < points.size();) {
      std::size_t next = at + 1;
      while (next + 1 < points.size() && is_solid_between(points[at], points[next + 1])) ++next;
      corners.push_back(points[next]);
      at = next;
    }
    return corners;
  }

  /// In three parts, so that it remains a loop.
  Points straightened_loop(Points points) const {
    points.push_back(points.front());
    Points corners;
    for (std::size_t part = 0; part < 3; ++part) {
      const auto from =
          points.begin() + static_cast<std::ptrdiff_t>(part * (points.size() - 1) / 3);
      const auto to =
          points.begin() + static_cast<std::ptrdiff_t>((part + 1) * (points.size() - 1) / 3);
      const Points some = straightened(Points(from, to + 1));
      corners.insert(corners.end(), some.begin(), some.end() - 1);
    }
    return corners;
  }

  const SolidVoxels& voxels_;
  const Eigen::Vector3d highest_;
};

}  // namespace

ObstacleCurves obstacle_curves(const SolidVoxels& voxels) {
  SolidVoxels thinned = voxels;
  thin_solid(thinned);
  const VoxelCycles cycles = voxel_cycles(thinned);
  const CurveMaker maker(voxels);
  ObstacleCurves found{{}, cycles.bodies, cycles.surface_voxels};
  for (const VoxelChain& chain : cycles.chains) found.curves.push_back(maker.curve_of(chain));
  return found;
}

}  // namespace mocha
