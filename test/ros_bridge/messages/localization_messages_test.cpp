#include "ros_bridge/messages/localization_messages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/messages/covariances.h"

namespace mocha {
namespace {

const RobotIdentity kRobot{"ugv1", "map", "ugv1/odom", "ugv1/base_link"};

geometry_msgs::PoseWithCovarianceStamped said() {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.frame_id = "map";
  message.pose.pose = to_message(Pose{{1.0, -2.0}, 0.5});
  message.pose.covariance[0] = message.pose.covariance[7] = 0.25;
  message.pose.covariance[35] = 0.07;
  return message;
}

TEST(LocalizationMessages, SayWhereTheRobotIsAndHowWell) {
  Localization localization;
  localization.state = Localization::State::kLocalized;
  localization.time_s = 12.5;
  localization.base.pose = {{3.0, 4.0}, 0.3};
  localization.base.covariance << 4e-4, 1e-4, 0.0, 1e-4, 5e-4, 2e-5, 0.0, 2e-5, 1e-4;
  localization.odom_in_map = {{-1.0, 2.0}, -0.7};
  localization.quality = 0.93;
  localization.places = 1;
  const auto state = to_message(localization, kRobot);
  EXPECT_EQ(state.state, mocha_ugv::Localization::LOCALIZED);
  EXPECT_NEAR(state.sigma_position, 0.03, 1e-9);
  EXPECT_NEAR(state.sigma_yaw, 0.01, 1e-9);
  EXPECT_EQ(state.message, "localised, to within 30 mm; the map explains 93 %");
  const auto pose = pose_message(localization, kRobot);
  EXPECT_EQ(pose.header.stamp, ros::Time(12.5));
  EXPECT_EQ(planar_covariance(pose.pose.covariance), localization.base.covariance);
  EXPECT_EQ(pose.pose.covariance[14], kUnknownVariance);
  const auto transform = map_to_odom(localization, kRobot);
  EXPECT_EQ(transform.header.frame_id, "map");
  EXPECT_EQ(transform.child_frame_id, "ugv1/odom");
  EXPECT_EQ(transform.transform.translation.x, -1.0);
  EXPECT_NEAR(transform.transform.rotation.z, std::sin(-0.35), 1e-12);
}

TEST(LocalizationMessages, SayWhyNothingIsKnown) {
  Localization localization;
  EXPECT_EQ(to_message(localization, kRobot).message, "lost: no place in the map looks like this");
  localization.searched_in_vain = true;
  EXPECT_NE(to_message(localization, kRobot).message.find("give an initialpose"),
            std::string::npos);
  localization.state = Localization::State::kAmbiguous;
  localization.places = 3;
  EXPECT_EQ(to_message(localization, kRobot).message,
            "3 places look like this: drive on by hand, or give an initialpose");
}

TEST(LocalizationMessages, TakeWhatSomebodySays) {
  std::string fault;
  const auto estimate = from_message(said(), "map", fault);
  ASSERT_TRUE(estimate) << fault;
  EXPECT_EQ(estimate->pose.position, Vector2(1.0, -2.0));
  EXPECT_NEAR(estimate->pose.yaw_rad, 0.5, 1e-12);
  EXPECT_EQ(estimate->covariance(1, 1), 0.25);
  geometry_msgs::PoseWithCovarianceStamped exact = said();
  exact.pose.covariance.fill(0.0);
  const auto least = from_message(exact, "map", fault);
  ASSERT_TRUE(least) << fault;
  EXPECT_NEAR(least->covariance(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(least->covariance(2, 2), 0.01, 1e-12);
}

TEST(LocalizationMessages, RefuseWhatMakesNoSense) {
  const auto fault_of = [](auto damage) {
    geometry_msgs::PoseWithCovarianceStamped message = said();
    damage(message);
    std::string fault;
    EXPECT_FALSE(from_message(message, "map", fault));
    return fault;
  };
  EXPECT_EQ(fault_of([](auto& m) { m.header.frame_id = "odom"; }),
            "in frame `odom` instead of map");
  EXPECT_EQ(fault_of([](auto& m) { m.pose.pose.position.x = NAN; }), "not finite, or too far away");
  EXPECT_EQ(fault_of([](auto& m) { m.pose.covariance[35] = INFINITY; }),
            "its covariance is not positive definite");
  EXPECT_EQ(fault_of([](auto& m) { m.pose.covariance[1] = m.pose.covariance[6] = 5.0; }),
            "its covariance is not positive definite");
}

}  // namespace
}  // namespace mocha
