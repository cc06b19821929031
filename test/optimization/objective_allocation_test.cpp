#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <memory>

#include "camouflage/adaptive_map.h"
#include "camouflage/camouflage_map.h"
#include "optimization/dynamics_penalty.h"
#include "optimization/moving_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "optimization/trajectory_objective.h"
#include "optimization/turning_penalty.h"
#include "world/distances/distance_field.h"

// Eigen takes its memory from malloc and everything else from operator new, which takes it from
// malloc: counting there sees all. The address sanitizer needs malloc for itself.
#ifndef __SANITIZE_ADDRESS__

namespace {
long allocations = 0;
}

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}

namespace mocha {
namespace {

enum class Knots { kWaypoints, kCamouflage, kAdaptive };

/// On rays from below; every other knot moves freely.
std::vector<RayKnot<2>> mixed_knots(const Eigen::Matrix2Xd& prey) {
  std::vector<RayKnot<2>> knots;
  for (int k = 0; k < prey.cols(); ++k) {
    knots.push_back(RayKnot<2>::on_ray(prey.col(k), {0.0, 3.0}));
    knots.back().freedom = 1 + k % 2;
  }
  return knots;
}

/// Everything that planning puts into an objective.
TrajectoryObjective<2, 3> full_objective(const DistanceField& field, Knots knots) {
  constexpr int kKnots = 12;
  Eigen::Matrix2Xd prey = Eigen::Matrix2Xd::Zero(2, kKnots);
  for (int k = 0; k < kKnots; ++k) prey(0, k) = 0.5 * (k + 1);
  Eigen::Matrix2Xd references = prey;
  references.row(1).setConstant(-3.0);
  TrajectoryObjective<2, 3>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.start(1, 1) = 0.3;
  options.end(0, 0) = 0.5 * (kKnots + 1);
  if (knots == Knots::kAdaptive) {
    options.knot_map = std::make_shared<AdaptiveMap<2>>(mixed_knots(prey), 1.0);
  } else if (knots == Knots::kCamouflage) {
    options.knot_map = std::make_shared<CamouflageMap<2>>(prey, references, 1.0);
  } else {
    options.knot_map = std::make_shared<WaypointMap<2>>(prey);
  }
  options.effort_weight = 0.01;
  options.metres_per_eta = 1.0;
  options.duration_cost = DurationCost::total(1.0);
  options.kappa = 12;
  const auto peer =
      std::make_shared<PredictedDisc>("peer", 0.0, Vector2(2.0, 0.3), Vector2(0.1, 0.0), 0.3, 0.05);
  options.penalties.push_back(std::make_unique<ObstaclePenalty<2>>(
      100.0, field, std::vector<ObstaclePenalty<2>::Cover>{{0.1, 0.5}, {-0.1, 0.5}}, 0.05));
  options.penalties.push_back(std::make_unique<DynamicsPenalty<2>>(100.0, 0.5, 0.5));
  options.penalties.push_back(std::make_unique<TurningPenalty>(100.0, 0.1, 0.05));
  options.penalties.push_back(std::make_unique<MovingPenalty>(
      100.0, 0.0, std::vector<MovingThing>{{peer, 0.6, std::numeric_limits<double>::infinity()}}));
  return TrajectoryObjective<2, 3>(std::move(options));
}

TEST(TrajectoryObjective, EvaluationsAndStepsAllocateNothing) {
  OccupancyGrid grid;
  grid.width = 200;
  grid.height = 100;
  grid.origin = {-2.0, -2.5};
  grid.cells.assign(20000, OccupancyGrid::kFree);
  fill_disc(grid, {3.0, 0.2}, 0.3, OccupancyGrid::kOccupied);
  const DistanceField field(grid, DistanceField::Solid::kOccupied);
  for (const Knots knots : {Knots::kWaypoints, Knots::kCamouflage, Knots::kAdaptive}) {
    auto objective = full_objective(field, knots);

    const Eigen::VectorXd x = objective.initial(Eigen::VectorXd::Constant(objective.pieces(), 0.7));
    Eigen::VectorXd gradient(objective.variables());
    const long before = allocations;
    double cost = 0.0;
    for (int i = 0; i < 10; ++i) {
      cost = objective.evaluate(x, gradient);
      EXPECT_TRUE(objective.prepare_steps(1.0));
      objective.to_step(gradient);
    }
    EXPECT_EQ(allocations - before, 0) << "knots " << static_cast<int>(knots);
    for (const auto& term : objective.terms()) {
      EXPECT_GT(term.second, 0.0) << term.first << " took no part";
    }
    EXPECT_TRUE(std::isfinite(cost));
    const long counting = allocations;
    delete new int(3);
    Eigen::VectorXd::Zero(100).eval();
    EXPECT_GE(allocations - counting, 1) << "the counter does not count";
  }
}

}  // namespace
}  // namespace mocha

#endif
