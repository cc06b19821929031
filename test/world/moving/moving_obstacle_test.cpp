#include "world/moving/moving_obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "trajectory/random_motion.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

TEST(PeerObstacle, FollowsItsMotion) {
  const auto motion = std::make_shared<const Motion>(10.0, std::vector<Phase>{random_drive(1, 6)});
  const PeerObstacle peer("ugv2", motion, 0.3, test::kRoverBraking);
  EXPECT_EQ(peer.name(), "ugv2");
  EXPECT_EQ(peer.rest_time(), motion->end_time());
  for (double t = 9.0; t < motion->end_time() + 2.0; t += 0.1) {
    const MovingObstacle::Disc disc = peer.at(t);
    EXPECT_EQ(disc.centre, motion->at(t).pose.position);
    EXPECT_EQ(disc.velocity, motion->at(t).velocity);
    EXPECT_EQ(disc.radius_m, 0.3);
    EXPECT_EQ(disc.radius_rate, 0.0);
  }
}

TEST(PeerObstacle, HoldsAPeerThatIsEarlyOrLate) {
  constexpr double kMistimed_s = 0.3;
  const auto motion = std::make_shared<const Motion>(10.0, std::vector<Phase>{random_drive(1, 6)});
  const PeerObstacle peer("ugv2", motion, 0.3, test::kRoverBraking, kMistimed_s);
  for (double t = 9.0; t < motion->end_time() + 1.0; t += 0.01) {
    const auto disc = peer.at(t);
    for (const double early_s : {-kMistimed_s, -0.1, 0.1, kMistimed_s}) {
      EXPECT_LE((motion->position(t + early_s) - disc.centre).norm() + 0.3, disc.radius_m);
    }
  }
}

/// As proofs in continuous time take it: centre and radius change uniformly between two looks, and
/// what that leaves out is the chord error.
TEST(PeerObstacle, SticksOutByNoMoreThanItSays) {
  for (const double mistimed_s : {0.0, 0.3}) {
    for (int seed = 0; seed < 10; ++seed) {
      const auto motion =
          std::make_shared<const Motion>(10.0, std::vector<Phase>{random_drive(seed, 4)});
      const PeerObstacle peer("ugv2", motion, 0.3, test::kRoverBraking, mistimed_s);
      for (const double span_s : {0.05, 0.2, 1.0}) {
        for (double from_s = 9.0; from_s < motion->end_time() + 0.5; from_s += 0.07) {
          const auto first = peer.at(from_s);
          const auto last = peer.at(from_s + span_s);
          const double error_m = peer.chord_error_m(from_s, from_s + span_s);
          for (double share = 0.1; share < 1.0; share += 0.2) {
            const auto disc = peer.at(from_s + share * span_s);
            const Vector2 centre = (1.0 - share) * first.centre + share * last.centre;
            const double radius_m = (1.0 - share) * first.radius_m + share * last.radius_m;
            EXPECT_LE((disc.centre - centre).norm() + disc.radius_m, radius_m + error_m + 1e-9);
          }
        }
      }
    }
  }
}

TEST(PeerObstacle, ClosingSpeedIsABoundAndNotALooseOne) {
  for (int seed = 0; seed < 20; ++seed) {
    const auto motion =
        std::make_shared<const Motion>(0.0, std::vector<Phase>{random_drive(seed, 9)});
    const PeerObstacle peer("peer", motion, 0.3, test::kRoverBraking);
    const double fastest = sampled_peaks(*motion, 0.0).speed;
    EXPECT_GE(peer.max_closing_speed(0.0), fastest);
    EXPECT_LE(peer.max_closing_speed(0.0), 1.5 * fastest);
    EXPECT_EQ(peer.max_closing_speed(motion->end_time()), 0.0);
  }
}

TEST(PredictedDisc, GrowsAsItIsPredicted) {
  const PredictedDisc disc("person", 5.0, {1.0, 2.0}, {0.6, -0.8}, 0.25, 0.1);
  EXPECT_LT((disc.at(7.0).centre - Vector2(2.2, 0.4)).norm(), 1e-12);
  EXPECT_NEAR(disc.at(7.0).radius_m, 0.45, 1e-12);
  EXPECT_NEAR(disc.at(4.0).radius_m, 0.25, 1e-12);  // no growth backward
  EXPECT_NEAR(disc.max_closing_speed(5.0), 1.1, 1e-12);
  EXPECT_TRUE(std::isinf(disc.rest_time()));
}

TEST(MovingObstacle, RefusesWhatIsNone) {
  const auto motion = std::make_shared<const Motion>(0.0, std::vector<Phase>{random_drive(1, 2)});
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(PeerObstacle("a", nullptr, 0.3, test::kRoverBraking), std::invalid_argument);
  EXPECT_THROW(PeerObstacle("a", std::make_shared<const Motion>(), 0.3, test::kRoverBraking),
               std::invalid_argument);
  EXPECT_THROW(PeerObstacle("a", motion, -0.1, test::kRoverBraking), std::invalid_argument);
  EXPECT_THROW(PeerObstacle("a", motion, nan, test::kRoverBraking), std::invalid_argument);
  EXPECT_THROW(PeerObstacle("a", motion, 0.3, test::kRoverBraking, nan), std::invalid_argument);
  EXPECT_THROW(PredictedDisc("a", nan, {0, 0}, {0, 0}, 0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(PredictedDisc("a", 0.0, {nan, 0}, {0, 0}, 0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(PredictedDisc("a", 0.0, {0, 0}, {infinity, 0}, 0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(PredictedDisc("a", 0.0, {0, 0}, {0, 0}, -0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(PredictedDisc("a", 0.0, {0, 0}, {0, 0}, 0.1, -0.1), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
