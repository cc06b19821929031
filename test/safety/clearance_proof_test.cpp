#include <gtest/gtest.h>

#include <random>

#include "safety/certificate.h"
#include "safety/circle_field.h"
#include "trajectory/random_motion.h"
#include "trajectory/stopping.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

double sampled_clearance(const Motion& motion, const Footprint& footprint, const CircleField& field,
                         double t) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& disc : footprint.cover().discs()) {
    const Vector2 centre = cover_centre(motion.at(t).pose, disc);
    least = std::min(least, field.sample(centre).distance_m - disc.radius_m);
  }
  return least;
}

/// Turn towards a winding drive, the drive, and a turn at its end, which some end early.
Motion winding(int seed) {
  const int direction = seed % 2 ? 1 : -1;
  const DrivePhase drive = random_drive(seed, 3 + seed % 6, direction);
  const double first = heading(drive, 0.0);
  const double duration = drive.path.duration();
  const Pose end{drive.path.position(duration), heading(drive, duration)};
  const TurnPhase begin{{Vector2::Zero(), first - 2.0}, 2.0, 2.0};
  const TurnPhase last{end, -2.5, 3.0};
  if (seed % 4 == 0) return Motion(100.0, {begin, drive, last});
  const double ended_s = 0.6 * (seed % 4);
  const TurnState turned = state_of(last, ended_s);
  return Motion(100.0, {begin, drive, part_of(last, 0.0, ended_s),
                        turn_to_rest({end.position, turned.yaw_rad}, turned.rates, 4.0)});
}

CircleField clutter(const Motion& motion, int seed, double gap_m) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<CircleField::Circle> circles;
  for (int i = 0; i < 40; ++i) {
    const double t =
        motion.start_time() + share(random) * (motion.end_time() - motion.start_time());
    const double angle = 2.0 * M_PI * share(random);
    const double radius = 0.02 + 0.5 * share(random);
    const double away = radius + gap_m + 0.5 * share(random);
    const Vector2 centre =
        motion.at(t).pose.position + away * Vector2(std::cos(angle), std::sin(angle));
    double nearest = away;
    for (double when = motion.start_time(); when < motion.end_time(); when += 0.02) {
      nearest = std::min(nearest, (motion.at(when).pose.position - centre).norm());
    }
    if (nearest > radius + gap_m) circles.push_back({centre, radius});
  }
  return CircleField(circles);
}

TEST(ClearanceProof, AgreesWithDenseSampling) {
  constexpr int kSamples = 10000;
  const Footprint footprints[] = {Footprint::disc(0.3), Footprint::rectangle(0.508, 0.43),
                                  Footprint::rectangle(0.8, 0.3)};
  int accepted = 0;
  int refused = 0;
  for (int seed = 0; seed < 120; ++seed) {
    const Motion motion = winding(seed);
    const Footprint& footprint = footprints[seed % 3];
    const CircleField field = clutter(motion, seed, 0.2 + 0.004 * seed);
    const double from = seed % 5 == 0 ? 103.0 : 100.0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSamples; ++i) {
      const double t = from + (motion.end_time() - from) * i / kSamples;
      least = std::min(least, sampled_clearance(motion, footprint, field, t));
    }
    // Margins around what the motion really keeps, so that the question is a close one.
    for (const double margin : {0.05, least - 0.003, least + 0.001, least + 0.02}) {
      if (margin < 0.0) continue;
      const Violation violation = check_clearance(motion, footprint, field, margin, from);
      ++(violation ? refused : accepted);
      if (least < margin - 1e-6) {
        ASSERT_TRUE(violation) << seed;
      }
      if (least > margin + 0.0025) {
        ASSERT_FALSE(violation) << seed << " " << describe(violation);
      }
      if (!violation) continue;
      EXPECT_EQ(violation.term, ViolatedTerm::kClearance);
      for (double t = from; t < violation.time_s; t += 2e-3) {
        ASSERT_GE(sampled_clearance(motion, footprint, field, t), margin) << seed << " " << t;
      }
      EXPECT_LT(sampled_clearance(motion, footprint, field, violation.time_s), margin + 0.002)
          << seed;
      EXPECT_LT(violation.value, margin + 0.002);
      EXPECT_EQ(violation.limit, margin);
    }
  }
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

