#include "benchmarks/leaving_scene.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kRoom_m = 5.0;  // from the start to the walls that are far
constexpr double kThick_m = 0.3;
constexpr double kGoal_m = 3.0;
constexpr double kMouth_m = 0.3;  // a dead end is so much deeper than the body
constexpr double kJamb_m = 0.4;
const Vector2 kOffGrid(0.0137, 0.0083);  // walls are not where cells end

/// How far the body reaches from its base in a direction of the map.
double reach_m(const Footprint& footprint, double yaw_rad, const Vector2& direction) {
  if (footprint.is_disc()) return footprint.circumscribed_radius_m();
  double reach = 0.0;
  for (const Vector2& corner : footprint.corners()) {
    reach = std::max(reach, turned(corner, {std::cos(yaw_rad), std::sin(yaw_rad)}).dot(direction));
  }
  return reach;
}

void add_box(World& world, const Vector2& low, const Vector2& high) {
  Polygon box{{low, {high.x(), low.y()}, high, {low.x(), high.y()}}};
  for (Vector2& corner : box.corners) corner += kOffGrid;
  world.polygons.push_back(box);
}

/// Four walls about the room inside.
void add_room(World& world, const Vector2& low, const Vector2& high) {
  const Vector2 from = low - Vector2::Constant(kThick_m);
  const Vector2 to = high + Vector2::Constant(kThick_m);
  add_box(world, from, {to.x(), low.y()});
  add_box(world, {from.x(), high.y()}, to);
  add_box(world, from, {low.x(), to.y()});
  add_box(world, {high.x(), from.y()}, to);
}

}  // namespace

RobotModel leaving_model(const std::string& name) {
  if (name != "own") return load_robot_model("config", name);
  RobotModel robot = load_robot_model("config", "rover");
  robot.footprint = Footprint::rectangle(0.9, 0.6);
  return robot;
}

World leaving_world(const RobotModel& robot, const TightStart& start) {
  const auto reach = [&](const Vector2& direction) {
    return reach_m(robot.footprint, start.yaw_rad, direction);
  };
  const Vector2 x = Vector2::UnitX();
  const Vector2 y = Vector2::UnitY();
  const double left_m = start.kind == TightKind::kCorner ? reach(-x) + start.gap_m : kRoom_m;
  Vector2 at(0.0, reach(-y) + start.gap_m);
  World world;
  add_room(world, {-left_m, 0.0}, {kRoom_m, kRoom_m + 1.0});
  if (start.kind == TightKind::kDeadEnd) {
    const double depth_m = at.y() + reach(y) + kMouth_m;
    const double right_m = reach(x) + start.gap_m;
    const double slot_left_m = -reach(-x) - start.gap_m;
    add_box(world, {slot_left_m - kJamb_m, 0.0}, {slot_left_m, depth_m});
    add_box(world, {right_m, 0.0}, {right_m + kJamb_m, depth_m});
  }
  const Vector2 way = start.kind == TightKind::kCorner ? Vector2(x + y).normalized() : y;
  world.bounds = {at - Vector2::Constant(2.0 * kRoom_m), at + Vector2::Constant(2.0 * kRoom_m)};
  at += kOffGrid;
  world.robots.push_back({"ugv1", robot, {at, start.yaw_rad}, Goal{at + kGoal_m * way, {}}});
  return world;
}

}  // namespace mocha
