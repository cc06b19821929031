#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "fleet/protocol/motions.h"
#include "optimization/clearance_penalty.h"
#include "optimization/dynamics_penalty.h"
#include "optimization/moving_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "optimization/one_sample.h"
#include "optimization/turning_penalty.h"
#include "optimization/wheel_penalty.h"
#include "optimization/zone_speed_penalty.h"
#include "safety/circle_field.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

using Sample = mocha::Sample<2>;
const Vector2 kZero = Vector2::Zero();
constexpr double kForever = std::numeric_limits<double>::infinity();

Sample sample_at(const Vector2& position, const Vector2& velocity, const Vector2& acceleration,
                 double time_s = 0.0) {
  return {position, velocity, acceleration, time_s};
}

/// Compares the gradient with differences in all entries.
void expect_gradient(const Penalty<2>& penalty, const Sample& sample, double step,
                     double tolerance) {
  PenaltyRows<2> rows = rows_at(penalty, sample);
  const auto slope = [&](const std::function<double&(Sample&)>& entry) {
    Sample plus = sample;
    Sample minus = sample;
    entry(plus) += step;
    entry(minus) -= step;
    return (value_of(penalty, plus) - value_of(penalty, minus)) / (2.0 * step);
  };
  const auto expect = [&](double analytic, double numeric, const char* what) {
    EXPECT_NEAR(analytic, numeric, tolerance * (1.0 + std::abs(analytic)))
        << penalty.name() << ", by " << what;
  };
  for (int axis = 0; axis < 2; ++axis) {
    expect(rows.by_position()(0, axis),
           slope([axis](Sample& s) -> double& { return s.position[axis]; }), "position");
    expect(rows.by_velocity()(0, axis),
           slope([axis](Sample& s) -> double& { return s.velocity[axis]; }), "velocity");
    expect(rows.by_acceleration()(0, axis),
           slope([axis](Sample& s) -> double& { return s.acceleration[axis]; }), "acceleration");
    expect(rows.by_jerk()(0, axis), slope([axis](Sample& s) -> double& { return s.jerk[axis]; }),
           "jerk");
  }
  expect(rows.by_time[0], slope([](Sample& s) -> double& { return s.time_s; }), "time");
}

class RandomSamples {
 public:
  Sample next(double speed) {
    return sample_at({place_(random_), place_(random_)},
                     speed * Vector2(unit_(random_), unit_(random_)),
                     {unit_(random_), unit_(random_)}, 5.0 * std::abs(unit_(random_)));
  }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> place_{-2.0, 2.0};
  std::normal_distribution<double> unit_{0.0, 1.0};
};

TEST(Cubic, IsZeroUpToZero) {  // paper (31)
  EXPECT_EQ(cubic(-1.0).value, 0.0);
  EXPECT_EQ(cubic(0.0).slope, 0.0);
  EXPECT_DOUBLE_EQ(cubic(2.0).value, 8.0);
  EXPECT_DOUBLE_EQ(cubic(2.0).slope, 12.0);
}

std::shared_ptr<const SpeedZones> slow_square(double since_s) {
  const Zone zone{"slow", Polygon{{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}}, 0.4};
  return SpeedZones::of({zone}, load_robot_model("config", "rover"), since_s);
}

TEST(ZoneSpeedPenalty, HasTheValuesOfHand) {
  const ZoneSpeedPenalty penalty(10.0, slow_square(-100.0), 0.0, 1.0, 0.5);
  EXPECT_EQ(value_of(penalty, sample_at(kZero, {0.4, 0.0}, kZero)), 0.0);
  EXPECT_NEAR(value_of(penalty, sample_at(kZero, {0.0, 0.8}, kZero)), 10.0 * 27.0, 1e-9);
  const double rim = 1.0 + slow_square(0.0)->reach_m();
  // w^2 = 0.16 + 4 * 0.5 * 0.08 = 0.32
  EXPECT_NEAR(value_of(penalty, sample_at({rim + 0.08, 0.0}, {0.8, 0.0}, kZero)), 10.0, 1e-9);
  EXPECT_EQ(value_of(penalty, sample_at({rim + 0.25, 0.0}, {0.8, 0.0}, kZero)), 0.0);
  EXPECT_EQ(penalty.wanted(piece_of(sample_at({9.0, 0.0}, {0.8, 0.0}, kZero)).bounds), kNone);
  EXPECT_EQ(penalty.wanted(piece_of(sample_at(kZero, {0.3, 0.0}, kZero)).bounds), kNone);
}

