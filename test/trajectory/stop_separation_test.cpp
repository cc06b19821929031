#include "trajectory/stop_separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "fleet/protocol/motions.h"
#include "trajectory/separation.h"
#include "trajectory/simple_motions.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kApart_m = 0.6;
constexpr double kTolerance_m = 0.02;
const Braking kBraking(0.5);
constexpr double kReaction_s = 0.3;

/// How close they come if a brakes at t and b after the reaction time, along real braking motions.
double closest_where_first_brakes(const BrakableMotion& a, const BrakableMotion& b, double t) {
  const auto stop = [](const BrakableMotion& brakable, double when) {
    const Motion& motion = brakable.motion;
    return with_brake(motion, motion.start_time(), std::max(when, motion.start_time()),
                      brakable.braking);
  };
  return closest_approach(stop(a, t), stop(b, t + kReaction_s), t, t + 30.0).distance_m;
}

double closest_stop(const BrakableMotion& a, const BrakableMotion& b, double t) {
  return std::min(closest_where_first_brakes(a, b, t), closest_where_first_brakes(b, a, t));
}

/// Of two robots that brake alike.
std::optional<StopMeeting> meeting_of(const Motion& a, const Motion& b, double from_s = 0.0,
                                      const Braking& braking = kBraking,
                                      double distance_m = kApart_m) {
  return first_stop_meeting({a, braking}, {b, braking}, distance_m, kReaction_s, from_s);
}

double closest_stop(const Motion& a, const Motion& b, double t, const Braking& braking = kBraking) {
  return closest_stop({a, braking}, {b, braking}, t);
}

/// From rest to rest, at `speed` [m/s] but for the first metre and the last.
Motion along(double start_s, const Vector2& from, const Vector2& to, double speed) {
  const int pieces = std::max(2, static_cast<int>((to - from).norm()));
  const Vector2 step = (to - from) / pieces;
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  start.col(0) = from;
  end.col(0) = to;
  PlanarMinco::Knots knots(2, pieces - 1);
  for (int i = 1; i < pieces; ++i) knots.col(i - 1) = from + i * step;
  Eigen::VectorXd durations = Eigen::VectorXd::Constant(pieces, step.norm() / speed);
  durations[0] *= 1.9;
  durations[pieces - 1] *= 1.9;
  PlanarMinco minco;
  minco.resize(pieces);
  minco.solve(start, end, knots, durations);
  return Motion(start_s, {DrivePhase{1, minco.curve()}});
}

TEST(StopSeparation, AFollowerKeepsWhatTheReactionTakes) {
  // The leader brakes: the follower comes closer by what it drives in 0.3 s, at about 1 m/s.
  const Motion leader = along(0.0, {0.0, 0.0}, {12.0, 0.0}, 1.0);
  const auto follower = [](double behind_m) {
    return along(0.0, {-behind_m, 0.0}, {12.0 - behind_m, 0.0}, 1.0);
  };
  EXPECT_FALSE(meeting_of(leader, follower(1.1)));
  const auto meeting = meeting_of(leader, follower(0.8));
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(closest_approach(leader, follower(0.8), 0.0, 1e3).distance_m, 0.8, 1e-3);
  EXPECT_LT(meeting->distance_m, kApart_m);
  EXPECT_NEAR(meeting->distance_m, 0.8 - 0.3, 0.08);
}

TEST(StopSeparation, TheFirstToCrossMustNotStopInTheWay) {
  const Motion first = along(0.0, {-4.0, 0.0}, {4.0, 0.0}, 1.0);
  const auto second = [](double later_s) { return along(later_s, {0.0, -4.0}, {0.0, 4.0}, 1.0); };
  ASSERT_GT(closest_approach(first, second(0.9), 0.0, 1e3).distance_m, kApart_m)
      << "they never meet while both drive on";
  const auto meeting = meeting_of(first, second(0.9));
  ASSERT_TRUE(meeting);
  EXPECT_LT(closest_stop(first, second(0.9), meeting->brakes_s), kApart_m + kTolerance_m);
  EXPECT_LT(meeting->place.norm(), 1.5);
  EXPECT_FALSE(meeting_of(first, second(1.5)));
}

