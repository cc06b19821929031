#include "ros_bridge/rviz/markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "ros_bridge/messages/conversions.h"

namespace mocha {

std_msgs::ColorRGBA color(double red, double green, double blue, double alpha) {
  std_msgs::ColorRGBA c;
  c.r = static_cast<float>(red);
  c.g = static_cast<float>(green);
  c.b = static_cast<float>(blue);
  c.a = static_cast<float>(alpha);
  return c;
}

std_msgs::ColorRGBA class_color(std::size_t number) {
  static const std::array<std_msgs::ColorRGBA, 8> colors = {
      color(0.90, 0.10, 0.55), color(0.10, 0.45, 0.90), color(0.05, 0.60, 0.25),
      color(0.95, 0.55, 0.05), color(0.50, 0.20, 0.75), color(0.00, 0.65, 0.70),
      color(0.60, 0.35, 0.10), color(0.55, 0.55, 0.10)};
  return colors[number % colors.size()];
}

namespace {

using visualization_msgs::Marker;

constexpr double kLineStep_s = 0.05;
constexpr double kDash_m = 0.15;
constexpr double kGhostStep_s = 1.0;
constexpr double kGhosts = 0.25;
constexpr double kLineLevel_m = 0.02;
constexpr double kSquareLevel_m = 0.1;  // above all lines
constexpr double kTextHeight_m = 0.4;
constexpr double kTextLevel_m = 0.6;  // above all else, seen from above

const std_msgs::ColorRGBA kInk = color(0.1, 0.1, 0.12);
const std_msgs::ColorRGBA kRobotColour = color(0.1, 0.25, 0.85);
const std_msgs::ColorRGBA kGoalColour = color(0.8, 0.05, 0.5);

/// Blue, cyan, green, yellow, red for a share from 0 to 1.
std_msgs::ColorRGBA rainbow(double share) {
  const double s = 4.0 * std::clamp(share, 0.0, 1.0);
  const auto ramp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  return color(ramp(s - 2.0), std::min(ramp(s), ramp(4.0 - s)), ramp(2.0 - s));
}

geometry_msgs::Point lifted(const Vector2& p, double height_m = 0.0) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = height_m;
  return message;
}

/// Times from the motion's start to its end, `dt` apart at most, both ends included.
std::vector<double> sample_times(double start, double end, double dt) {
  const int steps = std::max(1, static_cast<int>(std::ceil((end - start) / dt)));
  std::vector<double> times;
  for (int i = 0; i <= steps; ++i) times.push_back(start + (end - start) * i / steps);
  return times;
}

std::vector<geometry_msgs::Point> positions(const Motion& motion, double height_m) {
  std::vector<geometry_msgs::Point> points;
  for (const double t : sample_times(motion.start_time(), motion.end_time(), kLineStep_s)) {
    points.push_back(lifted(motion.position(t), height_m));
  }
  return points;
}

/// One colour for each of positions().
std::vector<std_msgs::ColorRGBA> speeds(const Motion& motion, double max_speed, double alpha) {
  std::vector<std_msgs::ColorRGBA> colors;
  for (const double t : sample_times(motion.start_time(), motion.end_time(), kLineStep_s)) {
    colors.push_back(rainbow(std::abs(motion.at(t).speed) / max_speed));
    colors.back().a = static_cast<float>(alpha);
  }
  return colors;
}

std::vector<Vector2> outline(const Footprint& footprint) {
  std::vector<Vector2> points = footprint.corners();
  if (footprint.is_disc()) {
    constexpr int kCorners = 32;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2.0 * M_PI * i / kCorners;
      points.push_back(footprint.circumscribed_radius_m() *
                       Vector2(std::cos(angle), std::sin(angle)));
    }
  }
  points.push_back(points.front());
  return points;
}

}  // namespace

nav_msgs::Path to_path(const Motion& motion, const std::string& frame, double dt) {
  nav_msgs::Path path;
  path.header.frame_id = frame;
  if (motion.empty()) return path;
  path.header.stamp = ros::Time(motion.start_time());
  for (const double t : sample_times(motion.start_time(), motion.end_time(), dt)) {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = frame;
    pose.header.stamp = ros::Time(t);
    pose.pose = to_message(motion.at(t).pose);
    path.poses.push_back(pose);
  }
  return path;
}

std::vector<Vector2> polyline(const Motion& motion, double dt) {
  std::vector<Vector2> points;
  for (const Phase& phase : motion.phases()) {
    const auto* drive = std::get_if<DrivePhase>(&phase);
    if (drive == nullptr) continue;
    for (const double t : sample_times(0.0, drive->path.duration(), dt)) {
      points.push_back(drive->path.position(t));
    }
  }
  return points;
}

std::vector<Vector2> evenly(const std::vector<Vector2>& path) {
  std::vector<Vector2> points;
  double missing_m = 0.0;  // to the next point
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 side = path[i] - path[i - 1];
    const double length_m = side.norm();
    for (; missing_m <= length_m && length_m > 0.0; missing_m += kDash_m)
      points.push_back(path[i - 1] + side * (missing_m / length_m));
    missing_m -= length_m;
  }
  if (!path.empty()) points.push_back(path.back());
  return points;
}

