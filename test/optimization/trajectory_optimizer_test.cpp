#include "optimization/trajectory_optimizer.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "camouflage/camouflage_map.h"
#include "optimization/dynamics_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "safety/circle_field.h"

namespace mocha {
namespace {

constexpr double kMaxSpeed = 2.0;
constexpr double kMaxAcceleration = 1.5;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr double kRelativeCost = 1e-4;
const std::function<bool()> kGoOn = [] { return false; };
const OptimizerOptions kUsual{400, kRelativeCost, kGoOn};

/// Straight ahead from rest to rest over pieces of `spacing_m`.
TrajectoryObjective<2, 3>::Options straight_line_options(int pieces, double duration_weight,
                                                         double spacing_m) {
  Eigen::Matrix2Xd prey = Eigen::Matrix2Xd::Zero(2, pieces - 1);
  for (int k = 0; k + 1 < pieces; ++k) prey(0, k) = spacing_m * (k + 1);
  TrajectoryObjective<2, 3>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.end(0, 0) = spacing_m * pieces;
  options.knot_map = std::make_shared<WaypointMap<2>>(prey);
  options.effort_weight = 1e-3;
  options.duration_cost = DurationCost::total(duration_weight);
  options.kappa = 16;
  options.metres_per_eta = 1.0;
  options.penalties.push_back(
      std::make_unique<DynamicsPenalty<2>>(1e4, kMaxSpeed, kMaxAcceleration));
  return options;
}

TrajectoryObjective<2, 3> straight_line(int pieces, double duration_weight,
                                        double spacing_m = 1.0) {
  return TrajectoryObjective<2, 3>(straight_line_options(pieces, duration_weight, spacing_m));
}

/// Posts in turn on the left and on the right, each across the straight line.
CircleField slalom_posts(int posts, double apart_m) {
  std::vector<CircleField::Circle> circles;
  for (int k = 0; k < posts; ++k)
    circles.push_back({{apart_m * (k + 0.5), k % 2 == 0 ? -0.3 : 0.3}, 0.5});
  return CircleField(std::move(circles));
}

Eigen::VectorXd slow_start(const TrajectoryObjective<2, 3>& objective) {
  return objective.initial(Eigen::VectorXd::Constant(objective.pieces(), 1.0));
}

TEST(TrajectoryOptimizer, StraightLineIsNearlyTimeOptimal) {
  auto objective = straight_line(8, 1.0, 2.5);
  const auto result = optimize<2, 3>(objective, slow_start(objective), {4000, 1e-6, kGoOn});
  EXPECT_EQ(result.stop, StopReason::kConverged) << result.evaluations << " evaluations";
  const double kinematic_s = 20.0 / kMaxSpeed + kMaxSpeed / kMaxAcceleration;
  // Penalties let the limits be passed a little; smooth starts and stops cost a little more.
  EXPECT_GT(result.curve.duration(), 0.97 * kinematic_s);
  EXPECT_LT(result.curve.duration(), 1.10 * kinematic_s);
  for (double t = 0.0; t < result.curve.duration(); t += 0.01) {
    EXPECT_LT(result.curve.derivative(t, 1).norm(), 1.03 * kMaxSpeed);
    EXPECT_LT(result.curve.derivative(t, 2).norm(), 1.10 * kMaxAcceleration);
    EXPECT_NEAR(result.curve.position(t).y(), 0.0, 1e-6);
  }
}

/// A model of the curvature is of the whole curve at once: a longer one takes no more steps.
TEST(TrajectoryOptimizer, WithAModelALongCurveTakesAboutAsManyEvaluationsAsAShortOne) {
  constexpr double kFine = 1e-5;
  const auto evaluations = [](int pieces) {
    auto objective = straight_line(pieces, 1.0);
    const auto result =
        optimize<2, 3>(objective, slow_start(objective), {4000, kFine, kGoOn, true});
    EXPECT_EQ(result.stop, StopReason::kConverged);
    return result.evaluations;
  };
  EXPECT_LT(evaluations(200), 2 * evaluations(10));
}

/// It does because the model gives effort far more weight than the cost does. With the true weight
/// it would take more evaluations than without a model.
TEST(TrajectoryOptimizer, WithAModelALongSlalomTakesFewerEvaluations) {
  constexpr int kPosts = 10;
  constexpr int kPiecesPerPost = 6;
  constexpr double kSpacing_m = 0.5;
  const CircleField posts = slalom_posts(kPosts, kPiecesPerPost * kSpacing_m);
  const auto slalom = [&](bool model) {
    auto options = straight_line_options(kPosts * kPiecesPerPost, 1.0, kSpacing_m);
    options.effort_weight = 1e-2;
    options.penalties.push_back(std::make_unique<ObstaclePenalty<2>>(
        200.0, posts, std::vector<ObstaclePenalty<2>::Cover>{{0.0, 0.5}}, 0.05));
    TrajectoryObjective<2, 3> objective(std::move(options));
    return optimize<2, 3>(objective, slow_start(objective), {4000, 1e-5, kGoOn, model});
  };
  const auto without = slalom(false);
  const auto with = slalom(true);
  ASSERT_EQ(without.stop, StopReason::kConverged);
  EXPECT_EQ(with.stop, StopReason::kConverged);
  EXPECT_LT(2 * with.evaluations, without.evaluations);
  EXPECT_LT(with.cost, 1.005 * without.cost);
}

TEST(TrajectoryOptimizer, WithAModelItComesToTheSameCost) {
  auto objective = straight_line(8, 1.0, 2.5);
  const Eigen::VectorXd x = slow_start(objective);
  const double cost = optimize<2, 3>(objective, x, {4000, 1e-6, kGoOn}).cost;
  EXPECT_NEAR((optimize<2, 3>(objective, x, {4000, 1e-6, kGoOn, true}).cost), cost, 1e-3 * cost);
}

TEST(TrajectoryOptimizer, ADearerSecondMakesItFaster) {
  auto patient = straight_line(8, 0.1);
  auto hasty = straight_line(8, 10.0);
  const double slow_s = optimize<2, 3>(patient, slow_start(patient), kUsual).curve.duration();
  EXPECT_LT((optimize<2, 3>(hasty, slow_start(hasty), kUsual).curve.duration()), slow_s);
}

TEST(TrajectoryOptimizer, ReturnsTheBestSeenWithItsOwnCostAndTerms) {
  auto objective = straight_line(8, 1.0);
  const Eigen::VectorXd x = slow_start(objective);
  Eigen::VectorXd gradient(objective.variables());
  double last = objective.evaluate(x, gradient);
  for (const int budget : {1, 3, 10, 40, 400}) {
    const auto result = optimize<2, 3>(objective, x, {budget, kRelativeCost, kGoOn});
    EXPECT_LE(result.evaluations, budget);
    EXPECT_LE(result.cost, last + 1e-9) << "more evaluations made it worse";
    last = result.cost;
    double sum = 0.0;
    for (const auto& term : result.terms) sum += term.second;
    EXPECT_NEAR(sum, result.cost, 1e-9 * result.cost);
    for (const auto& term : result.terms) {
      if (term.first != "duration") continue;
      EXPECT_NEAR(term.second, result.curve.duration(), 1e-9);
    }
  }
}

TEST(TrajectoryOptimizer, StopsWhenTheCallerSaysSo) {
  auto objective = straight_line(8, 1.0);
  int calls = 0;
  const auto result = optimize<2, 3>(objective, slow_start(objective),
                                     {400, kRelativeCost, [&calls] { return ++calls > 7; }});
  EXPECT_EQ(result.stop, StopReason::kStopped);
  EXPECT_EQ(result.evaluations, 7);
  EXPECT_EQ(result.curve.pieces(), 8);
}

TEST(TrajectoryOptimizer, WithoutABudgetThereIsNoCurve) {
  auto objective = straight_line(8, 1.0);
  const auto result = optimize<2, 3>(objective, slow_start(objective), {0, kRelativeCost, kGoOn});
  EXPECT_EQ(result.stop, StopReason::kBudget);
  EXPECT_EQ(result.curve.pieces(), 0);
}

TEST(TrajectoryOptimizer, SaysThatTheStartIsNotFinite) {
  auto objective = straight_line(8, 1.0);
  Eigen::VectorXd x = slow_start(objective);
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 1e200}) {
    x[0] = bad;
    const auto result = optimize<2, 3>(objective, x, kUsual);
    EXPECT_EQ(result.stop, StopReason::kNotFinite) << bad;
    EXPECT_EQ(result.curve.pieces(), 0);
  }
}