TEST(ZoneSpeedPenalty, GradientIsExact) {
  const ZoneSpeedPenalty in_force(3.0, slow_square(-100.0), 0.0, 0.97, 0.5);
  const ZoneSpeedPenalty comes(3.0, slow_square(-SpeedZones::kNotice_s), 0.0, 0.97, 0.5);
  RandomSamples samples;
  int counted = 0;
  for (int i = 0; i < 300; ++i) {
    Sample sample = samples.next(0.9);
    sample.time_s *= 0.2;
    counted += value_of(in_force, sample) > 0.0;
    expect_gradient(in_force, sample, 1e-6, 1e-4);
    expect_gradient(comes, sample, 1e-6, 1e-4);
  }
  EXPECT_GT(counted, 100);
}

TEST(DynamicsPenalty, HasTheValuesOfHand) {  // paper (32)
  const DynamicsPenalty<2> penalty(10.0, 2.0, 3.0);
  EXPECT_EQ(value_of(penalty, sample_at({9.0, 9.0}, {1.2, 1.6}, {0.0, 3.0})),
            0.0);  // just at both limits
  EXPECT_NEAR(value_of(penalty, sample_at(kZero, {0.0, 4.0}, {0.0, 0.0})), 10.0 * 27.0,
              1e-9);  // (16/4 - 1)^3
  EXPECT_NEAR(value_of(penalty, sample_at(kZero, {0.0, 0.0}, {3.0, 3.0})), 10.0,
              1e-9);  // (18/9 - 1)^3
  EXPECT_NEAR(value_of(penalty, sample_at(kZero, {4.0, 0.0}, {3.0, 3.0})), 280.0, 1e-9);
}

TEST(DynamicsPenalty, MayWeighSpeedAndAccelerationDifferently) {
  const DynamicsPenalty<2> penalty(10.0, 2.0, 1000.0, 3.0);
  EXPECT_NEAR(value_of(penalty, sample_at(kZero, {4.0, 0.0}, {3.0, 3.0})), 270.0 + 1000.0, 1e-9);
}

TEST(DynamicsPenalty, GradientMatchesDifferences) {
  const DynamicsPenalty<2> penalty(2.0, 0.8, 0.7);
  RandomSamples samples;
  for (int i = 0; i < 200; ++i) expect_gradient(penalty, samples.next(1.0), 1e-6, 1e-6);
}

TEST(TurningPenalty, HasTheValuesOfHand) {
  const double soft = 0.1;
  const TurningPenalty penalty(5.0, 0.5, soft);
  const auto expected = [&](double speed, double yaw_rate) {
    const double v2 = speed * speed;
    const double excess =
        v2 * v2 * (yaw_rate * yaw_rate / 0.25 - 1.0) / ((v2 + soft * soft) * (v2 + soft * soft));
    return excess > 0.0 ? 5.0 * excess * excess * excess : 0.0;
  };
  for (const double speed : {0.05, 0.3, 2.0}) {
    for (const double yaw_rate : {-1.5, -0.49, 0.0, 0.49, 0.51, 2.0}) {
      // Along x; the part of the acceleration across is speed times yaw rate.
      const Sample sample = sample_at(kZero, {speed, 0.0}, {0.7, speed * yaw_rate});
      EXPECT_NEAR(value_of(penalty, sample), expected(speed, yaw_rate), 1e-9)
          << speed << " " << yaw_rate;
    }
  }
}

TEST(TurningPenalty, AtRestCountsTheLimitOfTheYawRate) {
  const TurningPenalty penalty(5.0, 0.5, 0.05);
  // From rest, v = a t + j t^2 / 2 and so the yaw rate begins with (a x j) / (2 |a|^2).
  Sample sample = sample_at(kZero, kZero, {2.0, 0.0});
  for (const double yaw_rate : {-1.0, 0.0, 0.4, 0.49, 0.51, 1.5}) {
    sample.jerk = Vector2(7.0, 2.0 * 2.0 * yaw_rate);
    const double excess = std::max(0.0, yaw_rate * yaw_rate / 0.25 - 1.0);
    EXPECT_NEAR(value_of(penalty, sample), 5.0 * excess * excess * excess, 1e-9) << yaw_rate;
  }
}

