#include "fleet/protocol/clock_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kAhead_s = 3.7;  // of the peer's clock

/// One exchange: there, held, and back.
void exchange(ClockEstimate& clock, double sent_s, double there_s, double held_s, double back_s,
              double ahead_s = kAhead_s) {
  const double echoed_s = sent_s + there_s + held_s;
  clock.add(sent_s, held_s, echoed_s + ahead_s, echoed_s + back_s);
}

TEST(ClockEstimate, KnowsNothingBeforeTheFirstEcho) {
  EXPECT_FALSE(ClockEstimate().reading(kNow_s));
}

TEST(ClockEstimate, TellsTheOffsetFromTheDelay) {
  ClockEstimate clock;
  exchange(clock, kNow_s, 0.08, 0.05, 0.08);
  const ClockReading reading = clock.reading(kNow_s + 0.21).value();
  EXPECT_NEAR(reading.offset_s, kAhead_s, 1e-6);
  EXPECT_NEAR(reading.delay_s, 0.08, 1e-6);
  EXPECT_NEAR(reading.uncertainty_s, 0.08 + ClockEstimate::kResolution_s, 1e-6);
}

/// Whatever the delays there and back are, the truth is within the uncertainty.
TEST(ClockEstimate, IsNeverMoreWrongThanItSays) {
  std::mt19937 random(1);
  for (int run = 0; run < 100; ++run) {
    std::uniform_real_distribution<double> there(0.0, 0.4);
    std::exponential_distribution<double> back(10.0);
    ClockEstimate clock;
    double least_s = 1.0;
    for (double t = kNow_s; t < kNow_s + 60.0; t += 0.1) {
      const double ahead_s = kAhead_s + 0.9 * ClockEstimate::kDrift * (t - kNow_s);
      const double there_s = there(random);
      const double back_s = back(random);
      exchange(clock, t, there_s, 0.05, back_s, ahead_s);
      const double heard_s = t + there_s + 0.05 + back_s;
      const ClockReading reading = clock.reading(heard_s).value();
      ASSERT_LE(std::abs(reading.offset_s - ahead_s), reading.uncertainty_s);
      least_s = std::min(least_s, reading.uncertainty_s);
    }
    EXPECT_LT(least_s, 0.06);  // the best of many
  }
}

TEST(ClockEstimate, PutsTogetherTheFastestMessagesOfEitherWay) {
  ClockEstimate clock;
  exchange(clock, kNow_s, 0.01, 0.05, 0.3);
  exchange(clock, kNow_s + 1.0, 0.3, 0.05, 0.03);
  const ClockReading reading = clock.reading(kNow_s + 1.38).value();
  EXPECT_NEAR(reading.uncertainty_s, 0.02 + ClockEstimate::kResolution_s, 2e-4);
  EXPECT_NEAR(reading.offset_s, kAhead_s - 0.01, 2e-4);
}

TEST(ClockEstimate, NoticesAClockThatIsSet) {
  ClockEstimate clock;
  for (int i = 0; i < 50; ++i) exchange(clock, kNow_s + 0.1 * i, 0.01, 0.05, 0.01);
  exchange(clock, kNow_s + 5.0, 0.05, 0.05, 0.05, kAhead_s - 1.0);
  EXPECT_NEAR(clock.reading(kNow_s + 5.2)->offset_s, kAhead_s - 1.0, 1e-6);
}

TEST(ClockEstimate, ForgetsWhatIsOldAndWidensWhatItKeeps) {
  ClockEstimate clock;
  exchange(clock, kNow_s, 0.0, 0.05, 0.0);
  for (int i = 1; i < 1000; ++i) exchange(clock, kNow_s + 0.1 * i, 0.1, 0.05, 0.1);
  EXPECT_NEAR(clock.reading(kNow_s + 100.0)->uncertainty_s, 0.12, 1e-2);
  EXPECT_NEAR(clock.reading(kNow_s + 1100.0)->uncertainty_s, 0.12 + 1000.0 * ClockEstimate::kDrift,
              0.01);
}

TEST(ClockEstimate, SaysHowLongMessagesTakeTheseDays) {
  ClockEstimate clock;
  for (int i = 0; i < 20; ++i) exchange(clock, kNow_s + 0.1 * i, 0.0, 0.05, 0.0);
  EXPECT_NEAR(clock.reading(kNow_s + 2.1)->delay_s, 0.0, 1e-6);
  for (int i = 20; i < 60; ++i) exchange(clock, kNow_s + 0.1 * i, 0.1, 0.05, 0.1);
  EXPECT_NEAR(clock.reading(kNow_s + 6.1)->delay_s, 0.1, 0.01);
  EXPECT_NEAR(clock.reading(kNow_s + 6.1)->uncertainty_s, 0.02, 0.001);  // still by the best
}

TEST(ClockEstimate, PassesOverWhatCannotBe) {
  ClockEstimate clock;
  clock.add(kNow_s, -0.1, kNow_s, kNow_s + 0.1);
  clock.add(kNow_s + 1.0, 0.0, kNow_s, kNow_s);     // our own, from the future
  clock.add(kNow_s - 3600.0, 0.0, kNow_s, kNow_s);  // an echo that took an hour
  clock.add(std::nan(""), 0.0, kNow_s, kNow_s);
  EXPECT_FALSE(clock.reading(kNow_s));
}

}  // namespace
}  // namespace mocha
