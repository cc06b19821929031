#include "world/distances/voxel_distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "world/distances/distance_transform.h"

namespace mocha {
namespace {

/// Squared distances [cells^2] from every corner of a grid's cells to the nearest corner of a cell
/// that is (or is not) solid; outside of the grid all is solid.
std::vector<float> squared_distances(const VoxelGrid& grid, bool unknown_is_solid, bool wanted) {
  const Eigen::Vector3i corners = grid.size.array() + 1;
  const auto row = static_cast<std::size_t>(corners.x());
  const std::size_t layer = row * corners.y();
  std::vector<float> squared(layer * corners.z(), kNoSite);
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      const std::int8_t* const cells = &grid.cells[grid.index(0, y, z)];
      float* const lowest = &squared[z * layer + y * row];
      for (int x = 0; x < grid.size.x(); ++x) {
        const bool is_solid = cells[x] == VoxelGrid::kOccupied ||
                              (unknown_is_solid && cells[x] == VoxelGrid::kUnknown);
        if (is_solid != wanted) continue;
        for (const std::size_t up : {std::size_t{0}, layer}) {
          for (const std::size_t along : {up, up + row})
            lowest[along + x] = lowest[along + x + 1] = 0.0f;
        }
      }
    }
  }
  for (std::size_t i = 0; wanted && i < squared.size(); ++i) {
    const int x = static_cast<int>(i % row);
    const int y = static_cast<int>(i % layer / row);
    const int z = static_cast<int>(i / layer);
    if (x == 0 || y == 0 || z == 0 || x == grid.size.x() || y == grid.size.y() ||
        z == grid.size.z())
      squared[i] = 0.0f;
  }
  distance_transform_in_space(squared, corners.x(), corners.y(), corners.z());
  return squared;
}

}  // namespace

VoxelDistanceField::VoxelDistanceField(const VoxelGrid& grid, Solid solid)
    : resolution_m_(grid.resolution_m),
      cells_per_m_(1.0 / grid.resolution_m),
      origin_(grid.origin),
      corners_(grid.size.array() + 1) {
  const std::size_t cells = grid.size.minCoeff() < 1 ? 0
                                                     : static_cast<std::size_t>(grid.size.x()) *
                                                           grid.size.y() * grid.size.z();
  if (cells == 0 || grid.cells.size() != cells || !(grid.resolution_m > 0.0)) {
    const std::string sizes = std::to_string(grid.size.x()) + " x " +
                              std::to_string(grid.size.y()) + " x " + std::to_string(grid.size.z());
    throw std::invalid_argument("VoxelDistanceField: a grid of " + sizes + " cells of " +
                                std::to_string(grid.resolution_m) + " m with values for " +
                                std::to_string(grid.cells.size()) +
                                ": expected one for each, and sizes above 0");
  }
  const bool unknown_is_solid = solid == Solid::kOccupiedOrUnknown;
  const auto scale = static_cast<float>(resolution_m_);
  distance_m_ = squared_distances(grid, unknown_is_solid, true);
  const std::vector<float> inside = squared_distances(grid, unknown_is_solid, false);
  for (std::size_t i = 0; i < distance_m_.size(); ++i) {
    float& distance = distance_m_[i];
    const float within = inside[i] < kNoSite ? std::sqrt(inside[i]) : 0.0f;
    distance = scale * (distance > 0.0f ? std::sqrt(distance) : -within);
  }
}

VoxelDistanceField::Sample VoxelDistanceField::interpolated(const Vector& at) const {
  const Eigen::Vector3i low = at.cast<int>().cwiseMin(corners_ - Eigen::Vector3i::Constant(2));
  const Vector share = at - low.cast<double>();
  std::array<std::array<double, 2>, 2> along;  // interpolated in x, by y and z
  std::array<std::array<double, 2>, 2> by_x;
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 2; ++y) {
      const double before = at_corner(low.x(), low.y() + y, low.z() + z);
      by_x[z][y] = at_corner(low.x() + 1, low.y() + y, low.z() + z) - before;
      along[z][y] = before + share.x() * by_x[z][y];
    }
  }
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  const double below = mix(along[0][0], along[0][1], share.y());
  const double above = mix(along[1][0], along[1][1], share.y());
  const Vector gradient(mix(mix(by_x[0][0], by_x[0][1], share.y()),
                            mix(by_x[1][0], by_x[1][1], share.y()), share.z()),
                        mix(along[0][1] - along[0][0], along[1][1] - along[1][0], share.z()),
                        above - below);
  return {mix(below, above, share.z()), cells_per_m_ * gradient};
}

auto VoxelDistanceField::of_cell(const Eigen::Vector3i& cell) const -> CellDistances {
  CellDistances distances{0.0, -std::numeric_limits<double>::infinity()};
  for (int corner = 0; corner < 8; ++corner) {
    const double distance_m =
        at_corner(cell.x() + (corner & 1), cell.y() + (corner >> 1 & 1), cell.z() + (corner >> 2));
    distances.mean_m += 0.125 * distance_m;
    distances.largest_m = std::max(distances.largest_m, distance_m);
  }
  return distances;
}

