#include "perception/tracking/disc_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

using Eigen::Matrix2d;

constexpr int kIterations = 5;
constexpr double kMostHits = 6.0;       // that count as independent: their errors are alike
constexpr double kLeastNoise_m = 0.01;  // of a centre: of times and poses
constexpr double kGuess_m = 0.3;        // how far off the first guess may be, standard deviation

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

}  // namespace mocha
