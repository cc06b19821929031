#include <gtest/gtest.h>

#include "safety/certificate.h"
#include "trajectory/random_motion.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr MotionLimits kLimits{1.5, 1.2, 1.8, 4.0};
constexpr Peaks kPeaks{1.5, 1.2, 1.8};

MotionLimits scaled(double factor) {
  return {kLimits.max_speed * factor, kLimits.max_acceleration * factor,
          kLimits.max_yaw_rate * factor, kLimits.max_yaw_acceleration * factor};
}

bool exceeds(const MotionState& state, const MotionLimits& limits, double factor) {
  // Slower than 0.01 mm/s the state's yaw rate is an approximation.
  return state.velocity.norm() > factor * limits.max_speed ||
         state.acceleration.norm() > factor * limits.max_acceleration ||
         (state.velocity.norm() > 1e-5 && std::abs(state.yaw_rate) > factor * limits.max_yaw_rate);
}

/// One piece with the given coefficients of u^0 .. along x and y.
PlanarPath path_of(std::vector<double> x, std::vector<double> y, double duration_s) {
  x.resize(6);
  y.resize(6);
  PlanarPath::Piece piece;
  for (int k = 0; k < 6; ++k) piece.col(k) = Vector2(x[k], y[k]);
  return PlanarPath({piece}, {duration_s});
}

Motion straight(std::vector<double> x, double duration_s) {
  return Motion(0.0, {DrivePhase{1, path_of(std::move(x), {}, duration_s)}});
}

TEST(LimitsProof, AcceptsMotionsWithinTheirLimits) {
  for (int seed = 0; seed < 100; ++seed) {
    const Motion motion =
        within(random_drive(seed, 1 + seed % 20, seed % 2 ? 1 : -1), kPeaks, 1.7e9);
    const Violation violation = check_limits(motion, scaled(1.0005), 0.0);
    EXPECT_FALSE(violation) << seed << ": " << describe(violation);
    EXPECT_TRUE(check_limits(motion, scaled(0.995), 0.0)) << seed;
  }
}

TEST(LimitsProof, TheFasterWheelIsHeldToItsLimit) {
  constexpr int kSamples = 20000;
  int accepted = 0;
  int refused = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const Motion motion = within(random_drive(seed, 3 + seed % 10, seed % 2 ? 1 : -1), kPeaks, 0.0);
    MotionLimits limits = scaled(1.001);
    limits.track_m = 0.6;
    const auto wheel_speed = [&](double t) {
      const MotionState state = motion.at(t);
      return state.velocity.norm() + 0.5 * limits.track_m * std::abs(state.yaw_rate);
    };
    double fastest = 0.0;
    for (int i = 1; i < kSamples; ++i) {
      fastest = std::max(fastest, wheel_speed(motion.end_time() * i / kSamples));
    }
    limits.max_wheel_speed = 1.002 * fastest;
    const Violation between_samples = check_limits(motion, limits, 0.0);
    accepted += !between_samples;
    if (between_samples) {
      EXPECT_GT(between_samples.value, limits.max_wheel_speed) << describe(between_samples);
    }
    limits.max_wheel_speed = 0.99 * fastest;
    const Violation violation = check_limits(motion, limits, 0.0);
    if (!violation) continue;
    ++refused;
    EXPECT_EQ(violation.term, ViolatedTerm::kWheelSpeed);
    EXPECT_GT(violation.value, limits.max_wheel_speed);
    EXPECT_LE(violation.value, 1.001 * fastest);
    EXPECT_GT(wheel_speed(violation.time_s + 2e-3), 0.999 * limits.max_wheel_speed);
  }
  EXPECT_GE(accepted, 58);
  EXPECT_EQ(refused, 60);
}

