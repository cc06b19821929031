#include "world/distance_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "world/distance_transform.h"

namespace mocha {
namespace {

/// Marks the corners of all cells that are (or are not) solid as sites.
std::vector<float> corner_sites(const OccupancyGrid& grid, DistanceField::Solid solid,
                                bool wanted) {
  const bool unknown_too = solid == DistanceField::Solid::kOccupiedOrUnknown;
  const int columns = grid.width + 1;
  std::vector<float> sites(static_cast<std::size_t>(columns) * (grid.height + 1));
  std::vector<std::uint8_t> below(columns);  // corners of wanted cells in the row below
  std::vector<std::uint8_t> above(columns);
  for (int y = 0; y <= grid.height; ++y) {
    below.swap(above);
    std::fill(above.begin(), above.end(), std::uint8_t{0});
    for (int x = 0; y < grid.height && x < grid.width; ++x) {
      const std::int8_t cell = grid.at(x, y);
      const bool is_solid =
          cell == OccupancyGrid::kOccupied || (unknown_too && cell == OccupancyGrid::kUnknown);
      const std::uint8_t is_wanted = is_solid == wanted;
      above[x] |= is_wanted;
      above[x + 1] = is_wanted;
    }
    float* row = &sites[static_cast<std::size_t>(y) * columns];
    for (int x = 0; x < columns; ++x) row[x] = (below[x] | above[x]) != 0 ? 0.0f : kNoSite;
  }
  return sites;
}

/// Corners on the rim of the map become sites as well: outside is solid.
void add_rim(std::vector<float>& sites, int columns, int rows) {
  for (int x = 0; x < columns; ++x) {
    sites[x] = sites[static_cast<std::size_t>(rows - 1) * columns + x] = 0.0f;
  }
  for (int y = 0; y < rows; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * columns;
    sites[row] = sites[row + columns - 1] = 0.0f;
  }
}

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, Solid solid)
    : resolution_m_(grid.resolution_m),
      cells_per_m_(1.0 / grid.resolution_m),
      origin_(grid.origin),
      columns_(grid.width + 1),
      rows_(grid.height + 1),
      outside_solid_(solid == Solid::kOccupiedOrUnknown) {
  const std::size_t cells =
      static_cast<std::size_t>(std::max(0, grid.width)) * std::max(0, grid.height);
  if (cells == 0 || grid.cells.size() != cells || !(grid.resolution_m > 0.0)) {
    throw std::invalid_argument("DistanceField: the grid is empty or its sizes do not match");
  }
  distance_m_ = corner_sites(grid, solid, true);
  if (outside_solid_) add_rim(distance_m_, columns_, rows_);
  distance_transform(distance_m_, columns_, rows_);
  const auto scale = static_cast<float>(resolution_m_);
  for (float& distance : distance_m_) distance = scale * std::sqrt(distance);
  if (outside_solid_) return;
  std::vector<float> inside = corner_sites(grid, solid, false);
  distance_transform(inside, columns_, rows_);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside[i] > 0.0f) distance_m_[i] = -scale * std::sqrt(inside[i]);
  }
}

inline DistanceField::Sample DistanceField::interpolated(const Vector2& at) const {
  const int i = std::min(static_cast<int>(at.x()), columns_ - 2);
  const int j = std::min(static_cast<int>(at.y()), rows_ - 2);
  const double u = at.x() - i;
  const double v = at.y() - j;
  const double d00 = at_corner(i, j);
  const double d01 = at_corner(i, j + 1);
  const double along_below = at_corner(i + 1, j) - d00;
  const double along_above = at_corner(i + 1, j + 1) - d01;
  const double below = d00 + u * along_below;
  const double up = d01 + u * along_above - below;
  const double along = along_below + v * (along_above - along_below);
  return {below + v * up, cells_per_m_ * Vector2(along, up)};
}

DistanceField::Sample DistanceField::sample(const Vector2& p) const {
  const Vector2 at = cells_per_m_ * (p - origin_);
  if (at.x() >= 0.0 && at.x() <= columns_ - 1.0 && at.y() >= 0.0 && at.y() <= rows_ - 1.0)
    return interpolated(at);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (!p.allFinite()) return {kNan, Vector2(kNan, kNan)};
  const Vector2 inside(std::clamp(at.x(), 0.0, columns_ - 1.0),
                       std::clamp(at.y(), 0.0, rows_ - 1.0));
  Sample sample = interpolated(inside);
  const Vector2 beyond = resolution_m_ * (at - inside);
  const double beyond_m = beyond.norm();
  // Outside, what counts is what distance_bound() can prove there.
  const Vector2 outwards = beyond / beyond_m;
  for (int axis = 0; axis < 2; ++axis) {
    if (beyond[axis] != 0.0) sample.gradient[axis] = 0.0;
  }
  if (sample.distance_m - beyond_m < beyond_m) return {beyond_m, outwards};
  return {sample.distance_m - beyond_m, sample.gradient - outwards};
}

double DistanceField::distance_bound(const Vector2& p) const {
  if (!p.allFinite()) return 0.0;
  const Vector2 at = (p - origin_) / resolution_m_;
  const Vector2 inside(std::clamp(at.x(), 0.0, columns_ - 1.0),
                       std::clamp(at.y(), 0.0, rows_ - 1.0));
  const double beyond_m = resolution_m_ * (at - inside).norm();
  if (beyond_m > 0.0 && outside_solid_) return 0.0;
  const int i = std::min(static_cast<int>(inside.x()), columns_ - 2);
  const int j = std::min(static_cast<int>(inside.y()), rows_ - 2);
  const double u = inside.x() - i;
  const double v = inside.y() - j;
  const auto squared = [this](int x, int y) {
    const double distance = std::max(0.0, at_corner(x, y));
    return distance * distance;
  };
  const double mean = (1 - v) * ((1 - u) * squared(i, j) + u * squared(i + 1, j)) +
                      v * ((1 - u) * squared(i, j + 1) + u * squared(i + 1, j + 1));
  const double sag = resolution_m_ * resolution_m_ * (u * (1 - u) + v * (1 - v));
  const double bound = std::sqrt(std::max(0.0, mean - sag));
  // Every solid cell lies inside the map, and a distance changes no faster than one moves.
  return beyond_m > 0.0 ? std::max(beyond_m, bound - beyond_m) : bound;
}

double DistanceField::room(const Vector& p, double radius_m) const {
  // sample() falls short of the true distance by the interpolation, less than a cell. Beyond the
  // map's rim, going along and going away both count.
  return std::max(0.0, (distance_bound(p) - radius_m - resolution_m_) * M_SQRT1_2);
}

bool DistanceField::clear(const Box& box, double radius_m) const {
  return room(box.center(), radius_m) > 0.5 * box.diagonal().norm();
}

}  // namespace mocha