Drawing::Drawing(const std::string& frame, ros::Time stamp) : frame_(frame), stamp_(stamp) {
  markers_.markers.emplace_back();
  markers_.markers.back().header.frame_id = frame;
  markers_.markers.back().header.stamp = stamp;
  markers_.markers.back().action = Marker::DELETEALL;
}

Marker& Drawing::add(const std::string& name, int type) {
  Marker marker;
  marker.header.frame_id = frame_;
  marker.header.stamp = stamp_;
  marker.ns = name;
  marker.id = next_id_[name]++;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  markers_.markers.push_back(marker);
  return markers_.markers.back();
}

Marker& Drawing::add_text(const std::string& name, const std::string& text, const Vector2& place) {
  Marker& marker = add(name, Marker::TEXT_VIEW_FACING);
  marker.text = text;
  marker.scale.z = kTextHeight_m;
  marker.color = kInk;
  marker.pose.position = lifted(place, kTextLevel_m);
  return marker;
}

void Drawing::add_motion(const std::string& name, const Motion& motion, double max_speed) {
  if (motion.empty()) return;
  Marker& edges = add(name, Marker::LINE_STRIP);
  edges.scale.x = 0.13;
  edges.color = kInk;
  edges.points = positions(motion, 0.04);
  Marker& line = add(name, Marker::LINE_STRIP);
  line.scale.x = 0.09;
  line.color = color(1.0, 1.0, 1.0);
  line.points = positions(motion, 0.06);
  line.colors = speeds(motion, max_speed, 1.0);
}

void Drawing::add_line(const std::string& name, const std::vector<Vector2>& points, double width_m,
                       const std_msgs::ColorRGBA& color, bool dashed) {
  Marker& line = add(name, dashed ? Marker::LINE_LIST : Marker::LINE_STRIP);
  line.scale.x = width_m;
  line.color = color;
  const std::size_t even = points.size() - points.size() % 2;  // what a LINE_LIST must have
  for (std::size_t i = 0; i < (dashed ? even : points.size()); ++i)
    line.points.push_back(lifted(points[i], kLineLevel_m));
}

void Drawing::add_label(const std::string& name, const std::string& text, const Vector2& place,
                        double height_m, const std_msgs::ColorRGBA& color) {
  Marker& marker = add_text(name, text, place + Vector2(0.0, 0.7 * height_m));
  marker.scale.z = height_m;
  marker.color = color;
}

void Drawing::add_square(const std::string& name, const Vector2& place, double side_m,
                         const std_msgs::ColorRGBA& color) {
  Marker& square = add(name, Marker::CUBE);
  square.pose.position = lifted(place, kSquareLevel_m);
  square.scale.x = square.scale.y = side_m;
  square.scale.z = 0.02;
  square.color = color;
}

void Drawing::add_robot(const std::string& name, const std::string& base_frame,
                        const Footprint& footprint) {
  const double radius_m = footprint.circumscribed_radius_m();
  const auto fix = [&](Marker& marker) -> Marker& {
    marker.header.frame_id = base_frame;
    marker.header.stamp = ros::Time(0);
    marker.frame_locked = true;
    marker.color = kRobotColour;
    return marker;
  };
  Marker& line = fix(add(name, Marker::LINE_STRIP));
  line.scale.x = 0.05;
  for (const Vector2& corner : outline(footprint)) line.points.push_back(lifted(corner, 0.08));

  Marker& arrow = fix(add(name, Marker::ARROW));
  arrow.scale.x = 0.06;
  arrow.scale.y = 0.16;
  arrow.points = {lifted(Vector2::Zero(), 0.08), lifted({radius_m, 0.0}, 0.08)};

  fix(add_text(name, name, {0.0, radius_m + 0.7 * kTextHeight_m}));
}

void Drawing::add_goal(const std::string& name, const Vector2& place,
                       std::optional<double> yaw_rad) {
  Marker& disc = add(name, Marker::CYLINDER);
  disc.pose.position = lifted(place, 0.01);
  disc.scale.x = disc.scale.y = 0.3;
  disc.scale.z = 0.02;
  disc.color = kGoalColour;
  add_text(name, name + " goal", place + Vector2(0.0, kTextHeight_m + 0.1)).color = kGoalColour;
  if (!yaw_rad) return;
  Marker& arrow = add(name, Marker::ARROW);
  arrow.pose = to_message(Pose{place, *yaw_rad});
  arrow.scale.x = 0.5;
  arrow.scale.y = arrow.scale.z = 0.08;
  arrow.color = kGoalColour;
}

void Drawing::add_obstacle(const MovingObstacle& obstacle, double t, double horizon_s) {
  for (const double later : sample_times(0.0, horizon_s, kGhostStep_s)) {
    const MovingObstacle::Disc disc = obstacle.at(t + later);
    Marker& cylinder = add(obstacle.name(), Marker::CYLINDER);
    cylinder.pose.position = lifted(disc.centre, 0.005);  // below all lines
    cylinder.scale.x = cylinder.scale.y = 2.0 * disc.radius_m;
    cylinder.scale.z = 0.01;
    // Those to come lie on top of each other: together no more than the first.
    const double share = later > 0.0 ? kGhosts : 1.0;
    cylinder.color =
        color(0.95, 0.45, 0.05, 0.6 * share * (1.0 - later / (horizon_s + kGhostStep_s)));
  }
}

}  // namespace mocha
