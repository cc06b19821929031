#include "perception/tracking/disc_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace mocha {
namespace {

using Eigen::Matrix2d;

constexpr int kIterations = 5;
constexpr double kMostHits = 6.0;       // that count as independent: their errors are alike
constexpr double kLeastNoise_m = 0.01;  // of a centre: of times and poses
constexpr double kGuess_m = 0.3;        // how far off the first guess may be, standard deviation
constexpr double kLegRadius_m = 0.05;
constexpr double kOneLeg_m = 0.15;  // from a leg to between them, standard deviation along an axis
constexpr double kTwoLegs_m = 0.1;  // from between the legs to where the person is

/// A sum of squares, linear around a centre.
struct NormalEquations {
  Matrix2d information = Matrix2d::Zero();
  Vector2 gradient = Vector2::Zero();
  double squares = 0.0;
  double weights = 0.0;

  void add(const Vector2& jacobian, double off_m, double weight) {
    information += weight * jacobian * jacobian.transpose();
    gradient += weight * jacobian * off_m;
    squares += weight * off_m * off_m;
    weights += weight;
  }
};

/// Of the tangent at one edge of the sector: how far it is outside of the disc.
void add_edge(double edge_rad, double side, const Vector2& off, double radius_m,
              NormalEquations& sums) {
  const Vector2 outward = side * Vector2(-std::sin(edge_rad), std::cos(edge_rad));
  sums.add(outward, off.dot(outward) + radius_m, 1.0);
}

NormalEquations equations(const Detection& detection, const Vector2& centre, double radius_m) {
  NormalEquations sums;
  const double weight = std::min(1.0, kMostHits / std::max<double>(1.0, detection.hits.size()));
  for (const Vector2& hit : detection.hits) {
    const Vector2 to = centre - hit;
    const double distance_m = to.norm();
    if (distance_m < 1e-6) continue;
    sums.add(to / distance_m, distance_m - radius_m, weight);
  }
  const Vector2 off = centre - detection.sensor;
  if (!detection.left_hidden) add_edge(detection.left_rad, 1.0, off, radius_m, sums);
  if (!detection.right_hidden) add_edge(detection.right_rad, -1.0, off, radius_m, sums);
  return sums;
}

Vector2 mean(std::vector<Vector2>::const_iterator begin, std::vector<Vector2>::const_iterator end) {
  return std::accumulate(begin, end, Vector2(Vector2::Zero())) / static_cast<double>(end - begin);
}

/// Between the two groups of hits with the widest gap between them.
Vector2 between_legs(const std::vector<Vector2>& hits) {
  auto other = hits.begin() + 1;
  for (auto hit = other; hit != hits.end(); ++hit) {
    if ((*hit - *(hit - 1)).norm() > (*other - *(other - 1)).norm()) other = hit;
  }
  return 0.5 * (mean(hits.begin(), other) + mean(other, hits.end()));
}

}  // namespace

DiscFit fit_disc(const Detection& detection, double radius_m, double hit_noise_m) {
  const Vector2 guess = detection.centre(radius_m);
  Vector2 centre = guess;
  const double base = hit_noise_m * hit_noise_m;
  NormalEquations sums = equations(detection, centre, radius_m);
  double variance = base;
  Matrix2d information;
  for (int i = 0; i < kIterations; ++i) {
    variance = base + sums.squares / std::max(1.0, sums.weights);
    information = sums.information / variance + Matrix2d::Identity() / (kGuess_m * kGuess_m);
    const Vector2 gradient = sums.gradient / variance + (centre - guess) / (kGuess_m * kGuess_m);
    centre -= information.inverse() * gradient;
    sums = equations(detection, centre, radius_m);
  }
  variance = base + sums.squares / std::max(1.0, sums.weights);
  information = sums.information / variance + Matrix2d::Identity() / (kGuess_m * kGuess_m);
  return {centre, information.inverse() + kLeastNoise_m * kLeastNoise_m * Matrix2d::Identity()};
}

DiscFit fit_legs(const Detection& detection) {
  if (detection.legs < 1 || detection.legs > 2 || detection.hits.size() < 2)
    throw std::invalid_argument("fit_legs: a detection without legs");
  const std::vector<Vector2>& hits = detection.hits;
  const bool two = detection.legs == 2;
  const Vector2 front = two ? between_legs(hits) : mean(hits.begin(), hits.end());
  const double sigma_m = two ? kTwoLegs_m : kOneLeg_m;
  return {front + kLegRadius_m * (front - detection.sensor).normalized(),
          sigma_m * sigma_m * Matrix2d::Identity()};
}

}  // namespace mocha