TEST(StopSeparation, TwoHeadOnMustBothBeAbleToStop) {
  const Motion one = along(0.0, {-4.0, 0.0}, {-0.5, 0.0}, 1.0);
  const Motion other = along(0.0, {4.0, 0.0}, {0.5, 0.0}, 1.0);
  EXPECT_FALSE(meeting_of(one, other));
  // One leaves the lane of the other in time, if it does not brake in it.
  const Motion aside = test::drive(0.0, {{3.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, 3.0}}, 1.0);
  const Motion comes = along(-1.4, {-4.0, 0.0}, {4.0, 0.0}, 1.0);
  ASSERT_GT(closest_approach(aside, comes, 0.0, 1e3).distance_m, kApart_m + 0.1);
  EXPECT_FALSE(meeting_of(aside, comes));
  EXPECT_TRUE(first_stop_meeting({aside, kBraking}, {comes, kBraking}, kApart_m, 1.2, 0.0))
      << "hears of it late";
}

TEST(StopSeparation, AGentleBrakerKeepsMoreBehindOneThatBrakesHard) {
  const Braking gentle(0.2);
  const Motion ahead = along(0.0, {0.0, 0.0}, {12.0, 0.0}, 1.0);
  const Motion behind = along(0.0, {-2.0, 0.0}, {10.0, 0.0}, 1.0);
  const auto meeting = [&](const Braking& leads, const Braking& follows) {
    return first_stop_meeting({ahead, leads}, {behind, follows}, kApart_m, kReaction_s, 0.0);
  };
  EXPECT_FALSE(meeting(kBraking, kBraking));
  EXPECT_FALSE(meeting(gentle, gentle));
  EXPECT_FALSE(meeting(gentle, kBraking)) << "the follower brakes harder";
  const auto found = meeting(kBraking, gentle);
  ASSERT_TRUE(found);
  EXPECT_LT(closest_stop({ahead, kBraking}, {behind, gentle}, found->brakes_s), kApart_m);
}

TEST(StopSeparation, IsTheSameForBoth) {
  std::mt19937 random(4);
  int meetings = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Motion a = test::random_drive(random, 0.0, 4, 3.0);
    const Motion b = test::random_drive(random, 0.4, 4, 3.0);
    const BrakableMotion gently{a, Braking(0.3)};
    const BrakableMotion firmly{b, Braking(1.1, 1.4)};
    const auto one = first_stop_meeting(gently, firmly, kApart_m, kReaction_s, 0.0);
    const auto other = first_stop_meeting(firmly, gently, kApart_m, kReaction_s, 0.0);
    ASSERT_EQ(one.has_value(), other.has_value());
    if (!one) continue;
    ++meetings;
    EXPECT_EQ(one->brakes_s, other->brakes_s);
    EXPECT_EQ(one->distance_m, other->distance_m);
  }
  EXPECT_GT(meetings, 20);
}

TEST(StopSeparation, AgreesWithRealBrakingAtEveryMoment) {
  const std::vector<Braking> brakings = {kBraking, Braking(0.25), Braking(1.2)};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  std::uniform_real_distribution<double> late_s(-1.5, 1.5);
  int apart = 0;
  int meetings = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const double start_s = 1.75e9 + 0.01 * trial;
    const Motion a = along(start_s, {-3.0, 0.0}, {3.0, 0.4}, 0.7 + 0.001 * trial);
    const double towards_rad = angle(random);
    const Vector2 way(3.0 * std::cos(towards_rad), 3.0 * std::sin(towards_rad));
    const Motion b = trial % 3 == 0 ? test::random_drive(random, start_s + 0.3, 3, 2.5)
                                    : along(start_s + late_s(random), -way, way, 0.9);
    const double until_s = std::max(a.end_time(), b.end_time());
    if (bounds(b).acceleration > 2.0) continue;
    const BrakableMotion one{a, kBraking};
    const BrakableMotion other{b, brakings[trial % brakings.size()]};
    const auto meeting = first_stop_meeting(one, other, kApart_m, kReaction_s, start_s);
    if (meeting) {
      ++meetings;
      EXPECT_LT(closest_stop(one, other, meeting->brakes_s), kApart_m + 0.06);
    } else {
      ++apart;
    }
    const double until_meeting_s = meeting ? meeting->brakes_s - 0.1 : until_s;
    const double begin_s = std::ceil(start_s / 0.1) * 0.1;
    for (double t = begin_s; t < until_meeting_s; t += 0.07)
      EXPECT_GT(closest_stop(one, other, t), kApart_m - kTolerance_m)
          << trial << " at " << t - start_s;
  }
  EXPECT_GT(apart, 15);
  EXPECT_GT(meetings, 30);
}

