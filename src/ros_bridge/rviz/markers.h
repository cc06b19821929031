#pragma once

#include <nav_msgs/Path.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trajectory/motion.h"
#include "world/footprint.h"
#include "world/moving/moving_obstacle.h"

namespace mocha {

/// Poses along the motion, `dt` [s] apart, with the times at which the robot is there.
nav_msgs::Path to_path(const Motion& motion, const std::string& frame, double dt);

/// Positions along the drives of a motion, `dt` [s] apart.
std::vector<Vector2> polyline(const Motion& motion, double dt);

/// The same polyline with points 0.15 m apart, as dashes need them.
std::vector<Vector2> evenly(const std::vector<Vector2>& path);

std_msgs::ColorRGBA color(double red, double green, double blue, double alpha = 1.0);

/// Colours to tell paths of different classes apart; the ninth is the first again.
std_msgs::ColorRGBA class_color(std::size_t number);

/// A picture for rviz: it replaces all that was published before on its topic. Markers are numbered
/// in the order in which they are added, in one namespace per kind and name.
class Drawing {
 public:
  Drawing(const std::string& frame, ros::Time stamp);

  /// A broad line with dark edges, coloured by speed: blue at rest, red at `max_speed` [m/s].
  void add_motion(const std::string& name, const Motion& motion, double max_speed);

  /// A line of one colour; dashed, every other stretch between the points is left out.
  void add_line(const std::string& name, const std::vector<Vector2>& points, double width_m,
                const std_msgs::ColorRGBA& color, bool dashed);

  void add_label(const std::string& name, const std::string& text, const Vector2& place,
                 double height_m, const std_msgs::ColorRGBA& color);

  void add_square(const std::string& name, const Vector2& place, double side_m,
                  const std_msgs::ColorRGBA& color);

  /// Outline, heading and name of a robot, fixed to its frame.
  void add_robot(const std::string& name, const std::string& base_frame,
                 const Footprint& footprint);

  /// A disc with the robot's name, and an arrow where a heading is asked for.
  void add_goal(const std::string& name, const Vector2& place, std::optional<double> yaw_rad);

  /// Where a moving thing will be from `t` to `t + horizon_s`, ever fainter.
  void add_obstacle(const MovingObstacle& obstacle, double t, double horizon_s);

  const visualization_msgs::MarkerArray& markers() const { return markers_; }

 private:
  visualization_msgs::Marker& add(const std::string& name, int type);
  visualization_msgs::Marker& add_text(const std::string& name, const std::string& text,
                                       const Vector2& place);

  std::string frame_;
  ros::Time stamp_;
  std::map<std::string, int> next_id_;
  visualization_msgs::MarkerArray markers_;
};

}  // namespace mocha
