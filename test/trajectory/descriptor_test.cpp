#include "trajectory/descriptor.h"

#include <gtest/gtest.h>

#include "trajectory/random_motion.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

void expect_same(const Motion& a, const Motion& b, double position_m = 1e-9,
                 double velocity_mps = 1e-8) {
  ASSERT_EQ(a.phases().size(), b.phases().size());
  EXPECT_NEAR(a.end_time(), b.end_time(), 1e-9);
  for (int i = 0; i <= 1000; ++i) {
    const double t = a.start_time() + (a.end_time() - a.start_time()) * i / 1000.0;
    EXPECT_LT((a.at(t).pose.position - b.at(t).pose.position).norm(), position_m) << t;
    EXPECT_LT((a.at(t).velocity - b.at(t).velocity).norm(), velocity_mps) << t;
    EXPECT_NEAR(wrap_angle(a.at(t).pose.yaw_rad - b.at(t).pose.yaw_rad), 0.0, 1e-5) << t;
  }
}

TEST(Descriptor, RebuildsMincoMotions) {
  for (int seed = 0; seed < 10; ++seed) {
    const DrivePhase drive = random_drive(seed, 1 + seed * 2, seed % 2 ? 1 : -1);
    const double yaw = heading(drive, 0.0);
    const Motion motion(3.0, {StandPhase{{Vector2::Zero(), yaw - 1.0}, 0.5},
                              TurnPhase{{Vector2::Zero(), yaw - 1.0}, 1.0, 2.0}, drive});
    expect_same(motion, rebuild(describe(motion)));
  }
}

TEST(Descriptor, RebuildsSlices) {
  for (int seed = 0; seed < 10; ++seed) {
    const Motion motion(0.0, {random_drive(seed, 8)});
    for (const double share : {0.05, 0.37, 0.8}) {
      const double t = share * motion.end_time();
      const Motion part(t, motion.phases_between(t, motion.end_time()));
      // A knot close to the cut may be left out.
      expect_same(part, rebuild(describe(part)), 1e-6, 1e-5);
    }
  }
}

TEST(Descriptor, RebuildsTurnsThatAreUnderWayAndEnded) {
  const TurnPhase turn{{{1.0, 2.0}, 0.4}, -3.0, 3.0};
  const Motion whole(0.0, {turn});
  const Motion part = with_brake(whole, 0.6, 1.4, Braking(1.0, 2.0, 4.0));
  ASSERT_EQ(part.phases().size(), 2u);
  const Motion rebuilt = rebuild(describe(part));
  expect_same(part, rebuilt);
  for (double t = 0.61; t < part.end_time(); t += 0.05)
    EXPECT_NEAR(rebuilt.at(t).yaw_rate, part.at(t).yaw_rate, 1e-9) << t;
}

TEST(Descriptor, RebuildsBraking) {
  const Motion motion(0.0, {random_drive(3, 8)});
  const Motion braking = with_brake(motion, 1.0, 3.0, Braking(1.0));
  expect_same(braking, rebuild(describe(braking)));
}

class BadDescriptor : public ::testing::Test {
 protected:
  BadDescriptor() : good(describe(Motion(0.0, {random_drive(1, 4)}))), bad(good) {}
  PhaseDescriptor& phase() { return bad.phases[0]; }
  void expect_refused() { EXPECT_THROW(rebuild(bad), std::invalid_argument); }

  MotionDescriptor good;
  MotionDescriptor bad;
};

TEST_F(BadDescriptor, IsRefused) {
  EXPECT_NO_THROW(rebuild(good));
  bad.phases.clear();
  expect_refused();
  bad = good;
  phase().points.pop_back();
  expect_refused();
  bad = good;
  phase().durations_s.clear();
  phase().points.resize(1);
  expect_refused();
  bad = good;
  for (const double duration : {0.0, -1.0, std::nan(""), static_cast<double>(INFINITY)}) {
    phase().durations_s[2] = duration;
    expect_refused();
  }
  bad = good;
  phase().points[1].x() = std::nan("");
  expect_refused();
  bad = good;
  phase().start_derivatives(1, 1) = INFINITY;
  expect_refused();
  bad = good;
  phase().direction = 0;
  expect_refused();
  bad = good;
  phase().end_derivatives(0, 0) = 0.5;  // still moving at the end
  expect_refused();
  bad = good;
  bad.start_time_s = std::nan("");
  expect_refused();
  bad = good;
  phase().points[2].x() = 1e200;  // finite, but squares of it are not
  expect_refused();
}

TEST_F(BadDescriptor, TurnsAndStandsAreCheckedToo) {
  phase() = PhaseDescriptor{};
  phase().kind = PhaseDescriptor::Kind::kTurn;
  phase().points = {Vector2::Zero()};
  phase().durations_s = {0.0};
  phase().yaw_change_rad = 1.0;
  expect_refused();
  phase().durations_s = {1.0};
  EXPECT_NO_THROW(rebuild(bad));
  phase().durations_s = {std::nan("")};
  expect_refused();
  phase().durations_s = {1.0};
  phase().yaw_change_rad = std::nan("");
  expect_refused();
  phase().kind = PhaseDescriptor::Kind::kStand;
  phase().points.clear();
  expect_refused();
}

TEST_F(BadDescriptor, AnUnknownKindIsRefused) {
  phase().kind = static_cast<PhaseDescriptor::Kind>(7);
  phase().points = {Vector2::Zero()};
  phase().durations_s = {1.0};
  expect_refused();
}

}  // namespace
}  // namespace mocha
