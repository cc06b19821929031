#include "fleet/beat_datagrams.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "fleet/wire_format.h"

namespace mocha {
namespace {

/// About so many others, and then two lines about the sender.
Beat beat_about(int others) {
  Beat beat{"ugv1", 3, 12.5, {}};
  for (int i = 0; i < others; ++i)
    beat.seen.push_back({"robot" + std::to_string(1000 + i), {1, 7}, PromiseState::kCommitted});
  beat.seen.push_back({"ugv1", {3, 4}, PromiseState::kCommitted});
  beat.seen.push_back({"ugv1", {3, 5}, PromiseState::kProposed});
  return beat;
}

TEST(BeatDatagrams, AreAsManyAsItTakesAndLoseNothing) {
  for (const int others : {0, 5, 60, 199, 1000}) {
    const Beat beat = beat_about(others);
    const auto sent = datagrams(beat);
    EXPECT_EQ(sent.size() == 1, others <= 60) << others;
    std::vector<Seen> heard;
    std::size_t of_itself = 0;
    for (const auto& bytes : sent) {
      EXPECT_LE(bytes.size(), kMostDatagramBytes);
      const auto part = std::get<Beat>(decode(bytes.data(), bytes.size()));
      EXPECT_EQ(part.agent, "ugv1");
      EXPECT_EQ(part.epoch, 3u);
      EXPECT_EQ(part.stamp_s, 12.5);
      std::size_t here = 0;
      for (const Seen& line : part.seen) here += line.agent == part.agent;
      of_itself = std::max(of_itself, here);
      heard.insert(heard.end(), part.seen.begin(), part.seen.end());
    }
    EXPECT_EQ(of_itself, 2u);  // together: each alone would say something else
    ASSERT_EQ(heard.size(), beat.seen.size());
    for (std::size_t i = 0; i < heard.size(); ++i) EXPECT_EQ(heard[i].agent, beat.seen[i].agent);
  }
}

TEST(BeatDatagrams, RefuseWhatCannotBeSaid) {
  Beat beat = beat_about(100);
  beat.seen[40].agent = "a name with blanks";
  EXPECT_THROW(datagrams(beat), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
