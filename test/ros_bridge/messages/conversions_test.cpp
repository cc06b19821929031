#include "ros_bridge/messages/conversions.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "trajectory/random_motion.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kEpoch_s = 1.7e9 + 0.123456789;  // what ROS time looks like
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Motion over_the_wire(const Motion& motion) {
  mocha_ugv::Trajectory message;
  to_message(motion, message);
  return from_message(message);
}

/// Turn, wind forward, stand.
Motion example(int seed, double start_s) {
  const Motion drive = within(random_drive(seed, 6), {1.0, 0.8, 1.5}, 0.0);
  const Pose from = drive.at(0.0).pose;
  return Motion(start_s, {TurnPhase{{from.position, from.yaw_rad - 1.2}, 1.2, 1.7},
                          drive.phases()[0], StandPhase{drive.end_pose(), 0.7}});
}

void expect_same(const Motion& a, const Motion& b, double tolerance) {
  EXPECT_EQ(a.start_time(), b.start_time());
  EXPECT_EQ(a.end_time(), b.end_time());
  for (double t = a.start_time(); t <= a.end_time(); t += 0.037) {
    EXPECT_LT((a.at(t).pose.position - b.at(t).pose.position).norm(), tolerance);
    EXPECT_LT(std::abs(wrap_angle(a.at(t).pose.yaw_rad - b.at(t).pose.yaw_rad)), 1e2 * tolerance);
    EXPECT_LT((a.at(t).velocity - b.at(t).velocity).norm(), 10.0 * tolerance);
    EXPECT_LT((a.at(t).acceleration - b.at(t).acceleration).norm(), 1e2 * tolerance);
  }
}

TEST(Conversions, MotionsGoThereAndBackAtEpochTimes) {
  for (int seed = 1; seed <= 10; ++seed) {
    const Motion motion = example(seed, kEpoch_s);
    expect_same(motion, over_the_wire(motion), 1e-9);
    ASSERT_EQ(over_the_wire(motion).phases().size(), 3u);
  }
}

TEST(Conversions, TurnsThatAreUnderWayGoThereAndBack) {
  const Motion whole = example(4, kEpoch_s);
  const double begin_s = kEpoch_s + 0.5;
  const Motion part(begin_s, whole.phases_between(begin_s, whole.end_time()));
  expect_same(part, over_the_wire(part), 1e-9);
  EXPECT_NEAR(over_the_wire(part).at(begin_s + 0.1).yaw_rate, part.at(begin_s + 0.1).yaw_rate,
              1e-6);
}

TEST(Conversions, TurnsWithoutDerivativesAreFromRestToRest) {
  const Motion motion(kEpoch_s, {TurnPhase{{{1.0, 2.0}, 0.3}, 1.2, 1.7}});
  mocha_ugv::Trajectory message;
  to_message(motion, message);
  message.phases[0].start_derivatives.clear();
  message.phases[0].end_derivatives.clear();
  expect_same(motion, from_message(message), 1e-9);
}

TEST(Conversions, BackwardDrivesStayBackward) {
  const Motion motion(kEpoch_s, {random_drive(3, 4, -1)});
  expect_same(motion, over_the_wire(motion), 1e-9);
  EXPECT_LT(over_the_wire(motion).at(kEpoch_s + 1.0).speed, 0.0);
}

TEST(Conversions, StartTimesSurviveToTheBit) {
  double start_s = kEpoch_s;
  for (int i = 0; i < 1000; ++i) {
    const Motion motion(start_s, {StandPhase{{{1.0, 2.0}, 0.3}, 0.1}});
    EXPECT_EQ(over_the_wire(motion).start_time(), start_s);
    start_s = std::nextafter(start_s, 2e9) + 0.1037;
  }
}

TEST(Conversions, MotionsThatWereCutOnTheWayStillJoin) {
  // Promise, cut, promise again: every cut is made at an epoch time, may leave out a knot, and goes
  // over the wire.
  for (int seed = 1; seed <= 10; ++seed) {
    const Motion original = over_the_wire(Motion(kEpoch_s, {example(seed, 0.0).phases()[1]}));
    Motion motion = original;
    for (double cut_s = kEpoch_s + 0.3; cut_s < original.end_time() - 0.3; cut_s += 0.31) {
      const Motion rest(cut_s, motion.phases_between(cut_s, motion.end_time()));
      motion = over_the_wire(rest);
      const MotionState before = original.at(cut_s);
      const MotionState after = motion.at(cut_s);
      EXPECT_LT((before.pose.position - after.pose.position).norm(), 3e-5);
      EXPECT_LT((before.velocity - after.velocity).norm(), 1e-4);
      EXPECT_LT(std::abs(wrap_angle(before.pose.yaw_rad - after.pose.yaw_rad)), 1e-3);
      const Motion braking = over_the_wire(with_brake(motion, cut_s, cut_s + 0.2, Braking(0.5)));
      EXPECT_LT(
          (braking.at(cut_s + 0.1).pose.position - original.at(cut_s + 0.1).pose.position).norm(),
          3e-5);
    }
    EXPECT_LT((motion.end_pose().position - original.end_pose().position).norm(), 3e-5);
  }
}

