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
#include "planning/speed_profile.h"

namespace mocha {

/// The optimisation of Table I, in the paper's units: its weights belong to penalties with
/// dimension.
struct TableRules {
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

template <int D>
double length_m(const std::vector<Eigen::Matrix<double, D, 1>>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// Knots at uniform time, `spacing_m` apart on average.
template <int D>
InitialKnots<D> knots_on(const std::vector<Eigen::Matrix<double, D, 1>>& path, double spacing_m,
                         const TableRules& rules) {
  MotionLimits limits;
  limits.max_speed = rules.max_speed;
  limits.max_acceleration = rules.max_acceleration;
  limits.max_yaw_rate = std::numeric_limits<double>::infinity();
  const SpeedProfile<D> profile(path, 0.0, limits, spacing_m);
  return profile.knots(static_cast<int>(std::round(length_m<D>(path) / spacing_m)));
}

/// Where the rays of camouflage start, one reference point a knot.
template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> table_references(const BenchmarkWorld<D>& world,
                                                          const InitialKnots<D>& knots,
                                                          const TableRules& rules) {
  ReferenceRules reference_rules;
  reference_rules.side_depth_m = rules.travel_m;
  const auto references = choose_references<D>(knots.path, world.field, reference_rules);
  if (!references) throw std::runtime_error("table1: no reference points");
  return *references;
}

/// J of (14) from rest to rest; with camouflage, or with waypoints as variables.
template <int D>
typename TrajectoryObjective<D, 3>::Setup table_setup(const BenchmarkWorld<D>& world,
                                                      const InitialKnots<D>& knots, bool camouflage,
                                                      const TableRules& rules) {
  const auto to_sixth = [](double limit) { return std::pow(limit, 6); };
  typename TrajectoryObjective<D, 3>::Setup setup;
  setup.start.setZero();
  setup.end.setZero();
  setup.start.col(0) = world.path.front();
  setup.end.col(0) = world.path.back();
  const auto prey = knots.path.middleCols(1, knots.path.cols() - 2);
  if (camouflage) {
    setup.knot_map = std::make_shared<CamouflageMap<D>>(
        prey, table_references<D>(world, knots, rules), rules.travel_m);
  } else {
    setup.knot_map = std::make_shared<WaypointMap<D>>(prey);
  }
  setup.effort_weight = rules.w_e;
  setup.duration_cost = DurationCost::total(rules.w_t);
  setup.kappa = rules.kappa;
  setup.metres_per_eta = knots.metres_per_eta();
  setup.penalties.push_back(std::make_unique<ObstaclePenalty<D>>(
      rules.w_o * to_sixth(rules.d_s_m), world.field,
      std::vector<typename ObstaclePenalty<D>::Cover>{{0.0, rules.d_s_m}}, 1.0));
  setup.penalties.push_back(std::make_unique<DynamicsPenalty<D>>(
      rules.w_d * to_sixth(rules.max_speed), rules.max_speed,
      rules.w_d * to_sixth(rules.max_acceleration), rules.max_acceleration));
  return setup;
}

}  // namespace mocha
