#include "planning/escape_proof.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "safety/circle_field.h"

namespace mocha {
namespace {

constexpr double kMargin_m = 0.1;
const Footprint kDisc = Footprint::disc(0.3);

/// A circle so large that it is a wall at y = `y` above the robot.
CircleField wall(double y) { return CircleField({{{0.0, y + 1000.0}, 1000.0}}); }

Violation clearance(const Motion& motion, const ObstacleField<2>& field, double from_s = 0.0) {
  return check_clearance_or_leaving(motion, kDisc, field, kMargin_m, from_s);
}

Motion drive(double yaw_rad) { return straight_drive(0.0, {0.0, 0.0}, yaw_rad, 2.0, 0.8, 0.5); }

TEST(EscapeProof, WithTheMarginItIsTheStrictProof) {
  EXPECT_FALSE(clearance(drive(0.0), wall(0.5)));
  const Violation violation = clearance(drive(0.3), wall(0.5));
  EXPECT_EQ(violation.term, ViolatedTerm::kClearance);
  EXPECT_NEAR(violation.limit, kMargin_m, 1e-12);
}

TEST(EscapeProof, WhoIsTooCloseMayStayAndMayLeave) {
  EXPECT_FALSE(clearance(standing(0.0, {0.0, 0.0}, 0.0), wall(0.35)));
  EXPECT_FALSE(clearance(drive(-0.5), wall(0.35)));
  EXPECT_FALSE(clearance(drive(0.0), wall(0.352)));  // along the wall
}

TEST(EscapeProof, WhoIsTooCloseMayNotComeCloser) {
  EXPECT_TRUE(clearance(drive(0.1), wall(0.35)));
  EXPECT_TRUE(clearance(drive(1.5), wall(0.35)));
}

TEST(EscapeProof, OnceClearItMustStayClear) {
  // Away from one wall, and then too close to another one.
  const CircleField two({{{0.0, 1000.35}, 1000.0}, {{0.0, -2.2}, 0.5}});
  EXPECT_TRUE(clearance(drive(-M_PI / 2.0), two));
  const CircleField nearly(
      {{{0.0, 1000.35}, 1000.0}, {{0.0, -2.87}, 0.5}});  // 7 cm: more than at the start
  EXPECT_EQ(clearance(drive(-M_PI / 2.0), nearly).term, ViolatedTerm::kClearance);
  const CircleField farther({{{0.0, 1000.35}, 1000.0}, {{0.0, -3.0}, 0.5}});
  EXPECT_FALSE(clearance(drive(-M_PI / 2.0), farther));
}

TEST(EscapeProof, DeepInsideAnObstacleThereIsNoLeaving) {
  EXPECT_TRUE(clearance(standing(0.0, {0.0, 0.0}, 0.0), wall(0.2)));
  EXPECT_TRUE(clearance(drive(-1.5), wall(0.2)));
}

TEST(EscapeProof, SeparationLikewise) {
  const auto check = [](const Motion& motion, double y) {
    const PeerObstacle peer("ugv2", std::make_shared<const Motion>(standing(0.0, {0.0, y}, 0.0)),
                            0.3);
    return check_separation_or_leaving(motion, 0.3, peer, 0.4, 0.0, 30.0);
  };
  EXPECT_FALSE(check(drive(0.0), 1.1));
  EXPECT_TRUE(check(drive(1.0), 1.1));
  EXPECT_FALSE(check(standing(0.0, {0.0, 0.0}, 0.0), 0.8));
  EXPECT_FALSE(check(drive(-0.5), 0.8));
  EXPECT_EQ(check(drive(0.8), 0.8).term, ViolatedTerm::kSeparation);
  EXPECT_EQ(check(drive(0.8), 0.8).peer, "ugv2");
}

TEST(EscapeProof, APeerThatComesIsNoLeaving) {
  const auto comes =
      std::make_shared<const Motion>(straight_drive(0.0, {0.8, 0.0}, M_PI, 1.5, 0.8, 0.5));
  const PeerObstacle peer("ugv2", comes, 0.3);
  EXPECT_TRUE(
      check_separation_or_leaving(standing(0.0, {0.0, 0.0}, 0.0), 0.3, peer, 0.4, 0.0, 30.0));
}

}  // namespace
}  // namespace mocha