TEST(TurningPenalty, GradientAtRestMatchesDifferences) {
  const TurningPenalty penalty(5.0, 0.5, 0.05);
  RandomSamples samples;
  for (int i = 0; i < 200; ++i) {
    Sample sample = samples.next(0.0);
    sample.jerk = Vector2(std::sin(i), 3.0 * std::cos(i));
    sample.acceleration += 0.5 * sample.acceleration.normalized();
    expect_gradient(penalty, sample, 1e-7, 1e-4);
  }
}

TEST(TurningPenalty, IsFiniteWithoutAnyMotion) {
  const TurningPenalty penalty(5.0, 0.5, 0.05);
  PenaltyRows<2> rows = rows_at(penalty, sample_at(kZero, kZero, kZero));
  EXPECT_EQ(rows.value[0], 0.0);
  EXPECT_TRUE(rows.by_velocity().isZero());
  EXPECT_TRUE(rows.by_acceleration().isZero());
}

TEST(TurningPenalty, GradientMatchesDifferencesAlsoNearStandstill) {
  const TurningPenalty penalty(2.0, 0.4, 0.1);
  RandomSamples samples;
  for (int i = 0; i < 200; ++i) {
    expect_gradient(penalty, samples.next(1.0), 1e-7, 2e-5);
    expect_gradient(penalty, samples.next(0.05), 1e-8, 1e-4);
  }
}

MotionLimits narrow_wheels() {
  MotionLimits limits;
  limits.max_wheel_speed = 1.0;
  limits.track_m = 0.4;
  return limits;
}

TEST(WheelPenalty, HasTheValuesOfHand) {
  const double soft = 0.1;
  const WheelPenalty penalty(5.0, narrow_wheels(), soft);
  for (const double speed : {0.05, 0.6, 0.99}) {
    for (const double yaw_rate : {-3.0, -0.2, 0.0, 0.2, 1.9, 2.1, 6.0}) {
      const double wheel = speed + 0.2 * std::abs(yaw_rate);
      const double soft2 = speed * speed + soft * soft;
      const double excess = (wheel * wheel - 1.0) * std::pow(speed, 4) / (soft2 * soft2);
      const Sample sample = sample_at(kZero, {0.0, speed}, {-speed * yaw_rate, 0.4});
      EXPECT_NEAR(value_of(penalty, sample), 5.0 * std::pow(std::max(0.0, excess), 3), 1e-9)
          << speed << " " << yaw_rate;
    }
  }
}

TEST(WheelPenalty, GradientMatchesDifferencesAlsoNearStandstill) {
  const WheelPenalty penalty(2.0, narrow_wheels(), 0.1);
  RandomSamples samples;
  for (int i = 0; i < 200; ++i) {
    expect_gradient(penalty, samples.next(1.0), 1e-7, 1e-5);
    expect_gradient(penalty, samples.next(0.05), 1e-8, 1e-4);
  }
  EXPECT_EQ(value_of(penalty, sample_at(kZero, kZero, kZero)), 0.0);
}

TEST(WheelPenalty, IsNotWantedWhereTheWheelsAreFastEnough) {
  const WheelPenalty penalty(2.0, narrow_wheels(), 0.1);
  PieceBounds<2> bounds = piece_of(sample_at(kZero, {0.5, 0.0}, {0.0, 0.5})).bounds;
  EXPECT_EQ(penalty.wanted(bounds), kNone);  // 0.5 + 0.2 * 0.5 / 0.5
  bounds.max_acceleration2 = 4.0;
  EXPECT_NE(penalty.wanted(bounds), kNone);
  bounds.max_acceleration2 = 0.25;
  bounds.min_speed2 = 0.0;  // may stop: nothing is known of the yaw rate
  EXPECT_NE(penalty.wanted(bounds), kNone);
}

