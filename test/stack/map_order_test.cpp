#include "stack/map_order.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace mocha {
namespace {

/// A map whose cells are the names of the updates that counted.
struct MapOrderTest : ::testing::Test {
  using Order = MapOrder<char>;

  void grid(Order::Stamp stamp_ns) {
    if (!order.admits_grid(stamp_ns)) return;
    counted += '|';
    for (const Order::Stamped& update : order.follow(stamp_ns)) judge(update);
  }

  void update(char name, Order::Stamp stamp_ns) { hear({stamp_ns, false, name}); }
  void announcement(Order::Stamp stamp_ns) { hear({stamp_ns, true, '?'}); }

  void hear(const Order::Stamped& update) {
    order.hear(next++, update.stamp_ns);
    judge(update);
  }

  void judge(const Order::Stamped& update) {
    if (order.admits(update)) counted += update.update;
  }

  /// A grid, and the one that the first update asks for.
  void begin() {
    grid(10);
    announcement(10);
    grid(10);
    ASSERT_EQ(asked, 1);
    counted.clear();
  }

  int asked = 0;
  std::uint32_t next = 7;  // number of an update
  std::string counted;
  Order order{[this] { ++asked; }};
};

TEST_F(MapOrderTest, NothingCountsBeforeAGrid) {
  update('a', 11);
  update('b', 12);
  EXPECT_EQ(counted, "");
  grid(11);
  EXPECT_EQ(counted, "|b");
  EXPECT_EQ(asked, 1);
}

TEST_F(MapOrderTest, TheFirstUpdateCountsAndIsKeptForTheGridThatItAsksFor) {
  grid(10);
  update('a', 12);
  EXPECT_EQ(counted, "|a");
  EXPECT_EQ(asked, 1);
  grid(11);
  EXPECT_EQ(counted, "|a|a");
  grid(12);
  EXPECT_EQ(counted, "|a|a|") << "was kept no longer";
}

TEST_F(MapOrderTest, AGridContainsWhatIsNotNewer) {
  begin();
  grid(12);
  update('a', 11);
  update('b', 12);
  update('c', 13);
  EXPECT_EQ(counted, "|c");
  EXPECT_EQ(asked, 1);
}

TEST_F(MapOrderTest, UpdatesWaitForAnAnnouncedGrid) {
  begin();
  announcement(11);
  update('a', 12);
  grid(10);
  EXPECT_EQ(counted, "") << "it is not the one that was announced";
  grid(11);
  EXPECT_EQ(counted, "|a");
  EXPECT_EQ(asked, 1);
}

TEST_F(MapOrderTest, AnAnnouncementThatWasKeptHoldsUpWhatFollowsIt) {
  begin();
  announcement(11);
  update('a', 12);
  announcement(13);
  update('b', 14);
  grid(11);
  EXPECT_EQ(counted, "|a");
  grid(13);
  EXPECT_EQ(counted, "|a|b");
}

TEST_F(MapOrderTest, AfterAGapNothingCountsUntilAnyGridComes) {
  begin();
  ++next;
  update('a', 12);
  update('b', 13);
  EXPECT_EQ(counted, "");
  EXPECT_EQ(asked, 2);
  grid(9);
  EXPECT_EQ(counted, "|ab");
}

TEST_F(MapOrderTest, NumbersBeginAnewBehindTheHighest) {
  next = 0xffffffffu;
  begin();
  update('a', 12);
  EXPECT_EQ(counted, "a");
  EXPECT_EQ(asked, 1);
}

TEST_F(MapOrderTest, StampsThatFallAreAGap) {
  begin();
  update('a', 12);
  update('b', 3);
  update('c', 4);
  EXPECT_EQ(counted, "a");
  EXPECT_EQ(asked, 2);
  grid(3);
  EXPECT_EQ(counted, "a|c");
}

TEST_F(MapOrderTest, StartingOverForgetsWhatWasKept) {
  begin();
  announcement(11);
  update('a', 12);
  order.start_over();
  EXPECT_EQ(asked, 2);
  update('b', 13);
  grid(11);
  EXPECT_EQ(counted, "|b");
}

TEST_F(MapOrderTest, OfTooManyThatWaitNoneIsKeptAndAGridIsAskedFor) {
  begin();
  announcement(11);
  for (int i = 0; asked == 1 && i < 100'000; ++i) update('a', 12 + i);
  EXPECT_EQ(asked, 2);
  grid(11);
  EXPECT_EQ(counted, "|");
}

TEST_F(MapOrderTest, ItNeedsNobodyToAsk) {
  Order alone{{}};
  alone.hear(1, 10);
  EXPECT_FALSE(alone.admits({10, false, 'a'}));
  EXPECT_EQ(alone.follow(9).size(), 1u);
}

}  // namespace
}  // namespace mocha
