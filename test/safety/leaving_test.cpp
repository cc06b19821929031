#include "safety/leaving.h"

#include <gtest/gtest.h>

#include <random>

#include "safety/circle_field.h"
#include "trajectory/random_motion.h"
#include "trajectory/rover_braking.h"
#include "trajectory/simple_motions.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kMargin_m = 0.1;
const Footprint kDisc = Footprint::disc(0.3);
const Leaving kLeaving{1.0, 0.035};

/// A circle so large that it is a wall at y = `y` above the robot.
CircleField wall(double y) { return CircleField({{{0.0, y + 1000.0}, 1000.0}}); }

Violation clearance(const Motion& motion, const ObstacleField<2>& field, double from_s = 0.0) {
  return check_clearance_or_leaving(motion, kDisc, field, kMargin_m, kLeaving, from_s);
}

Motion drive(double yaw_rad, double length_m = 2.0) {
  return straight_drive(0.0, {0.0, 0.0}, yaw_rad, length_m, 0.8, 0.5);
}

double gap_m(const Motion& motion, const Footprint& footprint, const ObstacleField<2>& field,
             double t) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& disc : footprint.cover().discs()) {
    const Vector2 centre = cover_centre(motion.at(t).pose, disc);
    least_m = std::min(least_m, field.sample(centre).distance_m - disc.radius_m);
  }
  return least_m;
}

TEST(Leaving, WithTheMarginItIsTheStrictProof) {
  EXPECT_FALSE(clearance(drive(0.0), wall(0.5)));
  const Violation violation = clearance(drive(0.3), wall(0.5));
  EXPECT_EQ(violation.term, ViolatedTerm::kClearance);
  EXPECT_NEAR(violation.limit, kMargin_m, 1e-12);
}

TEST(Leaving, ARobotThatIsTooCloseMayStayAndMayLeave) {
  for (const double y : {0.28, 0.302, 0.32, 0.35}) {
    EXPECT_FALSE(clearance(standing(0.0, {0.0, 0.0}, 0.0), wall(y))) << y;
    EXPECT_FALSE(clearance(drive(-0.5), wall(y))) << y;
    EXPECT_FALSE(clearance(drive(-1.5), wall(y))) << y;
  }
}

TEST(Leaving, ARobotThatIsTooCloseMayNotComeCloser) {
  EXPECT_TRUE(clearance(drive(0.1), wall(0.35)));
  EXPECT_TRUE(clearance(drive(1.5), wall(0.35)));
  EXPECT_TRUE(clearance(drive(0.1, 0.15), wall(0.35)));
}

TEST(Leaving, AlongAWallThatIsTooCloseItGoesAMetre) {
  for (const double y : {0.32, 0.352, 0.38}) {
    const Motion along = drive(0.0);
    const Violation violation = clearance(along, wall(y));
    EXPECT_EQ(violation.term, ViolatedTerm::kClearance) << y;
    EXPECT_NEAR(violation.value, y - 0.3, 2e-3);
    EXPECT_NEAR(violation.limit, kMargin_m, 1e-12);
    EXPECT_NEAR(along.position(violation.time_s).x(), 1.0, 0.03) << y;
  }
  EXPECT_FALSE(clearance(drive(0.0, 0.95), wall(0.32)));
}

TEST(Leaving, ABodyBesideAWallMayTurnAwayFromIt) {
  // Its rear corner comes 3 mm closer then, and 6 mm are too many.
  const Footprint body = Footprint::rectangle(0.6, 0.4);
  const CircleField near = wall(0.22);
  const auto turned = [&](double turn_rad) {
    const Motion turn(0.0, {TurnPhase{{{0.0, 0.0}, 0.0}, turn_rad, 3.0}});
    return check_clearance_or_leaving(turn, body, near, kMargin_m, kLeaving, 0.0);
  };
  EXPECT_FALSE(turned(-0.01));
  EXPECT_EQ(turned(-0.04).term, ViolatedTerm::kClearance);
}

TEST(Leaving, LittleRoomIsLostAndHalfOfTheMarginIsEnough) {
  EXPECT_NEAR(kLeaving.required_m(0.03, 0.1), 0.024, 1e-12);
  EXPECT_NEAR(kLeaving.required_m(0.008, 0.1), 0.004, 1e-12);
  EXPECT_NEAR(kLeaving.required_m(-0.008, 0.1), -0.008, 1e-12);
  EXPECT_NEAR(kLeaving.required_m(0.054, 0.1), 0.048, 1e-12);
  EXPECT_NEAR(kLeaving.required_m(0.09, 0.1), 0.05, 1e-12);
}