TEST(ObstaclePenalty, HasTheValuesOfHand) {  // paper (30)
  const CircleField field({{{0.0, 0.0}, 1.0}});
  const ObstaclePenalty<2> disc(10.0, field, {{0.0, 0.5}}, 0.05);
  EXPECT_EQ(value_of(disc, sample_at({1.5, 0.0}, kZero, kZero)), 0.0);
  EXPECT_NEAR(value_of(disc, sample_at({1.25, 0.0}, kZero, kZero)), 10.0 * 0.421875,
              1e-9);                                                             // (1 - 1/4)^3
  EXPECT_NEAR(value_of(disc, sample_at({0.0, 1.0}, kZero, kZero)), 10.0, 1e-9);  // on the surface
  EXPECT_NEAR(value_of(disc, sample_at({0.0, 0.5}, kZero, kZero)), 80.0,
              1e-9);  // inside: (1 + 1)^3
}

TEST(ObstaclePenalty, PutsTheDiscsAlongTheHeading) {
  const CircleField field({{{3.0, 0.0}, 1.0}});
  const ObstaclePenalty<2> front(1.0, field, {{0.5, 0.6}}, 0.05);
  // Fast: the disc is 0.5 m ahead, so 0.5 m from the circle when the base is a metre away.
  const double near = value_of(front, sample_at({1.0, 0.0}, {100.0, 0.0}, kZero));
  EXPECT_NEAR(near, std::pow(1.0 - 0.25 / 0.36, 3), 1e-4);
  EXPECT_EQ(value_of(front, sample_at({1.0, 0.0}, {-100.0, 0.0}, kZero)), 0.0);
  EXPECT_EQ(value_of(front, sample_at({1.0, 0.0}, {0.0, 0.0}, kZero)),
            0.0);  // at rest: at the base
}

TEST(ObstaclePenalty, PutsTheDiscsAsideOfTheHeading) {
  const CircleField field({{{0.0, 3.0}, 1.0}});
  const ObstaclePenalty<2> left(1.0, field, {{0.3, 0.6, 0.5}}, 0.05);
  // Fast: the disc is 0.5 m to the left and 0.3 m ahead, so 0.5 m from the circle.
  const double near = value_of(left, sample_at({-0.3, 1.0}, {100.0, 0.0}, kZero));
  EXPECT_NEAR(near, std::pow(1.0 - 0.25 / 0.36, 3), 1e-4);
  EXPECT_EQ(value_of(left, sample_at({-0.3, 1.0}, {-100.0, 0.0}, kZero)), 0.0);
  EXPECT_EQ(value_of(left, sample_at({-0.3, 1.0}, kZero, kZero)), 0.0);  // at the base
}

TEST(ObstaclePenalty, GradientMatchesDifferencesAlsoNearStandstill) {
  const CircleField field({{{0.3, 0.2}, 0.4}, {{-1.2, 1.0}, 0.3}});
  const ObstaclePenalty<2> penalty(
      3.0, field, {{0.3, 0.8}, {-0.3, 0.8}, {0.2, 0.7, -0.25}, {0.0, 0.7, 0.3}}, 0.05);
  RandomSamples samples;
  for (int i = 0; i < 200; ++i) {
    expect_gradient(penalty, samples.next(1.0), 1e-7, 1e-5);
    expect_gradient(penalty, samples.next(0.02), 1e-7, 1e-5);
  }
}

TEST(ClearancePenalty, AsksForMoreRoomAtSpeed) {
  const CircleField field({{{0.0, 0.0}, 1.0}});
  const ClearancePenalty<2> disc(10.0, field, {{0.0, SpeedMargin(0.2, 0.1), 1.0}}, 1e-6);
  const auto value = [&](double distance_m, double speed) {
    return value_of(disc, sample_at({1.0 + distance_m, 0.0}, {0.0, speed}, kZero));
  };
  EXPECT_EQ(value(0.21, 0.0), 0.0);
  EXPECT_EQ(value(0.24, 0.3), 0.0);
  EXPECT_NEAR(value(0.295, 1.0), 10.0 * 0.125 / (1.0 + 0.125 / 8.0), 1e-3);
  EXPECT_NEAR(value(0.19, 0.0), 10.0 / (1.0 + 1.0 / 8.0), 1e-3);
  EXPECT_NEAR(value(0.0, 0.0), 80.0, 0.1) << "level";
}