TEST(LimitsProof, AgreesWithDenseSampling) {
  constexpr int kSamples = 10000;
  int accepted = 0;
  int refused = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const Motion motion = within(random_drive(seed, 3 + seed % 10), kPeaks, 0.0);
    const MotionLimits limits = scaled(0.7 + 0.008 * seed + 0.02 * (seed % 3));
    const double from = seed % 4 == 0 ? 0.4 * motion.end_time() : 0.0;
    const Violation violation = check_limits(motion, limits, from);
    ++(violation ? refused : accepted);
    const double step = (motion.end_time() - from) / kSamples;
    const double proved_until = violation ? violation.time_s - 1e-3 : motion.end_time();
    double first_clear = std::numeric_limits<double>::infinity();
    for (double t = from; t <= motion.end_time(); t += step) {
      if (t < proved_until) {
        ASSERT_FALSE(exceeds(motion.at(t), limits, 1.0 + 2e-6)) << seed << " " << t;
      }
      if (exceeds(motion.at(t), limits, 1.0 + 1e-4)) first_clear = std::min(first_clear, t);
    }
    if (std::isfinite(first_clear)) {
      ASSERT_TRUE(violation) << seed;
      EXPECT_LE(violation.time_s, first_clear);
      EXPECT_GE(violation.time_s, from);
      EXPECT_TRUE(exceeds(motion.at(violation.time_s + 1e-3), limits, 0.99)) << seed;
      EXPECT_GT(violation.value, violation.limit * (1.0 - 1e-3));
    }
  }
  EXPECT_GT(accepted, 10);
  EXPECT_GT(refused, 10);
}

TEST(LimitsProof, FindsASpikeBetweenSamples) {
  // 1 m/s, and for 2 ms in the middle a wiggle e u^2 (1 - u)^2 along the path that takes 2 e /
  // tau^2.
  const double tau = 0.002;
  for (const double acceleration : {1.1, 1.3}) {
    const double e = 0.5 * acceleration * tau * tau;
    const PlanarPath::Piece before = path_of({0.0, 1.003}, {}, 1.003).piece(0);
    const PlanarPath::Piece spike = path_of({1.003, tau, e, -2.0 * e, e}, {}, tau).piece(0);
    const PlanarPath::Piece after = path_of({1.005, 2.0, -1.0}, {}, 2.0).piece(0);
    const PlanarPath path({before, spike, after}, {1.003, tau, 2.0});
    const Violation violation = check_limits(Motion(0.0, {DrivePhase{1, path}}), kLimits, 0.0);
    EXPECT_EQ(static_cast<bool>(violation), acceleration > 1.2);
    if (!violation) continue;
    EXPECT_EQ(violation.term, ViolatedTerm::kAcceleration);
    EXPECT_NEAR(violation.time_s, 1.003, tau);
  }
}

TEST(LimitsProof, FindsAViolationAtTheVeryEnd) {
  // The deceleration 1 - (1 - u)^3 grows until the end: x = -(w^2 / 2 - w^5 / 20) with w = 1 - u.
  const Motion motion = straight({-0.45, 0.75, 0.0, -0.5, 0.25, -0.05}, 1.0);
  EXPECT_FALSE(check_limits(motion, {1.0, 1.0, 1.0, 1.0}, 0.0));
  const Violation violation = check_limits(motion, {1.0, 1.0 - 1e-5, 1.0, 1.0}, 0.0);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation.term, ViolatedTerm::kAcceleration);
  EXPECT_NEAR(violation.time_s, 1.0 - std::cbrt(1e-5), 1e-3);
  EXPECT_NEAR(violation.place.x(), 0.0, 1e-3);
}

TEST(LimitsProof, YawRateAtRestIsItsLimit) {
  // From rest with jerk and snap across: the yaw rate at the start is (j x s) / (3 j^2).
  const Motion motion(0.0,
                      {
                          DrivePhase{1, path_of({0, 0, 0, 10, -15, 6}, {0, 0, 0, 0, 1, -0.8}, 2.0)},
                      });
  // jerk = 6 * 10 / 8, snap = 24 / 16 across
  const double rate = 24.0 / 16.0 / (3.0 * 60.0 / 8.0);
  EXPECT_NEAR(motion.at(0.0).yaw_rate, rate, 1e-9);
  const Violation violation = check_limits(motion, {10.0, 10.0, 0.999 * rate, 1.0}, 0.0);
  EXPECT_EQ(violation.term, ViolatedTerm::kYawRate);
  EXPECT_EQ(violation.time_s, 0.0);
}

