#include "fleet/protocol/reservation_chain.h"

#include <gtest/gtest.h>

#include "fleet/protocol/motions.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

CommittedTrajectory trajectory(std::uint32_t sequence, Motion motion) {
  CommittedTrajectory trajectory;
  trajectory.agent = "a";
  trajectory.id = {1, sequence};
  trajectory.state = TrajectoryState::kCommitted;
  trajectory.footprint_radius_m = 0.3;
  trajectory.braking = test::kRoverBraking;
  trajectory.motion = test::shared(std::move(motion));
  return trajectory;
}

/// Drives to (3, 0) by t = 3, then from t = 5 on to (7, 0).
ReservationChain two_drives() {
  ReservationChain chain;
  chain.bind(trajectory(1, test::drive(0.0, {{0.0, 0.0}, {3.0, 0.0}}, 1.0)));
  chain.bind(trajectory(2, test::drive(5.0, {{3.0, 0.0}, {7.0, 0.0}}, 1.0)));
  return chain;
}

TEST(ReservationChain, EachHoldsUntilTheNextStarts) {
  ReservationChain chain = two_drives();
  const auto reservations = chain.reservations();
  ASSERT_EQ(reservations.size(), 2u);
  EXPECT_DOUBLE_EQ(reservations[0].until_s, 5.0);
  EXPECT_DOUBLE_EQ(reservations[1].from_s, 5.0);
  EXPECT_EQ(chain.newest().id.sequence, 2u);
  EXPECT_NEAR((chain.position(1.5) - Vector2(1.5, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((chain.position(4.0) - Vector2(3.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((chain.position(7.0) - Vector2(5.0, 0.0)).norm(), 0.0, 1e-9);
  chain.prune(4.9);
  EXPECT_EQ(chain.reservations().size(), 2u);
  chain.prune(5.0);
  EXPECT_EQ(chain.reservations().size(), 1u);
}

TEST(ReservationChain, WhatStartsLaterThanANewPromiseIsReplaced) {
  ReservationChain chain = two_drives();
  chain.bind(trajectory(3, test::drive(4.0, {{3.0, 0.0}, {3.0, -2.0}}, 1.0)));
  ASSERT_EQ(chain.reservations().size(), 2u);
  EXPECT_EQ(chain.reservations()[0].trajectory.id.sequence, 1u);
  EXPECT_DOUBLE_EQ(chain.reservations()[0].until_s, 4.0);
  EXPECT_NEAR(chain.position(9.0).y(), -2.0, 1e-9);
}

TEST(ReservationChain, WhatComesLateGoesBeforeItsSuccessors) {
  ReservationChain chain;
  EXPECT_TRUE(chain.bind(trajectory(3, test::drive(5.0, {{3.0, 0.0}, {7.0, 0.0}}, 1.0))));
  EXPECT_TRUE(chain.bind(trajectory(1, test::drive(0.0, {{0.0, 0.0}, {3.0, 0.0}}, 1.0))));
  ASSERT_EQ(chain.reservations().size(), 2u);
  EXPECT_EQ(chain.newest().id.sequence, 3u);
  EXPECT_DOUBLE_EQ(chain.reservations()[0].until_s, 5.0);
  EXPECT_NEAR((chain.position(1.5) - Vector2(1.5, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_FALSE(chain.bind(trajectory(2, test::stand(5.0, {9.0, 9.0}))));  // never began
  EXPECT_TRUE(chain.holds({1, 1}));
  EXPECT_FALSE(chain.holds({1, 2}));
  EXPECT_EQ(chain.reservations().size(), 2u);
}

TEST(ReservationChain, ComposesOneMotionFromNowOn) {
  const ReservationChain chain = two_drives();
  const auto motion = chain.composed(1.0);
  for (double t = 1.05; t < 10.0; t += 0.1) {
    EXPECT_NEAR((motion->at(t).pose.position - chain.position(t)).norm(), 0.0, 1e-6) << t;
  }
}

TEST(ReservationChain, ComposesBeforeItsFirstMotionBegins) {
  const ReservationChain chain = two_drives();
  const auto motion = chain.composed(-0.5);
  EXPECT_DOUBLE_EQ(motion->start_time(), 0.0);
  for (double t = 0.05; t < 10.0; t += 0.1) {
    EXPECT_NEAR((motion->at(t).pose.position - chain.position(t)).norm(), 0.0, 1e-6) << t;
  }
}

TEST(ReservationChain, WhatJoinsIsOnePart) {
  const ReservationChain chain = two_drives();
  const auto parts = chain.parts(1.0);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].trajectory.id.sequence, 2u);
  EXPECT_DOUBLE_EQ(parts[0].trajectory.motion->end_time(), chain.newest().motion->end_time());
}

TEST(ReservationChain, KeepsWhatIsInForceUntilWhatDoesNotJoinItBegins) {
  ReservationChain chain = two_drives();
  chain.bind(trajectory(3, test::stand(6.0, {8.0, 8.0})));
  const auto parts = chain.parts(1.0);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].trajectory.id.sequence, 2u);
  EXPECT_DOUBLE_EQ(parts[0].until_s, 6.0);
  EXPECT_DOUBLE_EQ(parts[1].from_s, 6.0);
  for (double t = 1.05; t < 6.0; t += 0.1) {
    const Vector2 there = parts[0].trajectory.motion->position(t);
    EXPECT_NEAR((there - chain.position(t)).norm(), 0.0, 1e-6) << t;
  }
  EXPECT_EQ(parts[1].trajectory.motion, chain.newest().motion);
  EXPECT_EQ(chain.composed(1.0), chain.newest().motion);
  chain.prune(6.0);
  EXPECT_EQ(chain.parts(6.0).size(), 1u);
}

TEST(ReservationChain, APartIsAsWideAsTheWidestOfItsPromises) {
  ReservationChain chain;
  CommittedTrajectory wide = trajectory(1, test::drive(0.0, {{0.0, 0.0}, {3.0, 0.0}}, 1.0));
  wide.footprint_radius_m = 0.5;
  chain.bind(wide);
  chain.bind(trajectory(2, test::drive(5.0, {{3.0, 0.0}, {7.0, 0.0}}, 1.0)));
  EXPECT_DOUBLE_EQ(chain.parts(1.0)[0].trajectory.footprint_radius_m, 0.5);
}

TEST(FirstConflict, LooksOnlyWhereBothReservationsHold) {
  const Reservation crossing =
      reservation_of(trajectory(1, test::drive(0.0, {{1.5, -3.0}, {1.5, 3.0}}, 2.0)));
  Reservation other = two_drives().reservations()[0];
  const auto conflict = first_conflict(crossing, other, 1.0, 0.0);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->peer, "a");
  EXPECT_LT(conflict->distance_m, 1.0);
  EXPECT_DOUBLE_EQ(conflict->required_m, 1.0);
  const Vector2 there = crossing.trajectory.motion->at(conflict->time_s).pose.position;
  EXPECT_EQ(conflict->place, there);
  EXPECT_FALSE(first_conflict(crossing, other, 1.0, 5.0));  // over by then
  other.until_s = conflict->time_s - 0.01;
  EXPECT_FALSE(first_conflict(crossing, other, 1.0, 0.0));
}

}  // namespace
}  // namespace mocha
