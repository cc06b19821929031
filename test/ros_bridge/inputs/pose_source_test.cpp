#include "ros_bridge/inputs/pose_source.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ros_bridge/messages/conversions.h"

namespace mocha {
namespace {

nav_msgs::Odometry odometry(double stamp, const Pose& pose, double speed = 0.0,
                            double yaw_rate = 0.0) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(stamp);
  message.header.frame_id = "ugv1/odom";
  message.pose.pose = to_message(pose);
  message.twist.twist.linear.x = speed;
  message.twist.twist.angular.z = yaw_rate;
  return message;
}

geometry_msgs::TransformStamped map_to_odom(double stamp, const Pose& pose) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(stamp);
  transform.header.frame_id = "map";
  transform.child_frame_id = "ugv1/odom";
  transform.transform.translation.x = pose.position.x();
  transform.transform.translation.y = pose.position.y();
  transform.transform.rotation = quaternion_of(pose.yaw_rad);
  return transform;
}

struct PoseSourceTest : ::testing::Test {
  OdometryPose source{"map", "/ugv1/odom", 0.25, 0.5};
  tf2::BufferCore transforms;

  std::string missing(double now) const { return source.read(transforms, now).missing; }
};

TEST_F(PoseSourceTest, CombinesTransformAndOdometry) {
  transforms.setTransform(map_to_odom(9.8, {{10.0, 5.0}, M_PI / 2.0}), "test");
  source.on_odometry(odometry(10.0, {{2.0, 1.0}, 0.3}, 0.7, -0.2));
  const PoseReading reading = source.read(transforms, 10.05);
  ASSERT_TRUE(reading.state) << reading.missing;
  EXPECT_NEAR(reading.state->pose.position.x(), 9.0, 1e-9);
  EXPECT_NEAR(reading.state->pose.position.y(), 7.0, 1e-9);
  EXPECT_NEAR(reading.state->pose.yaw_rad, M_PI / 2.0 + 0.3, 1e-9);
  EXPECT_EQ(reading.state->stamp_s, 10.0);
  EXPECT_EQ(reading.state->twist.speed, 0.7);
  EXPECT_EQ(reading.state->twist.yaw_rate, -0.2);
  EXPECT_NEAR(reading.odometry_age_s, 0.05, 1e-9);
  EXPECT_NEAR(reading.transform_age_s, 0.25, 1e-9);
}

TEST_F(PoseSourceTest, SaysWhatIsMissing) {
  EXPECT_EQ(missing(10.0), "no odometry on /ugv1/odom yet");
  source.on_odometry(odometry(10.0, {}));
  EXPECT_EQ(missing(10.0), "no transform map -> ugv1/odom");
  EXPECT_EQ(missing(10.4), "no odometry on /ugv1/odom for 0.40 s");
  EXPECT_EQ(missing(9.0), "odometry on /ugv1/odom is stamped 1.00 s in the future");
  transforms.setTransform(map_to_odom(10.0, {}), "test");
  source.on_odometry(odometry(11.0, {}));
  EXPECT_EQ(missing(11.0), "no transform map -> ugv1/odom for 1.00 s");
}

TEST_F(PoseSourceTest, StaticTransformDoesNotAge) {
  transforms.setTransform(map_to_odom(0.0, {}), "test", true);
  source.on_odometry(odometry(100.0, {}));
  EXPECT_EQ(missing(100.0), "");
}

TEST_F(PoseSourceTest, MalformedOdometryIsRefusedAndCounted) {
  transforms.setTransform(map_to_odom(10.0, {}), "test");
  source.on_odometry(odometry(10.0, {{1.0, 0.0}, 0.0}));
  source.on_odometry(odometry(10.1, {{NAN, 0.0}, 0.0}));
  source.on_odometry(odometry(10.1, {}, INFINITY));
  nav_msgs::Odometry no_rotation = odometry(10.1, {});
  no_rotation.pose.pose.orientation.w = 0.0;
  source.on_odometry(no_rotation);
  EXPECT_EQ(source.refused(), 3);
  EXPECT_EQ(source.read(transforms, 10.1).state->pose.position.x(), 1.0);
}

}  // namespace
}  // namespace mocha
