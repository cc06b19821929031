#include "control/lease.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "fleet/protocol/motions.h"

namespace mocha {
namespace {

const Braking kBraking(0.5);
constexpr MotionId kId{3, 7};

/// From t = 1 on; at full speed from 3 to 5 or so.
Motion winding() { return test::drive(1.0, {{0.0, 0.0}, {2.0, 0.5}, {4.0, 0.0}, {6.0, 0.5}}, 1.0); }

Motion turning() { return Motion(1.0, {TurnPhase{{{2.0, 1.0}, 0.0}, 3.0, 4.0}}); }

TEST(StopAtLeaseEnd, BrakesAlongThePathFromTheEndOfTheLeaseOn) {
  const Motion motion = winding();
  const Motion stop = stop_at_lease_end(motion, 3.7, 3.715, kBraking);
  EXPECT_DOUBLE_EQ(stop.start_time(), 3.7);
  EXPECT_NEAR((stop.position(3.7) - motion.position(3.7)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((stop.velocity(3.7) - motion.velocity(3.7)).norm(), 0.0, 1e-9);
  EXPECT_LT(stop.length_m(), 1.6);
  double beside_m = 1.0;
  for (double t = 3.7; t < motion.end_time(); t += 0.01)
    beside_m = std::min(beside_m, (stop.end_pose().position - motion.position(t)).norm());
  EXPECT_LT(beside_m, 0.02);
}

TEST(StopAtLeaseEnd, EndsATurn) {
  const Motion stop = stop_at_lease_end(turning(), 2.5, 2.52, kBraking);
  EXPECT_EQ(stop.start_time(), 2.5);
  EXPECT_EQ(stop.length_m(), 0.0);
  EXPECT_NEAR(stop.at(2.5).pose.yaw_rad, turning().at(2.5).pose.yaw_rad, 1e-9);
  EXPECT_LT(stop.end_time(), turning().end_time());
}

TEST(StopAtLeaseEnd, DoesNotBeginWhatHasNotBegun) {
  const Motion stop = stop_at_lease_end(winding(), 0.5, 0.52, kBraking);
  EXPECT_EQ(stop.length_m(), 0.0);
  EXPECT_EQ(stop.end_pose().position, Vector2(0.0, 0.0));
}

TEST(StopAtLeaseEnd, NoticedLateItBeginsHardlyInThePast) {
  EXPECT_NEAR(stop_at_lease_end(winding(), 2.0, 4.0, kBraking).start_time(), 3.9, 1e-9);
}

TEST(LeaseWatch, TellsOnceOfTheStop) {
  LeaseWatch watch;
  EXPECT_FALSE(watch.expire(9.0, kBraking));
  watch.commit(kId, winding(), 2.0);
  watch.renew(kId, 3.0);
  watch.renew({3, 6}, 9.0);  // of a former motion
  EXPECT_EQ(watch.end_s(), 3.0);
  EXPECT_FALSE(watch.expire(3.0, kBraking));
  const auto stop = watch.expire(3.01, kBraking);
  ASSERT_TRUE(stop);
  EXPECT_DOUBLE_EQ(stop->start_time(), 3.0);
  EXPECT_FALSE(watch.expire(3.02, kBraking));
}

TEST(LeaseWatch, AMotionThatBrakesByItselfNeedsNoOtherStop) {
  LeaseWatch watch;
  const Motion stop = stop_at_lease_end(winding(), 3.7, 3.7, kBraking);
  for (double t = stop.start_time(); t < stop.end_time() + 1.0; t += 0.05) {
    watch.commit(kId, stop, t);
    EXPECT_FALSE(watch.expire(t + 0.02, kBraking)) << t;
  }
}

TEST(LeaseWatch, ARobotThatIsYetToDriveOrTurnIsSaidToStand) {
  for (const Motion& motion : {winding(), turning()}) {
    LeaseWatch watch;
    watch.commit(kId, motion, 0.5);
    const auto stop = watch.expire(0.51, kBraking);
    ASSERT_TRUE(stop);
    EXPECT_EQ(stop->length_m(), 0.0);
  }
}

}  // namespace
}  // namespace mocha
