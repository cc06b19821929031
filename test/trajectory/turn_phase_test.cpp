#include "trajectory/turn_phase.h"

#include <gtest/gtest.h>

#include <random>

namespace mocha {
namespace {

constexpr double kStep_s = 1e-5;  // of central differences

/// From rest to rest and parts of such turns, to both sides.
std::vector<TurnPhase> turns() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<TurnPhase> turns;
  for (int i = 0; i < 40; ++i) {
    const double change_rad = (i % 2 ? 1.0 : -1.0) * (0.05 + 6.0 * unit(random));
    const TurnPhase whole{
        {{1.0, -2.0}, 3.0 * unit(random)}, change_rad, turn_duration_s(change_rad, 1.5, 4.0)};
    turns.push_back(whole);
    const double from_s = 0.9 * unit(random) * whole.duration_s;
    turns.push_back(part_of(whole, from_s, whole.duration_s));
    turns.push_back(part_of(whole, 0.5 * from_s, from_s));
  }
  return turns;
}

TEST(TurnPhase, RatesAreTheDerivativesOfTheHeading) {
  for (const TurnPhase& turn : turns()) {
    for (const double share : {0.1, 0.35, 0.5, 0.8}) {
      const double t = share * turn.duration_s;
      const TurnState before = state_of(turn, t - kStep_s);
      const TurnState after = state_of(turn, t + kStep_s);
      const TurnRates rates = state_of(turn, t).rates;
      EXPECT_NEAR(rates.yaw_rate, wrap_angle(after.yaw_rad - before.yaw_rad) / (2.0 * kStep_s),
                  1e-6);
      EXPECT_NEAR(rates.yaw_acceleration,
                  (after.rates.yaw_rate - before.rates.yaw_rate) / (2.0 * kStep_s), 1e-5);
    }
  }
}

TEST(TurnPhase, BeginsAndEndsAsItSays) {
  for (const TurnPhase& turn : turns()) {
    const TurnState begin = state_of(turn, 0.0);
    const TurnState end = state_of(turn, turn.duration_s);
    EXPECT_NEAR(wrap_angle(begin.yaw_rad - turn.start.yaw_rad), 0.0, 1e-12);
    EXPECT_NEAR(wrap_angle(end.yaw_rad - turn.start.yaw_rad - turn.yaw_change_rad), 0.0, 1e-12);
    EXPECT_NEAR(begin.rates.yaw_rate, turn.from.yaw_rate, 1e-12);
    EXPECT_NEAR(begin.rates.yaw_acceleration, turn.from.yaw_acceleration, 1e-9);
    EXPECT_NEAR(end.rates.yaw_rate, turn.to.yaw_rate, 1e-12);
    EXPECT_NEAR(end.rates.yaw_acceleration, turn.to.yaw_acceleration, 1e-9);
  }
}

TEST(TurnPhase, PartsAreTheSameTurn) {
  for (const TurnPhase& turn : turns()) {
    const double from_s = 0.3 * turn.duration_s;
    const TurnPhase part = part_of(turn, from_s, 0.9 * turn.duration_s);
    EXPECT_EQ(part.start.position, turn.start.position);
    for (double t = 0.0; t < part.duration_s; t += 0.05) {
      const TurnState whole = state_of(turn, from_s + t);
      const TurnState same = state_of(part, t);
      EXPECT_NEAR(wrap_angle(same.yaw_rad - whole.yaw_rad), 0.0, 1e-12);
      EXPECT_NEAR(same.rates.yaw_rate, whole.rates.yaw_rate, 1e-11);
      EXPECT_NEAR(same.rates.yaw_acceleration, whole.rates.yaw_acceleration, 1e-10);
    }
  }
}

/// Of the turn, at its hardest.
double hardest(const TurnPhase& turn) {
  double most = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const TurnRates rates = state_of(turn, turn.duration_s * i / 1000.0).rates;
    most = std::max(most, std::abs(rates.yaw_acceleration));
  }
  return most;
}

/// From time t within the turn.
TurnPhase ended(const TurnPhase& turn, double t, double deceleration) {
  const TurnState state = state_of(turn, t);
  return turn_to_rest({turn.start.position, state.yaw_rad}, state.rates, deceleration);
}

TEST(TurnPhase, ComesToRestToTheSameSideAsHardAsItMay) {
  for (const double change_rad : {0.2, -1.0, 3.0, -6.0}) {
    const TurnPhase turn{{}, change_rad, turn_duration_s(change_rad, 1.5, 4.0)};
    const double side = std::copysign(1.0, change_rad);
    for (const double deceleration : {0.5, 4.0}) {
      for (double t = 0.02; t < turn.duration_s - 0.01; t += 0.03) {
        const TurnPhase stop = ended(turn, t, deceleration);
        const TurnRates begin = state_of(turn, t).rates;
        EXPECT_EQ(stop.from.yaw_rate, begin.yaw_rate);
        EXPECT_EQ(stop.from.yaw_acceleration, begin.yaw_acceleration);
        EXPECT_EQ(stop.to.yaw_rate, 0.0);
        EXPECT_EQ(stop.to.yaw_acceleration, 0.0);
        EXPECT_NEAR(state_of(stop, stop.duration_s).rates.yaw_rate, 0.0, 1e-9);
        EXPECT_LE(hardest(stop), 1.01 * std::max(deceleration, std::abs(begin.yaw_acceleration)))
            << change_rad << " " << t;
        EXPECT_LT(stop.duration_s, 2.2 * std::abs(begin.yaw_rate) / deceleration + 0.5);
        for (double after_s = 0.0; after_s < stop.duration_s; after_s += 0.01)
          EXPECT_GT(side * state_of(stop, after_s).rates.yaw_rate, -1e-9) << change_rad << " " << t;
      }
    }
  }
}

TEST(TurnPhase, ComesToRestAlsoAtItsHardestAndHardlyTurning) {
  for (const double yaw_rate : {0.0, 1e-6, 0.3, -1.5}) {
    for (const double yaw_acceleration : {0.0, 1e-6, 4.0, -4.0, 9.0}) {
      const TurnPhase stop = turn_to_rest({}, {yaw_rate, yaw_acceleration}, 4.0);
      EXPECT_GE(stop.duration_s, 0.02);
      EXPECT_LT(stop.duration_s, 3.0);
      EXPECT_LE(hardest(stop), 1.01 * std::max(4.0, std::abs(yaw_acceleration)));
    }
  }
}

}  // namespace
}  // namespace mocha