TEST(Leaving, LossesOfAFewMotionsEndBeforeTheBodyTouches) {
  // A motion's room is what is found, less the slack of the proofs.
  double gap_m = 0.02;
  for (int i = 0; i < 3; ++i) gap_m = kLeaving.required_m(gap_m - Leaving::kSlack_m, 0.1);
  EXPECT_GE(gap_m, 0.0);
  EXPECT_EQ(kLeaving.required_m(-0.01 - Leaving::kSlack_m, 0.1), -0.01 - Leaving::kSlack_m)
      << "below, no more than the slack";
}

TEST(Leaving, APassageWithHalfOfTheMarginIsLeft) {
  // Walls on both sides, 65 mm away at first, then 54 and 75 mm: of 100 mm, half is enough.
  const auto passage = [](double narrowest_m) {
    CircleField::Circle left{{0.0, 0.365 + 1000.0}, 1000.0};
    CircleField::Circle right{{0.0, -0.365 - 1000.0}, 1000.0};
    CircleField::Circle corner{{0.4, 0.3 + narrowest_m + 0.01}, 0.01};
    return CircleField({left, right, corner});
  };
  EXPECT_FALSE(clearance(drive(0.0, 0.9), passage(0.054)));
  EXPECT_TRUE(clearance(drive(0.0, 0.9), passage(0.046)));
}

TEST(Leaving, AfterAMetreItHasAllOfTheMargin) {
  // 65 mm at first.
  const CircleField near = wall(0.365);
  EXPECT_TRUE(clearance(drive(-0.03), near));
  EXPECT_FALSE(clearance(drive(-0.04), near));
}

TEST(Leaving, AnArcAwayFromTheWallIsEnough) {
  // From 65 mm, along the wall at first; after a metre it is a few millimetres farther than asked.
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  const auto on_arc = [](double way_m) { return Vector2(way_m, -0.04 * way_m * way_m); };
  PlanarMinco::Knots knots(2, 7);
  for (int i = 0; i < 7; ++i) knots.col(i) = on_arc(0.25 * (i + 1));
  end.col(0) = on_arc(2.0);
  PlanarMinco minco;
  minco.resize(8);
  Eigen::VectorXd durations = Eigen::VectorXd::Constant(8, 0.5);
  durations[0] = durations[7] = 1.0;
  minco.solve(start, end, knots, durations);
  const Motion arc(0.0, {DrivePhase{1, minco.curve()}});
  EXPECT_FALSE(clearance(arc, wall(0.365)));
}

TEST(Leaving, WhatIsGainedIsNotLostAgain) {
  // Away from what is behind, 35 mm at first, and past a corner at 60 mm.
  const CircleField::Circle behind{{-0.335, 0.0}, 0.0};
  const CircleField::Circle corner{{0.5, 0.36}, 0.0};
  EXPECT_FALSE(clearance(drive(0.0), CircleField({behind})));
  const Violation violation = clearance(drive(0.0), CircleField({behind, corner}));
  EXPECT_EQ(violation.term, ViolatedTerm::kClearance);
  EXPECT_NEAR(violation.value, 0.06, 1e-3);
  EXPECT_GT(violation.limit, 0.06);
}

TEST(Leaving, TurningInPlaceNeedsNoMoreRoomThanStanding) {
  for (const double y : {0.3, 0.32, 0.35}) {
    const Motion turn(0.0, {TurnPhase{{{0.0, 0.0}, 0.0}, 2.0, 3.0}});
    EXPECT_FALSE(clearance(turn, wall(y))) << y;
    const Motion turns_and_leaves(
        0.0, {TurnPhase{{{0.0, 0.0}, 0.0}, -1.2, 3.0}, drive(-1.2).phases().front()});
    EXPECT_FALSE(clearance(turns_and_leaves, wall(y))) << y;
    const Motion turns_and_follows_it(
        0.0, {TurnPhase{{{0.0, 0.0}, -1.2}, 1.2, 3.0}, drive(0.0).phases().front()});
    EXPECT_TRUE(clearance(turns_and_follows_it, wall(y))) << y;
  }
}

