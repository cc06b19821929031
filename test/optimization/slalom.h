#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "optimization/dynamics_penalty.h"
#include "optimization/knot_choice.h"
#include "optimization/obstacle_penalty.h"
#include "safety/circle_field.h"

namespace mocha {

/// From rest to rest, 24 m straight ahead: posts to be passed on the first half, in turn on the
/// left and on the right, and nothing on the second.
class Slalom {
 public:
  static constexpr double kLength_m = 24.0;
  static constexpr double kDuration_s = 20.0;
  static constexpr int kIntervals = 32;
  static constexpr int kCoarsest = 8;

  Slalom() : posts_(posts()) {}

  TrajectoryObjective<2, 3> objective(double effort_weight = 1.0) const {
    TrajectoryObjective<2, 3>::Options options;
    options.start.setZero();
    options.end.setZero();
    options.end(0, 0) = kLength_m;
    options.knot_map = std::make_shared<WaypointMap<2>>(path().middleCols(1, kIntervals - 1));
    options.effort_weight = effort_weight;
    options.duration_cost = DurationCost::total(1.0);
    options.kappa = 16;
    options.metres_per_eta = 1.0;
    options.penalties.push_back(std::make_unique<DynamicsPenalty<2>>(1e3, 2.0, 1.5));
    options.penalties.push_back(std::make_unique<ObstaclePenalty<2>>(
        200.0, posts_, std::vector<ObstaclePenalty<2>::Cover>{{0.0, 0.6}}, 0.05));
    return TrajectoryObjective<2, 3>(std::move(options));
  }

  static Eigen::Matrix2Xd path() {
    Eigen::Matrix2Xd path = Eigen::Matrix2Xd::Zero(2, kIntervals + 1);
    for (int i = 0; i <= kIntervals; ++i) {
      const double share = static_cast<double>(i) / kIntervals;
      path(0, i) = kLength_m * share * share * (3.0 - 2.0 * share);
    }
    return path;
  }

  static KnotCandidates<2> candidates() {
    const auto below = [](const Eigen::Matrix2Xd& path) {
      Eigen::Matrix2Xd references = path.middleCols(1, path.cols() - 2);
      references.row(1).array() -= 10.0;
      return std::optional<Eigen::Matrix2Xd>(references);
    };
    return {path(), kDuration_s, kCoarsest, 0.3, below};
  }

 private:
  static CircleField posts() {
    std::vector<CircleField::Circle> circles;
    for (int k = 0; k < 4; ++k) circles.push_back({{2.0 + 3.0 * k, k % 2 == 0 ? -0.5 : 0.5}, 0.4});
    return CircleField(std::move(circles));
  }

  CircleField posts_;
};

}  // namespace mocha
