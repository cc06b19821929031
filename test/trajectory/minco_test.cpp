#include "trajectory/minco.h"

#include <gtest/gtest.h>

#include <random>

#include "trajectory/dense_minimum_effort.h"
#include "trajectory/minco_problem.h"

namespace mocha {
namespace {

using test::dense_minimum_effort;
using test::Problem;

template <typename Case>
class MincoTest : public ::testing::Test {};
TYPED_TEST_SUITE(MincoTest, test::AllCases);

template <int D, int S>
void expect_dense_reference(const Problem<D, S>& problem, double tolerance) {
  const auto minco = problem.solved();
  const auto reference = dense_minimum_effort(problem);
  for (int i = 0; i < problem.pieces(); ++i) {
    const typename Minco<D, S>::Piece expected =
        reference.middleRows(2 * S * i, 2 * S).transpose().template cast<double>();
    EXPECT_LT((minco.piece(i) - expected).norm(), tolerance * expected.norm()) << "piece " << i;
    EXPECT_EQ(minco.piece_duration(i), problem.durations[i]);
  }
}

TYPED_TEST(MincoTest, IsTheCurveOfLeastEffort) {
  for (const int pieces : {1, 2, 3, 6}) {
    for (int seed = 0; seed < 5; ++seed) {
      expect_dense_reference(Problem<TypeParam::D, TypeParam::S>(pieces, seed), 1e-9);
    }
  }
}

/// A stiff short piece between soft long ones costs digits, the more the higher S.
TYPED_TEST(MincoTest, BearsWidelyDifferingDurations) {
  const double tolerance = TypeParam::S == 4 ? 1e-4 : 1e-8;
  for (const int pieces : {1, 2, 3, 5}) {
    for (int seed = 0; seed < 10; ++seed) {
      expect_dense_reference(Problem<TypeParam::D, TypeParam::S>(pieces, seed, 1e-2, 10.0),
                             tolerance);
    }
  }
}

TYPED_TEST(MincoTest, IsSmoothAndMeetsKnotsAndEnds) {
  constexpr int S = TypeParam::S;
  for (const int pieces : {1, 2, 3, 20}) {
    const Problem<TypeParam::D, S> problem(pieces, pieces);
    const auto curve = problem.solved().curve();
    for (int i = 0; i + 1 < pieces; ++i) {
      for (int order = 0; order <= 2 * S - 2; ++order) {
        const auto before = curve.derivative({i, 1.0}, order);
        const auto after = curve.derivative({i + 1, 0.0}, order);
        EXPECT_LT((before - after).norm(), 1e-8 * (1.0 + before.norm())) << i << " order " << order;
      }
      EXPECT_LT((curve.derivative({i, 1.0}, 0) - problem.knots.col(i)).norm(), 1e-10);
    }
    EXPECT_LT((curve.state(0.0) - problem.start).norm(), 1e-10);
    EXPECT_LT((curve.state(curve.duration()) - problem.end).norm(), 1e-8);
    EXPECT_NEAR(curve.duration(), problem.durations.sum(), 1e-12);
  }
}

TEST(Minco, OnePieceRestToRestIsTheMinimumJerkProfile) {
  Problem<2, 3> problem(1, 1);
  problem.start.setZero();
  problem.end.setZero();
  problem.end.col(0) << 3.0, -4.0;
  problem.durations[0] = 2.5;
  const auto minco = problem.solved();
  for (double u = 0.0; u <= 1.0; u += 0.1) {
    const double progress = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
    const Vector2 expected = progress * problem.end.col(0);
    EXPECT_LT((minco.curve().position(2.5 * u) - expected).norm(), 1e-12);
  }
  EXPECT_NEAR(minco.effort(), 720.0 * 25.0 / std::pow(2.5, 5), 1e-9);
}

TYPED_TEST(MincoTest, EffortIsTheIntegralOfTheSquaredDerivative) {
  const auto minco = Problem<TypeParam::D, TypeParam::S>(6, 3).solved();
  const auto curve = minco.curve();
  double integral = 0.0;
  const int steps = 400;
  for (int i = 0; i < curve.pieces(); ++i) {
    for (int k = 0; k <= steps; ++k) {  // Simpson's rule
      const double weight = k == 0 || k == steps ? 1.0 : 2.0 + 2.0 * (k % 2);
      const double u = static_cast<double>(k) / steps;
      integral += weight * curve.derivative({i, u}, TypeParam::S).squaredNorm() *
                  curve.piece_duration(i) / (3.0 * steps);
    }
  }
  EXPECT_NEAR(minco.effort() / integral, 1.0, 1e-8);
}

/// Any other C^(S-1) curve through the same knots has derivatives 1 .. S-1 there that differ:
/// perturb those.
TYPED_TEST(MincoTest, NoOtherCurveThroughTheSameKnotsTakesLessEffort) {
  using M = Minco<TypeParam::D, TypeParam::S>;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const Problem<TypeParam::D, TypeParam::S> problem(5, 9);
  const auto minco = problem.solved();
  const auto curve = minco.curve();
  for (int trial = 0; trial < 50; ++trial) {
    const double size = trial < 25 ? 1.0 : 1e-3;
    double effort = 0.0;
    std::vector<typename M::State> states;
    for (int i = 0; i <= 5; ++i) {
      states.push_back(i < 5 ? curve.state(curve.piece_start(i)) : problem.end);
      if (i == 0 || i == 5) continue;
      for (auto& x : states.back().template rightCols<M::kFree>().reshaped()) {
        x += size * normal(random);
      }
    }
    for (int i = 0; i < 5; ++i) {
      M piece;
      piece.resize(1);
      piece.solve(states[i], states[i + 1], typename M::Knots(TypeParam::D, 0),
                  Eigen::VectorXd::Constant(1, problem.durations[i]));
      effort += piece.effort();
    }
    EXPECT_GT(effort, minco.effort());
  }
}

TYPED_TEST(MincoTest, IsReusable) {
  auto minco = Problem<TypeParam::D, TypeParam::S>(8, 1).solved();
  for (const int pieces : {3, 1, 12}) {
    const Problem<TypeParam::D, TypeParam::S> other(pieces, 2);
    minco.resize(pieces);
    minco.solve(other.start, other.end, other.knots, other.durations);
    const auto fresh = other.solved();
    EXPECT_EQ(minco.effort(), fresh.effort());
    for (int i = 0; i < pieces; ++i) EXPECT_EQ(minco.piece(i), fresh.piece(i));
  }
}

}  // namespace
}  // namespace mocha