TEST(LimitsProof, RefusesAReversalWithinADrive) {
  // 16 u^2 (1 - u)^2: straight out and back within one drive; no yaw rate anywhere, but the heading
  // flips.
  const Motion motion = straight({0, 0, 1, -2, 1}, 4.0);
  const Violation violation = check_limits(motion, {10.0, 10.0, 10.0, 10.0}, 0.0);
  EXPECT_EQ(violation.term, ViolatedTerm::kYawRate);
  EXPECT_NEAR(violation.time_s, 2.0, 2e-3);
  EXPECT_TRUE(std::isinf(violation.value));
  EXPECT_NE(describe(violation).find("heading flips"), std::string::npos);
  // The same at a knot between two pieces of one drive.
  const PlanarPath path = std::get<DrivePhase>(motion.phases()[0]).path;
  const PlanarPath out = path.slice(0.0, 2.0);
  const PlanarPath back = path.slice(2.0, 4.0);
  const Motion pieces(0.0, {DrivePhase{1, PlanarPath({out.piece(0), back.piece(0)}, {2.0, 2.0})}});
  EXPECT_NEAR(check_limits(pieces, {10.0, 10.0, 10.0, 10.0}, 0.0).time_s, 2.0, 2e-3);
  // As two phases, forward and backward, it is a motion like any other.
  const Motion phases(0.0, {DrivePhase{1, out}, DrivePhase{-1, back}});
  EXPECT_FALSE(check_limits(phases, {10.0, 10.0, 10.0, 10.0}, 0.0));
}

TEST(LimitsProof, RefusesJumpsAtAKnotWithinADrive) {
  const MotionLimits ample{10.0, 10.0, 10.0, 10.0};
  const auto check = [&](std::vector<double> x, std::vector<double> y, double duration_s = 1.0) {
    const PlanarPath::Piece first = path_of({0.0, 0.004}, {}, 1.0).piece(0);
    const PlanarPath::Piece second = path_of(std::move(x), std::move(y), duration_s).piece(0);
    return check_limits(
        Motion(0.0, {DrivePhase{1, PlanarPath({first, second}, {1.0, duration_s})}}), ample, 0.0);
  };
  EXPECT_FALSE(check({0.004, 0.004, -0.002}, {}));
  EXPECT_FALSE(check({0.0041, 0.004, -0.002}, {}));  // 0.1 mm: as between phases
  const Violation place = check({0.104, 0.004, -0.002}, {});
  EXPECT_EQ(place.term, ViolatedTerm::kSpeed);
  EXPECT_EQ(place.time_s, 1.0);
  EXPECT_TRUE(std::isinf(place.value));
  EXPECT_NE(describe(place).find("place jumps"), std::string::npos);
  const Violation velocity = check({0.004, 0.104, -0.052}, {});
  EXPECT_EQ(velocity.term, ViolatedTerm::kAcceleration);
  EXPECT_TRUE(std::isinf(velocity.value));
  for (const double turn : {0.5, -1.5, M_PI}) {  // by less than 0.01 m/s
    const double vx = 0.004 * std::cos(turn);
    const double vy = 0.004 * std::sin(turn);
    const Violation heading = check({0.004, vx, -0.5 * vx}, {0.0, vy, -0.5 * vy});
    EXPECT_EQ(heading.term, ViolatedTerm::kYawRate) << turn;
    EXPECT_EQ(heading.time_s, 1.0);
    EXPECT_TRUE(std::isinf(heading.value));
  }
  // A piece too short to be sampled is looked at like any other.
  EXPECT_EQ(check({0.004, 0.1, -0.05}, {}, 5e-7).term, ViolatedTerm::kAcceleration);
}

TEST(LimitsProof, RefusesACuspPassedNearlyAtRest) {
  // v = (1 - 2u, 1 mm/s): turns by 180 degrees while almost standing.
  const Motion motion(0.0, {DrivePhase{1, path_of({0, 1, -1}, {0, 1e-3}, 1.0)},
                            DrivePhase{1, path_of({0, -1, 0.5}, {1e-3, 1e-3, -0.5e-3}, 1.0)}});
  const Violation violation = check_limits(motion, {2.0, 3.0, 3.0, 3.0}, 0.0);
  EXPECT_EQ(violation.term, ViolatedTerm::kYawRate);
  EXPECT_NEAR(violation.time_s, 0.5, 0.02);
}

