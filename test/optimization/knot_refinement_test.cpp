#include "optimization/knot_refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "optimization/slalom.h"

namespace mocha {
namespace {

constexpr double kTravel = 5.0;  // [m]
constexpr double kPiece_s = 8.0;

/// A chain, its curve, and what its pieces are penalised.
struct Driven {
  KnotChain<2> chain;
  Minco<2, 3>::Curve curve;
  std::vector<double> penalties;
  double cost;
  double effort;
};

Driven drive(TrajectoryObjective<2, 3>& objective, KnotChain<2> chain) {
  Driven driven;
  objective.set_knot_map(std::make_shared<AdaptiveMap<2>>(chain.knots, kTravel));
  Eigen::VectorXd gradient(objective.variables());
  driven.cost = objective.evaluate(objective.initial(chain.durations_s), gradient);
  driven.effort = objective.effort();
  driven.curve = objective.curve();
  for (int i = 0; i < chain.pieces(); ++i) driven.penalties.push_back(objective.penalty(i));
  driven.chain = std::move(chain);
  return driven;
}

/// Knots beside the straight line, at x [m].
KnotChain<2> chain_at(const std::vector<Eigen::Vector2d>& places) {
  KnotChain<2> chain;
  for (const Eigen::Vector2d& place : places)
    chain.knots.push_back(RayKnot<2>::on_ray(place, {0.0, 1.0}));
  chain.durations_s.setConstant(static_cast<Eigen::Index>(places.size()) + 1, kPiece_s);
  return chain;
}

KnotChain<2> swerving_chain() {
  return chain_at({{3.0, -0.4}, {8.0, 0.5}, {13.0, 0.2}, {18.5, -0.1}});
}

double distance_m(const Minco<2, 3>::Curve& a, const Minco<2, 3>::Curve& b) {
  double most_m = std::abs(a.duration() - b.duration());
  for (double t = 0.0; t < a.duration(); t += 0.01)
    most_m = std::max(most_m, (a.position(t) - b.position(t)).norm());
  return most_m;
}

TEST(TryKnots, LeavesTheCurveAsItIsAndFindsTheGradientsThere) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const Driven driven = drive(objective, swerving_chain());
  const auto trial = try_knots(objective, driven.chain, driven.curve, driven.penalties);
  EXPECT_LT(distance_m(objective.curve(), driven.curve), 1e-9);
  EXPECT_EQ(objective.pieces(), 2 * driven.chain.pieces());
  EXPECT_NEAR(objective.effort(), driven.effort, 1e-9 * driven.effort);
  Eigen::VectorXd durations_s(objective.pieces());
  for (int i = 0; i < objective.pieces(); ++i)
    durations_s[i] = 0.5 * driven.chain.durations_s[i / 2];
  const Eigen::VectorXd x = objective.initial(durations_s);
  Eigen::VectorXd ignored(x.size());
  constexpr double kStep = 1e-5;
  for (int i = 0; i < driven.chain.pieces(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(x.size(), 4 * i + axis);
      const double slope =
          (objective.evaluate(x + step, ignored) - objective.evaluate(x - step, ignored)) /
          (2.0 * kStep);
      EXPECT_NEAR(trial.by_middle(axis, i), slope, 1e-5 * (1.0 + std::abs(slope)));
    }
  }
}

TEST(TryKnots, GainsAreWhatIsGainedWhereEffortIsAllThatCosts) {
  constexpr double kBend_m = 0.3;
  TrajectoryObjective<2, 3>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.end(0, 0) = Slalom::kLength_m;
  std::vector<Eigen::Vector2d> places;
  for (int k = 1; k < 12; ++k) places.push_back({2.0 * k, 0.0});
  KnotChain<2> chain = chain_at(places);
  for (RayKnot<2>& knot : chain.knots) knot = RayKnot<2>::on_ray(knot.prey, {1.0, 0.0});
  options.knot_map = std::make_shared<AdaptiveMap<2>>(chain.knots, kTravel);
  options.effort_weight = 0.7;
  options.duration_cost = DurationCost::total(1.0);
  options.kappa = 8;
  options.metres_per_eta = 1.0;
  TrajectoryObjective<2, 3> objective(std::move(options));
  const Driven straight = drive(objective, chain);
  chain.knots[6].prey.y() += kBend_m;
  const Driven bent = drive(objective, chain);
  const auto trial = try_knots(objective, chain, bent.curve, bent.penalties);
  const double gained = bent.cost - straight.cost;
  EXPECT_NEAR(trial.axis_gains[6], gained, 0.02 * gained);
}

TEST(Refine, AddedKnotsAreOnTheCurveAndKeepIt) {
  const Slalom slalom;
  auto objective = slalom.objective();
  Driven driven = drive(objective, swerving_chain());
  const auto trial = try_knots(objective, driven.chain, driven.curve, driven.penalties);
  KnotChain<2> refined = driven.chain;
  ASSERT_TRUE(refine(refined, trial, 1e-4));
  EXPECT_GT(refined.pieces(), driven.chain.pieces());
  EXPECT_NEAR(refined.durations_s.sum(), driven.chain.durations_s.sum(), 1e-12);
  EXPECT_LT(distance_m(drive(objective, refined).curve, driven.curve), 1e-6);
}

TEST(Refine, AddsWhatIsWorthMostAndNoMoreThanItMust) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const Driven driven = drive(objective, swerving_chain());
  auto trial = try_knots(objective, driven.chain, driven.curve, driven.penalties);
  trial.cost = 100.0;
  trial.knot_gains = {0.01, 5.0, 0.02, 0.01, 0.01};
  trial.axis_gains = {0.0, 0.02, 4.0, 0.01};
  const auto additions = [&](double share) {
    KnotChain<2> refined = driven.chain;
    const bool is_changed = refine(refined, trial, share);
    int freedom = 0;
    for (const RayKnot<2>& knot : refined.knots) freedom += knot.freedom - 1;
    const int knots = refined.pieces() - driven.chain.pieces();
    EXPECT_EQ(is_changed, knots + freedom > 0);
    return std::pair<int, int>(knots, freedom);
  };
  EXPECT_EQ(additions(0.1), (std::pair<int, int>(0, 0)));
  EXPECT_EQ(additions(0.05), (std::pair<int, int>(1, 0)));
  EXPECT_EQ(additions(0.01), (std::pair<int, int>(1, 1)));
  KnotChain<2> refined = driven.chain;
  refine(refined, trial, 0.01);
  EXPECT_LT((refined.knots[1].position() - trial.middles.col(1)).norm(), 1e-12);
  EXPECT_EQ(refined.knots[3].freedom, 2) << "the third knot, after the new one";
}

