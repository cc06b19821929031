#include "trajectory/stopping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trajectory/random_motion.h"
#include "trajectory/simple_motions.h"

namespace mocha {
namespace {

/// Smallest distance of a place from the motion's path from `from_s` on.
double off_path_m(const Motion& motion, const Vector2& place, double from_s) {
  double nearest = std::numeric_limits<double>::infinity();
  Vector2 last = motion.at(from_s).pose.position;
  for (double t = from_s; t < motion.end_time() + 0.02; t += 0.02) {
    const Vector2 next = motion.at(t).pose.position;
    const Vector2 along = next - last;
    const double share =
        along.isZero() ? 0.0
                       : std::clamp((place - last).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (place - last - share * along).norm());
    last = next;
  }
  return nearest;
}

void expect_joins(const MotionState& before, const MotionState& after) {
  EXPECT_LT((before.pose.position - after.pose.position).norm(), 1e-9);
  EXPECT_LT((before.velocity - after.velocity).norm(), 1e-9);
  EXPECT_LT((before.acceleration - after.acceleration).norm(), 1e-8);
  EXPECT_NEAR(wrap_angle(before.pose.yaw_rad - after.pose.yaw_rad), 0.0, 1e-6);
}

struct Fleet {
  Peaks limits;
  double deceleration;
};

TEST(Stopping, BrakesAlongRandomMotions) {
  const Fleet fleets[] = {{{2.0, 4.0, 2.0}, 2.8}, {{1.0, 0.8, 1.5}, 0.56}, {{2.0, 2.0, 2.0}, 1.4}};
  double worst_off = 0.0;
  double worst_acceleration = 0.0;
  double worst_yaw_rate = 0.0;
  for (const Fleet& fleet : fleets) {
    for (int seed = 0; seed < 12; ++seed) {
      const Motion motion = within(random_drive(seed, 8, seed % 3 ? 1 : -1), fleet.limits, 50.0);
      for (double share = 0.02; share < 1.0; share += 0.07) {
        const double t = 50.0 + share * (motion.end_time() - 50.0);
        const Motion braking(t, brake_along(motion, t, Braking(fleet.deceleration)));
        if (motion.at(t).velocity.norm() > 1e-3) expect_joins(motion.at(t), braking.at(t));
        EXPECT_LE(braking.end_time(),
                  std::max(motion.end_time(),
                           t + 0.5 + motion.at(t).velocity.norm() / fleet.deceleration));
        for (double when = t; when <= braking.end_time(); when += 0.05) {
          worst_off = std::max(worst_off, off_path_m(motion, braking.at(when).pose.position, t));
        }
        const Peaks peaks = sampled_peaks(braking, t, 500);
        EXPECT_LE(peaks.speed, 1.05 * fleet.limits.speed);
        worst_acceleration =
            std::max(worst_acceleration, peaks.acceleration / fleet.limits.acceleration);
        worst_yaw_rate = std::max(worst_yaw_rate, peaks.yaw_rate / fleet.limits.yaw_rate);
      }
    }
  }
  EXPECT_LT(worst_off, 0.01);
  EXPECT_LT(worst_acceleration, 1.15);
  EXPECT_LT(worst_yaw_rate, 1.15);
}

TEST(Stopping, BrakesGentlyInABend) {
  constexpr double kLimit = 1.0;  // [m/s^2]
  const Braking braking(0.6 * kLimit, kLimit);
  const Motion bend = round_a_circle(4.0, 1.97);  // takes 97 % of the limit
  for (double share = 0.3; share < 0.7; share += 0.05) {
    const double t = share * bend.end_time();
    ASSERT_GT(bend.at(t).acceleration.norm(), 0.95 * kLimit);
    const Motion stop(t, brake_along(bend, t, braking));
    EXPECT_LE(sampled_peaks(stop, t).acceleration, 1.02 * kLimit) << share;
    EXPECT_LT(stop.end_time(), bend.end_time());
    EXPECT_LT(stop.at(stop.end_time()).velocity.norm(), 1e-9);
    const Motion careless(t, brake_along(bend, t, Braking(0.6 * kLimit)));
    EXPECT_GT(sampled_peaks(careless, t).acceleration, 1.05 * kLimit) << share;
    EXPECT_LT(stop.length_m(), 1.4 * careless.length_m());
  }
}

TEST(Stopping, BrakesOnTheStraightAsWithoutABend) {
  const Motion straight = straight_drive(0.0, {0.0, 0.0}, 0.3, 4.0, 1.0, 0.8);
  const double t = 0.4 * straight.end_time();
  const Motion one(t, brake_along(straight, t, Braking(0.6, 1.0)));
  const Motion other(t, brake_along(straight, t, Braking(0.6)));
  EXPECT_EQ(one.end_time(), other.end_time());
  EXPECT_EQ(one.end_pose().position, other.end_pose().position);
}

TEST(Stopping, StopsWithinTheDistanceOfTheDeceleration) {
  const Motion motion = within(random_drive(4, 12), {1.5, 1.5, 2.0}, 0.0);
  const double t = 0.4 * motion.end_time();
  const double speed = motion.at(t).velocity.norm();
  const Motion braking(t, brake_along(motion, t, Braking(1.0)));
  EXPECT_LT(braking.length_m(), speed * speed / 2.0 + 0.25 * speed);
  EXPECT_GT(braking.length_m(), 0.0);
  const MotionState end = braking.at(braking.end_time() - 1e-6);
  EXPECT_NEAR(end.acceleration.norm(), 1.0, 1e-3);  // ends on the deceleration
}

TEST(Stopping, FollowsTheMotionWhereItStopsSooner) {
  const Motion motion = within(random_drive(2, 6), {1.0, 2.0, 1.5}, 7.0);
  const double t = motion.end_time() - 0.6;
  const std::vector<Phase> phases = brake_along(motion, t, Braking(0.05));
  const Motion braking(t, phases);
  EXPECT_NEAR(braking.end_time(), motion.end_time(), 1e-9);
  for (double when = t; when < motion.end_time(); when += 0.05) {
    EXPECT_LT((braking.at(when).pose.position - motion.at(when).pose.position).norm(), 1e-9);
  }
}

TEST(Stopping, EndsAtARestBetweenDrives) {
  // Ahead, then back: braking hard or weakly never runs into the second drive.
  const DrivePhase ahead = random_drive(3, 5);
  const double duration = ahead.path.duration();
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  const double yaw = heading(ahead, duration);
  const Vector2 back = -2.0 * Vector2(std::cos(yaw), std::sin(yaw));
  piece.col(0) = ahead.path.position(duration);
  piece.col(3) = 10.0 * back;
  piece.col(4) = -15.0 * back;
  piece.col(5) = 6.0 * back;
  const Motion motion(0.0, {ahead, DrivePhase{-1, PlanarPath({piece}, {4.0})}});
  for (const double deceleration : {0.01, 0.3, 5.0}) {
    const Motion braking(0.9 * duration,
                         brake_along(motion, 0.9 * duration, Braking(deceleration)));
    EXPECT_LE(braking.end_time(), duration + 1e-9);
  }
  const Motion in_reverse(duration + 2.0, brake_along(motion, duration + 2.0, Braking(2.0)));
  EXPECT_LT(in_reverse.at(duration + 2.1).speed, 0.0);
}

TEST(Stopping, BrakesThroughDrivesThatFollowEachOtherWithoutRest) {
  const Motion whole = within(random_drive(6, 8), {1.0, 1.0, 1.5}, 0.0);
  const double middle = 0.5 * whole.end_time();
  std::vector<Phase> phases = whole.phases_between(0.0, middle);
  for (Phase& phase : whole.phases_between(middle, whole.end_time())) phases.push_back(phase);
  const Motion halves(0.0, phases);
  const double t = middle - 0.3;
  const Motion a(t, brake_along(whole, t, Braking(0.7)));
  const Motion b(t, brake_along(halves, t, Braking(0.7)));
  EXPECT_NEAR(a.end_time(), b.end_time(), 1e-6);
  EXPECT_LT((a.end_pose().position - b.end_pose().position).norm(), 1e-6);
}

TEST(Stopping, StandsWhereTheMotionStands) {
  const Motion motion(0.0, {random_drive(1, 4)});
  for (const double t : {-1.0, 0.0, motion.end_time(), motion.end_time() + 5.0}) {
    const Motion braking(t, brake_along(motion, t, Braking(1.0)));
    EXPECT_LT((braking.end_pose().position - motion.at(t).pose.position).norm(), 1e-9);
    EXPECT_EQ(braking.length_m(), 0.0);
  }
}

TEST(Stopping, CrawlingIsNoSpecialCase) {
  for (int seed = 0; seed < 10; ++seed) {
    const Motion motion = within(random_drive(seed, 5), {1.0, 1.0, 1.5}, 0.0);
    for (double after = 0.001; after < 0.5; after *= 1.3) {
      for (const double t : {after, motion.end_time() - after}) {
        const Motion braking(t, brake_along(motion, t, Braking(0.7)));
        EXPECT_LE(braking.end_time(), t + 1.0);
        EXPECT_LT((braking.at(t).velocity - motion.at(t).velocity).norm(), 1.01e-3);
        EXPECT_LT(sampled_peaks(braking, t, 200).acceleration, 1.15) << seed << " " << t;
      }
    }
  }
}

TEST(Stopping, EndsATurnInPlaceAndWhatComesAfterIt) {
  const DrivePhase drive = random_drive(1, 4);
  const double yaw = heading(drive, 0.0);
  const Motion motion(10.0, {TurnPhase{{Vector2::Zero(), yaw - 1.0}, 1.0, 2.0}, drive});
  const Braking braking(1.0, 2.0, 6.0);
  const Motion stop(11.0, brake_along(motion, 11.0, braking));
  EXPECT_EQ(stop.length_m(), 0.0);
  EXPECT_LT(stop.end_time(), 11.5);
  EXPECT_NEAR(wrap_angle(stop.at(11.0).pose.yaw_rad - motion.at(11.0).pose.yaw_rad), 0.0, 1e-9);
  EXPECT_NEAR(stop.at(11.0 + 1e-9).yaw_rate, motion.at(11.0).yaw_rate, 1e-6);
  const Motion composed = with_brake(motion, 10.0, 11.0, braking);
  EXPECT_EQ(composed.phases().size(), 2u);
  EXPECT_EQ(composed.end_time(), stop.end_time());
  EXPECT_NEAR(composed.at(10.7).yaw_rate, motion.at(10.7).yaw_rate, 1e-9);
}

TEST(Stopping, EndsATurnWherePartsOfItWereJoined) {
  const double start_s = 1.7e9 + 0.1234567;
  const Braking braking(1.0, 2.0, 3.9);
  const Motion whole(start_s, {TurnPhase{{}, 3.0, turn_duration_s(3.0, 1.5, 4.0)}});
  std::vector<Phase> parts = whole.phases_between(start_s + 0.4, start_s + 0.5);
  for (const Phase& part : whole.phases_between(start_s + 0.5, start_s + 1.1))
    parts.push_back(part);
  for (const Phase& stop : brake_along(whole, start_s + 1.1, braking)) parts.push_back(stop);
  const Motion joined(start_s + 0.4, parts);
  ASSERT_EQ(joined.phases().size(), 3u);
  for (double t = joined.start_time(); t < joined.end_time() + 0.05; t += 0.01) {
    const Motion stop = with_brake(joined, joined.start_time(), t, braking);
    EXPECT_LE(stop.end_time(), std::max(joined.end_time(), t) + 0.11) << t - start_s;
    EXPECT_LT(stop.end_time(), t + 0.7) << t - start_s;
  }
}

TEST(Stopping, OffTheMotionATurnInPlaceIsEnded) {
  const Pose pose{{1.0, 2.0}, 0.5};
  const Motion stop(0.0, brake_from(pose, 0.0, -1.5, Braking(1.0, 2.0, 4.0)));
  EXPECT_NEAR(stop.at(1e-6).yaw_rate, -1.5, 1e-4);
  EXPECT_LT(stop.end_time(), 0.7);
  EXPECT_LT(stop.end_pose().yaw_rad, 0.3);
  const Motion stand(0.0, brake_from(pose, 0.0, 0.02, Braking(1.0)));
  EXPECT_TRUE(std::holds_alternative<StandPhase>(stand.phases().front()));
}

TEST(Stopping, ComposesMotionAndBrake) {
  const Motion motion = within(random_drive(9, 10), {1.5, 2.0, 2.0}, 20.0);
  const double t0 = 21.0;
  const double t_brake = 20.0 + 0.5 * (motion.end_time() - 20.0);
  const Motion braking = with_brake(motion, t0, t_brake, Braking(1.4));
  EXPECT_EQ(braking.start_time(), t0);
  for (double t = t0; t < t_brake; t += 0.01) {
    EXPECT_LT((braking.at(t).pose.position - motion.at(t).pose.position).norm(), 1e-9);
  }
  expect_joins(motion.at(t_brake), braking.at(t_brake + 1e-12));
  EXPECT_LT(braking.end_time(), motion.end_time());
  EXPECT_EQ(with_brake(motion, 0.0, 5.0, Braking(1.0)).length_m(), 0.0);  // not yet begun
}

/// What is left of a drive within a millisecond has accelerations that no robot can have meant,
/// once its numbers are rounded.
TEST(Stopping, LeavesNoSliversBeforeTheBraking) {
  const Motion whole = within(random_drive(9, 10), {1.5, 2.0, 2.0}, 20.0);
  const double middle = 0.5 * (20.0 + whole.end_time());
  std::vector<Phase> phases = whole.phases_between(20.0, middle);
  for (Phase& phase : whole.phases_between(middle, whole.end_time())) phases.push_back(phase);
  const Motion halves(20.0, phases);
  for (const double off_s : {-1e-3, -3e-4, 3e-4, 1e-3}) {
    const Motion soon = with_brake(whole, middle, middle + std::abs(off_s), Braking(1.4));
    EXPECT_EQ(soon.phases().size(), 1u) << off_s;
    const Motion at_boundary = with_brake(halves, 21.0, middle + off_s, Braking(1.4));
    EXPECT_EQ(at_boundary.phases().size(), 2u) << off_s;
    expect_joins(halves.at(middle), at_boundary.at(middle + 1e-12));
  }
}

TEST(Stopping, OffTheMotionStaysOnItsCircle) {
  const Pose pose{{1.0, 2.0}, 0.7};
  for (const double speed : {1.5, 0.2, 0.004, -0.8}) {
    for (const double yaw_rate : {0.0, 1.2, -2.0}) {
      const Motion braking(3.0, brake_from(pose, speed, yaw_rate, Braking(1.0)));
      const MotionState start = braking.at(3.0);
      EXPECT_LT((start.pose.position - pose.position).norm(), 1e-9);
      EXPECT_NEAR(wrap_angle(start.pose.yaw_rad - pose.yaw_rad), 0.0, 1e-9);
      EXPECT_NEAR(start.speed, speed, 1e-9);
      EXPECT_NEAR(start.yaw_rate, yaw_rate, 1e-9);
      for (double t = 3.0; t < braking.end_time(); t += 0.01) {
        const MotionState state = braking.at(t);
        EXPECT_LE(std::abs(state.speed), std::abs(speed) * 1.001);
        EXPECT_LE(std::abs(state.yaw_rate), 1.1 * std::abs(yaw_rate) + 1e-6);
        if (yaw_rate == 0.0) continue;
        const double radius = speed / yaw_rate;
        const Vector2 centre = pose.position + radius * Vector2(-std::sin(0.7), std::cos(0.7));
        EXPECT_NEAR((state.pose.position - centre).norm(), std::abs(radius), 5e-3);
      }
    }
  }
  EXPECT_EQ(Motion(0.0, brake_from(pose, 0.0, 1.0, Braking(1.0))).length_m(), 0.0);
}

TEST(Stopping, ARobotThatHasHardlySetOffKeepsItsHeading) {
  for (const int direction : {1, -1}) {
    PlanarPath::Piece piece = PlanarPath::Piece::Zero();  // 1 m at 0.7 rad, minimum jerk
    const Vector2 along(std::cos(0.7), std::sin(0.7));
    piece.col(3) = 10.0 * along;
    piece.col(4) = -15.0 * along;
    piece.col(5) = 6.0 * along;
    const Motion motion(1.7e9 + 0.3, {DrivePhase{direction, PlanarPath({piece}, {4.0})}});
    const double yaw_rad = motion.at(motion.start_time()).pose.yaw_rad;
    for (double after_s = 2e-5; after_s < 0.5; after_s *= 1.05) {
      const Motion stopped =
          with_brake(motion, motion.start_time(), motion.start_time() + after_s, Braking(0.4));
      EXPECT_NEAR(wrap_angle(stopped.end_pose().yaw_rad - yaw_rad), 0.0, 1e-3) << after_s;
    }
  }
}

}  // namespace
}  // namespace mocha