TEST(TrajectoryOptimizer, SurvivesDurationsThatAreFarOff) {
  for (const double duration_s : {1e-3, 1e3}) {
    for (const bool model : {false, true}) {
      auto objective = straight_line(8, 1.0);
      const Eigen::VectorXd x = objective.initial(Eigen::VectorXd::Constant(8, duration_s));
      const auto result = optimize<2, 3>(objective, x, {4000, kRelativeCost, kGoOn, model});
      ASSERT_EQ(result.curve.pieces(), 8);
      EXPECT_TRUE(std::isfinite(result.cost));
      EXPECT_LT(result.curve.duration(), 1e3);
    }
  }
}

/// A field that answers with NaN beside the path: the line search has to come back from it.
class Cliff : public ObstacleField<2> {
 public:
  Sample sample(const Vector& p) const override {
    return std::abs(p.y()) > 0.5 ? Sample{kNan, Vector(kNan, kNan)} : Sample{0.2, Vector(0.0, 1.0)};
  }
  double distance_bound(const Vector&) const override { return 0.0; }
  bool clear(const Box&, double) const override { return false; }
};

TEST(TrajectoryOptimizer, StaysWhereTheCostIsFinite) {
  const Cliff cliff;
  Eigen::Matrix2Xd prey = Eigen::Matrix2Xd::Zero(2, 3);
  prey.row(0) << 1.0, 2.0, 3.0;
  Eigen::Matrix2Xd references = prey;
  references.row(1).setConstant(-3.0);
  TrajectoryObjective<2, 3>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.end(0, 0) = 4.0;
  options.knot_map = std::make_shared<CamouflageMap<2>>(prey, references, 2.0);
  options.effort_weight = 1e-3;
  options.duration_cost = DurationCost::total(1.0);
  options.kappa = 8;
  options.metres_per_eta = 1.0;
  options.penalties.push_back(std::make_unique<ObstaclePenalty<2>>(
      1e5, cliff, std::vector<ObstaclePenalty<2>::Cover>{{0.0, 1.0}}, 0.05));
  TrajectoryObjective<2, 3> objective(std::move(options));
  const auto result =
      optimize<2, 3>(objective, objective.initial(Eigen::VectorXd::Constant(4, 1.0)), kUsual);
  ASSERT_EQ(result.curve.pieces(), 4);
  EXPECT_TRUE(std::isfinite(result.cost));
  for (double t = 0.0; t < result.curve.duration(); t += 0.01) {
    EXPECT_TRUE(result.curve.position(t).allFinite());
  }
}

}  // namespace
}  // namespace mocha