TEST(ClearancePenalty, GradientMatchesDifferencesAlsoNearStandstill) {
  const CircleField field({{{0.3, 0.2}, 0.4}, {{-1.2, 1.0}, 0.3}});
  const SpeedMargin required(0.5, 0.1);
  const ClearancePenalty<2> penalty(
      1e-3, field, {{0.3, required, 2.0}, {0.0, required, 2.0}, {0.1, required, 2.0, 0.3}}, 0.05);
  RandomSamples samples;
  for (int i = 0; i < 200; ++i) {
    expect_gradient(penalty, samples.next(1.0), 1e-6, 1e-3);
    expect_gradient(penalty, samples.next(0.02), 1e-6, 1e-3);
  }
}

MovingPenalty moving(double until_s) {
  const auto walker = std::make_shared<PredictedDisc>("walker", 100.0, Vector2(1.0, 0.0),
                                                      Vector2(0.0, 0.5), 0.3, 0.2);
  return MovingPenalty(10.0, 100.0, {{walker, 0.7, until_s}});
}

TEST(MovingPenalty, HasTheValuesOfHandWhileTheRadiusGrows) {  // paper (33)
  const MovingPenalty penalty = moving(kForever);
  const auto expected = [](double distance_m, double time_s) {
    const double safety_m = 0.4 + 0.3 + 0.3 + 0.2 * time_s;
    const double lack = std::max(0.0, 1.0 - distance_m * distance_m / (safety_m * safety_m));
    return 10.0 * lack * lack * lack;
  };
  for (const double time_s : {0.0, 1.0, 4.0}) {
    const Vector2 walker(1.0, 0.5 * time_s);
    for (const double distance_m : {0.2, 0.9, 1.5, 2.5}) {
      const Sample sample = sample_at(walker + Vector2(distance_m, 0.0), kZero, kZero, time_s);
      EXPECT_NEAR(value_of(penalty, sample), expected(distance_m, time_s), 1e-9);
    }
  }
}

TEST(MovingPenalty, PassesOverNoPeerThatIsNear) {
  const auto motion = test::shared(test::drive(100.0, {{0.0, 0.0}, {3.0, 2.0}, {4.0, 0.0}}, 1.0));
  const auto peer = std::make_shared<PeerObstacle>("peer", motion, 0.3, test::kRoverBraking);
  const MovingPenalty penalty(10.0, 100.0, {{peer, 0.7, kForever}});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-3.0, 7.0);
  int near = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector2 place(uniform(random), uniform(random));
    const double time_s = uniform(random);
    const double distance_m = (place - motion->position(100.0 + time_s)).norm();
    const double lack = std::max(0.0, 1.0 - distance_m * distance_m);
    const double value = value_of(penalty, sample_at(place, kZero, kZero, time_s));
    EXPECT_NEAR(value, 10.0 * lack * lack * lack, 1e-9);
    near += lack > 0.0;
  }
  EXPECT_GT(near, 30);
}

TEST(MovingPenalty, CountsOnlyUntilItsTime) {
  const MovingPenalty penalty = moving(102.0);
  EXPECT_GT(value_of(penalty, sample_at({1.0, 1.0}, kZero, kZero, 1.99)), 0.0);
  EXPECT_EQ(value_of(penalty, sample_at({1.0, 1.0}, kZero, kZero, 2.01)), 0.0);
}

TEST(MovingPenalty, GradientMatchesDifferences) {
  const MovingPenalty penalty = moving(kForever);
  RandomSamples samples;
  for (int i = 0; i < 200; ++i) expect_gradient(penalty, samples.next(1.0), 1e-6, 1e-6);
}

TEST(MovingPenalty, NobodyAroundCostsNothing) {
  EXPECT_EQ(value_of(MovingPenalty(10.0, 0.0, {}), sample_at(kZero, kZero, kZero)), 0.0);
}

TEST(Penalties, ThreeDimensionsAreLikeTwo) {
  const DynamicsPenalty<3> penalty(10.0, 2.0, 3.0);
  const mocha::Sample<3> sample{{0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}, {0.0, 3.0, 3.0}};
  PenaltyRows<3> rows = rows_at(penalty, sample);
  EXPECT_NEAR(rows.value[0], 280.0, 1e-9);
  EXPECT_GT(rows.by_velocity()(0, 2), 0.0);
}

}  // namespace
}  // namespace mocha