TEST(Conversions, OtherFieldsOfTheMessageStay) {
  mocha_ugv::Trajectory message;
  message.agent = "ugv1";
  message.sequence = 7;
  to_message(example(1, kEpoch_s), message);
  to_message(example(2, kEpoch_s), message);  // phases are replaced, not added
  EXPECT_EQ(message.phases.size(), 3u);
  EXPECT_EQ(message.agent, "ugv1");
  EXPECT_EQ(message.sequence, 7u);
}

TEST(Conversions, MalformedMotionsAreRefused) {
  using Message = mocha_ugv::Trajectory;
  Message good;
  to_message(example(1, kEpoch_s), good);
  ASSERT_NO_THROW(from_message(good));
  const auto refuses = [&](const char* what, const std::function<void(Message&)>& spoil) {
    Message message = good;
    spoil(message);
    EXPECT_THROW(from_message(message), std::invalid_argument) << what;
  };
  refuses("no phases", [](Message& m) { m.phases.clear(); });
  refuses("another order", [](Message& m) { m.s = 4; });
  refuses("unknown kind", [](Message& m) { m.phases[0].kind = 3; });
  refuses("drive without direction", [](Message& m) { m.phases[1].direction = 0; });
  refuses("x and y differ", [](Message& m) { m.phases[1].x.pop_back(); });
  refuses("too few durations", [](Message& m) { m.phases[1].durations.pop_back(); });
  refuses("no durations", [](Message& m) { m.phases[1].durations.clear(); });
  refuses("negative duration", [](Message& m) { m.phases[1].durations[2] = -0.1; });
  refuses("no time", [](Message& m) { m.phases[1].durations[2] = 0.0; });
  refuses("duration not finite", [](Message& m) { m.phases[1].durations[2] = kNan; });
  refuses("place not finite", [](Message& m) { m.phases[1].x[3] = kNan; });
  refuses("place infinite", [](Message& m) { m.phases[1].y[1] = INFINITY; });
  refuses("half a turn's rates", [](Message& m) { m.phases[0].start_derivatives.pop_back(); });
  refuses("a turn's rate not finite", [](Message& m) { m.phases[0].end_derivatives[0] = kNan; });
  refuses("a turn's acceleration", [](Message& m) { m.phases[0].start_derivatives[1] = kNan; });
  refuses("no start derivatives", [](Message& m) { m.phases[1].start_derivatives.clear(); });
  refuses("no end derivatives", [](Message& m) { m.phases[1].end_derivatives.clear(); });
  refuses("too many derivatives", [](Message& m) { m.phases[1].end_derivatives.push_back(0.0); });
  refuses("velocity not finite", [](Message& m) { m.phases[1].start_derivatives[0] = kNan; });
  refuses("moving at the end", [](Message& m) {
    m.phases.pop_back();
    m.phases[1].end_derivatives[0] = 0.5;
  });
  refuses("jump in place", [](Message& m) { m.phases[0].x[0] += 0.1; });
  refuses("jump in heading", [](Message& m) { m.phases[0].yaw_change += 0.1; });
  refuses("heading not finite", [](Message& m) { m.phases[0].yaw_start = kNan; });
  refuses("turn without end", [](Message& m) { m.phases[0].durations[0] = INFINITY; });
  refuses("turn in no time", [](Message& m) { m.phases[0].durations[0] = 0.0; });
  refuses("turn at two places", [](Message& m) {
    m.phases[0].x.push_back(0.0);
    m.phases[0].y.push_back(0.0);
  });
  refuses("stand at no place", [](Message& m) {
    m.phases[2].x.clear();
    m.phases[2].y.clear();
  });
}

TEST(Conversions, PosesGoThereAndBack) {
  for (double yaw_rad = -3.1; yaw_rad <= 3.1; yaw_rad += 0.2) {
    const Pose back = from_message(to_message(Pose{{1.5, -2.5}, yaw_rad}));
    EXPECT_EQ(back.position, Vector2(1.5, -2.5));
    EXPECT_NEAR(back.yaw_rad, yaw_rad, 1e-12);
  }
}

}  // namespace
}  // namespace mocha
