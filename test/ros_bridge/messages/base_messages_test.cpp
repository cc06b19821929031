#include "ros_bridge/messages/base_messages.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

const RobotIdentity kRobot{"ugv1", "map", "ugv1/odom", "ugv1/base_link"};

BaseFeedback feedback() {
  BaseFeedback feedback;
  feedback.stamp_s = 12.5;
  feedback.pose = {{1.0, 2.0}, 0.5};
  feedback.pose_covariance << 0.1, 0.01, 0.02, 0.01, 0.2, 0.03, 0.02, 0.03, 0.3;
  feedback.twist = {0.4, -0.6};
  feedback.speed_variance = 0.04;
  feedback.yaw_rate_variance = 0.09;
  feedback.imu = ImuReading{{0.1, 0.2, 9.8}, {0.01, 0.02, -0.6}};
  feedback.battery_v = 11.5;
  return feedback;
}

TEST(BaseMessages, OdometryHasItsCovarianceInItsPlaces) {
  const auto message = odometry_message(feedback(), kRobot);
  EXPECT_EQ(message.header.stamp.toSec(), 12.5);
  EXPECT_EQ(message.header.frame_id, "ugv1/odom");
  EXPECT_EQ(message.child_frame_id, "ugv1/base_link");
  EXPECT_EQ(message.pose.pose.position.y, 2.0);
  EXPECT_EQ(message.twist.twist.angular.z, -0.6);
  const auto& pose = message.pose.covariance;
  EXPECT_EQ(pose[0], 0.1);
  EXPECT_EQ(pose[7], 0.2);
  EXPECT_EQ(pose[35], 0.3);
  EXPECT_EQ(pose[5], 0.02);
  EXPECT_EQ(pose[30], 0.02);
  EXPECT_EQ(pose[11], 0.03);
  EXPECT_EQ(pose[31], 0.03);
  for (const int unknown : {14, 21, 28}) EXPECT_GT(pose[unknown], 1e3);
  EXPECT_EQ(message.twist.covariance[0], 0.04);
  EXPECT_EQ(message.twist.covariance[35], 0.09);
}

TEST(BaseMessages, TheTransformIsThatOfTheOdometry) {
  const auto transform = odometry_transform(feedback(), kRobot);
  EXPECT_EQ(transform.header.frame_id, "ugv1/odom");
  EXPECT_EQ(transform.child_frame_id, "ugv1/base_link");
  EXPECT_EQ(transform.transform.translation.x, 1.0);
  EXPECT_NEAR(2.0 * std::asin(transform.transform.rotation.z), 0.5, 1e-12);
}

TEST(BaseMessages, WhatIsNotMeasuredIsMarkedSo) {
  const auto imu = imu_message(feedback(), kRobot);
  EXPECT_EQ(imu.orientation_covariance[0], -1.0);
  EXPECT_EQ(imu.angular_velocity.z, -0.6);
  EXPECT_EQ(imu.linear_acceleration.z, 9.8);
  const auto battery = battery_message(feedback());
  EXPECT_EQ(battery.voltage, 11.5f);
  EXPECT_TRUE(std::isnan(battery.percentage));
  EXPECT_TRUE(std::isnan(battery.current));
  EXPECT_TRUE(battery.present);
}

}  // namespace
}  // namespace mocha
