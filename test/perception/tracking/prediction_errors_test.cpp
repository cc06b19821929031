#include "perception/tracking/prediction_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace mocha {
namespace {

constexpr double kScan_s = 0.1;
constexpr int kScansAhead = 10;  // a second
constexpr double kAhead_s = kScan_s * kScansAhead;

/// People whose velocity changes at random, by a normally distributed step from scan to scan.
class Walkers {
 public:
  Walkers(int count, double restlessness, int seed)
      : restlessness_(restlessness), random_(seed), things_(count) {
    for (int i = 0; i < count; ++i) {
      things_[i] = {static_cast<std::uint32_t>(i + 1),
                    0.0,
                    {3.0 * i, 0.0},
                    {1.0, 0.0},
                    0.3,
                    Eigen::Vector4d(4e-4, 4e-4, 0.01, 0.01).asDiagonal(),
                    true,
                    false,
                    false,
                    true,
                    {3.0 * i, 0.0}};
    }
  }

  void change(double restlessness) { restlessness_ = restlessness; }

  const std::vector<TrackedObstacle>& step() {
    std::normal_distribution<double> normal;
    for (TrackedObstacle& thing : things_) {
      thing.time_s += kScan_s;
      thing.position += kScan_s * thing.velocity;
      thing.seen_at = thing.position;
      thing.velocity +=
          restlessness_ * std::sqrt(kScan_s) * Vector2(normal(random_), normal(random_));
    }
    return things_;
  }

 private:
  double restlessness_;
  std::mt19937 random_;
  std::vector<TrackedObstacle> things_;
};

/// Shares of the predictions that were kept to, at one second and until then.
struct Held {
  double at;
  double throughout;
};

Held held(PredictionErrors& errors, Walkers& walkers, int scans, double confidence) {
  struct Made {
    std::vector<TrackedObstacle> things;
    double deviations_at;
    double deviations_throughout;
  };
  std::vector<Made> made;
  std::vector<std::vector<TrackedObstacle>> seen;
  for (int i = 0; i < scans; ++i) {
    seen.push_back(walkers.step());
    errors.update(seen.back());
    const PredictionSpread spread = errors.spread();
    made.push_back({seen.back(), spread.deviations_at(kAhead_s, confidence),
                    spread.deviations_throughout(kAhead_s, confidence)});
  }
  int at = 0, throughout = 0, all = 0;
  for (std::size_t i = 0; i + kScansAhead < made.size(); ++i) {
    for (std::size_t k = 0; k < made[i].things.size(); ++k) {
      const TrackedObstacle& then = made[i].things[k];
      const auto deviation = PredictedDeviation::of(then.covariance);
      double farthest = 0.0, last = 0.0;
      for (int step = 1; step <= kScansAhead; ++step) {
        const double ahead_s = step * kScan_s;
        const Vector2 place = then.position + ahead_s * then.velocity;
        last = (seen[i + step][k].position - place).norm() / deviation.after(ahead_s);
        farthest = std::max(farthest, last);
      }
      ++all;
      at += last <= made[i].deviations_at;
      throughout += farthest <= made[i].deviations_throughout;
    }
  }
  return {at / static_cast<double>(all), throughout / static_cast<double>(all)};
}

TEST(PredictionErrors, DiscsHoldWhatTheySayHoweverPeopleWalk) {
  for (const double restlessness : {0.02, 0.2, 1.0}) {
    for (const double confidence : {0.5, 0.8, 0.9, 0.95}) {
      PredictionErrors errors;
      Walkers walkers(5, restlessness, 3);
      held(errors, walkers, 200, confidence);  // it learns
      const Held share = held(errors, walkers, 1500, confidence);
      EXPECT_NEAR(share.at, confidence, 0.03) << restlessness;
      EXPECT_NEAR(share.throughout, confidence, 0.03) << restlessness;
    }
  }
}

TEST(PredictionErrors, FollowsAChange) {
  PredictionErrors errors;
  Walkers walkers(5, 0.05, 3);
  held(errors, walkers, 600, 0.8);
  const double calm = errors.spread().deviations_at(kAhead_s, 0.8);
  walkers.change(0.8);
  held(errors, walkers, 200, 0.8);
  EXPECT_GT(errors.spread().deviations_at(kAhead_s, 0.8), 4.0 * calm);
  EXPECT_NEAR(held(errors, walkers, 1500, 0.8).at, 0.8, 0.03);
}

TEST(PredictionErrors, SaysMoreOfLongerTimesAndHigherConfidences) {
  PredictionErrors errors;
  Walkers walkers(4, 0.3, 5);
  held(errors, walkers, 300, 0.8);
  const PredictionSpread spread = errors.spread();
  EXPECT_NO_THROW(spread.check());
  for (Eigen::Index row = 0; row < spread.at.rows(); ++row) {
    for (Eigen::Index column = 0; column < spread.at.cols(); ++column)
      EXPECT_GE(spread.throughout(row, column), spread.at(row, column));
  }
}

TEST(PredictionErrors, AThingThatSwervesAndComesBackIsOffUntilThen) {
  PredictionErrors errors;
  std::vector<TrackedObstacle> things = Walkers(3, 0.0, 1).step();
  for (int i = 1; i < 600; ++i) {
    for (TrackedObstacle& thing : things) {
      thing.time_s += kScan_s;
      thing.position += kScan_s * thing.velocity;
      // Once in half a second, so that it is as far aside then as before.
      thing.seen_at = thing.position + Vector2(0.0, 0.3 * std::sin(4.0 * M_PI * thing.time_s));
    }
    errors.update(things);
  }
  const PredictionSpread spread = errors.spread();
  EXPECT_GT(spread.deviations_throughout(kAhead_s, 0.5), 2.0);
  EXPECT_GE(spread.deviations_throughout(kAhead_s, 0.5), 1.3 * spread.deviations_at(kAhead_s, 0.5));
}

TEST(PredictionErrors, WhatIsNotSeenTeachesNothing) {
  PredictionErrors errors;
  const PredictionSpread before = errors.spread();
  std::vector<TrackedObstacle> things = Walkers(3, 0.0, 1).step();
  for (int i = 0; i < 100; ++i) {
    for (TrackedObstacle& thing : things) {
      thing.time_s += kScan_s;
      thing.seen_at.x() += 1.0;  // far from where it was going
      thing.is_seen = i == 0;
    }
    errors.update(things);
  }
  EXPECT_EQ(errors.spread().at, before.at);
  // A thing that comes back long after the predicted time teaches nothing either.
  for (TrackedObstacle& thing : things) thing.is_seen = true;
  errors.update(things);
  EXPECT_EQ(errors.spread().at, before.at);
}

TEST(PredictionErrors, WhatHasAnotherNumberIsAnotherThing) {
  PredictionErrors errors;
  const PredictionSpread before = errors.spread();
  std::vector<TrackedObstacle> things = Walkers(3, 0.0, 1).step();
  for (int i = 0; i < 50; ++i) {
    for (TrackedObstacle& thing : things) {
      thing.time_s += kScan_s;
      thing.id += 10;
    }
    errors.update(things);
  }
  EXPECT_EQ(errors.spread().at, before.at);
}

}  // namespace
}  // namespace mocha
