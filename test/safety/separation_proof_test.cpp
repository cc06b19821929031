#include <gtest/gtest.h>

#include <random>

#include "safety/certificate.h"
#include "trajectory/random_motion.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

double distance_m(const Motion& motion, const MovingObstacle& obstacle, double own_radius_m,
                  double t) {
  const auto disc = obstacle.at(t);
  return (motion.at(t).pose.position - disc.centre).norm() - own_radius_m - disc.radius_m;
}

/// From rest to rest along a straight line.
Motion straight(double start_s, const Vector2& from, const Vector2& to, double duration_s) {
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  piece.col(0) = from;
  piece.col(3) = 10.0 * (to - from);
  piece.col(4) = -15.0 * (to - from);
  piece.col(5) = 6.0 * (to - from);
  return Motion(start_s, {DrivePhase{1, PlanarPath({piece}, {duration_s})}});
}

PeerObstacle peer_on(const Motion& motion, double radius_m = 0.3) {
  return PeerObstacle("ugv2", std::make_shared<const Motion>(motion), radius_m,
                      test::kRoverBraking);
}

void expect_agreement(const Motion& motion, const MovingObstacle& obstacle, double from,
                      double until, int* accepted, int* refused) {
  constexpr int kSamples = 10000;
  double least = kForever;
  for (int i = 0; i <= kSamples; ++i) {
    least =
        std::min(least, distance_m(motion, obstacle, 0.3, from + (until - from) * i / kSamples));
  }
  for (const double clearance : {0.1, least - 0.003, least + 1e-4, least + 0.05}) {
    if (clearance < 0.0) continue;
    const Violation violation = check_separation(motion, 0.3, obstacle, clearance, from, until);
    ++(violation ? *refused : *accepted);
    if (least < clearance) {
      ASSERT_TRUE(violation);
    }
    if (least > clearance + 0.002) {
      ASSERT_FALSE(violation) << describe(violation);
    }
    if (!violation) continue;
    EXPECT_EQ(violation.term, ViolatedTerm::kSeparation);
    EXPECT_EQ(violation.peer, obstacle.name());
    for (double t = from; t < violation.time_s; t += 2e-3) {
      ASSERT_GE(distance_m(motion, obstacle, 0.3, t), clearance);
    }
    EXPECT_LT(distance_m(motion, obstacle, 0.3, violation.time_s), clearance + 1.1e-3);
  }
}

TEST(SeparationProof, AgreesWithDenseSampling) {
  int accepted = 0;
  int refused = 0;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int seed = 0; seed < 40; ++seed) {
    const Motion own(0.0, {random_drive(seed, 6)});
    const Motion other(2.0 * unit(random), {random_drive(seed + 100, 4 + seed % 5)});
    const PeerObstacle peer = peer_on(other);
    const double end = std::max(own.end_time(), other.end_time());
    expect_agreement(own, peer, 0.2, end, &accepted, &refused);
    const PredictedDisc person("person", 0.0, {3.0 * unit(random), 3.0 * unit(random)},
                               {unit(random), unit(random)}, 0.25, 0.05);
    expect_agreement(own, person, 0.0, 4.0, &accepted, &refused);
  }
  EXPECT_GT(accepted, 30);
  EXPECT_GT(refused, 30);
}

TEST(SeparationProof, FindsASwiftCrossingBetweenSamples) {
  const Motion stand(0.0, {StandPhase{{Vector2::Zero(), 0.0}, 10.0}});
  // Two specks that meet for a tenth of a millisecond.
  const PredictedDisc bullet("bullet", 0.0, {-50.0, 0.0}, {20.0, 0.0}, 1e-3, 0.0);
  const Violation violation = check_separation(stand, 1e-3, bullet, 0.0, 0.0, 5.0);
  ASSERT_TRUE(violation);
  EXPECT_NEAR(violation.time_s, 2.5, 1e-3);
  const PredictedDisc beside("bullet", 0.0, {-50.0, 4e-3}, {20.0, 0.0}, 1e-3, 0.0);
  EXPECT_FALSE(check_separation(stand, 1e-3, beside, 0.0, 0.0, 5.0));
}

TEST(SeparationProof, EndsWhereStepsFallBelowTheTickOfTheClock) {
  constexpr double kNow_s = 1.7e9;
  const Motion stand(kNow_s, {StandPhase{{Vector2::Zero(), 0.0}, 10.0}});
  for (const double speed : {2e4, 1e9, 1e200}) {
    const PredictedDisc bullet("bullet", kNow_s + 1.0, {0.0, 3.5e-3}, {speed, 0.0}, 1e-3, 0.0);
    EXPECT_TRUE(check_separation(stand, 1e-3, bullet, 0.0, kNow_s, kNow_s + 2.0)) << speed;
  }
  const PredictedDisc still("still", kNow_s, {0.0, 3.5e-3}, {0.0, 0.0}, 1e-3, 0.0);
  EXPECT_FALSE(check_separation(stand, 1e-3, still, 0.0, kNow_s, kNow_s + 2.0));
  EXPECT_TRUE(check_separation(stand, 1e-3, still, 0.0, -kForever, kNow_s));
}

TEST(SeparationProof, WaitsForTheLaterOfBoth) {
  const Motion own = straight(0.0, {0.0, 0.0}, {1.0, 0.0}, 2.0);
  // The peer sets off after the own motion has ended, and drives into the robot that stands there.
  const PeerObstacle peer = peer_on(straight(5.0, {4.0, 0.0}, {1.65, 0.0}, 4.0));
  EXPECT_FALSE(check_separation(own, 0.3, peer, 0.04, 0.0));
  const Violation violation = check_separation(own, 0.3, peer, 0.06, 0.0);
  ASSERT_TRUE(violation);
  EXPECT_GT(violation.time_s, 8.0);
  EXPECT_FALSE(check_separation(own, 0.3, peer, 0.06, 0.0, 7.0));
  EXPECT_TRUE(check_separation(own, 0.3, peer, 0.06, 20.0));  // both rest, too close
}

TEST(SeparationProof, GrowingDiscsReachARobotThatStands) {
  const Motion stand(0.0, {StandPhase{{Vector2::Zero(), 0.0}, 1.0}});
  const PredictedDisc person("person", 0.0, {2.0, 0.0}, {0.0, 0.0}, 0.3, 0.1);
  const Violation violation = check_separation(stand, 0.3, person, 0.5, 0.0, 20.0);
  ASSERT_TRUE(violation);
  EXPECT_NEAR(violation.time_s, 9.0, 0.02);
  EXPECT_FALSE(check_separation(stand, 0.3, person, 0.5, 0.0, 8.9));
}

TEST(SeparationProof, NeedsAnEnd) {
  const Motion stand(0.0, {StandPhase{{Vector2::Zero(), 0.0}, 1.0}});
  const PredictedDisc person("person", 0.0, {20.0, 0.0}, {0.0, 0.0}, 0.3, 0.0);
  EXPECT_THROW(check_separation(stand, 0.3, person, 0.1, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