TEST(StopSeparation, KnowsThatBrakingIsGentlerInABend) {
  constexpr double kRadius_m = 4.0;
  const Braking gently_in_bends(0.6, 1.0);
  const Motion circling = round_a_circle(kRadius_m, 1.97);  // takes 97 % of the limit
  const double arrives_s = 0.5 * circling.end_time();
  const Vector2 crossing = circling.position(arrives_s);
  const Vector2 outward = (crossing - Vector2(0.0, kRadius_m)).normalized();
  int meetings = 0;
  int apart = 0;
  for (double before_s = 1.0; before_s < 4.0; before_s += 0.05) {
    const Motion crosses = test::drive(
        arrives_s - before_s, {crossing - outward, crossing, crossing + 3.0 * outward}, 1.0);
    if (meeting_of(circling, crosses, 0.0, gently_in_bends)) {
      ++meetings;
      continue;
    }
    ++apart;
    for (double t = arrives_s - before_s; t < arrives_s; t += 0.1)
      EXPECT_GT(closest_stop(circling, crosses, t, gently_in_bends), kApart_m - kTolerance_m)
          << before_s;
  }
  EXPECT_GT(meetings, 5);
  EXPECT_GT(apart, 5);
}

TEST(StopSeparation, FindsMeetingsBetweenItsMoments) {
  constexpr double kNear_m = 0.1;
  const Braking kHard(3.0);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> angle(0.5, 2.6);
  std::uniform_real_distribution<double> late_s(-0.3, 0.3);
  int meetings = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double towards_rad = angle(random);
    const Vector2 way(6.0 * std::cos(towards_rad), 6.0 * std::sin(towards_rad));
    const double start_s = late_s(random);
    bool found = false;
    bool missed = false;
    for (double shift_s = 0.0; shift_s < 0.095; shift_s += 0.01) {
      const Motion a = along(1.0 + shift_s, {-6.0, 0.0}, {6.0, 0.0}, 3.0);
      const Motion b = along(1.0 + shift_s + start_s, -way, way, 3.0);
      found |= meeting_of(a, b, 0.0, kHard, kNear_m).has_value();
      missed |= !meeting_of(a, b, 0.0, kHard, kNear_m + 0.03).has_value();
    }
    EXPECT_FALSE(found && missed) << trial;
    meetings += found;
  }
  EXPECT_GT(meetings, 10);
}

TEST(StopSeparation, LooksOnlyAsLongAsItIsAsked) {
  const Motion first = along(0.0, {-4.0, 0.0}, {4.0, 0.0}, 1.0);
  const Motion second = along(0.9, {0.0, -4.0}, {0.0, 4.0}, 1.0);
  const auto meeting = meeting_of(first, second);
  ASSERT_TRUE(meeting);
  EXPECT_FALSE(first_stop_meeting({first, kBraking}, {second, kBraking}, kApart_m, kReaction_s, 0.0,
                                  meeting->brakes_s - 0.2));
  EXPECT_FALSE(meeting_of(first, second, 60.0));
}

TEST(StopSeparation, RefusesWhatIsNoRule) {
  const Motion stand = test::stand(0.0, {0.0, 0.0});
  const Motion none;
  const BrakableMotion a{stand, kBraking};
  EXPECT_THROW(first_stop_meeting(a, {none, kBraking}, 0.6, 0.3, 0.0), std::invalid_argument);
  EXPECT_THROW(first_stop_meeting(a, a, 0.6, -0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(first_stop_meeting(a, a, 0.6, 11.0, 0.0), std::invalid_argument);
}

TEST(StopSeparation, WhatIsPromisedForTomorrowMeetsAsToday) {
  constexpr double kDay_s = 86400.0;
  const auto head_on = [](double start_s) {
    return meeting_of(along(start_s, {0.0, 0.0}, {6.0, 0.0}, 1.0),
                      along(start_s + 1.0, {8.0, 0.1}, {3.0, 0.1}, 1.0));
  };
  const auto today = head_on(5.0);
  const auto tomorrow = head_on(kDay_s);
  ASSERT_TRUE(today && tomorrow);
  EXPECT_NEAR(tomorrow->brakes_s - kDay_s, today->brakes_s - 5.0, 0.11);
  EXPECT_NEAR(tomorrow->distance_m, today->distance_m, 0.02);
  EXPECT_FALSE(meeting_of(along(-20.0, {0.0, 0.0}, {6.0, 0.0}, 1.0),
                          along(kDay_s, {8.0, 5.0}, {3.0, 5.0}, 1.0)));
}

}  // namespace
}  // namespace mocha
