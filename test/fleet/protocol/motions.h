#pragma once

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "trajectory/minco.h"
#include "trajectory/motion.h"

namespace mocha::test {

/// From rest to rest through the points, each piece at about `speed` [m/s], but in no less than 0.5
/// s.
inline Motion drive(double start_s, const std::vector<Vector2>& points, double speed) {
  const int pieces = static_cast<int>(points.size()) - 1;
  PlanarMinco minco;
  minco.resize(pieces);
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  start.col(0) = points.front();
  end.col(0) = points.back();
  PlanarMinco::Knots knots(2, pieces - 1);
  Eigen::VectorXd durations(pieces);
  for (int i = 0; i < pieces; ++i) {
    if (i > 0) knots.col(i - 1) = points[i];
    durations[i] = std::max(0.5, (points[i + 1] - points[i]).norm() / speed);
  }
  minco.solve(start, end, knots, durations);
  return Motion(start_s, {DrivePhase{1, minco.curve()}});
}

inline Motion stand(double start_s, const Vector2& place) {
  return Motion(start_s, {StandPhase{{place, 0.0}, 0.0}});
}

inline std::shared_ptr<const Motion> shared(Motion motion) {
  return std::make_shared<const Motion>(std::move(motion));
}

/// A drive through `count` random points of a square of the given half width.
inline Motion random_drive(std::mt19937& random, double start_s, int count, double half_width) {
  std::uniform_real_distribution<double> coordinate(-half_width, half_width);
  std::uniform_real_distribution<double> speed(0.3, 2.0);
  std::vector<Vector2> points;
  while (static_cast<int>(points.size()) < count) {
    const Vector2 next(coordinate(random), coordinate(random));
    if (points.empty() || (next - points.back()).norm() > 0.3) points.push_back(next);
  }
  return drive(start_s, points, speed(random));
}

}  // namespace mocha::test
