#include "perception/monitoring/motion_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "perception/monitoring/scan_motion.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.1;

/// A winding drive with changing speed.
Pose driven(double t) {
  const double s = 0.6 * t + 0.2 * std::sin(1.5 * t);
  return {{s, 0.4 * std::sin(s)}, std::atan(0.4 * std::cos(s))};
}

Pose turned_step(const Pose& step, double turn_rad, double scale) {
  return {scale * (Eigen::Rotation2Dd(turn_rad) * step.position), step.yaw_rad};
}

/// What is found of scans whose step at a time is `step_at`.
std::optional<MotionDifference> compared(const std::function<Pose(double)>& step_at,
                                         double until_s = 8.0) {
  MotionComparison comparison(1.5);
  for (double t = 0.0; t < until_s; t += kStep_s)
    comparison.add(t, driven(t), t > 0.0 ? std::optional(step_at(t)) : std::nullopt);
  return comparison.difference(0.01);
}

Pose true_step(double t) { return relative(driven(t - kStep_s), driven(t)); }

TEST(MotionComparison, FindsNothingWhereBothAgree) {
  const auto found = compared(true_step);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->lag_s, 0.0);
  EXPECT_NEAR(found->turn_rad, 0.0, 1e-6);
  EXPECT_NEAR(found->slip, 0.0, 1e-6);
}

TEST(MotionComparison, FindsTheLag) {
  const auto found = compared([](double t) { return true_step(t - 0.3); });
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lag_s, 0.3, 1e-6);
}

TEST(MotionComparison, FindsTurnAndSlip) {
  const auto found = compared([](double t) { return turned_step(true_step(t), -0.05, 1.0 / 1.2); });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->lag_s, 0.0);
  EXPECT_NEAR(found->turn_rad, 0.05, 1e-6);
  EXPECT_NEAR(found->slip, 0.2, 1e-6);
}

TEST(MotionComparison, SaysNothingBeforeTheRobotHasMoved) {
  EXPECT_FALSE(compared(true_step, 0.5));
  EXPECT_FALSE(compared([](double) { return Pose{}; }, 0.8));
}

TEST(MotionComparison, SeesAnOdometryThatStands) {
  MotionComparison comparison(1.5);
  for (int i = 0; i < 10; ++i) comparison.add(kStep_s * i, {}, Pose{{0.05, 0.0}, 0.0});
  EXPECT_NEAR(comparison.unreported_travel_m(), 0.45, 1e-9);
  for (int i = 10; i < 20; ++i)
    comparison.add(kStep_s * i, {{0.05 * (i - 9), 0.0}, 0.0}, Pose{{0.05, 0.0}, 0.0});
  EXPECT_EQ(comparison.unreported_travel_m(), 0.0);
}

/// Hits all round in a room of 8 x 6 m with its lower left corner at (-3, -2), from `base`.
ScanHits room_from(const Pose& base) {
  ScanHits scan;
  for (int i = 0; i < 360; ++i) {
    const double angle = base.yaw_rad + (i - 180) * M_PI / 180.0;
    const Vector2 ray(std::cos(angle), std::sin(angle));
    const double x_m = ((ray.x() > 0.0 ? 5.0 : -3.0) - base.position.x()) / ray.x();
    const double y_m = ((ray.y() > 0.0 ? 4.0 : -2.0) - base.position.y()) / ray.y();
    const Vector2 hit = base.position + std::min(x_m, y_m) * ray;
    scan.hits.push_back(relative(base, {hit, 0.0}).position);
  }
  return scan;
}

TEST(ReferenceScan, TellsWhereAScanWasTaken) {
  const Pose there{{0.2, -0.1}, 0.15};
  const auto found = ReferenceScan(room_from({})).align(room_from(there), {});
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->pose.position - there.position).norm(), 0.0, 2e-3);
  EXPECT_NEAR(found->pose.yaw_rad, there.yaw_rad, 1e-3);
  EXPECT_GT(found->inliers, 0.7);
}

TEST(ReferenceScan, SaysNothingInALongCorridor) {
  ScanHits corridor;
  for (int i = -100; i <= 100; ++i) corridor.hits.emplace_back(0.05 * i, -1.0);
  for (int i = 100; i >= -100; --i) corridor.hits.emplace_back(0.05 * i, 1.0);
  EXPECT_FALSE(ReferenceScan(corridor).align(corridor, {}));
}

TEST(ReferenceScan, SaysNothingOfAnotherPlace) {
  ScanHits elsewhere = room_from({});
  for (std::size_t i = 0; i < elsewhere.hits.size(); ++i)
    elsewhere.hits[i] *= i % 3 == 0 ? 1.0 : 0.4;
  EXPECT_FALSE(ReferenceScan(room_from({})).align(elsewhere, {}));
  EXPECT_FALSE(ReferenceScan(room_from({})).align(ScanHits{}, {}));
  EXPECT_FALSE(ReferenceScan(ScanHits{}).align(room_from({}), {}));
}

TEST(ScanMotion, FollowsTheRobotWhateverTheOdometrySays) {
  ScanMotion motion;
  EXPECT_FALSE(motion.add(room_from(driven(0.0)), {}));
  for (int i = 1; i < 20; ++i) {
    const auto step = motion.add(room_from(driven(kStep_s * i)), {});
    ASSERT_TRUE(step) << i;
    EXPECT_NEAR((step->position - true_step(kStep_s * i).position).norm(), 0.0, 4e-3) << i;
  }
}

}  // namespace
}  // namespace mocha
