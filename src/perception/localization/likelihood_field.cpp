#include "perception/localization/likelihood_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "perception/sensor/beam.h"
#include "world/distances/distance_transform.h"

namespace mocha {
namespace {

constexpr double kSmallestCell_m = 0.001;
constexpr double kLargestCell_m = 10.0;

void check(const OccupancyGrid& map) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("LikelihoodField: ") + what);
  };
  const std::size_t cells =
      static_cast<std::size_t>(std::max(0, map.width)) * std::max(0, map.height);
  require(cells > 0 && map.cells.size() == cells, "the grid is empty or its sizes do not match");
  require(map.resolution_m >= kSmallestCell_m && map.resolution_m <= kLargestCell_m,
          "the cells are not 1 mm to 10 m wide");
  require(is_usable(map.origin) && is_usable(map.cell_centre(map.width, map.height)),
          "the grid lies too far away, or nowhere");
}

/// With unknown cells around it as far as walls at its rim reach.
OccupancyGrid with_rim(const OccupancyGrid& map, double reach_m) {
  check(map);
  const Vector2 size_m = map.resolution_m * Vector2(map.width, map.height);
  return grown_to_hold(map, {map.origin, map.origin + size_m}, reach_m);
}

}  // namespace

LikelihoodField::LikelihoodField(const OccupancyGrid& map, double reach_m)
    : map_(with_rim(map, reach_m)), reach_m_(reach_m), distance_m_(map_.cells.size()) {
  std::transform(map_.cells.begin(), map_.cells.end(), distance_m_.begin(),
                 [](int8_t cell) { return cell == OccupancyGrid::kOccupied ? 0.0f : kNoSite; });
  distance_transform(distance_m_, map_.width, map_.height);
  for (float& distance : distance_m_) {
    distance = static_cast<float>(std::min(reach_m, map_.resolution_m * std::sqrt(distance)));
  }
}

LikelihoodField::Sample LikelihoodField::sample(const Vector2& p) const {
  const Vector2 at = (p - map_.origin) / map_.resolution_m - Vector2(0.5, 0.5);
  if (!(at.minCoeff() >= 0.0 && at.x() < map_.width - 1 && at.y() < map_.height - 1))
    return {reach_m_, Vector2::Zero()};
  const int i = static_cast<int>(at.x());
  const int j = static_cast<int>(at.y());
  const double u = at.x() - i;
  const double v = at.y() - j;
  const double d00 = at_centre(i, j);
  const double d10 = at_centre(i + 1, j);
  const double d01 = at_centre(i, j + 1);
  const double d11 = at_centre(i + 1, j + 1);
  return {
      (1 - v) * ((1 - u) * d00 + u * d10) + v * ((1 - u) * d01 + u * d11),
      Vector2((1 - v) * (d10 - d00) + v * (d11 - d01), (1 - u) * (d01 - d00) + u * (d11 - d10)) /
          map_.resolution_m};
}

int8_t LikelihoodField::cell(const Vector2& p) const {
  const Vector2 at = (p - map_.origin) / map_.resolution_m;
  if (!(at.minCoeff() >= 0.0 && at.x() < map_.width && at.y() < map_.height))
    return OccupancyGrid::kUnknown;
  return map_.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
}

}  // namespace mocha
