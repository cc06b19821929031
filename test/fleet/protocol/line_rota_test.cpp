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

TEST(LineRota, OneTwiceAsUrgentHasItsTurnTwiceAsOften) {
  LineRota rota(1);
  std::map<std::string, int> turns;
  for (int k = 0; k < 300; ++k) {
    for (const std::string& peer : rota.take({{"near", 1.0}, {"far", 0.5}}, 1.0 * k)) ++turns[peer];
  }
  EXPECT_NEAR(turns["near"], 200, 3);
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
