#include "ros_bridge/runtime/stop_signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace mocha {
namespace {

TEST(StopSignals, WaitUntilTheyAreAskedFor) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          const StopSignals signals;
          const bool early = signals.came();
          kill(getpid(), signal);
          _exit(!early && signals.came() ? 0 : 1);
        },
        ::testing::ExitedWithCode(0), "");
  }
}

}  // namespace
}  // namespace mocha
