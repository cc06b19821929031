#include "planning/replanner/proposals.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kTimeout_s = 0.6;

class ProposalsTest : public ::testing::Test {
 protected:
  ProposedMotion make(double now_s, std::uint32_t plan, bool brakes = false) {
    return proposals_.make(now_s, standing(now_s, {1.0 * plan, 0.0}, 0.0), false,
                           {plan, now_s + 2.0}, brakes);
  }
  Proposals proposals_{kTimeout_s};
};

TEST_F(ProposalsTest, AreNumberedAndPendUntilTheyAreAnswered) {
  EXPECT_FALSE(proposals_.pending(kNow_s));
  EXPECT_EQ(make(kNow_s, 7).sequence, 1u);
  EXPECT_TRUE(proposals_.pending(kNow_s + 0.1));
  const PromiseSource source = proposals_.settled(1);
  EXPECT_EQ(source.plan, 7u);
  EXPECT_EQ(source.follows_until_s, kNow_s + 2.0);
  EXPECT_FALSE(proposals_.pending(kNow_s + 0.1));
  EXPECT_EQ(make(kNow_s, 8).sequence, 2u);
  proposals_.refused(2);
  EXPECT_FALSE(proposals_.pending(kNow_s + 0.1));
}

TEST_F(ProposalsTest, AreGivenUpWithoutAnAnswer) {
  make(kNow_s, 1);
  EXPECT_TRUE(proposals_.pending(kNow_s + kTimeout_s - 0.01));
  EXPECT_FALSE(proposals_.pending(kNow_s + kTimeout_s));
}

TEST_F(ProposalsTest, AnAnswerToAnOlderOneSaysNothingOfTheNewest) {
  make(kNow_s, 1);
  make(kNow_s + 0.1, 2, true);
  EXPECT_EQ(proposals_.newest().end_pose().position.x(), 2.0);
  EXPECT_TRUE(proposals_.newest_brakes());
  EXPECT_EQ(proposals_.settled(1).plan, 1u);
  EXPECT_TRUE(proposals_.pending(kNow_s + 0.2));
  proposals_.refused(1);
  EXPECT_TRUE(proposals_.pending(kNow_s + 0.2));
  EXPECT_EQ(proposals_.settled(2).plan, 2u);
}

TEST_F(ProposalsTest, GoOnAfterWhatIsInForceSinceBeforeARestart) {
  EXPECT_EQ(proposals_.settled(41).plan, 0u);
  EXPECT_EQ(make(kNow_s, 3).sequence, 42u);
}

}  // namespace
}  // namespace mocha