TEST(LimitsProof, RefusesASwingOfTheHeadingInTheFirstInstants) {
  // Sideways at 10 um/s, then ahead: 90 degrees within milliseconds, almost at rest.
  const Motion motion(0.0, {DrivePhase{1, path_of({0, 0, 0, 10, -15, 6}, {0, 2e-5, -1e-5}, 2.0)}});
  const Violation violation = check_limits(motion, {10.0, 10.0, 10.0, 10.0}, 0.0);
  EXPECT_EQ(violation.term, ViolatedTerm::kYawRate);
  EXPECT_LT(violation.time_s, 0.01);
}

TEST(LimitsProof, LooksAtTheHeadingFromAMicrometreOn) {
  const auto check = [](double metres) {  // a quarter turn or so from rest to rest, in a second
    const Motion motion(0.0, {DrivePhase{1, path_of({0, 0, metres, -metres / 3, -metres / 4},
                                                    {0, 0, 0, 2 * metres, -1.5 * metres}, 1.0)}});
    return check_limits(motion, {10.0, 10.0, 1.0, 10.0}, 0.0);
  };
  EXPECT_EQ(check(1.0).term, ViolatedTerm::kYawRate);
  EXPECT_EQ(check(1e-5).term, ViolatedTerm::kYawRate);
  EXPECT_FALSE(check(1e-8));
  EXPECT_FALSE(
      check_limits(Motion(0.0, {DrivePhase{-1, path_of({3.0}, {4.0}, 2.0)}}), kLimits, 0.0));
  // Within a drive even a micrometre must not be driven to and fro.
  const double v = 1e-4;
  const double tau = 4e-3;
  const PlanarPath::Piece before = path_of({0.0, v}, {}, 1.0).piece(0);
  const PlanarPath::Piece fro =
      path_of({v, v * tau, -2.5 * v * tau, 5 * v * tau / 3}, {}, tau).piece(0);
  const PlanarPath::Piece after = path_of({v, v, -v / 2}, {}, 1.0).piece(0);
  const PlanarPath path({before, fro, after}, {1.0, tau, 1.0});
  EXPECT_EQ(check_limits(Motion(0.0, {DrivePhase{1, path}}), kLimits, 0.0).term,
            ViolatedTerm::kYawRate);
}

TEST(LimitsProof, AcceptsCrawlingStraight) {
  EXPECT_FALSE(check_limits(straight({0, 0, 0, 0.001, -0.0015, 0.0006}, 5.0), kLimits, 0.0));
  EXPECT_FALSE(check_limits(straight({0, 0, 0, 10, -15, 6}, 20.0), kLimits, 0.0));
}

TEST(LimitsProof, AcceptsSlicesThatBeginCloseToRest) {
  for (int seed = 0; seed < 20; ++seed) {
    const Motion motion = within(random_drive(seed, 6), kPeaks, 0.0);
    for (double after = 1e-4; after < 0.5 * motion.end_time(); after *= 1.7) {
      for (const double t : {after, motion.end_time() - after}) {
        const Motion part(t, motion.phases_between(t, motion.end_time()));
        const Violation violation = check_limits(part, scaled(1.001), t);
        EXPECT_FALSE(violation) << seed << " " << t << " " << describe(violation);
        EXPECT_FALSE(check_limits(motion, scaled(1.001), t)) << seed << " " << t;
      }
    }
  }
}

TEST(LimitsProof, AcceptsSlicesCloseToRestFarFromTheOrigin) {
  // In UTM coordinates positions are rounded to a nanometre: much, against what a slow robot moves
  // near its rests.
  for (int seed = 0; seed < 20; ++seed) {
    const PlanarPath near = random_drive(seed, 4).path.stretched(10.0);
    std::vector<PlanarPath::Piece> pieces;
    for (int i = 0; i < near.pieces(); ++i) {
      pieces.push_back(near.piece(i));
      pieces.back().col(0) += Vector2(5e5, 5e6);
    }
    const Motion motion(0.0, {DrivePhase{1, PlanarPath(pieces, near.durations())}});
    ASSERT_FALSE(check_limits(motion, kLimits, 0.0));
    for (double left_s = 2e-5; left_s < 0.5; left_s *= 1.4) {
      const double t = motion.end_time() - left_s;
      const Motion part(t, motion.phases_between(t, motion.end_time()));
      const Violation violation = check_limits(part, kLimits, t);
      EXPECT_FALSE(violation) << seed << " " << left_s << " " << describe(violation);
    }
  }
}

