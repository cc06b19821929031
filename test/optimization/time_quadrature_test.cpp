#include "optimization/time_quadrature.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "optimization/one_sample.h"

namespace mocha {
namespace {

/// Smooth in everything, so that the trapezoid rule can be compared with a fine integral.
class SmoothPenalty : public Penalty<2> {
 public:
  const char* name() const override { return "smooth"; }
  Derivatives wanted(const PieceBounds<2>&) const override {
    return kPosition | kVelocity | kAcceleration | kJerk | kTime;
  }
  void add(const PieceSamples<2>& s, PenaltyRows<2>& rows) const override {
    for (int j = 0; j < s.size(); ++j) {
      const double swing = std::sin(s.time_s[j]);
      const double distance2 = s.position().row(j).squaredNorm();
      rows.value[j] += swing * swing * distance2 + s.velocity().row(j).squaredNorm() +
                       0.1 * s.acceleration().row(j).squaredNorm() +
                       0.01 * s.jerk().row(j).squaredNorm();
      rows.by_position().row(j) += 2.0 * swing * swing * s.position().row(j);
      rows.by_time[j] += 2.0 * swing * std::cos(s.time_s[j]) * distance2;
    }
    rows.by_velocity() += 2.0 * s.velocity();
    rows.by_acceleration() += 0.2 * s.acceleration();
    rows.by_jerk() += 0.02 * s.jerk();
  }
};

/// One per second of trajectory.
class One : public Penalty<2> {
 public:
  const char* name() const override { return "one"; }
  Derivatives wanted(const PieceBounds<2>&) const override { return kPosition; }
  void add(const PieceSamples<2>&, PenaltyRows<2>& rows) const override {
    rows.value.array() += 1.0;
  }
};

/// Says that it is zero after a time, and is.
class OneUntil : public Penalty<2> {
 public:
  explicit OneUntil(double end_s) : end_s_(end_s) {}
  const char* name() const override { return "one until"; }
  Derivatives wanted(const PieceBounds<2>& piece) const override {
    return piece.start_s < end_s_ ? kVelocity : kNone;
  }
  void add(const PieceSamples<2>& s, PenaltyRows<2>& rows) const override {
    EXPECT_LT(s.bounds.start_s, end_s_) << "was asked about a piece that it does not want";
    rows.value.array() += 1.0;
  }