TEST(ClearanceProof, TheMarginIsThatOfTheSpeed) {
  constexpr int kSamples = 5000;
  const Footprint footprints[] = {Footprint::disc(0.3), Footprint::rectangle(0.508, 0.43)};
  int accepted = 0;
  int refused = 0;
  int slow_ones = 0;  // refused at a place that is not the closest: there it is slower
  for (int seed = 0; seed < 80; ++seed) {
    const Motion motion = winding(seed);
    const Footprint& footprint = footprints[seed % 2];
    const CircleField field = clutter(motion, seed, 0.2 + 0.004 * seed);
    const double per_speed2 = 0.004 + 0.001 * seed;
    const double from = seed % 5 == 0 ? 103.0 : 100.0;
    // What is left of the gap for the margin at rest.
    double least_m = std::numeric_limits<double>::infinity();
    double least_gap_m = least_m;
    for (int i = 0; i <= kSamples; ++i) {
      const double t = from + (motion.end_time() - from) * i / kSamples;
      const double gap_m = sampled_clearance(motion, footprint, field, t);
      least_gap_m = std::min(least_gap_m, gap_m);
      least_m = std::min(least_m, gap_m - per_speed2 * motion.velocity(t).squaredNorm());
    }
    if (least_m < 0.01) continue;
    for (const double still_m : {least_m - 0.004, least_m + 0.001}) {
      const SpeedMargin margin(still_m, per_speed2);
      const Violation violation = check_clearance(motion, footprint, field, margin, from);
      ++(violation ? refused : accepted);
      EXPECT_EQ(bool(violation), still_m > least_m) << seed << " " << describe(violation);
      if (!violation) continue;
      EXPECT_LT(violation.value, violation.limit + 0.002) << seed;
      EXPECT_GT(violation.limit, still_m - 1e-9) << seed;
      slow_ones += violation.value > least_gap_m + 0.01;
    }
  }
  EXPECT_GT(accepted, 30);
  EXPECT_EQ(refused, accepted);
  EXPECT_GT(slow_ones, 5);
}

Motion ahead(double length_m, double duration_s) {
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  piece.col(3) = Vector2(10.0 * length_m, 0.0);
  piece.col(4) = Vector2(-15.0 * length_m, 0.0);
  piece.col(5) = Vector2(6.0 * length_m, 0.0);
  return Motion(0.0, {DrivePhase{1, PlanarPath({piece}, {duration_s})}});
}

TEST(ClearanceProof, FindsANeedleBetweenSamples) {
  // A tiny robot at 7.5 m/s and a wire of 0.1 mm: any sampling at 1 kHz can miss it.
  const Footprint speck = Footprint::disc(1e-3);
  for (int i = 1; i < 50; ++i) {
    const double x = 0.2 * i + 0.0137;
    const CircleField wire({{Vector2(x, 0.0), 1e-4}});
    const Violation violation = check_clearance(ahead(10.0, 2.5), speck, wire, 0.0, 0.0);
    ASSERT_TRUE(violation) << x;
    EXPECT_NEAR(violation.place.x(), x, 3e-3);
    const CircleField beside({{Vector2(x, 3.2e-3), 1e-4}});
    EXPECT_FALSE(check_clearance(ahead(10.0, 2.5), speck, beside, 0.0, 0.0)) << x;
  }
}

TEST(ClearanceProof, FindsAContactAtTheVeryEnd) {
  const Footprint disc = Footprint::disc(0.3);
  const CircleField at_end({{Vector2(5.0 + 0.3 + 0.1 - 0.002, 0.0), 0.1}});
  const Violation violation = check_clearance(ahead(5.0, 4.0), disc, at_end, 0.0, 0.0);
  ASSERT_TRUE(violation);
  EXPECT_GT(violation.time_s, 3.7);
  EXPECT_TRUE(check_clearance(ahead(5.0, 4.0), disc, at_end, 0.0, 10.0));  // and it stays there
  const CircleField beyond({{Vector2(5.0 + 0.3 + 0.1 + 0.002, 0.0), 0.1}});
  EXPECT_FALSE(check_clearance(ahead(5.0, 4.0), disc, beyond, 0.0, 0.0));
  EXPECT_FALSE(check_clearance(ahead(5.0, 4.0), disc, beyond, 0.0, 10.0));
}

