#include "ros_bridge/inputs/map_source.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/runtime/transport.h"

namespace mocha {
namespace {

bool is_same(const OccupancyGrid& a, const OccupancyGrid& b) {
  return a.resolution_m == b.resolution_m && a.origin == b.origin && a.width == b.width &&
         a.height == b.height && a.cells == b.cells;
}

}  // namespace

NewestMap::NewestMap(std::string frame) : frame_(std::move(frame)) {}

void NewestMap::on_map(const nav_msgs::OccupancyGrid& map) {
  try {
    if (map.header.frame_id != frame_) {
      throw std::invalid_argument("is in frame `" + map.header.frame_id + "`, not in `" + frame_ +
                                  "`");
    }
    OccupancyGrid grid = from_message(map);
    stamp_ = map.header.stamp;
    if (is_same(grid, grid_)) return;
    grid_ = std::move(grid);
    ++revision_;
  } catch (const std::exception& error) {
    ++refused_;
    ROS_WARN_THROTTLE(5.0, "Refused a map: it %s", error.what());
  }
}

double NewestMap::age_s(ros::Time now) const {
  return available() ? (now - stamp_).toSec() : std::numeric_limits<double>::infinity();
}

bool NewestMap::within_reach(const Vector2& point, double border_m) const {
  constexpr double kMostCells = 2.5e7;
  const Vector2 border = Vector2::Constant(border_m);
  const Vector2 size = grid_.resolution_m * Vector2(grid_.width, grid_.height);
  const Vector2 low = grid_.origin.cwiseMin(point - border);
  const Vector2 high = (grid_.origin + size).cwiseMax(point + border);
  return point.allFinite() &&
         (high - low).prod() <= kMostCells * grid_.resolution_m * grid_.resolution_m;
}

std::shared_ptr<const DistanceField> NewestMap::field(DistanceField::Solid solid,
                                                      const std::vector<Vector2>& points,
                                                      double border_m) {
  Kept& kept = kept_[solid == DistanceField::Solid::kOccupied ? 0 : 1];
  const auto holds = [&](const Vector2& point) {
    const Vector2 at = (point - kept.field->origin()) / kept.field->resolution_m();
    return at.minCoeff() >= 1.0 && at.x() <= kept.field->columns() - 2 &&
           at.y() <= kept.field->rows() - 2;
  };
  bool usable = kept.field && kept.revision == revision_;
  std::vector<Vector2> reachable;
  for (const Vector2& point : points) {
    if (!within_reach(point, border_m)) continue;
    reachable.push_back(point);
    usable = usable && holds(point);
  }
  if (usable) return kept.field;
  const OccupancyGrid grown = grown_to_hold(grid_, reachable, border_m);
  kept = {std::make_shared<DistanceField>(grown, solid), revision_};
  return kept.field;
}

MapSource::MapSource(ros::NodeHandle& node, std::string frame)
    : NewestMap(std::move(frame)),
      maps_(
          node.subscribe("map", 1, &NewestMap::on_map, static_cast<NewestMap*>(this), at_once())) {}

}  // namespace mocha
