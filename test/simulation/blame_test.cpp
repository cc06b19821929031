#include "simulation/blame.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

/// Looks ahead only, half to the left and half to the right.
LidarModel forward_lidar() {
  LidarModel lidar{};
  lidar.mount = {{0.1, 0.0}, 0.0};
  lidar.field_of_view_rad = M_PI;
  lidar.min_range_m = 0.3;
  lidar.max_range_m = 10.0;
  return lidar;
}

/// A robot that heads along y, and is touched there, by its length, at this angle from its heading.
class BlameTest : public ::testing::Test {
 protected:
  Blame blame(double angle_rad, double speed_mps, double other_mps) const {
    const Vector2 towards(-std::sin(angle_rad), std::cos(angle_rad));
    const Vector2 place = base_.position + 0.3 * towards;
    const Touch touch{place, velocity_at(place, base_, {speed_mps, 0.0}), -other_mps * towards,
                      towards};
    return blame_of(touch, base_, forward_lidar());
  }
  const Pose base_{{2.0, 1.0}, M_PI / 2.0};
};

TEST_F(BlameTest, WhoStandsIsNotToBlame) {
  EXPECT_EQ(blame(0.0, 0.0, 1.0), Blame::kStanding);
  EXPECT_EQ(blame(0.0, 0.1, 1.0), Blame::kStanding);
  EXPECT_EQ(blame(0.0, 0.11, 1.0), Blame::kOwn);
}

TEST_F(BlameTest, WhatComesFromWhereNobodyLooksIsUnseen) {
  EXPECT_EQ(blame(M_PI, 0.5, 1.0), Blame::kUnseen);
  EXPECT_EQ(blame(0.75 * M_PI, 0.5, 1.0), Blame::kUnseen);
  EXPECT_EQ(blame(0.3 * M_PI, 0.15, 1.0), Blame::kOwn) << "it could be seen";
}

TEST_F(BlameTest, WhoBacksIntoSomethingIsToBlame) {
  EXPECT_EQ(blame(M_PI, -0.5, 0.0), Blame::kOwn);
  EXPECT_EQ(blame(M_PI, -0.5, 1.0), Blame::kOwn);
}

TEST_F(BlameTest, WhatIsNearerThanTheLidarMeasuresIsInItsViewAllTheSame) {
  EXPECT_EQ(blame(0.0, 0.5, 1.0), Blame::kOwn);
}

TEST(Velocity, OfABodyThatTurnsIsThatOfThePlace) {
  const Pose base{{2.0, 1.0}, M_PI / 2.0};
  EXPECT_NEAR((velocity_at({2.0, 2.0}, base, {0.5, 1.0}) - Vector2(-1.0, 0.5)).norm(), 0.0, 1e-12);
}

TEST(Touch, ApproachIsAlongTheLineBetweenThem) {
  const Touch touch{{}, {1.0, 0.5}, {-0.5, 3.0}, {1.0, 0.0}};
  EXPECT_NEAR(touch.approach_mps(), 1.5, 1e-12);
}

}  // namespace
}  // namespace mocha
