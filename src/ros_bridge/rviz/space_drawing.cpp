#include "ros_bridge/rviz/space_drawing.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <cstdio>
#include <variant>
#include <vector>

#include "ros_bridge/messages/space_conversions.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {
namespace {

using visualization_msgs::Marker;

constexpr double kSpaceLineStep_s = 0.05;
constexpr double kSelectedLine_m = 0.09;
constexpr double kOtherLine_m = 0.045;
constexpr double kObstacleCurve_m = 0.03;
constexpr double kSpaceText_m = 0.35;

class SpaceDrawing {
 public:
  SpaceDrawing(const std::string& frame, ros::Time stamp) : frame_(frame), stamp_(stamp) {
    add("", Marker::POINTS).action = Marker::DELETEALL;
  }

  void add_line(const std::string& kind, const std::vector<Eigen::Vector3d>& points, double width_m,
                const std_msgs::ColorRGBA& colour) {
    Marker& line = add(kind, Marker::LINE_STRIP);
    line.scale.x = width_m;
    line.color = colour;
    for (const Eigen::Vector3d& point : points) line.points.push_back(point_message(point));
  }

  void add_text(const std::string& kind, const std::string& text, const Eigen::Vector3d& place,
                const std_msgs::ColorRGBA& colour) {
    Marker& label = add(kind, Marker::TEXT_VIEW_FACING);
    label.text = text;
    label.scale.z = kSpaceText_m;
    label.color = colour;
    label.pose.position = point_message(place);
  }

  const visualization_msgs::MarkerArray& markers() const { return markers_; }

 private:
  Marker& add(const std::string& kind, int type) {
    Marker marker;
    marker.header.frame_id = frame_;
    marker.header.stamp = stamp_;
    marker.ns = kind;
    marker.id = static_cast<int>(markers_.markers.size());
    marker.type = type;
    marker.pose.orientation.w = 1.0;
    markers_.markers.push_back(marker);
    return markers_.markers.back();
  }

  const std::string frame_;
  const ros::Time stamp_;
  visualization_msgs::MarkerArray markers_;
};

std::vector<Eigen::Vector3d> drawn_points(const SpaceCandidate& candidate) {
  if (candidate.curve.pieces() == 0) return candidate.path;
  std::vector<Eigen::Vector3d> points;
  for (double t = 0.0; t < candidate.curve.duration(); t += kSpaceLineStep_s)
    points.push_back(candidate.curve.position(t));
  points.push_back(candidate.curve.position(candidate.curve.duration()));
  return points;
}

/// The part of it that is in the box, and a little beyond.
std::vector<Eigen::Vector3d> corners_of(const Cuts<3>::Curve& curve,
                                        const Eigen::AlignedBox3d& box) {
  if (const auto* column = std::get_if<Column>(&curve)) {
    const auto& [x, y] = std::pair(column->foot.x(), column->foot.y());
    return {{x, y, box.min().z()}, {x, y, box.max().z()}};
  }
  if (const auto* loop = std::get_if<Loop>(&curve)) {
    std::vector<Eigen::Vector3d> corners = loop->corners;
    corners.push_back(corners.front());
    return corners;
  }
  return std::get<Arch>(curve).corners;
}

std::string cost_label(const SpaceCandidate& candidate) {
  char cost[32];
  std::snprintf(cost, sizeof(cost), "%.1f", candidate.cost);
  return candidate.reason == PlanReason::kSolved ? cost : outcome(candidate);
}

}  // namespace

visualization_msgs::MarkerArray space_markers(const SpacePlan& plan, const ObstacleCurves& curves,
                                              const VoxelDistanceField& field,
                                              const std::string& frame, ros::Time stamp) {
  SpaceDrawing drawing(frame, stamp);
  for (const auto& curve : curves.curves)
    drawing.add_line("curves", corners_of(curve, field.bounds()), kObstacleCurve_m,
                     color(0.15, 0.15, 0.2, 0.8));
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const SpaceCandidate& candidate = plan.candidates[i];
    const std::vector<Eigen::Vector3d> points = drawn_points(candidate);
    std_msgs::ColorRGBA own = class_color(i);
    own.a = candidate.reason == PlanReason::kSolved ? 1.0F : 0.4F;
    drawing.add_line("candidates", points,
                     &candidate == plan.selected() ? kSelectedLine_m : kOtherLine_m, own);
    // Not all in the same place: each at a share of its own of the way.
    const double share = (i + 1.0) / (plan.candidates.size() + 1.0);
    const Eigen::Vector3d& place = points[static_cast<std::size_t>(share * (points.size() - 1))];
    drawing.add_text("costs", cost_label(candidate),
                     place + kSpaceText_m * Eigen::Vector3d::UnitZ(), own);
  }
  return drawing.markers();
}

sensor_msgs::PointCloud2 solid_cells_message(const VoxelDistanceField& field,
                                             const std::string& frame, ros::Time stamp) {
  const std::vector<Eigen::Vector3d> centres = field.surface();
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = frame;
  cloud.header.stamp = stamp;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(centres.size());
  sensor_msgs::PointCloud2Iterator<float> value(cloud, "x");
  for (const Eigen::Vector3d& centre : centres) {
    for (int axis = 0; axis < 3; ++axis) value[axis] = static_cast<float>(centre[axis]);
    ++value;
  }
  return cloud;
}

}  // namespace mocha
