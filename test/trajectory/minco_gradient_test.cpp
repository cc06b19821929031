#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "trajectory/dense_minimum_effort.h"
#include "trajectory/minco.h"
#include "trajectory/minco_problem.h"

namespace mocha {
namespace {

using test::dense_minimum_effort;
using test::Problem;
using test::Real;

/// The control effort, from the coefficients of the dense reference.
template <int D, int S>
struct Effort {
  Real value(const Problem<D, S>& problem) const {
    const auto coefficients = dense_minimum_effort(problem);
    Real sum = 0.0;
    for (int i = 0; i < problem.pieces(); ++i) {
      const Real weight = std::pow(static_cast<Real>(problem.durations[i]), 1 - 2 * S);
      for (int a = S; a < 2 * S; ++a) {
        for (int b = S; b < 2 * S; ++b) {
          sum += weight * test::monomial_slope(a, S, 1.0) * test::monomial_slope(b, S, 1.0) /
                 (a + b - 2 * S + 1) *
                 coefficients.row(2 * S * i + a).dot(coefficients.row(2 * S * i + b));
        }
      }
    }
    return 0.7 * sum;
  }

  void add_gradient(const Minco<D, S>& minco, std::vector<typename Minco<D, S>::Piece>& by_piece,
                    Eigen::VectorXd& by_duration) const {
    minco.add_effort_gradient(0.7, by_piece, by_duration);
  }
};

/// Some smooth function that couples all pieces and durations.
template <int D, int S>
struct Wave {
  using Piece = typename Minco<D, S>::Piece;
  std::vector<Piece> weights;

  explicit Wave(const Problem<D, S>& problem) : weights(problem.pieces()) {
    std::mt19937 random(17);
    std::normal_distribution<double> normal;
    const auto minco = problem.solved();
    for (int i = 0; i < problem.pieces(); ++i) {
      for (auto& x : weights[i].reshaped()) x = normal(random);
      weights[i] /= minco.piece(i).norm();
    }
  }

  template <typename Scalar, typename PieceOf, typename DurationOf>
  Scalar phase(const PieceOf& piece, const DurationOf& tau) const {
    Scalar phase = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      phase += piece(i).cwiseProduct(weights[i].template cast<Scalar>()).sum() * (1.0 + tau(i));
    }
    return phase;
  }

  Real value(const Problem<D, S>& problem) const {
    const auto coefficients = dense_minimum_effort(problem);
    const auto tau = [&](int i) { return static_cast<Real>(problem.durations[i]); };
    const auto piece = [&](int i) -> Eigen::Matrix<Real, D, 2 * S> {
      return coefficients.middleRows(2 * S * i, 2 * S).transpose();
    };
    return std::sin(phase<Real>(piece, tau)) + std::cos(tau(0));
  }

  void add_gradient(const Minco<D, S>& minco, std::vector<Piece>& by_piece,
                    Eigen::VectorXd& by_duration) const {
    const auto tau = [&](int i) { return minco.piece_duration(i); };
    const auto piece = [&](int i) { return minco.piece(i); };
    const double slope = std::cos(phase<double>(piece, tau));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      by_piece[i] += slope * (1.0 + tau(i)) * weights[i];
      by_duration[i] += slope * piece(i).cwiseProduct(weights[i]).sum();
    }
    by_duration[0] -= std::sin(tau(0));
  }
};

/// Total gradients by knots and durations against central differences of fourth order.
template <int D, int S, typename Function>
void expect_gradients(Problem<D, S> problem, const Function& function, double tolerance) {
  using M = Minco<D, S>;
  auto minco = problem.solved();
  std::vector<typename M::Piece> by_piece(problem.pieces(), M::Piece::Zero());
  Eigen::VectorXd by_duration = Eigen::VectorXd::Zero(problem.pieces());
  typename M::Knots by_knot(D, problem.pieces() - 1);
  function.add_gradient(minco, by_piece, by_duration);
  minco.propagate(by_piece, by_duration, by_knot);

  const auto slope = [&](double& variable, double h) {
    const double middle = variable;
    const auto rise = [&](double step) {
      variable = middle + step;
      const double above = variable;
      const Real up = function.value(problem);
      variable = middle - step;
      const Real down = function.value(problem);
      return static_cast<double>((up - down) / (static_cast<Real>(above) - variable));
    };
    const double slope = (4.0 * rise(h) - rise(2.0 * h)) / 3.0;
    variable = middle;
    return slope;
  };
  for (int i = 0; i < problem.pieces(); ++i) {
    const double expected = slope(problem.durations[i], 1e-4 * problem.durations[i]);
    EXPECT_NEAR(by_duration[i], expected, tolerance * std::abs(expected)) << "duration " << i;
  }
  for (int i = 0; i < by_knot.size(); ++i) {
    const double expected = slope(problem.knots.reshaped()[i], 1e-4);
    EXPECT_NEAR(by_knot.reshaped()[i], expected, tolerance * std::abs(expected)) << "knot " << i;
  }
}

template <typename Case>
class MincoGradientTest : public ::testing::Test {};
TYPED_TEST_SUITE(MincoGradientTest, test::AllCases);

TYPED_TEST(MincoGradientTest, OfTheEffortIsThatOfDifferences) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  for (const int pieces : {1, 2, 5}) {
    expect_gradients(Problem<D, S>(pieces, 31 + pieces), Effort<D, S>(), 1e-6);
  }
}

TYPED_TEST(MincoGradientTest, OfAnySmoothFunctionIsThatOfDifferences) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  for (const int pieces : {1, 2, 5}) {
    const Problem<D, S> problem(pieces, 31 + pieces);
    expect_gradients(problem, Wave<D, S>(problem), 1e-6);
  }
}

TYPED_TEST(MincoGradientTest, HoldsForWidelyDifferingDurations) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  for (int seed = 0; seed < 3; ++seed) {
    const Problem<D, S> problem(4, seed, 1e-2, 10.0);
    expect_gradients(problem, Effort<D, S>(), 1e-6);
    expect_gradients(problem, Wave<D, S>(problem), 1e-6);
  }
}

}  // namespace
}  // namespace mocha
