#include "trajectory/minco.h"

#include <gtest/gtest.h>

#include <random>

namespace mocha {
namespace {

/// A random problem of M pieces in D dimensions.
template <int D>
struct Problem {
  using M = Minco<D, 3>;
  typename M::State start;
  typename M::State end;
  typename M::Knots knots;
  Eigen::VectorXd durations;

  Problem(int pieces, int seed) : knots(D, pieces - 1), durations(pieces) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> tau(0.3, 2.0);
    for (auto& x : start.reshaped()) x = normal(random);
    for (auto& x : end.reshaped()) x = normal(random);
    for (auto& x : knots.reshaped()) x = 3.0 * normal(random);
    for (auto& x : durations) x = tau(random);
  }

  M solved() const {
    M minco;
    minco.resize(static_cast<int>(durations.size()));
    minco.solve(start, end, knots, durations);
    return minco;
  }
};

template <int D>
void expect_continuity(int pieces) {
  const Problem<D> problem(pieces, pieces);
  const auto curve = problem.solved().curve();
  for (int i = 0; i + 1 < pieces; ++i) {
    for (int order = 0; order <= 4; ++order) {
      const auto before = curve.derivative({i, 1.0}, order);
      const auto after = curve.derivative({i + 1, 0.0}, order);
      EXPECT_LT((before - after).norm(), 1e-8 * (1.0 + before.norm())) << i << " order " << order;
    }
    EXPECT_LT((curve.derivative({i, 1.0}, 0) - problem.knots.col(i)).norm(), 1e-10);
  }
  EXPECT_LT((curve.state(0.0) - problem.start).norm(), 1e-10);
  EXPECT_LT((curve.state(curve.duration()) - problem.end).norm(), 1e-9);
  EXPECT_NEAR(curve.duration(), problem.durations.sum(), 1e-12);
}

TEST(Minco, IsSmoothToOrderFourAndMeetsKnotsAndEnds) {
  for (const int pieces : {1, 2, 3, 20}) expect_continuity<2>(pieces);
  for (const int pieces : {1, 2, 7}) expect_continuity<3>(pieces);
}

TEST(Minco, OnePieceRestToRestIsTheMinimumJerkProfile) {
  Problem<2> problem(1, 1);
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

TEST(Minco, EffortIsTheIntegralOfTheSquaredJerk) {
  const auto minco = Problem<2>(6, 3).solved();
  const auto curve = minco.curve();
  double integral = 0.0;
  const int steps = 200;
  for (int i = 0; i < curve.pieces(); ++i) {
    for (int k = 0; k < steps; ++k) {
      const double u = (k + 0.5) / steps;
      integral += curve.derivative({i, u}, 3).squaredNorm() * curve.piece_duration(i) / steps;
    }
  }
  EXPECT_NEAR(minco.effort() / integral, 1.0, 1e-4);
}

/// Any other C2 curve through the same knots has derivatives 1 and 2 at the knots that differ:
/// perturb those.
TEST(Minco, NoOtherCurveThroughTheSameKnotsTakesLessEffort) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const Problem<2> problem(5, 9);
  const auto minco = problem.solved();
  const auto curve = minco.curve();
  for (int trial = 0; trial < 50; ++trial) {
    const double size = trial < 25 ? 1.0 : 1e-3;
    double effort = 0.0;
    std::vector<PlanarPath::State> states;
    for (int i = 0; i <= 5; ++i) {
      states.push_back(i < 5 ? curve.state(curve.piece_start(i)) : problem.end);
      if (i > 0 && i < 5) {
        for (auto& x : states.back().rightCols<2>().reshaped()) x += size * normal(random);
      }
    }
    for (int i = 0; i < 5; ++i) {
      PlanarMinco piece;
      piece.resize(1);
      piece.solve(states[i], states[i + 1], PlanarMinco::Knots(2, 0),
                  Eigen::VectorXd::Constant(1, problem.durations[i]));
      effort += piece.effort();
    }
    EXPECT_GT(effort, minco.effort());
  }
}

/// J = effort-independent random smooth function of coefficients and durations; total gradient
/// against differences.
template <int D>
void expect_gradients(int pieces, bool effort) {
  Problem<D> problem(pieces, 31 + pieces);
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  using Piece = typename Minco<D, 3>::Piece;
  std::vector<Piece> weights(pieces);
  for (Piece& weight : weights) {
    for (auto& x : weight.reshaped()) x = 0.02 * normal(random);
  }
  const auto value = [&](const Minco<D, 3>& minco) {
    if (effort) return 0.7 * minco.effort();
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i) {
      sum += std::sin(minco.piece(i).cwiseProduct(weights[i]).sum()) * minco.piece_duration(i);
    }
    return sum;
  };
  auto minco = problem.solved();
  std::vector<Piece> by_piece(pieces, Piece::Zero());
  Eigen::VectorXd by_duration = Eigen::VectorXd::Zero(pieces);
  if (effort) {
    minco.add_effort_gradient(0.7, by_piece, by_duration);
  } else {
    for (int i = 0; i < pieces; ++i) {
      const double sum = minco.piece(i).cwiseProduct(weights[i]).sum();
      by_piece[i] = std::cos(sum) * minco.piece_duration(i) * weights[i];
      by_duration[i] = std::sin(sum);
    }
  }
  typename Minco<D, 3>::Knots by_knot(D, pieces - 1);
  minco.propagate(by_piece, by_duration, by_knot);

  const auto slope = [&](double& variable) {  // fourth-order central difference
    const double h = 1e-4;
    const double middle = variable;
    const auto at = [&](double offset) {
      variable = middle + offset;
      return value(problem.solved());
    };
    const double slope = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12.0 * h);
    variable = middle;
    return slope;
  };
  const double scale =
      by_duration.cwiseAbs().maxCoeff() + (pieces > 1 ? by_knot.cwiseAbs().maxCoeff() : 0.0);
  for (int i = 0; i < pieces; ++i) {
    EXPECT_NEAR(by_duration[i], slope(problem.durations[i]), 1e-6 * scale) << "duration " << i;
  }
  for (int i = 0; i < by_knot.size(); ++i) {
    EXPECT_NEAR(by_knot.reshaped()[i], slope(problem.knots.reshaped()[i]), 1e-6 * scale)
        << "knot value " << i;
  }
}

TEST(Minco, EffortGradientIsThatOfDifferences) {
  for (const int pieces : {1, 2, 6}) expect_gradients<2>(pieces, true);
  expect_gradients<3>(5, true);
}

TEST(Minco, PropagatesAnyGradient) {
  for (const int pieces : {1, 2, 6}) expect_gradients<2>(pieces, false);
  expect_gradients<3>(5, false);
}

TEST(Minco, IsReusable) {
  auto minco = Problem<2>(8, 1).solved();
  const Problem<2> other(3, 2);
  minco.resize(3);
  minco.solve(other.start, other.end, other.knots, other.durations);
  EXPECT_EQ(minco.effort(), other.solved().effort());
}

}  // namespace
}  // namespace mocha
