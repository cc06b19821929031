#include "optimization/adaptive_optimizer.h"

#include <gtest/gtest.h>

#include <memory>

#include "optimization/slalom.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

constexpr double kTravelled = 5.0;  // [m]
const OptimizerOptions kThorough{20000, 1e-6, [] { return false; }};

TEST(AdaptiveOptimizer, ReachesTheCostOfManyWaypointsWithFewerPieces) {
  const Slalom slalom;
  auto waypoints = slalom.objective();
  const auto many = optimize<2, 3>(
      waypoints, waypoints.initial(Eigen::VectorXd::Constant(Slalom::kIntervals, 0.6)), kThorough);
  ASSERT_EQ(many.stop, StopReason::kConverged);
  auto objective = slalom.objective();
  const auto few = optimize_adaptively<2>(objective, Slalom::candidates(), kTravelled, kThorough);
  EXPECT_EQ(few.found.stop, StopReason::kConverged);
  EXPECT_LT(few.found.cost, 1.002 * many.cost);
  EXPECT_LT(few.found.curve.pieces(), 2 * Slalom::kIntervals / 3);
  EXPECT_LT(few.piece_evaluations, static_cast<long>(many.evaluations) * Slalom::kIntervals / 2);
}

TEST(AdaptiveOptimizer, PutsKnotsWhereThePostsAre) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const auto result =
      optimize_adaptively<2>(objective, Slalom::candidates(), kTravelled, kThorough);
  int among_posts = 0;
  for (const RayKnot<2>& knot : result.chain.knots) among_posts += knot.position().x() < 12.5;
  EXPECT_GT(2 * among_posts, static_cast<int>(result.chain.knots.size()));
  EXPECT_GT(among_posts, 2) << "no more than at first";
}

TEST(AdaptiveOptimizer, TheChainIsThatOfTheCurve) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const auto result =
      optimize_adaptively<2>(objective, Slalom::candidates(), kTravelled, kThorough);
  const auto& curve = result.found.curve;
  ASSERT_EQ(result.chain.pieces(), curve.pieces());
  int variables = curve.pieces();
  for (int k = 0; k + 1 < curve.pieces(); ++k) {
    const RayKnot<2>& knot = result.chain.knots[k];
    EXPECT_LT((knot.position() - curve.derivative({k + 1, 0.0}, 0)).norm(), 1e-9);
    EXPECT_DOUBLE_EQ(result.chain.durations_s[k], curve.piece_duration(k));
    variables += knot.freedom;
  }
  EXPECT_EQ(result.found.variables.size(), variables);
  EXPECT_GE(result.piece_evaluations, 4L * result.found.evaluations);
}

/// Rays along the path cannot lead round anything; variables across them can.
TEST(AdaptiveOptimizer, KnotsOnBadRaysArePromoted) {
  const Slalom slalom;
  KnotCandidates<2> candidates = Slalom::candidates();
  candidates.references = [](const Eigen::Matrix2Xd& path) {
    Eigen::Matrix2Xd references = path.middleCols(1, path.cols() - 2);
    references.row(0).array() -= 10.0;
    return std::optional<Eigen::Matrix2Xd>(references);
  };
  auto stuck = slalom.objective();
  const KnotChain<2> chain = choose_knots(stuck, candidates);
  stuck.set_knot_map(std::make_shared<AdaptiveMap<2>>(chain.knots, kTravelled));
  const auto on_rays = optimize<2, 3>(stuck, stuck.initial(chain.durations_s), kThorough);
  auto objective = slalom.objective();
  const auto result = optimize_adaptively<2>(objective, candidates, kTravelled, kThorough);
  int promoted = 0;
  for (const RayKnot<2>& knot : result.chain.knots) promoted += knot.freedom > 1;
  EXPECT_GT(promoted, 0);
  EXPECT_LT(result.found.cost, 0.5 * on_rays.cost);
}

TEST(AdaptiveOptimizer, InSpaceItReachesTheCostOfWaypointsToo) {
  constexpr int kSteps = 16;
  const PrimitiveField<3> trunks({{{7.0, 0.1}, 0.5}, {{14.0, -0.2}, 0.5}}, 2.0);
  Eigen::Matrix3Xd path = Eigen::Matrix3Xd::Zero(3, kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    path(0, i) = 20.0 * share * share * (3.0 - 2.0 * share);
  }
  TrajectoryObjective<3, 3>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.end(0, 0) = 20.0;
  options.knot_map = std::make_shared<WaypointMap<3>>(path.middleCols(1, kSteps - 1));
  options.effort_weight = 1.0;
  options.duration_cost = DurationCost::total(1.0);
  options.kappa = 16;
  options.metres_per_eta = 1.0;
  options.penalties.push_back(std::make_unique<ObstaclePenalty<3>>(
      200.0, trunks, std::vector<ObstaclePenalty<3>::Cover>{{0.0, 0.8}}, 0.05));
  TrajectoryObjective<3, 3> objective(std::move(options));
  const auto many = optimize<3, 3>(
      objective, objective.initial(Eigen::VectorXd::Constant(kSteps, 1.0)), kThorough);
  const auto beside = [](const Eigen::Matrix3Xd& points) {
    Eigen::Matrix3Xd references = points.middleCols(1, points.cols() - 2);
    references.row(1).array() += 10.0;
    return std::optional<Eigen::Matrix3Xd>(references);
  };
  const auto few =
      optimize_adaptively<3>(objective, {path, 16.0, 4, 0.5, beside}, kTravelled, kThorough);
  EXPECT_LT(few.found.cost, 1.002 * many.cost);
  EXPECT_LT(few.found.curve.pieces(), kSteps);
}

TEST(AdaptiveOptimizer, KeepsToTheBudgetAndStopsWhenAsked) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const auto whole = optimize_adaptively<2>(objective, Slalom::candidates(), kTravelled, kThorough);
  for (const int budget : {30, whole.found.evaluations / 2, whole.found.evaluations - 5}) {
    const auto some = optimize_adaptively<2>(objective, Slalom::candidates(), kTravelled,
                                             {budget, 1e-6, [] { return false; }});
    EXPECT_EQ(some.found.evaluations, budget);
    EXPECT_EQ(some.found.stop, StopReason::kBudget);
    EXPECT_GT(some.found.curve.pieces(), 0);
  }
  int asked = 0;
  const auto stopped = optimize_adaptively<2>(objective, Slalom::candidates(), kTravelled,
                                              {20000, 1e-6, [&] { return ++asked > 20; }});
  EXPECT_EQ(stopped.found.stop, StopReason::kStopped);
  EXPECT_LE(stopped.found.evaluations, 20);
}

}  // namespace
}  // namespace mocha
