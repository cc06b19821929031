#include "control/odometry_check.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

constexpr double kStep_s = 0.02;
constexpr UnicycleState kDrive{0.5, 0.0};

TEST(OdometryCheck, BelievesWhatMoves) {
  OdometryCheck check(0.1, 30.0);
  for (int i = 0; i < 500; ++i) {
    check.add(kStep_s * i, {{0.01 * (i / 5), 0.0}, 0.0}, kDrive);  // in ticks of a centimetre
    EXPECT_FALSE(check.is_frozen(kStep_s * i));
  }
}

TEST(OdometryCheck, BelievesWhatStandsUnasked) {
  OdometryCheck check(0.1, 30.0);
  for (int i = 0; i < 5000; ++i) check.add(kStep_s * i, {}, {0.0, 0.0});
  EXPECT_FALSE(check.is_frozen(100.0));
}

TEST(OdometryCheck, NoticesWhatStandsThoughAsked) {
  for (const UnicycleState command : {kDrive, UnicycleState{-0.5, 0.0}, UnicycleState{0.0, 1.0}}) {
    OdometryCheck check(0.1, 30.0);
    double time_s = 0.0;
    while (!check.is_frozen(time_s) && time_s < 1.0) check.add(time_s += kStep_s, {}, command);
    EXPECT_NEAR(time_s, 0.22, 0.03);
    EXPECT_NE(check.words().find("more than 0.10 m were commanded"), std::string::npos);
  }
}

TEST(OdometryCheck, TriesAgainAfterAWhileOrAsSoonAsItMoves) {
  OdometryCheck check(0.1, 30.0);
  check.add(0.0, {}, kDrive);
  for (int i = 1; i <= 11; ++i) check.add(kStep_s * i, {}, kDrive);
  EXPECT_TRUE(check.is_frozen(0.22));
  EXPECT_TRUE(check.is_frozen(30.0));
  EXPECT_FALSE(check.is_frozen(31.0));
  check.add(1.0, {{0.01, 0.0}, 0.0}, {0.0, 0.0});
  EXPECT_FALSE(check.is_frozen(1.0));
}

TEST(OdometryCheck, OldWordsSayNothingNew) {
  OdometryCheck check(0.1, 30.0);
  for (int i = 0; i < 100; ++i) check.add(5.0, {}, kDrive);
  EXPECT_FALSE(check.is_frozen(5.0));
}

TEST(OdometryCheck, TimeMayBeginAnew) {
  OdometryCheck check(0.1, 30.0);
  check.add(100.0, {}, kDrive);
  check.add(100.05, {}, kDrive);
  check.add(1.0, {}, kDrive);
  for (int i = 1; i <= 4; ++i) check.add(1.0 + kStep_s * i, {}, kDrive);
  EXPECT_FALSE(check.is_frozen(1.1));
}

}  // namespace
}  // namespace mocha