 private:
  double end_s_;
};

/// What the penalties see of a curve at time t of it.
Sample<2> sample_of(const PlanarPath& path, double t, double time_s) {
  return {path.position(t), path.derivative(t, 1), path.derivative(t, 2), time_s,
          path.derivative(t, 3)};
}

using Penalties = std::vector<std::unique_ptr<Penalty<2>>>;

PlanarMinco curve() {
  PlanarMinco minco;
  minco.resize(4);
  PlanarMinco::State start = PlanarMinco::State::Zero();
  PlanarMinco::State end = PlanarMinco::State::Zero();
  start.col(1) = Vector2(0.5, -0.2);
  end.col(0) = Vector2(4.0, 1.0);
  PlanarMinco::Knots knots(2, 3);
  knots << 1.0, 2.0, 3.2, 0.6, -0.4, 0.3;
  minco.solve(start, end, knots, (Eigen::Vector4d() << 1.3, 0.7, 1.1, 2.0).finished());
  return minco;
}

struct Integral {
  double value;
  std::vector<PlanarMinco::Piece> by_piece;
  Eigen::VectorXd by_duration;
  std::vector<double> shares;
};

Integral integrate(const PlanarMinco& minco, const Penalties& penalties, int kappa) {
  Integral result;
  result.by_piece.assign(minco.pieces(), PlanarMinco::Piece::Zero());
  result.by_duration.setZero(minco.pieces());
  result.shares.assign(penalties.size(), 0.0);
  result.value = TimeQuadrature<2, 3>(kappa, minco.pieces(), penalties.size())
                     .add(minco, penalties, result.by_piece, result.by_duration, result.shares);
  return result;
}

double fine_integral(const PlanarMinco& minco, const Penalty<2>& penalty) {
  const auto path = minco.curve();
  constexpr int kSteps = 200000;
  const double step = path.duration() / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step;
    sum += step * value_of(penalty, sample_of(path, t, t));
  }
  return sum;
}

TEST(TimeQuadrature, ApproachesTheIntegralWithTheSquareOfTheStep) {  // paper (21)
  const PlanarMinco minco = curve();
  Penalties penalties;
  penalties.push_back(std::make_unique<SmoothPenalty>());
  const double exact = fine_integral(minco, *penalties[0]);
  const double coarse = std::abs(integrate(minco, penalties, 16).value - exact);
  const double fine = std::abs(integrate(minco, penalties, 64).value - exact);
  EXPECT_LT(fine, 1e-3 * exact);
  EXPECT_NEAR(coarse / fine, 16.0, 2.0);
}

TEST(TimeQuadrature, AConstantGivesTheDuration) {
  const PlanarMinco minco = curve();
  Penalties penalties;
  penalties.push_back(std::make_unique<One>());
  for (const int kappa : {1, 2, 5, 12}) {
    const Integral result = integrate(minco, penalties, kappa);
    EXPECT_NEAR(result.value, 5.1, 1e-12);
    EXPECT_LT((result.by_duration.array() - 1.0).abs().maxCoeff(), 1e-12);
  }
}

TEST(TimeQuadrature, SharesAddUp) {
  const PlanarMinco minco = curve();
  Penalties penalties;
  penalties.push_back(std::make_unique<SmoothPenalty>());
  penalties.push_back(std::make_unique<One>());
  const Integral result = integrate(minco, penalties, 12);
  EXPECT_NEAR(result.shares[1], 5.1, 1e-12);
  EXPECT_NEAR(result.shares[0] + result.shares[1], result.value, 1e-12);
}

TEST(TimeQuadrature, SkipsPiecesOnWhichAPenaltyIsZero) {
  const PlanarMinco minco = curve();
  Penalties penalties;
  penalties.push_back(std::make_unique<OneUntil>(1.5));  // the first two pieces: 1.3 s and 0.7 s
  const Integral result = integrate(minco, penalties, 12);
  EXPECT_NEAR(result.value, 2.0, 1e-12);
  EXPECT_EQ(result.by_duration[2], 0.0);
  EXPECT_EQ(result.by_duration[3], 0.0);
}

TEST(TimeQuadrature, TellsTheIntegralOfEachPieceAtTheLastCall) {
  const PlanarMinco minco = curve();
  Penalties all;
  all.push_back(std::make_unique<One>());
  Penalties until;
  until.push_back(std::make_unique<OneUntil>(1.5));
  Integral result = integrate(minco, all, 12);
  TimeQuadrature<2, 3> quadrature(12, 1, 1);
  quadrature.resize(minco.pieces());
  for (const Penalties* penalties : {&all, &until}) {
    quadrature.add(minco, *penalties, result.by_piece, result.by_duration, result.shares);
    for (int i = 0; i < minco.pieces(); ++i) {
      const double expected_s = penalties == &all || i < 2 ? minco.piece_duration(i) : 0.0;
      EXPECT_NEAR(quadrature.integral(i), expected_s, 1e-12);
    }
  }
}

TEST(TimeQuadrature, AddsToWhatIsThere) {
  const PlanarMinco minco = curve();
  Penalties penalties;
  penalties.push_back(std::make_unique<SmoothPenalty>());
  const Integral once = integrate(minco, penalties, 12);
  Integral twice = once;
  TimeQuadrature<2, 3>(12, minco.pieces(), 1)
      .add(minco, penalties, twice.by_piece, twice.by_duration, twice.shares);
  EXPECT_LT((twice.by_duration - 2.0 * once.by_duration).norm(), 1e-9);
  EXPECT_LT((twice.by_piece[2] - 2.0 * once.by_piece[2]).norm(), 1e-9);
}

/// A curve whose coefficients and durations can be changed one by one.
double value_with(const PlanarMinco& minco, int piece, int row, int column, double change,
                  int longer_piece) {
  // The quadrature reads pieces and durations only; a changed curve is rebuilt from its parts.
  const auto path = minco.curve();
  double start_s = 0.0;
  double total = 0.0;
  constexpr int kKappa = 12;
  for (int i = 0; i < path.pieces(); ++i) {
    PlanarMinco::Piece c = path.piece(i);
    if (i == piece) c(row, column) += change;
    const double tau = path.piece_duration(i) + (i == longer_piece ? change : 0.0);
    const PlanarPath single({c}, {tau});
    for (int j = 0; j <= kKappa; ++j) {
      const double t = tau * j / kKappa;
      total += (j == 0 || j == kKappa ? 0.5 : 1.0) * tau / kKappa *
               value_of(SmoothPenalty(), sample_of(single, t, start_s + t));
    }
    start_s += tau;
  }
  return total;
}

TEST(TimeQuadrature, GradientMatchesDifferences) {  // paper (23)-(26)
  const PlanarMinco minco = curve();
  Penalties penalties;
  penalties.push_back(std::make_unique<SmoothPenalty>());
  const Integral result = integrate(minco, penalties, 12);
  EXPECT_NEAR(value_with(minco, -1, 0, 0, 0.0, -1), result.value, 1e-9);
  constexpr double kStep = 1e-6;
  const auto slope = [&](int piece, int row, int column, int longer) {
    return (value_with(minco, piece, row, column, kStep, longer) -
            value_with(minco, piece, row, column, -kStep, longer)) /
           (2.0 * kStep);
  };
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(result.by_duration[i], slope(-1, 0, 0, i), 1e-5) << "duration " << i;
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 6; ++column) {
        EXPECT_NEAR(result.by_piece[i](row, column), slope(i, row, column, -1), 1e-5);
      }
    }
  }
}