TEST(ClearanceProof, FindsWhatOnlyACornerTouchesInATurn) {
  const Footprint long_one = Footprint::rectangle(1.0, 0.2);
  const double reach = long_one.cover_reach_m();
  const Motion turn(0.0, {TurnPhase{{Vector2::Zero(), 0.0}, M_PI / 2.0, 2.0}});
  const double diagonal = std::sqrt(0.5);
  const auto post = [&](double away) {
    return CircleField({{away * Vector2(diagonal, diagonal), 0.01}});
  };
  const Violation violation = check_clearance(turn, long_one, post(reach), 0.0, 0.0);
  ASSERT_TRUE(violation);
  EXPECT_GT(violation.time_s, 0.7);  // clear at the start and at the end, in the way between
  EXPECT_LT(violation.time_s, 1.0);
  EXPECT_FALSE(check_clearance(turn, long_one, post(reach), 0.0, 1.4));
  EXPECT_FALSE(check_clearance(turn, long_one, post(reach + 0.012), 0.0, 0.0));
  const Motion rest(0.5, turn.phases_between(0.5, 2.0));
  const Violation same = check_clearance(rest, long_one, post(reach), 0.0, 0.0);
  ASSERT_TRUE(same);
  EXPECT_NEAR(same.time_s, violation.time_s, 0.01);
  const Motion ended = with_brake(turn, 0.0, 0.5, Braking(1.0, 1.0, 4.0));
  EXPECT_FALSE(check_clearance(ended, long_one, post(reach), 0.0, 0.0));
}

TEST(ClearanceProof, DiscsFollowTheHeadingBackward) {
  // The front disc leads although the robot drives backward: only the tail's end comes near the
  // post.
  const Footprint body = Footprint::rectangle(1.0, 0.4);
  const Motion forward = ahead(2.0, 4.0);
  const Motion backward(0.0, {DrivePhase{-1, std::get<DrivePhase>(forward.phases()[0]).path}});
  const CircleField post({{Vector2(2.4, 0.0), 0.05}});
  for (const Motion& motion : {forward, backward}) {
    EXPECT_TRUE(check_clearance(motion, body, post, 0.0, 0.0));
    EXPECT_FALSE(check_clearance(motion, body, CircleField({{Vector2(2.7, 0.0), 0.05}}), 0.0, 0.0));
  }
}

/// Walls on both sides of the x axis, so far from it.
PrimitiveField<2> walls(double away_m) {
  const auto wall = [](double from_y, double to_y) {
    return Polygon{{{-9.0, from_y}, {9.0, from_y}, {9.0, to_y}, {-9.0, to_y}}};
  };
  return PrimitiveField<2>({wall(away_m, away_m + 1.0), wall(-away_m - 1.0, -away_m)}, 1.0);
}

const Footprint kJackal = Footprint::rectangle(0.508, 0.43);

TEST(ClearanceProof, ARectangleStandsCloseBesideAWall) {
  const Motion stand(0.0, {StandPhase{{Vector2::Zero(), 0.0}, 2.0}});
  EXPECT_FALSE(check_clearance(stand, kJackal, walls(0.215 + 0.03), 0.02, 0.0));
  EXPECT_TRUE(check_clearance(stand, kJackal, walls(0.215 + 0.03), 0.031, 0.0));
  const Motion across(0.0, {StandPhase{{Vector2::Zero(), M_PI / 2.0}, 2.0}});
  EXPECT_FALSE(check_clearance(across, kJackal, walls(0.254 + 0.03), 0.02, 0.0));
  EXPECT_TRUE(check_clearance(across, kJackal, walls(0.254 + 0.03), 0.031, 0.0));
}