TEST(Leaving, WhatARectangleGainsInATurnIsNotLostAgain) {
  // Beside a wall it has the most room along it: a corner is nearer before and after.
  const Footprint jackal = load_robot_model("config", "jackal").footprint;
  const CircleField near = wall(0.28);
  const auto turned = [&](double by_rad, double from_s) {
    const Motion turn(0.0, {TurnPhase{{{0.0, 0.0}, -0.15}, by_rad, 2.0}});
    return check_clearance_or_leaving(turn, jackal, near, kMargin_m, kLeaving, from_s);
  };
  for (double t = 0.0; t < 2.0; t += 0.1) EXPECT_FALSE(turned(0.15, t)) << t;
  EXPECT_EQ(turned(0.27, 0.0).term, ViolatedTerm::kClearance);  // 12 mm of 31 are lost
  EXPECT_TRUE(turned(-0.1, 0.0));
}

TEST(Leaving, OnceClearItMustStayClear) {
  // Away from one wall, and then too close to another one.
  const CircleField two({{{0.0, 1000.35}, 1000.0}, {{0.0, -2.2}, 0.5}});
  EXPECT_TRUE(clearance(drive(-M_PI / 2.0), two));
  const CircleField nearly(
      {{{0.0, 1000.35}, 1000.0}, {{0.0, -2.87}, 0.5}});  // 7 cm: more than at the start
  EXPECT_EQ(clearance(drive(-M_PI / 2.0), nearly).term, ViolatedTerm::kClearance);
  const CircleField farther({{{0.0, 1000.35}, 1000.0}, {{0.0, -3.0}, 0.5}});
  EXPECT_FALSE(clearance(drive(-M_PI / 2.0), farther));
}

TEST(Leaving, ARobotThatIsTooCloseLeavesSlowly) {
  // 20 mm at first of 35 mm; driving away from the wall, it may be the faster the farther it is.
  const SpeedMargin margin(0.035, 0.065);
  const auto leaves = [&](double yaw_rad, double speed) {
    const Motion motion =
        slowed(straight_drive(0.0, {0.0, 0.0}, yaw_rad, 2.0, 0.8, 0.5), 0.8 / speed);
    return !check_clearance_or_leaving(motion, kDisc, wall(0.32), margin, kLeaving, 0.0);
  };
  EXPECT_TRUE(leaves(-0.05, 0.2));
  EXPECT_FALSE(leaves(-0.05, 0.8));
  EXPECT_TRUE(leaves(-1.5, 0.6));
}

TEST(Leaving, ARobotThatIsTooFastForItsGapMaySlowDown) {
  // At 0.8 m/s it needs 77 mm, and has 60: enough for 0.62 m/s.
  const SpeedMargin margin(0.035, 0.065);
  const Motion fast = straight_drive(0.0, {0.0, 0.0}, 0.0, 8.0, 0.8, 0.5);
  const auto along_a_wall = [&](const Motion& motion) {
    return check_clearance_or_leaving(motion, kDisc, wall(0.36), margin, kLeaving, 5.0);
  };
  EXPECT_EQ(along_a_wall(fast).term, ViolatedTerm::kClearance);
  EXPECT_FALSE(along_a_wall(with_brake(fast, 5.0, 5.0, test::kRoverBraking)));
}

TEST(Leaving, DeepInsideAnObstacleThereIsNoLeaving) {
  EXPECT_TRUE(clearance(standing(0.0, {0.0, 0.0}, 0.0), wall(0.2)));
  EXPECT_TRUE(clearance(drive(-1.5), wall(0.2)));
}

/// Random drives that begin too close to something, of a disc and of a rectangle.
class LeavingDrives : public ::testing::TestWithParam<const char*> {
 protected:
  static Motion motion(int seed) {
    return within(random_drive(seed, 5, seed % 2 == 0 ? 1 : -1),
                  {0.4 + 0.1 * (seed % 16), 1.5, 2.0}, 0.0);
  }
  /// Something behind the start or beside it, and some more farther along.
  CircleField field(int seed, const Motion& motion) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const Vector2 course = motion.velocity(0.1);
    const double behind_rad = std::atan2(-course.y(), -course.x()) + 1.7 * unit(random);
    const Vector2 out(std::cos(behind_rad), std::sin(behind_rad));
    const double radius_m = std::pow(10.0, 1.0 + 2.0 * unit(random));
    CircleField::Circle first{(1.0 + radius_m) * out, radius_m};
    const double wanted_m = 0.5 * (kMargin_m - 0.02) + 0.5 * (kMargin_m + 0.02) * unit(random);
    first.centre -= (gap(motion, CircleField({first}), 0.0) - wanted_m) * out;
    const auto beside = [&](const Vector2& place) {
      const double angle = M_PI * unit(random);
      return CircleField::Circle{place + 0.75 * Vector2(std::cos(angle), std::sin(angle)), 0.3};
    };
    return CircleField({first, beside(motion.position(0.3 * motion.end_time())),
                        beside(motion.end_pose().position)});
  }
  double gap(const Motion& motion, const CircleField& field, double t) const {
    return gap_m(motion, footprint_, field, t);
  }
  Violation check(const Motion& motion, const CircleField& field, double from_s) const {
    return check_clearance_or_leaving(motion, footprint_, field, kMargin_m, kLeaving, from_s);
  }

  const Footprint footprint_ = load_robot_model("config", GetParam()).footprint;
};

