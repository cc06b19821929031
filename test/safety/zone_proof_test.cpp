#include <gtest/gtest.h>

#include "safety/certificate.h"
#include "trajectory/random_motion.h"
#include "trajectory/simple_motions.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kLongAgo_s = -100.0;
constexpr Peaks kPeaks{0.6, 1.2, 1.8};

const RobotModel& rover() {
  static const RobotModel model = load_robot_model("config", "rover");
  return model;
}

Zone band(double from_x, double to_x, double max_speed) {
  const double y = 100.0;
  return {"band", Polygon{{{from_x, -y}, {to_x, -y}, {to_x, y}, {from_x, y}}}, max_speed};
}

Violation check(const Motion& motion, const Zone& zone, double since_s = kLongAgo_s,
                double from_s = 0.0) {
  return check_speed_zones(motion, *SpeedZones::of({zone}, rover(), since_s), from_s);
}

/// The greatest excess [m/s] over what a zone that is in force asks for, by samples.
double sampled_excess(const Motion& motion, const SpeedZones& zones) {
  constexpr int kSamples = 2000;
  double most = -1.0;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = motion.end_time() * i / kSamples;
    const MotionState state = motion.at(t);
    if (zones.fastest_at(state.pose.position) < rover().limits.max_speed)
      most = std::max(most, state.velocity.norm() - zones.limit_at(zones.areas()[0], t));
  }
  return most;
}

TEST(ZoneProof, SaysWhereWhenAndByHowMuch) {
  const Motion motion = straight_drive(0.0, {0.0, 0.0}, 0.0, 10.0, 0.8, 0.6);
  const Violation violation = check(motion, band(4.0, 6.0, 0.3));
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation.term, ViolatedTerm::kZoneSpeed);
  EXPECT_NEAR(violation.place.x(), 4.0 - rover().footprint.circumscribed_radius_m(), 2e-3);
  EXPECT_NEAR(motion.position(violation.time_s).x(), violation.place.x(), 1e-9);
  EXPECT_NEAR(violation.value, motion.at(violation.time_s).speed, 0.05);
  EXPECT_EQ(violation.limit, 0.3);
  EXPECT_NE(describe(violation).find("speed in zone `band` 0.7"), std::string::npos)
      << describe(violation);
}

TEST(ZoneProof, SlowMotionsAndThoseElsewherePass) {
  const Motion motion = straight_drive(0.0, {0.0, 0.0}, 0.0, 10.0, 0.8, 0.6);
  EXPECT_FALSE(check(motion, band(4.0, 6.0, 0.9)));
  EXPECT_FALSE(check(motion, band(10.5, 12.0, 0.1)));
  EXPECT_FALSE(check(motion, band(-3.0, -0.5, 0.1)));
  EXPECT_FALSE(check(standing(0.0, {5.0, 0.0}, 0.0), band(4.0, 6.0, 0.1)));
  DrivePhase slow = std::get<DrivePhase>(motion.phases().front());
  slow.path = slow.path.stretched(4.0);
  EXPECT_FALSE(check(Motion(0.0, {slow}), band(4.0, 6.0, 0.3)));
}

TEST(ZoneProof, OnlyWhatComesCounts) {
  const Motion motion = straight_drive(0.0, {0.0, 0.0}, 0.0, 10.0, 0.8, 0.6);
  const Violation violation = check(motion, band(2.0, 3.0, 0.3));
  ASSERT_TRUE(violation);
  double t = violation.time_s;
  while (motion.position(t).x() < 3.5) t += 0.01;
  EXPECT_FALSE(check(motion, band(2.0, 3.0, 0.3), kLongAgo_s, t));
}

TEST(ZoneProof, AgreesWithSamplesOfRandomMotions) {
  int accepted = 0;
  int refused = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const Motion motion = within(random_drive(seed, 2 + seed % 10, seed % 2 ? 1 : -1), kPeaks, 0.0);
    const Vector2 about = motion.position(0.4 * motion.end_time());
    const Vector2 size(0.6, 0.4);
    const Zone zone{"square",
                    Polygon{{about - size, about + Vector2(0.6, -0.4), about + size,
                             about + Vector2(-0.6, 0.4)}},
                    0.15 + 0.75 * (seed % 20) / 20.0};
    const auto zones = SpeedZones::of({zone}, rover(), kLongAgo_s);
    const double excess = sampled_excess(motion, *zones);
    const Violation violation = check_speed_zones(motion, *zones, 0.0);
    if (excess > 1e-3) {
      EXPECT_TRUE(violation) << seed;
      EXPECT_GT(violation.value, violation.limit - 1e-3) << seed;
      EXPECT_LE(violation.value - violation.limit, excess + 1e-2) << seed;
      ++refused;
    } else if (excess < -3e-3) {
      EXPECT_FALSE(violation) << seed << ": " << describe(violation);
      ++accepted;
    }
  }
  EXPECT_GT(accepted, 30);
  EXPECT_GT(refused, 30);
}

TEST(ZoneProof, ARobotInANewZoneMayBrakeAndWhatIsProvedStaysProved) {
  const Motion motion = long_drive(0.0, 20.0);
  for (const double since_s : {3.0, 4.0, 5.0}) {
    const Zone zone = band(-5.0, 25.0, 0.3);
    const Violation violation = check(motion, zone, since_s, since_s);
    ASSERT_TRUE(violation);
    EXPECT_GE(violation.time_s, since_s + SpeedZones::kNotice_s);
    const double brakes_s = motion.switch_time(since_s + 1.0);
    const Motion stop =
        with_brake(motion, motion.switch_time(since_s), brakes_s, rover().braking());
    for (double from_s = since_s; from_s < stop.end_time(); from_s += 0.2)
      EXPECT_FALSE(check(stop, zone, since_s, from_s))
          << describe(check(stop, zone, since_s, from_s));
  }
}

}  // namespace
}  // namespace mocha
