#include "world/distances/distance_field.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "world/distances/distance_repair.h"
#include "world/distances/distance_transform.h"
#include "world/distances/window_joining.h"

namespace mocha {
namespace {

constexpr double kSlackCells = 1.5;    // between a corner and a place between corners
constexpr std::size_t kFewSites = 32;  // of a window; more of them depend on each other's places
constexpr double kRepairWork = 2.0;    // of one side, for each corner: a third of making it anew
constexpr int kReach = 100;            // corners that are made anew around what changed, or so
constexpr int kDiffer = 64;            // corners along the sides of what is told to differ

/// Marks the corners of all cells that are (or are not) solid as sites, in a window.
std::vector<float> corner_sites(const OccupancyGrid& grid, DistanceField::Solid solid, bool wanted,
                                const CornerWindow& window) {
  const bool unknown_too = solid == DistanceField::Solid::kOccupiedOrUnknown;
  const int columns = window.columns();
  std::vector<float> sites(static_cast<std::size_t>(columns) * window.rows());
  std::vector<std::uint8_t> below(columns + 1);  // corners of wanted cells in the row below
  std::vector<std::uint8_t> above(columns + 1);
  const int first = std::max(0, window.x0 - 1);
  const int last = std::min(grid.width - 1, window.x1);
  for (int y = window.y0 - 1; y <= window.y1; ++y) {
    below.swap(above);
    std::fill(above.begin(), above.end(), std::uint8_t{0});
    for (int x = first; y >= 0 && y < grid.height && x <= last; ++x) {
      const std::int8_t cell = grid.at(x, y);
      const bool is_solid =
          cell == OccupancyGrid::kOccupied || (unknown_too && cell == OccupancyGrid::kUnknown);
      const std::uint8_t is_wanted = is_solid == wanted;
      if (x >= window.x0) above[x - window.x0] |= is_wanted;
      above[x + 1 - window.x0] = is_wanted;
    }
    if (y < window.y0) continue;
    float* row = &sites[static_cast<std::size_t>(y - window.y0) * columns];
    for (int x = 0; x < columns; ++x) row[x] = (below[x] | above[x]) != 0 ? 0.0f : kNoSite;
  }
  return sites;
}

/// Corners on the rim of the map become sites as well: outside is solid.
void add_rim(const OccupancyGrid& grid, const CornerWindow& window, std::vector<float>& sites) {
  for (int y = window.y0; y <= window.y1; ++y) {
    float* row = &sites[static_cast<std::size_t>(y - window.y0) * window.columns()];
    if (y == 0 || y == grid.height) std::fill(row, row + window.columns(), 0.0f);
    if (window.x0 == 0) row[0] = 0.0f;
    if (window.x1 == grid.width) row[window.columns() - 1] = 0.0f;
  }
}

/// Distances of the corners of a window [m], by the sites in it; right only in the rows from y0 to
/// y1.
std::vector<float> distances_m(const OccupancyGrid& grid, DistanceField::Solid solid,
                               const CornerWindow& window, int y0, int y1) {
  const auto scale = static_cast<float>(grid.resolution_m);
  const int first = y0 - window.y0;
  const int end = y1 + 1 - window.y0;
  const auto begin_i = static_cast<std::size_t>(first) * window.columns();
  const auto end_i = static_cast<std::size_t>(end) * window.columns();
  std::vector<float> distances = corner_sites(grid, solid, true, window);
  const bool outside_solid = solid == DistanceField::Solid::kOccupiedOrUnknown;
  if (outside_solid) add_rim(grid, window, distances);
  distance_transform(distances, window.columns(), window.rows(), first, end);
  for (std::size_t i = begin_i; i < end_i; ++i) distances[i] = scale * std::sqrt(distances[i]);
  if (outside_solid) return distances;
  std::vector<float> inside = corner_sites(grid, solid, false, window);
  distance_transform(inside, window.columns(), window.rows(), first, end);
  for (std::size_t i = begin_i; i < end_i; ++i) {
    if (inside[i] > 0.0f) distances[i] = -scale * std::sqrt(inside[i]);
  }
  return distances;
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
  distance_m_ = distances_m(grid, solid, corners(), 0, rows_ - 1);
}

std::vector<CornerWindow> DistanceField::repair(const OccupancyGrid& grid,
                                                const std::vector<CornerWindow>& cells) {
  if (grid.width + 1 != columns_ || grid.height + 1 != rows_ || grid.origin != origin_ ||
      grid.resolution_m != resolution_m_)
    throw std::invalid_argument("DistanceField: the changed map is another one");
  const auto make_repair = [&](int side) {
    return DistanceRepair(distance_m_, columns_, rows_, static_cast<float>(resolution_m_), side,
                          static_cast<std::int64_t>(kRepairWork * distance_m_.size()));
  };
  std::vector<DistanceRepair> sides = {make_repair(1)};
  if (!outside_solid_) sides.push_back(make_repair(-1));
  std::vector<CornerWindow> left;
  for (const CornerWindow& window : cells) {
    const CornerWindow changed =
        CornerWindow{window.x0, window.y0, window.x1 + 1, window.y1 + 1}.within(corners());
    if (!changed.empty() && !repair_sites(grid, changed, sides)) left.push_back(changed);
  }
  std::vector<CornerWindow> differ;
  for (const DistanceRepair& side : sides)
    differ.insert(differ.end(), side.touched().begin(), side.touched().end());
  double area = 0.0;
  for (const CornerWindow& changed : left)
    area += static_cast<double>(changed.grown(kReach).columns()) * changed.grown(kReach).rows();
  const bool is_spoilt = std::any_of(sides.begin(), sides.end(),
                                     [](const DistanceRepair& side) { return side.used_up(); });
  if (is_spoilt || area > static_cast<double>(distance_m_.size())) left = {corners()};
  for (const CornerWindow& changed : joined(left, kReach)) make_anew(grid, changed, differ);
  return differ;
}

/// Site by site, where few have changed; false where it is to be made anew.
bool DistanceField::repair_sites(const OccupancyGrid& grid, const CornerWindow& changed,
                                 std::vector<DistanceRepair>& sides) {
  struct Sites {
    std::vector<Eigen::Vector2i> gone, come;
  };
  std::vector<Sites> changes;
  std::size_t count = 0;
  for (const int sign : {1, -1}) {
    if (changes.size() == sides.size()) break;
    auto& [gone, come] = changes.emplace_back();
    std::vector<float> sites = corner_sites(grid, solid(), sign > 0, changed);
    if (outside_solid_) add_rim(grid, changed, sites);
    for (int y = changed.y0, i = 0; y <= changed.y1; ++y) {
      for (int x = changed.x0; x <= changed.x1; ++x, ++i) {
        const bool was_site = sign * at_corner(x, y) <= 0.0;
        if ((sites[i] == 0.0f) != was_site) (was_site ? gone : come).emplace_back(x, y);
      }
    }
    count += gone.size() + come.size();
  }
  if (count > kFewSites) return false;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (!sides[i].remove(changes[i].gone) || !sides[i].add(changes[i].come)) return false;
  }
  return true;
}

/// With all that what changed may have been or may be nearest to.
void DistanceField::make_anew(const OccupancyGrid& grid, const CornerWindow& changed,
                              std::vector<CornerWindow>& differ) {
  const CornerWindow reach = reach_of(changed);
  // What is nearest to a place in reach lies as far beyond its rim as it is away from there at
  // most.
  float most_m = 0.0f;
  visit_rim(reach, [&](int x, int y) {
    most_m = std::max(most_m, std::abs(distance_m_[static_cast<std::size_t>(y) * columns_ + x]));
  });
  const double margin = std::min(most_m * cells_per_m_ + kSlackCells, columns_ + rows_ + 0.0);
  const CornerWindow sources = reach.grown(static_cast<int>(margin) + 1).within(corners());
  const std::vector<float> made = distances_m(grid, solid(), sources, reach.y0, reach.y1);
  for (int y = reach.y0; y <= reach.y1; y += kDiffer) {
    for (int x = reach.x0; x <= reach.x1; x += kDiffer) {
      const CornerWindow part{x, y, x + kDiffer - 1, y + kDiffer - 1};
      const CornerWindow window = take_over(made, sources, part.within(reach));
      if (!window.empty()) differ.push_back(window);
    }
  }
}

/// The corners whose nearest obstacle may be in `changed`, before or after the change. Around it
/// goes a rim of corners that all are closer to something than to what changed. Whatever is beyond
/// and has its nearest obstacle in `changed` would be seen from a corner of the rim.
CornerWindow DistanceField::reach_of(const CornerWindow& changed) const {
  for (int margin = 4;; margin += std::max(4, margin / 2)) {
    const CornerWindow reach = changed.grown(margin).within(corners());
    bool is_apart = true;
    visit_rim(reach, [&](int x, int y) {
      const double away = std::hypot(std::max({changed.x0 - x, 0, x - changed.x1}),
                                     std::max({changed.y0 - y, 0, y - changed.y1}));
      is_apart = is_apart && std::abs(at_corner(x, y)) * cells_per_m_ < away - kSlackCells;
    });
    if (is_apart) return reach;
  }
}

/// The corners at the sides of a window beyond which the map goes on.
template <typename Visit>
void DistanceField::visit_rim(const CornerWindow& window, const Visit& visit) const {
  for (int x = window.x0; x <= window.x1; ++x) {
    if (window.y0 > 0) visit(x, window.y0);
    if (window.y1 < rows_ - 1) visit(x, window.y1);
  }
  for (int y = window.y0; y <= window.y1; ++y) {
    if (window.x0 > 0) visit(window.x0, y);
    if (window.x1 < columns_ - 1) visit(window.x1, y);
  }
}

/// Those of a part; returns where they differ from what they were.
CornerWindow DistanceField::take_over(const std::vector<float>& made, const CornerWindow& sources,
                                      const CornerWindow& part) {
  CornerWindow differ{columns_, rows_, -1, -1};
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const std::size_t from =
          static_cast<std::size_t>(y - sources.y0) * sources.columns() + (x - sources.x0);
      float& distance_m = distance_m_[static_cast<std::size_t>(y) * columns_ + x];
      if (distance_m == made[from]) continue;
      distance_m = made[from];
      differ = {std::min(differ.x0, x), std::min(differ.y0, y), std::max(differ.x1, x),
                std::max(differ.y1, y)};
    }
  }
  return differ;
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
  if (is_inside(at)) return interpolated(at);
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
  const Vector2 at = cells_per_m_ * (p - origin_);
  if (is_inside(at)) return bound_inside(at);
  if (!p.allFinite() || outside_solid_) return 0.0;
  const Vector2 inside(std::clamp(at.x(), 0.0, columns_ - 1.0),
                       std::clamp(at.y(), 0.0, rows_ - 1.0));
  const double beyond_m = resolution_m_ * (at - inside).norm();
  // Every solid cell lies inside the map, and a distance changes no faster than one moves.
  return std::max(beyond_m, bound_inside(inside) - beyond_m);
}

