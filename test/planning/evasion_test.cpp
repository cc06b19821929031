#include "planning/evasion.h"

#include <gtest/gtest.h>

#include "planning/conflict.h"
#include "planning/worlds.h"
#include "safety/certificate.h"
#include "safety/margin_budget.h"
#include "trajectory/random_motion.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class EvasionTest : public ::testing::TestWithParam<const char*> {
 protected:
  const RobotModel robot_ = load_robot_model("config", GetParam());
  const double required_m_ =
      robot_.footprint.circumscribed_radius_m() + MarginBudget::of(robot_).static_margin_m();
  const double deceleration_ = 0.6 * robot_.limits.max_acceleration;
  const OccupancyGrid open_ = free_grid({-6.0, -6.0}, {6.0, 6.0});
  const std::shared_ptr<const DistanceField> nowhere_ = occupied_field(open_);

  static MovingThing person(const Vector2& centre, const Vector2& velocity) {
    return {std::make_shared<PredictedDisc>("person", kNow_s, centre, velocity, 0.25, 0.0), 0.5,
            kForever_s};
  }
  std::vector<Motion> evade(const Motion& committed, double start_s,
                            std::vector<MovingThing> moving,
                            const std::shared_ptr<const DistanceField>& field) const {
    return evasions(committed, start_s, deceleration_, robot_,
                    {*field, required_m_, std::move(moving), start_s + 5.0});
  }
  Motion at_full_speed() const {
    const Peaks limits{0.95 * robot_.limits.max_speed, 0.7 * robot_.limits.max_acceleration,
                       0.7 * robot_.limits.max_yaw_rate};
    return within(random_drive(3, 8), limits, kNow_s);
  }
};

TEST_P(EvasionTest, EveryOneKeepsTheLimitsAndGoesOnFromTheMotionToRest) {
  for (int seed = 0; seed < 10; ++seed) {
    const Motion committed =
        within(random_drive(seed, 8),
               {0.9 * robot_.limits.max_speed, 0.7 * robot_.limits.max_acceleration,
                0.7 * robot_.limits.max_yaw_rate},
               kNow_s);
    for (const double start_s : {kNow_s - 1.0, kNow_s + 0.7, kNow_s + 2.0, kNow_s + 90.0}) {
      const MotionState leaves = committed.at(start_s);
      const auto found = evade(committed, start_s, {}, nowhere_);
      ASSERT_FALSE(found.empty());
      EXPECT_LE(found.size(), 10u);
      for (const Motion& motion : found) {
        const Violation violation = check_limits(motion, robot_.limits, start_s);
        EXPECT_FALSE(violation) << seed << ": " << describe(violation);
        EXPECT_EQ(motion.start_time(), start_s);
        const MotionState begins = motion.at(start_s + 1e-6);
        EXPECT_LT((begins.pose.position - leaves.pose.position).norm(), 1e-4);
        EXPECT_LT((begins.velocity - leaves.velocity).norm(), 1e-3);
        EXPECT_LT(std::abs(wrap_angle(begins.pose.yaw_rad - leaves.pose.yaw_rad)), 1e-3);
        EXPECT_TRUE(motion.at(motion.end_time() + 0.1).at_rest);
      }
    }
  }
}

TEST_P(EvasionTest, StepsOutOfTheWayOfWhatComes) {
  const Motion stands = standing(kNow_s, {0.0, 0.0}, 0.0);
  for (int i = 0; i < 8; ++i) {
    const Vector2 course(std::cos(0.7 * i), std::sin(0.7 * i));
    const MovingThing comes = person(-4.0 * course, 1.2 * course);
    ASSERT_LT(least_room_m(stands, {comes}, kNow_s, kNow_s + 5.0), 0.0);
    const auto found = evade(stands, kNow_s, {comes}, nowhere_);
    ASSERT_FALSE(found.empty());
    EXPECT_GT(least_room_m(found.front(), {comes}, kNow_s, kNow_s + 5.0), 0.0) << i;
  }
}

TEST_P(EvasionTest, OfTwoWithEnoughRoomTheSoonerDoneComesFirst) {
  const Motion stands = standing(kNow_s, {0.0, 0.0}, 0.0);
  const auto found = evade(stands, kNow_s, {person({40.0, 0.0}, {0.0, 0.0})}, nowhere_);
  ASSERT_GT(found.size(), 1u);
  for (std::size_t i = 1; i < found.size(); ++i)
    EXPECT_LE(found[i - 1].end_time(), found[i].end_time());
  EXPECT_EQ(found.front().phases().size(), 2u);  // stands, and drives without a turn
}

TEST_P(EvasionTest, GoesBackwardWhereThatIsTheWay) {
  // What comes is ahead, and walls are on both sides.
  OccupancyGrid corridor = open_;
  fill_box(corridor, {-6.0, required_m_ + 0.1}, {6.0, 6.0});
  fill_box(corridor, {-6.0, -6.0}, {6.0, -required_m_ - 0.1});
  const auto walls = occupied_field(corridor);
  const Motion stands = standing(kNow_s, {0.0, 0.0}, 0.0);
  const MovingThing comes = person({1.6, 0.0}, {-0.3, 0.0});
  const auto found = evade(stands, kNow_s, {comes}, walls);
  ASSERT_FALSE(found.empty());
  const auto& drive = std::get<DrivePhase>(found.front().phases().back());
  EXPECT_EQ(drive.direction, -1);
  EXPECT_LT(found.front().end_pose().position.x(), -0.3);
  EXPECT_NEAR(found.front().end_pose().yaw_rad, 0.0, 1e-6);
  for (const Motion& motion : found)
    EXPECT_FALSE(check_clearance(motion, robot_.footprint, *walls, 0.0, kNow_s));
}

TEST_P(EvasionTest, StandsFreeAtTheEnd) {
  const auto pillars = [&] {
    OccupancyGrid grid = open_;
    for (int i = 0; i < 6; ++i)
      fill_disc(grid, 1.6 * Vector2(std::cos(1.0 * i), std::sin(1.0 * i)), 0.3,
                OccupancyGrid::kOccupied);
    return occupied_field(grid);
  }();
  const Motion stands = standing(kNow_s, {0.0, 0.0}, 0.3);
  const auto found = evade(stands, kNow_s, {person({0.0, 3.0}, {0.0, -1.0})}, pillars);
  ASSERT_FALSE(found.empty());
  for (const Motion& motion : found)
    EXPECT_GE(pillars->distance_bound(motion.end_pose().position), required_m_ - 1e-6);
}

TEST_P(EvasionTest, IsNoneWhereThereIsNoRoom) {
  OccupancyGrid cell = open_;
  fill_box(cell, {-6.0, -6.0}, {6.0, 6.0});
  fill_box(cell, {-required_m_, -required_m_}, {required_m_, required_m_}, OccupancyGrid::kFree);
  const Motion stands = standing(kNow_s, {0.0, 0.0}, 0.0);
  EXPECT_TRUE(
      evade(stands, kNow_s, {person({0.5, 0.0}, {-1.0, 0.0})}, occupied_field(cell)).empty());
}

INSTANTIATE_TEST_SUITE_P(Robots, EvasionTest, ::testing::Values("rover", "jackal"));

}  // namespace
}  // namespace mocha
