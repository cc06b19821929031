#include "perception/tracking/disc_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace mocha {
namespace {

constexpr double kNoise_m = 0.025;
constexpr double kRadius_m = 0.3;
constexpr double kSpacing_rad = 0.01;
const Vector2 kCentre(3.0, 1.0);

/// What a sensor at the origin sees of the disc between two bearings, counted from its middle in
/// shares of its half width.
Detection seen(double from, double to, double noise_m = 0.0, int seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double distance_m = kCentre.norm();
  const double bearing_rad = std::atan2(kCentre.y(), kCentre.x());
  const double half_rad = std::asin(kRadius_m / distance_m);
  Detection detection{0.0,
                      {0.0, 0.0},
                      bearing_rad + from * half_rad,
                      bearing_rad + to * half_rad,
                      from > -1.0,
                      to < 1.0,
                      INFINITY,
                      kRadius_m,
                      {}};
  for (double angle = detection.right_rad + 0.001; angle < detection.left_rad;
       angle += kSpacing_rad) {
    const Vector2 ray(std::cos(angle), std::sin(angle));
    const double along_m = kCentre.dot(ray);
    const double off2 = kCentre.squaredNorm() - along_m * along_m;
    const double range_m =
        along_m - std::sqrt(std::max(0.0, kRadius_m * kRadius_m - off2)) + noise_m * normal(random);
    detection.hits.push_back(range_m * ray);
    detection.nearest_m = std::min(detection.nearest_m, range_m);
  }
  return detection;
}

TEST(DiscFit, FindsTheCentreOfWhatIsSeenInPart) {
  for (const auto& [from, to] :
       {std::pair{-1.0, 1.0}, std::pair{-0.2, 1.0}, std::pair{-1.0, -0.1}, std::pair{-0.6, 0.6}}) {
    const DiscFit fit = fit_disc(seen(from, to), kRadius_m, kNoise_m);
    EXPECT_LT((fit.centre - kCentre).norm(), 0.01) << from << " to " << to;
  }
}

TEST(DiscFit, AMiddleTellsInItsDirectionAndLessAcross) {
  const Vector2 along = kCentre.normalized();
  const Vector2 across(-along.y(), along.x());
  const DiscFit middle = fit_disc(seen(-0.4, 0.4), kRadius_m, kNoise_m);
  EXPECT_GT(across.dot(middle.covariance * across), 4.0 * along.dot(middle.covariance * along));
  const DiscFit whole = fit_disc(seen(-1.0, 1.0), kRadius_m, kNoise_m);
  EXPECT_LT(across.dot(whole.covariance * across), 0.5 * across.dot(middle.covariance * across));
}

TEST(DiscFit, KnowsHowFarItIsOff) {
  for (const auto& [from, to] :
       {std::pair{-1.0, 1.0}, std::pair{-0.2, 1.0}, std::pair{-0.6, 0.6}}) {
    constexpr int kRuns = 200;
    double sum = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      const DiscFit fit = fit_disc(seen(from, to, kNoise_m, run), kRadius_m, kNoise_m);
      const Vector2 error = fit.centre - kCentre;
      sum += error.dot(fit.covariance.ldlt().solve(error));
    }
    EXPECT_LT(sum / kRuns, 2.5) << "surer than it may be, " << from << " to " << to;
    EXPECT_GT(sum / kRuns, 0.1);
  }
}

TEST(DiscFit, WhatIsNoDiscTellsLess) {
  Detection legs = seen(-1.0, 1.0);
  const DiscFit disc = fit_disc(legs, kRadius_m, kNoise_m);
  for (std::size_t i = 0; i < legs.hits.size(); ++i)
    legs.hits[i] += (i % 2 == 0 ? 0.1 : -0.1) * legs.hits[i].normalized();
  const DiscFit scattered = fit_disc(legs, kRadius_m, kNoise_m);
  EXPECT_GT(scattered.covariance.trace(), 2.0 * disc.covariance.trace());
}

TEST(FitLegs, APersonIsBetweenTheLegs) {
  Detection detection{};
  detection.sensor = {0.0, 0.0};
  for (const double y : {-0.17, -0.15, -0.13, 0.11, 0.13, 0.15, 0.17, 0.19})
    detection.hits.push_back({3.0, y});
  detection.legs = 2;
  EXPECT_LT((fit_legs(detection).centre - Vector2(3.05, 0.0)).norm(), 1e-3);
  const double two = fit_legs(detection).covariance.trace();
  detection.legs = 1;
  EXPECT_GT(fit_legs(detection).covariance.trace(), two) << "of one leg less is known";
  detection.legs = 0;
  EXPECT_THROW(fit_legs(detection), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
