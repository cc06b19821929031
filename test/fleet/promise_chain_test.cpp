#include "fleet/promise_chain.h"

#include <gtest/gtest.h>

#include "fleet/motions.h"

namespace mocha {
namespace {

Promise promise(std::uint32_t sequence, Motion motion) {
  Promise promise;
  promise.agent = "a";
  promise.id = {1, sequence};
  promise.state = PromiseState::kCommitted;
  promise.footprint_radius_m = 0.3;
  promise.motion = test::shared(std::move(motion));
  return promise;
}

/// Drives to (3, 0) by t = 3, then from t = 5 on to (7, 0).
PromiseChain two_drives() {
  PromiseChain chain;
  chain.bind(promise(1, test::drive(0.0, {{0.0, 0.0}, {3.0, 0.0}}, 1.0)));
  chain.bind(promise(2, test::drive(5.0, {{3.0, 0.0}, {7.0, 0.0}}, 1.0)));
  return chain;
}

TEST(PromiseChain, EachHoldsUntilTheNextStarts) {
  PromiseChain chain = two_drives();
  const auto claims = chain.claims();
  ASSERT_EQ(claims.size(), 2u);
  EXPECT_DOUBLE_EQ(claims[0].until_s, 5.0);
  EXPECT_DOUBLE_EQ(claims[1].from_s, 5.0);
  EXPECT_EQ(chain.newest().id.sequence, 2u);
  EXPECT_NEAR((chain.position(1.5) - Vector2(1.5, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((chain.position(4.0) - Vector2(3.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((chain.position(7.0) - Vector2(5.0, 0.0)).norm(), 0.0, 1e-9);
  chain.prune(4.9);
  EXPECT_EQ(chain.claims().size(), 2u);
  chain.prune(5.0);
  EXPECT_EQ(chain.claims().size(), 1u);
}

TEST(PromiseChain, WhatStartsLaterThanANewPromiseIsReplaced) {
  PromiseChain chain = two_drives();
  chain.bind(promise(3, test::drive(4.0, {{3.0, 0.0}, {3.0, -2.0}}, 1.0)));
  ASSERT_EQ(chain.claims().size(), 2u);
  EXPECT_EQ(chain.claims()[0].promise.id.sequence, 1u);
  EXPECT_DOUBLE_EQ(chain.claims()[0].until_s, 4.0);
  EXPECT_NEAR(chain.position(9.0).y(), -2.0, 1e-9);
}

TEST(PromiseChain, ComposesOneMotionFromNowOn) {
  const PromiseChain chain = two_drives();
  const auto motion = chain.composed(1.0);
  for (double t = 1.05; t < 10.0; t += 0.1) {
    EXPECT_NEAR((motion->at(t).pose.position - chain.position(t)).norm(), 0.0, 1e-6) << t;
  }
}

TEST(PromiseChain, ComposesBeforeItsFirstMotionBegins) {
  const PromiseChain chain = two_drives();
  const auto motion = chain.composed(-0.5);
  EXPECT_DOUBLE_EQ(motion->start_time(), 0.0);
  for (double t = 0.05; t < 10.0; t += 0.1) {
    EXPECT_NEAR((motion->at(t).pose.position - chain.position(t)).norm(), 0.0, 1e-6) << t;
  }
}

TEST(PromiseChain, ComposesTheNewestAloneWherePartsDoNotJoin) {
  PromiseChain chain = two_drives();
  chain.bind(promise(3, test::stand(6.0, {8.0, 8.0})));
  EXPECT_EQ(chain.composed(1.0), chain.newest().motion);
}

TEST(FirstConflict, LooksOnlyWhereBothClaimsHold) {
  const Claim crossing = claim_of(promise(1, test::drive(0.0, {{1.5, -3.0}, {1.5, 3.0}}, 2.0)));
  Claim other = two_drives().claims()[0];
  const auto conflict = first_conflict(crossing, other, 1.0, 0.0);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->peer, "a");
  EXPECT_LT(conflict->distance_m, 1.0);
  EXPECT_DOUBLE_EQ(conflict->required_m, 1.0);
  const Vector2 there = crossing.promise.motion->at(conflict->time_s).pose.position;
  EXPECT_EQ(conflict->place, there);
  EXPECT_FALSE(first_conflict(crossing, other, 1.0, 5.0));  // over by then
  other.until_s = conflict->time_s - 0.01;
  EXPECT_FALSE(first_conflict(crossing, other, 1.0, 0.0));
}

}  // namespace
}  // namespace mocha
