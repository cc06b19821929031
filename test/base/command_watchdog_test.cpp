#include "base/command_watchdog.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

TEST(CommandWatchdog, ForgetsCommandsThatGrowOld) {
  CommandWatchdog watchdog(0.3);
  EXPECT_FALSE(watchdog.command(0.0));
  watchdog.take(10.0, {0.5, -0.2});
  ASSERT_TRUE(watchdog.command(10.3));
  EXPECT_EQ(watchdog.command(10.3)->speed, 0.5);
  EXPECT_EQ(watchdog.command(10.3)->yaw_rate, -0.2);
  EXPECT_FALSE(watchdog.command(10.31));
  watchdog.take(20.0, {0.1, 0.0});
  EXPECT_TRUE(watchdog.command(20.1));
}

TEST(CommandWatchdog, AClockThatWasSetBackMakesNoCommandYoung) {
  CommandWatchdog watchdog(0.3);
  watchdog.take(10.0, {0.5, 0.0});
  EXPECT_FALSE(watchdog.command(9.9));
}

TEST(CommandWatchdog, RefusesWhatIsNotFiniteAndItRefreshesNothing) {
  CommandWatchdog watchdog(0.3);
  watchdog.take(10.0, {0.5, 0.0});
  EXPECT_FALSE(watchdog.take(10.2, {std::nan(""), 0.0}));
  EXPECT_FALSE(watchdog.take(10.2, {0.0, INFINITY}));
  EXPECT_EQ(watchdog.refused(), 2);
  EXPECT_EQ(watchdog.command(10.2)->speed, 0.5);
  EXPECT_FALSE(watchdog.command(10.4));
}

}  // namespace
}  // namespace mocha
