#include "fleet/wire/replay_guard.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(ReplayGuard, TakesEachDatagramOnce) {
  ReplayGuard guard;
  for (std::uint32_t number = 5; number < 500; ++number) {
    EXPECT_TRUE(guard.take(1, number));
    for (std::uint32_t old = number > 100 ? number - 100 : 5; old <= number; ++old)
      EXPECT_FALSE(guard.take(1, old));
  }
  EXPECT_EQ(guard.loss(), 0.0);
}

TEST(ReplayGuard, TakesWhatComesLateButNotTooLate) {
  ReplayGuard guard;
  EXPECT_TRUE(guard.take(1, 100));
  EXPECT_TRUE(guard.take(1, 163));
  EXPECT_TRUE(guard.take(1, 130));
  EXPECT_FALSE(guard.take(1, 130));
  EXPECT_FALSE(guard.take(1, 100));
  EXPECT_TRUE(guard.take(1, 164));
  EXPECT_TRUE(guard.take(1, 101));
  EXPECT_FALSE(guard.take(1, 99));
}

TEST(ReplayGuard, NumbersBeginAnewWithEachEpochAndOldEpochsAreOver) {
  ReplayGuard guard;
  EXPECT_TRUE(guard.take(3, 4000000000U));
  EXPECT_TRUE(guard.take(4, 1));
  EXPECT_FALSE(guard.take(3, 4000000001U));
  EXPECT_FALSE(guard.take(4, 1));
  EXPECT_TRUE(guard.take(4, 4294967295U));  // a leap
  EXPECT_FALSE(guard.take(4, 2));
}

TEST(ReplayGuard, KnowsHowManyAreMissing) {
  ReplayGuard guard;
  EXPECT_EQ(guard.loss(), 0.0);
  for (std::uint32_t number = 1; number <= 200; ++number) {
    if (number % 4 != 0) guard.take(1, number);
  }
  EXPECT_NEAR(guard.loss(), 0.25, 0.02);
  guard.take(1, 10000);
  EXPECT_GT(guard.loss(), 0.9);
  for (std::uint32_t number = 10001; number < 10100; ++number) guard.take(1, number);
  EXPECT_EQ(guard.loss(), 0.0);
}

}  // namespace
}  // namespace mocha
