#include "perception/localization/odometry_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "perception/shipped_options.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

TEST(OdometryNoiseTest, ManySmallStepsWalkAtRandom) {
  const OdometryNoise noise;
  const Pose small{{0.04, 0.0}, 0.0};
  PoseEstimate after;
  for (int i = 0; i < 100; ++i) after = noise.after(after, small);
  const Eigen::Matrix3d large = noise.of({{4.0, 0.0}, 0.0});
  EXPECT_NEAR(after.pose.position.x(), 4.0, 1e-9);
  EXPECT_NEAR(after.covariance(2, 2), large(2, 2), 1e-9);
  EXPECT_NEAR(after.covariance(1, 1), large(1, 1), 0.02 * large(1, 1));
  EXPECT_NEAR(after.covariance(0, 0), 100.0 * noise.of(small)(0, 0), 1e-9);
}

TEST(OdometryNoiseTest, ALongStepMayHaveSlipped) {
  const double angle_rad = 0.7;
  const Vector2 ahead(std::cos(angle_rad), std::sin(angle_rad));
  const Vector2 aside(-ahead.y(), ahead.x());
  const Eigen::Matrix2d noise =
      OdometryNoise(shipped_robot(), 0.1).of({2.0 * ahead, 0.0}).topLeftCorner<2, 2>();
  EXPECT_GT(std::sqrt(ahead.dot(noise * ahead)), 0.2);
  EXPECT_LT(std::sqrt(aside.dot(noise * aside)), 0.06);
  EXPECT_NEAR(ahead.dot(noise * aside), 0.0, 1e-12);
  EXPECT_TRUE(OdometryNoise().of({{0.0, 0.0}, 0.2}).allFinite());
}

TEST(OdometryNoiseTest, AHeadingThatIsNotKnownLeadsAside) {
  PoseEstimate before{{{1.0, 2.0}, M_PI_2}, Eigen::Matrix3d::Zero()};
  before.covariance(2, 2) = 0.01;
  const Pose step{{2.0, 0.0}, 0.3};
  const PoseEstimate after = OdometryNoise().after(before, step);
  EXPECT_NEAR(after.pose.position.x(), 1.0, 1e-12);
  EXPECT_NEAR(after.pose.position.y(), 4.0, 1e-12);
  EXPECT_NEAR(after.pose.yaw_rad, M_PI_2 + 0.3, 1e-12);
  const Eigen::Matrix3d own = OdometryNoise().of(step);
  EXPECT_NEAR(after.covariance(0, 0) - own(1, 1), 4.0 * 0.01, 1e-12);  // it drives north
  EXPECT_NEAR(after.covariance(1, 1) - own(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(after.covariance(0, 2), -2.0 * 0.01, 1e-12);
}

TEST(OdometryNoiseTest, AModelMaySayMoreButNotLess) {
  RobotModel model = shipped_robot();
  model.odometry_noise_distance = model.odometry_noise_yaw = 0.0;
  const Pose step{{1.0, 0.0}, 0.5};
  EXPECT_EQ(OdometryNoise(model, 0.05).of(step), OdometryNoise().of(step));
  model.odometry_noise_distance = 0.1;
  model.odometry_noise_yaw = 0.2;
  const Eigen::Matrix3d worse = OdometryNoise(model, 0.05).of(step);
  EXPECT_GT(worse(0, 0), 0.04);
  EXPECT_NEAR(worse(2, 2), 0.16 * (0.5 + 0.1), 1e-12);
}

}  // namespace
}  // namespace mocha