auto VoxelDistanceField::surface() const -> std::vector<Vector> {
  std::vector<Vector> centres;
  Eigen::Vector3i at;
  for (at.z() = 0; at.z() < size().z(); ++at.z()) {
    for (at.y() = 0; at.y() < size().y(); ++at.y()) {
      for (at.x() = 0; at.x() < size().x(); ++at.x()) {
        const CellDistances distances = of_cell(at);
        if (distances.largest_m > 0.0 || distances.mean_m < -resolution_m_) continue;
        centres.push_back(origin_ + resolution_m_ * (at.cast<double>().array() + 0.5).matrix());
      }
    }
  }
  return centres;
}

VoxelDistanceField::Sample VoxelDistanceField::sample(const Vector& p) const {
  const Vector at = cells_per_m_ * (p - origin_);
  if (is_inside(at)) return interpolated(at);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (!p.allFinite()) return {kNan, Vector::Constant(kNan)};
  const Vector inside = at.cwiseMax(0.0).cwiseMin(corners_.cast<double>() - Vector::Ones());
  const Vector beyond = resolution_m_ * (inside - at);
  return {-beyond.norm(), beyond.normalized()};
}

/// A lower bound [cells^2] at the centre of a cell. An obstacle at r in direction u keeps the
/// distance d to the corner c in the octant of u: r^2 - 2 r u.c + 3/4 >= d^2 with u.c >= 1/2, so
/// r >= 1/2 + sqrt(d^2 - 1/2), unless it may be on this side of the corner.
double VoxelDistanceField::squared_at_centre(const Eigen::Vector3i& cell) const {
  double least = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    least = std::min(least, at_corner(cell.x() + (corner & 1), cell.y() + (corner >> 1 & 1),
                                      cell.z() + (corner >> 2)));
  }
  least *= cells_per_m_;
  if (!(least * least >= 0.75) || least < 0.0) return 0.0;
  const double r = 0.5 + std::sqrt(least * least - 0.5);
  return r * r;
}

/// A lower bound [cells^2] by the face of the cell that is nearest to `share`: in the tetrahedron
/// of the centres on both of its sides and two of its corners.
double VoxelDistanceField::squared_between_centres(const Eigen::Vector3i& cell,
                                                   const Vector& share) const {
  const Vector off = share - Vector::Constant(0.5);
  int axis = 0;
  off.cwiseAbs().maxCoeff(&axis);
  const int side = off[axis] > 0.0 ? 1 : -1;
  Eigen::Vector3i beyond = cell;
  beyond[axis] += side;
  if (beyond[axis] < 0 || beyond[axis] >= corners_[axis] - 1) return 0.0;
  const double above = 0.5 - std::abs(off[axis]);  // the face
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (std::abs(off[u]) < std::abs(off[v])) std::swap(u, v);
  // The weights of the corners make up the place beside the middle of the face.
  const double corners = 2.0 * std::abs(off[u]);
  Eigen::Vector3i corner = cell;
  corner[axis] += side > 0 ? 1 : 0;
  corner[u] += off[u] > 0.0 ? 1 : 0;
  const auto at = [&] {
    const double distance =
        cells_per_m_ * std::max(0.0, at_corner(corner.x(), corner.y(), corner.z()));
    return distance * distance;
  };
  double mean = (0.5 * corners - off[v]) * at();
  corner[v] += 1;
  mean += (0.5 * corners + off[v]) * at();
  mean += (0.5 - 0.5 * corners + above) * squared_at_centre(cell);
  mean += (0.5 - 0.5 * corners - above) * squared_at_centre(beyond);
  return mean - 0.25 - 0.25 * corners + above * above + off[u] * off[u] + off[v] * off[v];
}

double VoxelDistanceField::distance_bound(const Vector& p) const {
  const Vector at = cells_per_m_ * (p - origin_);
  if (!is_inside(at)) return 0.0;
  const Eigen::Vector3i low = at.cast<int>().cwiseMin(corners_ - Eigen::Vector3i::Constant(2));
  const Vector share = at - low.cast<double>();
  double squared = -share.cwiseProduct(Vector::Ones() - share).sum();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i step(corner & 1, corner >> 1 & 1, corner >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      weight *= step[axis] == 1 ? share[axis] : 1.0 - share[axis];
    const double distance =
        cells_per_m_ *
        std::max(0.0, at_corner(low.x() + step.x(), low.y() + step.y(), low.z() + step.z()));
    squared += weight * distance * distance;
  }
  return resolution_m_ * std::sqrt(std::max({0.0, squared, squared_between_centres(low, share)}));
}

double VoxelDistanceField::room(const Vector& p, double radius_m) const {
  // By the nearest corner alone: it is at most half a cell's diagonal away. sample() falls short of
  // the true distance by the interpolation, less than a cell's diagonal.
  const Vector at = cells_per_m_ * (p - origin_);
  if (!is_inside(at)) return 0.0;
  const Eigen::Vector3i nearest = (at.array() + 0.5).matrix().cast<int>();
  const double bound_m = at_corner(nearest.x(), nearest.y(), nearest.z());
  return std::max(0.0, bound_m - radius_m - 2.0 * kCubeHalfDiagonal * resolution_m_);
}

bool VoxelDistanceField::clear(const Box& box, double radius_m) const {
  return room(box.center(), radius_m) > 0.5 * box.diagonal().norm();
}

}  // namespace mocha