TEST(LimitsProof, AcceptsBrakingWithinFifteenPercent) {
  for (int seed = 0; seed < 20; ++seed) {
    const Motion motion = within(random_drive(seed, 8), kPeaks, 0.0);
    for (double share = 0.03; share < 1.0; share += 0.06) {
      const Motion braking = with_brake(motion, 0.0, share * motion.end_time(), Braking(0.7 * 1.2));
      const Violation violation = check_limits(braking, scaled(1.15), 0.0);
      EXPECT_FALSE(violation) << seed << " " << share << " " << describe(violation);
    }
  }
}

TEST(LimitsProof, ChecksOnlyFromTheGivenTime) {
  const Motion motion = straight({0, 0, 0, 10, -15, 6}, 2.0);  // peak speed 0.94 m/s at 1 s
  const MotionLimits limits{0.9, 10.0, 1.0, 1.0};
  const Violation violation = check_limits(motion, limits, 0.0);
  EXPECT_EQ(violation.term, ViolatedTerm::kSpeed);
  EXPECT_LT(violation.time_s, 1.0);
  EXPECT_NEAR(violation.value, 0.9375, 1e-3);  // the worst of the stretch
  EXPECT_EQ(check_limits(motion, limits, 1.0).time_s, 1.0);
  EXPECT_FALSE(check_limits(motion, limits, 1.4));
  EXPECT_FALSE(check_limits(motion, limits, 5.0));
}

TEST(LimitsProof, CutsAPieceExactlyWhereTimesAreCoarse) {
  // At 1.7e9 s the clock ticks by 2.4e-7 s: much, against the milliseconds that are left of a
  // piece.
  constexpr double kStart_s = 1.7e9;
  const Motion motion(kStart_s, {DrivePhase{1, path_of({0.0, 0.3}, {}, 0.3)},
                                 DrivePhase{1, path_of({0.3, 2.0, -1.0}, {}, 2.0)}});
  for (double left_s = 2e-6; left_s < 0.1; left_s *= 1.3) {
    const double from = kStart_s + 0.3 - left_s;
    EXPECT_FALSE(check_limits(motion, {1.0, 1.0, 1.0, 1.0}, from)) << left_s;
    const Violation violation = check_limits(motion, {1.0 - 1e-5, 1.0, 1.0, 1.0}, from);
    EXPECT_EQ(violation.term, ViolatedTerm::kSpeed) << left_s;
    EXPECT_EQ(violation.time_s, from) << left_s;
  }
}

TEST(LimitsProof, BeginsExactlyWhereTheMotionIs) {
  for (int seed = 0; seed < 50; ++seed) {
    const Motion motion = within(random_drive(seed, 2 + seed % 5), kPeaks, 1.7e9 + 0.013 * seed);
    for (const double left_s : {0.02, 0.05, 0.1}) {  // braking: the fastest moment is the first
      const double from = motion.end_time() - left_s;
      const double speed = motion.at(from).velocity.norm();
      const auto limited = [&](double factor) {
        return check_limits(motion, {factor * speed, 100.0, 1e3, 100.0}, from);
      };
      EXPECT_FALSE(limited(1.0)) << seed << " " << left_s;
      EXPECT_TRUE(limited(1.0 - 2e-6)) << seed << " " << left_s;
    }
  }
}

