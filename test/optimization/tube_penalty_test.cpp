#include "optimization/tube_penalty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "optimization/one_sample.h"

namespace mocha {
namespace {

using Eigen::Vector3d;

constexpr double kWeight = 10.0;

/// A ball that grows while it flies, and turns after two seconds.
std::vector<Tube<3>> bird() {
  const TubePiece<3> first{1.0, 3.0, {0.0, 0.0, 1.0}, {1.0, 0.5, -0.2}, 0.8, 0.1};
  TubePiece<3> second{3.0, 5.0, first.centre_at(3.0), {0.0, -1.0, 0.4}, first.radius_at(3.0), 0.0};
  return {{first, second}};
}

double by_hand(const Vector3d& place, double t) {
  const Tube<3> tube = bird().front();
  for (const TubePiece<3>& piece : tube) {
    if (t < piece.start_s || t >= piece.end_s) continue;
    const double ratio =
        (place - piece.centre_at(t)).squaredNorm() / (piece.radius_at(t) * piece.radius_at(t));
    return kWeight * std::pow(std::max(0.0, 1.0 - ratio), 3);
  }
  return 0.0;
}

class TubePenaltyTest : public testing::Test {
 protected:
  Sample<3> random_sample() {
    std::uniform_real_distribution<double> place(-1.0, 3.0);
    std::uniform_real_distribution<double> time(0.0, 6.0);
    Sample<3> sample;
    sample.position = {place(random_), place(random_), place(random_)};
    sample.time_s = time(random_);
    return sample;
  }

  std::mt19937 random_{1};
  const TubePenalty<3> penalty_{kWeight, bird()};
};

TEST_F(TubePenaltyTest, HasTheValuesOfHandWheneverAndWherever) {
  int costs = 0;
  for (int i = 0; i < 5000; ++i) {
    const Sample<3> sample = random_sample();
    const double value = value_of(penalty_, sample);
    EXPECT_NEAR(value, by_hand(sample.position, sample.time_s), 1e-9);
    costs += value > 0.0;
  }
  EXPECT_GT(costs, 100);
}

TEST_F(TubePenaltyTest, GradientMatchesDifferences) {
  constexpr double kStep = 1e-6;
  int costs = 0;
  for (int i = 0; i < 5000; ++i) {
    const Sample<3> sample = random_sample();
    // Not where a piece ends.
    if (std::abs(sample.time_s - std::round(sample.time_s)) < 0.01) continue;
    PenaltyRows<3> rows = rows_at(penalty_, sample);
    costs += rows.value[0] > 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      Sample<3> more = sample;
      Sample<3> less = sample;
      more.position[axis] += kStep;
      less.position[axis] -= kStep;
      EXPECT_NEAR(rows.by_position()(0, axis),
                  (value_of(penalty_, more) - value_of(penalty_, less)) / (2.0 * kStep), 1e-5);
    }
    Sample<3> later = sample;
    Sample<3> earlier = sample;
    later.time_s += kStep;
    earlier.time_s -= kStep;
    EXPECT_NEAR(rows.by_time[0],
                (value_of(penalty_, later) - value_of(penalty_, earlier)) / (2.0 * kStep), 1e-5);
  }
  EXPECT_GT(costs, 100);
}

TEST_F(TubePenaltyTest, OverlooksNoPieceThatItMayMeet) {
  for (int i = 0; i < 2000; ++i) {
    const Sample<3> sample = random_sample();
    if (value_of(penalty_, sample) == 0.0) continue;
    PieceBounds<3> bounds = piece_of(sample).bounds;
    bounds.start_s -= 0.3;
    bounds.duration_s = 0.6;
    EXPECT_EQ(penalty_.wanted(bounds), kPosition | kTime);
  }
  EXPECT_EQ(penalty_.wanted({{Vector3d(9, 9, 9), Vector3d(9, 9, 9)}, 0.0, 0.0, 0.0, 0.0, 9.0}),
            kNone);
  EXPECT_EQ(penalty_.wanted({{Vector3d(0, 0, 1), Vector3d(0, 0, 1)}, 0.0, 0.0, 0.0, 5.5, 1.0}),
            kNone);
}

}  // namespace
}  // namespace mocha
