#include "ros_bridge/rviz/world_markers.h"

#include <initializer_list>
#include <string>

#include "ros_bridge/messages/conversions.h"

namespace mocha {
namespace {

using visualization_msgs::Marker;

constexpr double kWallHeight_m = 0.5;
constexpr double kRobotHeight_m = 0.2;
constexpr double kLine_m = 0.05;
constexpr double kMovingLifetime_s = 0.5;  // several times their period

struct Colour {
  float red, green, blue, alpha;
};

constexpr Colour kWall{0.45f, 0.45f, 0.5f, 1.0f};
constexpr Colour kMover{0.95f, 0.55f, 0.1f, 0.9f};
constexpr Colour kRobot{0.15f, 0.4f, 0.9f, 0.8f};
constexpr Colour kGoal{0.1f, 0.7f, 0.25f, 0.9f};
constexpr Colour kText{0.05f, 0.05f, 0.05f, 1.0f};

geometry_msgs::Point point(const Vector2& p, double height_m) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = height_m;
  return message;
}

/// Markers in the order in which they are added, numbered within their namespace.
class Picture {
 public:
  Marker& add(const std::string& kind, int type, const Colour& colour) {
    Marker marker;
    marker.header.frame_id = "map";  // without a stamp: drawn at the newest transform
    marker.ns = kind;
    marker.id = static_cast<int>(array.markers.size());
    marker.type = type;
    marker.color.r = colour.red;
    marker.color.g = colour.green;
    marker.color.b = colour.blue;
    marker.color.a = colour.alpha;
    marker.pose.orientation.w = 1.0;
    array.markers.push_back(marker);
    return array.markers.back();
  }

  void add_disc(const std::string& kind, const Circle& circle, double height_m,
                const Colour& colour) {
    Marker& marker = add(kind, Marker::CYLINDER, colour);
    marker.pose.position = point(circle.centre, 0.5 * height_m);
    marker.scale.x = marker.scale.y = 2.0 * circle.radius_m;
    marker.scale.z = height_m;
  }

  void add_outline(const std::string& kind, const Polygon& polygon, double height_m,
                   const Colour& colour) {
    Marker& marker = add(kind, Marker::LINE_STRIP, colour);
    marker.scale.x = kLine_m;
    for (const Vector2& corner : polygon.corners) marker.points.push_back(point(corner, height_m));
    marker.points.push_back(marker.points.front());
  }

  /// The sides as upright faces, and the outline on top of them.
  void add_prism(const std::string& kind, const Polygon& polygon, double height_m,
                 const Colour& colour) {
    add_outline(kind, polygon, height_m, colour);
    Marker& marker = add(kind, Marker::TRIANGLE_LIST, colour);
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      const Vector2& a = polygon.corners[i];
      const Vector2& b = polygon.corners[(i + 1) % polygon.corners.size()];
      for (const auto& corner : {point(a, 0.0), point(b, 0.0), point(b, height_m), point(a, 0.0),
                                 point(b, height_m), point(a, height_m)}) {
        marker.points.push_back(corner);
      }
    }
  }

  void add_text(const std::string& kind, const std::string& text, const Vector2& place,
                double height_m) {
    Marker& marker = add(kind, Marker::TEXT_VIEW_FACING, kText);
    marker.pose.position = point(place, height_m);
    marker.scale.z = 0.3;
    marker.text = text;
  }

  visualization_msgs::MarkerArray array;
};

void add_goal(Picture& picture, const WorldRobot& robot) {
  picture.add_disc("goals", {robot.goal->position, 0.15}, 0.02, kGoal);
  picture.add_text("goals", robot.name + " goal", robot.goal->position, 0.5);
  if (!robot.goal->yaw_rad) return;
  Marker& arrow = picture.add("goals", Marker::ARROW, kGoal);
  arrow.pose = to_message(Pose{robot.goal->position, *robot.goal->yaw_rad});
  arrow.scale.x = 0.6;
  arrow.scale.y = arrow.scale.z = 0.08;
}

void add_robot(Picture& picture, const SimulatedRobot& robot) {
  const Obstacle body = robot.body();
  if (const auto* disc = std::get_if<Circle>(&body)) {
    picture.add_disc("robots", *disc, kRobotHeight_m, kRobot);
  } else {
    picture.add_prism("robots", std::get<Polygon>(body), kRobotHeight_m, kRobot);
  }
  Marker& heading = picture.add("robots", Marker::ARROW, kText);
  heading.pose = to_message(robot.vehicle.pose());
  heading.pose.position.z = kRobotHeight_m;
  heading.scale.x = robot.setup.model.footprint.circumscribed_radius_m();
  heading.scale.y = heading.scale.z = kLine_m;
  picture.add_text("names", robot.setup.name, robot.vehicle.pose().position, 0.6);
}

}  // namespace

visualization_msgs::MarkerArray world_markers(const World& world) {
  Picture picture;
  for (const Circle& circle : world.circles) {
    picture.add_disc("static", circle, kWallHeight_m, kWall);
  }
  for (const Polygon& polygon : world.polygons) {
    picture.add_prism("static", polygon, kWallHeight_m, kWall);
  }
  for (const WorldRobot& robot : world.robots) {
    if (robot.goal) add_goal(picture, robot);
  }
  return picture.array;
}

visualization_msgs::MarkerArray moving_markers(const WorldSimulator& simulator) {
  Picture picture;
  for (const Circle& disc : simulator.moving_discs()) {
    picture.add_disc("moving", disc, kWallHeight_m, kMover);
  }
  for (const SimulatedRobot& robot : simulator.robots()) add_robot(picture, robot);
  // Movers come and go.
  for (visualization_msgs::Marker& marker : picture.array.markers)
    marker.lifetime = ros::Duration(kMovingLifetime_s);
  return picture.array;
}

}  // namespace mocha