TEST(LimitsProof, TurnsInPlace) {
  for (const double change : {0.1, -0.1, 2.5, -2.5}) {  // bound by acceleration, bound by rate
    const double duration = turn_duration_s(change, 1.8, 4.0);
    const TurnPhase turn{{Vector2(3.0, 4.0), 0.0}, change, duration};
    EXPECT_FALSE(check_limits(Motion(5.0, {turn}), kLimits, 0.0));
    const TurnPhase hasty{turn.start, change, 0.98 * duration};
    const Violation violation = check_limits(Motion(5.0, {hasty}), kLimits, 0.0);
    ASSERT_TRUE(violation);
    const bool by_rate = std::abs(change) > 1.0;
    EXPECT_EQ(violation.term, by_rate ? ViolatedTerm::kYawRate : ViolatedTerm::kAcceleration);
    EXPECT_EQ(violation.limit, by_rate ? 1.8 : 4.0);
    EXPECT_GT(violation.value, violation.limit);
    EXPECT_GT(violation.time_s, 5.0);
    EXPECT_LT(violation.time_s, 5.0 + (by_rate ? 0.5 : 0.25) * duration);
    EXPECT_EQ(violation.place, Vector2(3.0, 4.0));
    EXPECT_EQ(check_limits(Motion(5.0, {hasty}), kLimits, 5.0 + 0.9 * duration).term,
              ViolatedTerm::kNothing);
  }
}

TEST(LimitsProof, TurnsThatAreUnderWayAndEnded) {
  for (const double change : {2.5, -2.5}) {
    const TurnPhase turn{{}, change, turn_duration_s(change, 1.8, 4.0)};
    for (const double share : {0.1, 0.4, 0.6, 0.9}) {
      const double t = share * turn.duration_s;
      EXPECT_FALSE(check_limits(Motion(t, {part_of(turn, t, turn.duration_s)}), kLimits, t));
      const TurnState state = state_of(turn, t);
      TurnPhase stop = turn_to_rest({{}, state.yaw_rad}, state.rates, 3.9);
      EXPECT_FALSE(check_limits(Motion(t, {stop}), kLimits, t)) << change << " " << share;
      if (share > 0.5) continue;
      stop.yaw_change_rad *= 0.8;
      stop.duration_s *= 0.8;
      const Violation violation = check_limits(Motion(t, {stop}), kLimits, t);
      EXPECT_EQ(violation.term, ViolatedTerm::kAcceleration) << change << " " << share;
      EXPECT_EQ(violation.limit, 4.0);
      EXPECT_GT(violation.value, 4.0);
    }
    const TurnPhase too_fast{{}, 0.5 * change, 1.0, {change, 0.0}, {}};
    const Violation violation = check_limits(Motion(0.0, {too_fast}), kLimits, 0.0);
    EXPECT_EQ(violation.term, ViolatedTerm::kYawRate);
    EXPECT_EQ(violation.time_s, 0.0);
    EXPECT_NEAR(violation.value, 2.5, 1e-9);
  }
}

TEST(LimitsProof, ABaseThatCannotReverseIsHeldToDriveForward) {
  MotionLimits limits = scaled(1.001);
  limits.can_reverse = false;
  for (int seed = 0; seed < 10; ++seed) {
    EXPECT_FALSE(check_limits(within(random_drive(seed, 4, 1), kPeaks, 0.0), limits, 0.0)) << seed;
    const Motion backward = within(random_drive(seed, 4, -1), kPeaks, 0.0);
    const double from_s = 0.1 * seed;
    const Violation violation = check_limits(backward, limits, from_s);
    EXPECT_EQ(violation.term, ViolatedTerm::kSpeedBackward) << seed;
    EXPECT_EQ(violation.time_s, from_s);
    EXPECT_EQ(violation.limit, 0.0);
    EXPECT_GT(violation.value, 0.1);
    EXPECT_EQ(describe(violation).find("speed backward"), 0u) << describe(violation);
    EXPECT_FALSE(check_limits(backward, limits, backward.end_time())) << "it is over";
  }
}

TEST(LimitsProof, SaysWhatWhereAndByHowMuch) {
  const Violation violation{ViolatedTerm::kSpeed, 12.5, {1.0, -2.0}, 1.25, 1.0, ""};
  EXPECT_EQ(describe(violation), "speed 1.250 m/s, limit 1.000, at (1.00, -2.00)");
  const Violation near{ViolatedTerm::kSeparation, 2.0, {0.0, 0.0}, 0.1, 0.2, "ugv2"};
  EXPECT_EQ(describe(near), "distance to ugv2 0.100 m, needs 0.200, at (0.00, 0.00)");
  EXPECT_EQ(describe(Violation{}), "no violation");
}

}  // namespace
}  // namespace mocha