/// The cube of a sum of derivatives: Gauss and Newton's curvature is the true one.
class CubeOfSum : public Penalty<2> {
 public:
  const char* name() const override { return "cube of sum"; }
  Derivatives wanted(const PieceBounds<2>&) const override {
    return kPosition | kVelocity | kAcceleration | kJerk;
  }
  void add(const PieceSamples<2>& s, PenaltyRows<2>& rows) const override {
    for (int j = 0; j < s.size(); ++j) {
      double sum = 0.0;
      for (int order = 0; order < kOrders; ++order)
        sum += along_[order].dot(s.derivative[order].row(j));
      const Cubic cube = cubic(sum);
      rows.value[j] += kWeight * cube.value;
      for (int order = 0; order < kOrders; ++order)
        rows.by_derivative[order].row(j) += kWeight * cube.slope * along_[order];
    }
  }

 private:
  static constexpr double kWeight = 5.0;
  const std::array<Eigen::RowVector2d, kOrders> along_ = {
      Eigen::RowVector2d{0.4, 0.3}, {0.5, -0.2}, {-0.1, 0.3}, {0.02, 0.01}};
};

constexpr double kEffortWeight = 0.3;
constexpr double kLasts_s = 1.7;

/// The cost of one piece by the states at its ends, and its gradient by differences.
class OnePiece {
 public:
  using Ends = Eigen::Matrix<double, 12, 1>;

  explicit OnePiece(bool penalised) {
    if (penalised) penalties_.push_back(std::make_unique<CubeOfSum>());
    minco_.resize(1);
  }

  double cost(const Ends& ends) {
    solve(ends);
    std::vector<PlanarMinco::Piece> by_piece(1, PlanarMinco::Piece::Zero());
    Eigen::VectorXd by_duration = Eigen::VectorXd::Zero(1);
    std::vector<double> shares(penalties_.size(), 0.0);
    return kEffortWeight * minco_.effort() +
           quadrature_.add(minco_, penalties_, by_piece, by_duration, shares);
  }

  Eigen::Matrix<double, 12, 12> curvature(const Ends& ends) {
    solve(ends);
    return quadrature_.curvature(minco_, penalties_, kEffortWeight, 0, 0.0).topLeftCorner<12, 12>();
  }

 private:
  void solve(const Ends& ends) {
    minco_.solve(Eigen::Map<const PlanarMinco::State>(ends.data()),
                 Eigen::Map<const PlanarMinco::State>(ends.data() + 6), PlanarMinco::Knots(2, 0),
                 Eigen::VectorXd::Constant(1, kLasts_s));
  }

  PlanarMinco minco_;
  TimeQuadrature<2, 3>::Penalties penalties_;
  TimeQuadrature<2, 3> quadrature_{8, 1, 1};
};

TEST(TimeQuadrature, CurvatureIsThatOfEffortAndCubes) {
  constexpr double kStep = 1e-3;
  for (const bool penalised : {false, true}) {
    OnePiece piece(penalised);
    OnePiece::Ends ends;
    ends << 0.5, 0.2, 1.0, 0.1, 0.3, -0.2, 2.0, 0.6, 0.8, 0.4, -0.1, 0.2;
    const auto curvature = piece.curvature(ends);
    for (int k = 0; k < 12; ++k) {
      for (int l = 0; l < 12; ++l) {
        const OnePiece::Ends dk = kStep * OnePiece::Ends::Unit(k);
        const OnePiece::Ends dl = kStep * OnePiece::Ends::Unit(l);
        const double difference = piece.cost(ends + dk + dl) - piece.cost(ends + dk - dl) -
                                  piece.cost(ends - dk + dl) + piece.cost(ends - dk - dl);
        EXPECT_NEAR(curvature(k, l), difference / (4.0 * kStep * kStep), 1e-4 * curvature.norm())
            << k << ' ' << l;
      }
    }
  }
}

}  // namespace
}  // namespace mocha