TEST(Refine, NewRaysPointDownTheGradientAcrossTheCurve) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const Driven driven = drive(objective, swerving_chain());
  const auto trial = try_knots(objective, driven.chain, driven.curve, driven.penalties);
  KnotChain<2> refined = driven.chain;
  refine(refined, trial, 1e-9);
  for (const RayKnot<2>& knot : refined.knots) {
    for (int i = 0; i < driven.chain.pieces(); ++i) {
      if ((knot.prey - trial.middles.col(i)).norm() > 1e-12) continue;
      const Eigen::Vector2d along = driven.curve.derivative({i, 0.5}, 1).normalized();
      EXPECT_NEAR(knot.axes.col(0).dot(along), 0.0, 1e-9);
      EXPECT_EQ(knot.freedom, 1);
    }
  }
}

/// Pieces that are already much shorter than the others are left alone.
TEST(Refine, DoesNotHalveShortPieces) {
  const Slalom slalom;
  auto objective = slalom.objective();
  KnotChain<2> chain = swerving_chain();
  chain.durations_s[1] = 0.1 * kPiece_s;
  const Driven driven = drive(objective, chain);
  auto trial = try_knots(objective, driven.chain, driven.curve, driven.penalties);
  trial.axis_gains.assign(4, 0.0);
  trial.knot_gains = {0.0, 1e6, 0.0, 0.0, 0.0};
  EXPECT_FALSE(refine(chain, trial, 1e-3));
}

TEST(Refine, RemovesIdleKnotsAwayFromPenalties) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const Driven coarse = drive(objective, chain_at({{8.0, 0.3}, {16.0, 0.0}}));
  // A knot on the curve holds it by no force.
  KnotChain<2> chain = coarse.chain;
  const double t = coarse.curve.duration() * 5.0 / 6.0;
  chain.knots.push_back(RayKnot<2>::on_ray(coarse.curve.position(t), {0.0, 1.0}));
  chain.durations_s.setConstant(4, kPiece_s);
  chain.durations_s.tail(2).setConstant(0.5 * kPiece_s);
  const Driven driven = drive(objective, chain);
  ASSERT_LT(distance_m(driven.curve, coarse.curve), 1e-9);
  auto trial = try_knots(objective, driven.chain, driven.curve, driven.penalties);
  ASSERT_TRUE(trial.is_free[2] && trial.is_free[3]);
  trial.knot_gains.assign(4, 0.0);
  trial.axis_gains.assign(3, 0.0);
  KnotChain<2> refined = driven.chain;
  EXPECT_FALSE(refine(refined, trial, 1e-3));
  EXPECT_EQ(refined.pieces(), 3);
  EXPECT_LT(distance_m(drive(objective, refined).curve, coarse.curve), 1e-9);
  trial.is_free[3] = false;
  refined = driven.chain;
  refine(refined, trial, 1e-3);
  EXPECT_EQ(refined.pieces(), 4) << "a penalty may need it";
  // One that bends the curve stays.
  chain.knots.back().prey.y() += 0.3;
  const Driven bent = drive(objective, chain);
  trial = try_knots(objective, bent.chain, bent.curve, bent.penalties);
  trial.knot_gains.assign(4, 0.0);
  trial.axis_gains.assign(3, 0.0);
  refined = bent.chain;
  refine(refined, trial, 1e-3);
  EXPECT_EQ(refined.pieces(), 4);
}

}  // namespace
}  // namespace mocha
