#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "benchmarks/benchmark_world.h"
#include "camouflage/camouflage_map.h"
#include "camouflage/reference_point.h"
#include "optimization/dynamics_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "optimization/trajectory_objective.h"
#include "planning/candidates/speed_profile.h"
#include "trajectory/polyline.h"

namespace mocha {

/// The optimisation of Table I, in the paper's units: its weights belong to penalties with
/// dimension.
struct TableOptions {
  double max_speed = 12.0;        ///< [m/s]
  double max_acceleration = 5.0;  ///< [m/s^2]
  int kappa = 20;
  double w_e = 1.0;
  double w_t = 1.0;
  double w_o = 100.0;
  double w_d = 100.0;
  double d_s_m = 1.2;     ///< safety distance of the penalty
  double radius_m = 0.5;  ///< of the ball that the certificate puts around the robot
  double travel_m = 8.0;  ///< of a knot along its ray
};

/// How a front-end path would be driven; corners are rounded over `window_m`.
template <int D>
SpeedProfile<D> table_profile(const std::vector<Eigen::Matrix<double, D, 1>>& path, double window_m,
                              const TableOptions& options) {
  MotionLimits limits;
  limits.max_speed = options.max_speed;
  limits.max_acceleration = options.max_acceleration;
  limits.max_yaw_rate = std::numeric_limits<double>::infinity();
  return SpeedProfile<D>(path, 0.0, limits, window_m, {});
}

/// Knots at uniform time, `spacing_m` apart on average.
template <int D>
InitialKnots<D> knots_on(const std::vector<Eigen::Matrix<double, D, 1>>& path, double spacing_m,
                         const TableOptions& options) {
  return table_profile<D>(path, spacing_m, options)
      .knots(static_cast<int>(std::round(length_of<D>(path) / spacing_m)));
}

/// Where the rays of camouflage start, one reference point a knot.
template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> table_references(const BenchmarkWorld<D>& world,
                                                          const InitialKnots<D>& knots,
                                                          const TableOptions& options) {
  const auto references = choose_references<D>(knots.path, *world.field, options.travel_m);
  if (!references) throw std::runtime_error("table1: no reference points");
  return references.references;
}

/// J of paper (14) from rest to rest; with camouflage, or with waypoints as variables.
template <int D>
typename TrajectoryObjective<D, 3>::Options table_objective_options(const BenchmarkWorld<D>& world,
                                                                    const InitialKnots<D>& knots,
                                                                    bool camouflage,
                                                                    const TableOptions& options) {
  const auto to_sixth = [](double limit) { return std::pow(limit, 6); };
  typename TrajectoryObjective<D, 3>::Options objective_options;
  objective_options.start.setZero();
  objective_options.end.setZero();
  objective_options.start.col(0) = world.path.front();
  objective_options.end.col(0) = world.path.back();
  const auto prey = knots.path.middleCols(1, knots.path.cols() - 2);
  if (camouflage) {
    objective_options.knot_map = std::make_shared<CamouflageMap<D>>(
        prey, table_references<D>(world, knots, options), options.travel_m);
  } else {
    objective_options.knot_map = std::make_shared<WaypointMap<D>>(prey);
  }
  objective_options.effort_weight = options.w_e;
  objective_options.duration_cost = DurationCost::total(options.w_t);
  objective_options.kappa = options.kappa;
  objective_options.metres_per_eta = knots.metres_per_eta();
  objective_options.penalties.push_back(std::make_unique<ObstaclePenalty<D>>(
      options.w_o * to_sixth(options.d_s_m), *world.field,
      std::vector<typename ObstaclePenalty<D>::Cover>{{0.0, options.d_s_m}}, 1.0));
  objective_options.penalties.push_back(std::make_unique<DynamicsPenalty<D>>(
      options.w_d * to_sixth(options.max_speed), options.max_speed,
      options.w_d * to_sixth(options.max_acceleration), options.max_acceleration));
  return objective_options;
}

}  // namespace mocha
