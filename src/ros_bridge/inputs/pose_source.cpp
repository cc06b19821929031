#include "ros_bridge/inputs/pose_source.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/runtime/transport.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f s", value);
  return text;
}

bool well_formed(const nav_msgs::Odometry& odometry) {
  const Pose pose = from_message(odometry.pose.pose);
  const auto& q = odometry.pose.pose.orientation;
  const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return pose.position.allFinite() && std::isfinite(pose.yaw_rad) && std::abs(norm - 1.0) < 0.1 &&
         std::isfinite(odometry.twist.twist.linear.x) &&
         std::isfinite(odometry.twist.twist.angular.z) && !odometry.header.frame_id.empty();
}

}  // namespace

OdometryPose::OdometryPose(std::string map_frame, std::string topic, double max_odometry_age_s,
                           double max_transform_age_s)
    : map_frame_(std::move(map_frame)),
      topic_(std::move(topic)),
      max_odometry_age_s_(max_odometry_age_s),
      max_transform_age_s_(max_transform_age_s) {}

void OdometryPose::on_odometry(const nav_msgs::Odometry& odometry) {
  if (!well_formed(odometry)) {
    ++refused_;
    return;
  }
  odom_frame_ = odometry.header.frame_id;
  in_odom_.stamp_s = odometry.header.stamp.toSec();
  in_odom_.pose = from_message(odometry.pose.pose);
  in_odom_.twist = {odometry.twist.twist.linear.x, odometry.twist.twist.angular.z};
}

PoseReading OdometryPose::read(const tf2::BufferCore& transforms, double now_s) const {
  PoseReading reading;
  if (odom_frame_.empty()) {
    reading.missing = "no odometry on " + topic_ + " yet";
    return reading;
  }
  reading.odometry_age_s = now_s - in_odom_.stamp_s;
  if (std::abs(reading.odometry_age_s) > max_odometry_age_s_) {
    reading.missing = reading.odometry_age_s > 0.0
                          ? "no odometry on " + topic_ + " for " + seconds(reading.odometry_age_s)
                          : "odometry on " + topic_ + " is stamped " +
                                seconds(-reading.odometry_age_s) + " in the future";
    return reading;
  }
  geometry_msgs::TransformStamped map_to_odom;
  try {
    map_to_odom = transforms.lookupTransform(map_frame_, odom_frame_, ros::Time(0));
  } catch (const tf2::TransformException&) {
    reading.missing = "no transform " + map_frame_ + " -> " + odom_frame_;
    return reading;
  }
  const ros::Time stamp = map_to_odom.header.stamp;
  reading.transform_age_s = stamp.isZero() ? 0.0 : now_s - stamp.toSec();
  if (reading.transform_age_s > max_transform_age_s_) {
    reading.missing = "no transform " + map_frame_ + " -> " + odom_frame_ + " for " +
                      seconds(reading.transform_age_s);
    return reading;
  }
  geometry_msgs::Pose odom_origin;
  odom_origin.position.x = map_to_odom.transform.translation.x;
  odom_origin.position.y = map_to_odom.transform.translation.y;
  odom_origin.orientation = map_to_odom.transform.rotation;
  reading.state = in_odom_;
  reading.in_odom = in_odom_.pose;
  reading.state->pose = composed(from_message(odom_origin), in_odom_.pose);
  return reading;
}

PoseSource::PoseSource(ros::NodeHandle& node, const RobotIdentity& robot, double max_odometry_age_s,
                       double max_transform_age_s)
    : pose_(robot.map_frame, node.resolveName("odom"), max_odometry_age_s, max_transform_age_s),
      listener_(transforms_, node, false, at_once()),
      odometry_(node.subscribe("odom", 5, &OdometryPose::on_odometry, &pose_, at_once())) {}

}  // namespace mocha
