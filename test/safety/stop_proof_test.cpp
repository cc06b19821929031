#include "safety/stop_proof.h"

#include <gtest/gtest.h>

#include "fleet/protocol/motions.h"

namespace mocha {
namespace {

const StopOptions kOptions{Braking(0.5), 0.3};
constexpr double kRadius_m = 0.3;

PeerObstacle peer_on(Motion motion, const Braking& braking = kOptions.braking) {
  return PeerObstacle("ugv2", test::shared(std::move(motion)), kRadius_m, braking);
}

TEST(StopProof, SaysWhenWhereAndByHowMuch) {
  const Motion own = test::drive(0.0, {{-4.0, 0.0}, {4.0, 0.0}}, 0.6);
  const PeerObstacle peer = peer_on(test::drive(0.5, {{0.0, -4.0}, {0.0, 4.0}}, 0.6));
  const Violation violation = check_stops(own, kRadius_m, peer, 0.1, kOptions, 0.0);
  ASSERT_EQ(violation.term, ViolatedTerm::kSeparation);
  EXPECT_EQ(violation.peer, "ugv2");
  EXPECT_NEAR(violation.limit, 0.1, 1e-9);
  EXPECT_LT(violation.value, 0.1);
  EXPECT_LT(violation.place.norm(), 2.0);
  EXPECT_GT(violation.time_s, 3.0);
  EXPECT_LT(violation.time_s, 7.5);
  EXPECT_FALSE(check_stops(own, kRadius_m, peer, 0.1, kOptions, 9.0));
  const PeerObstacle later = peer_on(test::drive(5.0, {{0.0, -4.0}, {0.0, 4.0}}, 0.6));
  EXPECT_FALSE(check_stops(own, kRadius_m, later, 0.1, kOptions, 0.0));
}

TEST(StopProof, ARobotThatIsTooCloseMayLeaveButComeNoCloser) {
  const PeerObstacle stands = peer_on(test::stand(0.0, {0.5, 0.0}));
  const Motion leaves = test::drive(0.0, {{0.0, 0.0}, {-3.0, 0.0}}, 0.5);
  const Motion comes = test::drive(0.0, {{0.0, 0.0}, {0.1, 0.0}}, 0.5);
  EXPECT_FALSE(check_stops(leaves, kRadius_m, stands, 0.1, kOptions, 0.0));
  EXPECT_TRUE(check_stops(comes, kRadius_m, stands, 0.1, kOptions, 0.0));
}

TEST(StopProof, APeerIsTakenToBrakeAsItSays) {
  const Motion ahead = test::drive(0.0, {{0.0, 0.0}, {12.0, 0.0}}, 0.8);
  const Motion behind = test::drive(0.0, {{-1.6, 0.0}, {10.4, 0.0}}, 0.8);
  const Braking gentle(0.2);
  EXPECT_FALSE(check_stops(ahead, kRadius_m, peer_on(behind), 0.0, kOptions, 0.0));
  EXPECT_TRUE(check_stops(ahead, kRadius_m, peer_on(behind, gentle), 0.0, kOptions, 0.0));
  const StopOptions gently{gentle, kOptions.reaction_s};
  EXPECT_FALSE(check_stops(behind, kRadius_m, peer_on(ahead, gentle), 0.0, gently, 0.0));
  EXPECT_TRUE(check_stops(behind, kRadius_m, peer_on(ahead), 0.0, gently, 0.0));
}

TEST(StopProof, WhatPromisesNothingViolatesNothing) {
  const PredictedDisc person("1", 0.0, {0.5, 0.0}, {-1.0, 0.0}, 0.3, 0.0);
  EXPECT_FALSE(check_stops(test::drive(0.0, {{0.0, 0.0}, {1.0, 0.0}}, 0.5), kRadius_m, person, 0.1,
                           kOptions, 0.0));
}

}  // namespace
}  // namespace mocha
