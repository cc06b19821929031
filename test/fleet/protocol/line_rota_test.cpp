#include "fleet/protocol/line_rota.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

std::vector<LineRota::Entry> entries(int count, double urgency) {
  std::vector<LineRota::Entry> entries;
  for (int i = 0; i < count; ++i) entries.push_back({"p" + std::to_string(i), urgency});
  return entries;
}

TEST(LineRota, SpeaksOfAllWhereThereIsRoom) {
  LineRota rota(3);
  EXPECT_EQ(rota.take(entries(3, 1.0), 0.0).size(), 3U);
  EXPECT_EQ(rota.take(entries(3, 1.0), 0.1).size(), 3U);
  EXPECT_TRUE(rota.take({}, 0.2).empty());
}

TEST(LineRota, EquallyUrgentOnesTakeTurns) {
  LineRota rota(2);
  std::map<std::string, int> turns;
  for (int k = 0; k < 50; ++k) {
    for (const std::string& peer : rota.take(entries(5, 1.0), 1.0 * k)) ++turns[peer];
  }
  ASSERT_EQ(turns.size(), 5U);
  for (const auto& [peer, count] : turns) EXPECT_EQ(count, 20) << peer;
}

TEST(LineRota, OnesTwiceAsUrgentHaveTheirTurnsTwiceAsOften) {
  std::vector<LineRota::Entry> all = entries(20, 1.0);
  for (int i = 10; i < 20; ++i) all[i].urgency = 0.5;
  LineRota rota(2);
  std::map<std::string, int> turns;
  for (int k = 0; k < 1000; ++k) {
    for (const std::string& peer : rota.take(all, 0.1 * k)) ++turns[peer];
  }
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(turns[all[i].peer], i < 10 ? 133 : 67, 8) << i;
}

TEST(LineRota, SpeaksFirstOfThoseOfWhomNothingWasSaidTheMostUrgentFirst) {
  LineRota rota(1);
  EXPECT_EQ(rota.take({{"a", 0.1}, {"b", 1.0}}, 0.0).front(), "b");
  EXPECT_EQ(rota.take({{"a", 0.1}, {"b", 1.0}}, 5.0).front(), "a");
  EXPECT_EQ(rota.take({{"a", 0.1}, {"b", 1.0}, {"new", 0.01}}, 6.0).front(), "new");
}

TEST(LineRota, ForgetsWhoIsNoLongerThere) {
  LineRota rota(1);
  rota.take({{"a", 1.0}}, 0.0);
  rota.take({}, 0.1);
  rota.take({{"b", 1.0}}, 0.2);
  EXPECT_EQ(rota.take({{"a", 0.5}, {"b", 1.0}}, 9.0).front(), "a");
}

TEST(LineRota, NeedsRoom) { EXPECT_THROW(LineRota(0), std::invalid_argument); }

}  // namespace
}  // namespace mocha