TEST(ClearanceProof, ARectangleTurnsWhereItsCornersPass) {
  const Motion turn(0.0, {TurnPhase{{Vector2::Zero(), 0.1}, 2.0 * M_PI, 6.0}});
  const double corner_m = kJackal.circumscribed_radius_m();
  EXPECT_FALSE(check_clearance(turn, kJackal, walls(corner_m + 0.011), 0.0, 0.0));
  EXPECT_TRUE(check_clearance(turn, kJackal, walls(corner_m - 0.001), 0.0, 0.0));
}

TEST(ClearanceProof, APolygonIsProvedByItsShape) {
  // A wedge, its tip ahead: beside the tip there is room that beside its tail there is not.
  const Footprint wedge = Footprint::polygon({{0.5, 0.0}, {-0.3, 0.3}, {-0.3, -0.3}});
  const Motion stand(0.0, {StandPhase{{Vector2::Zero(), 0.0}, 1.0}});
  const auto post = [](double x, double y) { return CircleField({{{x, y}, 0.01}}); };
  EXPECT_FALSE(check_clearance(stand, wedge, post(0.4, 0.1), 0.03, 0.0));
  EXPECT_FALSE(check_clearance(stand, wedge, post(0.4, -0.1), 0.03, 0.0));
  EXPECT_TRUE(check_clearance(stand, wedge, post(-0.25, 0.26), 0.0, 0.0));
  EXPECT_TRUE(check_clearance(stand, wedge, post(-0.25, -0.26), 0.0, 0.0));
  const Motion drive = ahead(2.0, 4.0);
  EXPECT_TRUE(check_clearance(drive, wedge, post(1.0, 0.31), 0.03, 0.0));
  EXPECT_FALSE(check_clearance(drive, wedge, post(1.0, 0.36), 0.03, 0.0));
}

TEST(ClearanceProof, StandingIsCheckedToo) {
  const Motion stand(5.0, {StandPhase{{Vector2(1.0, 0.0), 0.0}, 2.0}});
  const Footprint disc = Footprint::disc(0.3);
  const CircleField near({{Vector2(1.5, 0.0), 0.1}});
  EXPECT_FALSE(check_clearance(stand, disc, near, 0.09, 0.0));
  const Violation violation = check_clearance(stand, disc, near, 0.11, 0.0);
  ASSERT_TRUE(violation);
  EXPECT_NEAR(violation.value, 0.1, 1e-9);
  EXPECT_EQ(check_clearance(stand, disc, near, 0.11, 6.0).time_s, 6.0);
}

TEST(ClearanceProof, ReportsHowFarItGoesIn) {
  const CircleField block({{Vector2(3.0, 0.0), 0.5}});
  const Violation violation =
      check_clearance(ahead(2.4, 4.0), Footprint::disc(0.3), block, 0.05, 0.0);
  ASSERT_TRUE(violation);
  EXPECT_NEAR(violation.value, 0.6 - 0.5 - 0.3, 1e-3);
  EXPECT_NEAR(violation.place.x(), 3.0 - 0.5 - 0.3 - 0.05, 2e-3);
}

class NothingKnown : public CircleField {
 public:
  NothingKnown() : CircleField({}) {}
  double distance_bound(const Vector2&) const override { return std::nan(""); }
};

TEST(ClearanceProof, NotANumberIsNoProof) {
  EXPECT_TRUE(
      check_clearance(winding(1), Footprint::rectangle(0.5, 0.4), NothingKnown(), 0.0, 0.0));
  EXPECT_TRUE(check_clearance(ahead(1.0, 2.0), Footprint::disc(0.3), NothingKnown(), 0.0, 0.0));
  EXPECT_TRUE(check_clearance(ahead(1.0, 2.0), Footprint::disc(0.3), NothingKnown(), 0.0, 9.0));
}

TEST(ClearanceProof, OpenSpaceIsClear) {
  EXPECT_FALSE(
      check_clearance(winding(2), Footprint::rectangle(0.5, 0.4), CircleField({}), 0.3, 0.0));
}

}  // namespace
}  // namespace mocha