TEST_P(LeavingDrives, LoseLittleAndHaveTheMarginAfterAMetre) {
  int certified = 0;
  int refused = 0;
  for (int seed = 0; seed < 1500; ++seed) {
    const Motion motion = this->motion(seed);
    const CircleField field = this->field(seed, motion);
    const double here_m = gap(motion, field, 0.0);
    if (here_m >= kMargin_m) continue;
    if (check(motion, field, 0.0)) {
      ++refused;
      continue;
    }
    ++certified;
    double way_m = 0.0;
    double least_m = here_m;         // all the way
    double least_after_all_m = 1.0;  // a metre
    for (double t = 0.0; t < motion.end_time(); t += 0.002) {
      way_m += 0.002 * motion.velocity(t).norm();
      const double now_m = gap(motion, field, t);
      least_m = std::min(least_m, now_m);
      if (way_m > 1.01) least_after_all_m = std::min(least_after_all_m, now_m);
    }
    EXPECT_GE(least_m, std::min(here_m - 0.010, 0.5 * kMargin_m - 0.001)) << seed;
    EXPECT_GE(least_after_all_m, kMargin_m - 1e-3) << seed;
  }
  EXPECT_GT(certified, 100);
  EXPECT_GT(refused, 100);
}

TEST_P(LeavingDrives, WhatIsCertifiedStaysCertifiedOnItsWay) {
  int certified = 0;
  for (int seed = 0; seed < 1500; ++seed) {
    const Motion motion = this->motion(seed);
    const CircleField field = this->field(seed, motion);
    if (gap(motion, field, 0.0) >= kMargin_m || check(motion, field, 0.0)) continue;
    ++certified;
    for (double t = 0.1; t < motion.end_time() + 1.0; t += 0.1) {
      const Violation violation = check(motion, field, t);
      EXPECT_FALSE(violation) << seed << ", after " << t << " s: " << describe(violation);
      if (violation) break;
    }
  }
  EXPECT_GT(certified, 100);
}

INSTANTIATE_TEST_SUITE_P(Robots, LeavingDrives, ::testing::Values("rover", "jackal"));

TEST(Leaving, SeparationLikewise) {
  const auto check = [](const Motion& motion, double y) {
    const PeerObstacle peer("ugv2", std::make_shared<const Motion>(standing(0.0, {0.0, y}, 0.0)),
                            0.3, test::kRoverBraking);
    return check_separation_or_leaving(motion, 0.3, peer, 0.4, 0.0, 30.0);
  };
  EXPECT_FALSE(check(drive(0.0), 1.1));
  EXPECT_TRUE(check(drive(1.0), 1.1));
  EXPECT_FALSE(check(standing(0.0, {0.0, 0.0}, 0.0), 0.8));
  EXPECT_FALSE(check(drive(-0.5), 0.8));
  EXPECT_EQ(check(drive(0.8), 0.8).term, ViolatedTerm::kSeparation);
  EXPECT_EQ(check(drive(0.8), 0.8).peer, "ugv2");
}

TEST(Leaving, APeerThatComesIsNoLeaving) {
  const auto comes =
      std::make_shared<const Motion>(straight_drive(0.0, {0.8, 0.0}, M_PI, 1.5, 0.8, 0.5));
  const PeerObstacle peer("ugv2", comes, 0.3, test::kRoverBraking);
  EXPECT_TRUE(
      check_separation_or_leaving(standing(0.0, {0.0, 0.0}, 0.0), 0.3, peer, 0.4, 0.0, 30.0));
}

}  // namespace
}  // namespace mocha
