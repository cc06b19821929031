#include "control/stop_latch.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(StopLatch, StopsAtOnceAndStaysWithoutAnybodyElse) {
  StopLatch latch;
  EXPECT_FALSE(latch.stopped());
  EXPECT_FALSE(latch.released());
  latch.stop();
  EXPECT_TRUE(latch.stopped());
  EXPECT_TRUE(latch.by_itself());
}

TEST(StopLatch, FollowsTheState) {
  StopLatch latch;
  latch.hear(false, 4);
  EXPECT_TRUE(latch.released());
  latch.hear(true, 4);
  EXPECT_TRUE(latch.stopped());
  EXPECT_FALSE(latch.by_itself());
  latch.hear(false, 5);
  EXPECT_FALSE(latch.stopped());
}

TEST(StopLatch, AStateThatDoesNotKnowOfTheStopDoesNotReleaseIt) {
  StopLatch latch;
  latch.hear(false, 4);
  latch.stop();
  latch.hear(false, 4);
  EXPECT_TRUE(latch.stopped());
  latch.hear(true, 4);
  latch.hear(false, 5);
  EXPECT_FALSE(latch.stopped());
}

TEST(StopLatch, AResetOfOneStopLeavesAnother) {
  StopLatch latch;
  latch.hear(false, 4);
  latch.stop();
  latch.hear(true, 5);
  EXPECT_TRUE(latch.stopped());
  latch.hear(false, 6);
  EXPECT_FALSE(latch.stopped());
}

TEST(StopLatch, FirstHeardAfterTheStopAnOldStateDoesNotReleaseIt) {
  StopLatch latch;
  latch.stop();
  latch.hear(false, 4);  // kept for late joiners
  EXPECT_TRUE(latch.stopped());
  latch.hear(false, 5);
  EXPECT_FALSE(latch.stopped());
}

TEST(StopLatch, StoppedAgainItNeedsAnotherReset) {
  StopLatch latch;
  latch.hear(false, 4);
  latch.stop();
  latch.hear(true, 5);
  latch.stop();  // a button that is held
  latch.hear(false, 5);
  EXPECT_TRUE(latch.stopped());
}

}  // namespace
}  // namespace mocha