double DistanceField::bound_inside(const Vector2& at) const {
  const int i = std::min(static_cast<int>(at.x()), columns_ - 2);
  const int j = std::min(static_cast<int>(at.y()), rows_ - 2);
  const double u = at.x() - i;
  const double v = at.y() - j;
  const auto squared = [this](int x, int y) {
    const double distance = std::max(0.0, at_corner(x, y));
    return distance * distance;
  };
  const double mean = (1 - v) * ((1 - u) * squared(i, j) + u * squared(i + 1, j)) +
                      v * ((1 - u) * squared(i, j + 1) + u * squared(i + 1, j + 1));
  const double sag = resolution_m_ * resolution_m_ * (u * (1 - u) + v * (1 - v));
  return std::sqrt(std::max(0.0, mean - sag));
}

double DistanceField::room(const Vector& p, double radius_m) const {
  // Asked for at every sample of a trajectory, so by the nearest corner alone, inside: it is at
  // most half a cell's diagonal away. sample() falls short of the true distance by the
  // interpolation, less than a cell. Beyond the map's rim, going along and going away both count.
  const Vector2 at = cells_per_m_ * (p - origin_);
  const double bound_m =
      is_inside(at) ? at_corner(static_cast<int>(at.x() + 0.5), static_cast<int>(at.y() + 0.5)) -
                          M_SQRT1_2 * resolution_m_
                    : distance_bound(p);
  return std::max(0.0, (bound_m - radius_m - resolution_m_) * M_SQRT1_2);
}

bool DistanceField::clear(const Box& box, double radius_m) const {
  return room(box.center(), radius_m) > 0.5 * box.diagonal().norm();
}

}  // namespace mocha
