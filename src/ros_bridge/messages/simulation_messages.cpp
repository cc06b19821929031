#include "ros_bridge/messages/simulation_messages.h"

#include "ros_bridge/messages/conversions.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

/// The frame in which a thing at `outer` is seen at `inner`.
Pose frame_between(const Pose& outer, const Pose& inner) {
  return composed(outer, relative(inner, {{0.0, 0.0}, 0.0}));
}

mocha_ugv::RobotTruth truth_message(const SimulatedRobot& robot) {
  const Pose& pose = robot.vehicle.pose();
  const RunRecord& record = robot.record;
  mocha_ugv::RobotTruth truth;
  truth.name = robot.setup.name;
  truth.pose.x = pose.position.x();
  truth.pose.y = pose.position.y();
  truth.pose.theta = pose.yaw_rad;
  truth.speed = robot.vehicle.twist().speed;
  truth.yaw_rate = robot.vehicle.twist().yaw_rate;
  truth.clearance = robot.clearance_m;
  truth.path_length = record.path_length_m();
  truth.acceleration = robot.vehicle.acceleration();
  truth.moved = record.moved_at_s().has_value();
  if (truth.moved) truth.moved_at = ros::Time(*record.moved_at_s());
  truth.has_goal = robot.setup.goal.has_value();
  truth.reached = record.reached_at_s().has_value();
  if (truth.reached) truth.reached_at = ros::Time(*record.reached_at_s());
  truth.contacts = robot.contacts;
  truth.own_contacts = robot.own_contacts;
  return truth;
}

std::uint8_t to_message(Blame blame) {
  switch (blame) {
    case Blame::kOwn:
      return mocha_ugv::Contact::OWN;
    case Blame::kStanding:
      return mocha_ugv::Contact::STANDING;
    case Blame::kUnseen:
      return mocha_ugv::Contact::UNSEEN;
  }
  return mocha_ugv::Contact::OWN;
}

}  // namespace

nav_msgs::Odometry odometry_message(const SimulatedRobot& robot, ros::Time stamp) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = robot.setup.name + "/odom";
  message.child_frame_id = robot.setup.name + "/base_link";
  message.pose.pose = to_message(robot.odometry.pose());
  message.twist.twist.linear.x = robot.odometry.twist().speed;
  message.twist.twist.angular.z = robot.odometry.twist().yaw_rate;
  return message;
}

sensor_msgs::LaserScan scan_message(const SimulatedRobot& robot, const Scan& scan) {
  const LidarModel& lidar = robot.setup.model.lidar;
  sensor_msgs::LaserScan message;
  message.header.stamp = ros::Time(scan.start_time_s);
  message.header.frame_id = robot.setup.name + "/laser";
  message.angle_min = static_cast<float>(robot.lidar.angle_min_rad());
  message.angle_increment = static_cast<float>(robot.lidar.angle_increment_rad());
  message.angle_max = static_cast<float>(robot.lidar.angle_min_rad() +
                                         robot.lidar.angle_increment_rad() * (lidar.beams - 1));
  message.time_increment = static_cast<float>(robot.lidar.time_increment_s());
  message.scan_time = static_cast<float>(1.0 / lidar.rate_hz);
  message.range_min = static_cast<float>(lidar.min_range_m);
  message.range_max = static_cast<float>(lidar.max_range_m);
  message.ranges = scan.ranges_m;
  return message;
}

geometry_msgs::TransformStamped odom_to_base(const SimulatedRobot& robot, ros::Time stamp) {
  const std::string& name = robot.setup.name;
  return transform_message(stamp, name + "/odom", name + "/base_link", robot.odometry.pose());
}

geometry_msgs::TransformStamped map_to_odom(const SimulatedRobot& robot, ros::Time stamp) {
  return transform_message(stamp, "map", robot.setup.name + "/odom",
                           frame_between(robot.vehicle.pose(), robot.odometry.honest_pose()));
}

geometry_msgs::TransformStamped map_to_odom(const SimulatedRobot& robot,
                                            const nav_msgs::Odometry& odometry, ros::Time stamp) {
  const Pose then = robot.past.at(odometry.header.stamp.toSec());
  return transform_message(stamp, "map", odometry.header.frame_id,
                           frame_between(then, from_message(odometry.pose.pose)));
}

geometry_msgs::TransformStamped base_to_laser(const SimulatedRobot& robot) {
  const std::string& name = robot.setup.name;
  const LidarModel& lidar = robot.setup.model.lidar;
  return transform_message(ros::Time(), name + "/base_link", name + "/laser", lidar.mount,
                           lidar.height_m);
}

mocha_ugv::GroundTruth ground_truth_message(const WorldSimulator& simulator, ros::Time stamp) {
  mocha_ugv::GroundTruth message;
  message.header.stamp = stamp;
  message.header.frame_id = "map";
  for (const SimulatedRobot& robot : simulator.robots()) {
    message.robots.push_back(truth_message(robot));
  }
  message.min_separation = simulator.min_separation_m();
  return message;
}

mocha_ugv::Contact contact_message(const ContactEvent& contact, ros::Time stamp) {
  mocha_ugv::Contact message;
  message.header.stamp = stamp;
  message.header.frame_id = "map";
  message.robot = contact.robot;
  message.other = contact.other;
  message.place.x = contact.touch.place.x();
  message.place.y = contact.touch.place.y();
  message.depth = contact.depth_m;
  message.blame = to_message(contact.blame);
  message.robot_speed = contact.touch.own_velocity.norm();
  message.approach_speed = contact.touch.approach_mps();
  return message;
}

}  // namespace mocha
