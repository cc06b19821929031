#include "rviz_panel/background_calls.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace mocha {
namespace {

TEST(BackgroundCalls, RunInTheirOrderOnAnotherThread) {
  std::vector<int> ran;
  std::thread::id where;
  std::promise<void> done;
  BackgroundCalls calls;
  for (int i = 0; i < 3; ++i) calls.add([&ran, i] { ran.push_back(i); });
  calls.add([&] {
    where = std::this_thread::get_id();
    done.set_value();
  });
  done.get_future().wait();
  EXPECT_EQ(ran, (std::vector<int>{0, 1, 2}));
  EXPECT_NE(where, std::this_thread::get_id());
}

TEST(BackgroundCalls, TheEndWaitsForTheOneThatRunsOnly) {
  std::promise<void> started, go_on;
  bool ended = false, another = false;
  std::thread opener;
  {
    BackgroundCalls calls;
    calls.add([&] {
      started.set_value();
      go_on.get_future().wait();
      ended = true;
    });
    calls.add([&] { another = true; });
    started.get_future().wait();
    opener = std::thread([&go_on] { go_on.set_value(); });
  }
  opener.join();
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace mocha
