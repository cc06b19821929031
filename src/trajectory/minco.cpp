#include "trajectory/minco.h"

#include <Eigen/LU>
#include <array>
#include <cassert>

#include "trajectory/hermite.h"

namespace mocha {
namespace {

// These helpers are always inlined for speed, and because the interprocedural analysis of GCC 12
// (ipa-modref) overlooks that such a loop reads all columns, and drops the stores before the call.

/// The same column, with a zero below it where that makes the number of rows even.
template <int Rows, typename Expression>
EIGEN_ALWAYS_INLINE Eigen::Matrix<double, Rows, 1> padded(const Expression& column) {
  Eigen::Matrix<double, Rows, 1> result;
  result.template head<Expression::RowsAtCompileTime>() = column;
  if (Rows > Expression::RowsAtCompileTime) result[Rows - 1] = 0.0;
  return result;
}

/// Column c of the result is the sum of columns r times table(r, c). Unlike Eigen's products, which
/// fuse multiplication and addition where the processor can, it gives the same bits everywhere.
template <int R, int C, typename Table>
EIGEN_ALWAYS_INLINE Eigen::Matrix<double, R, C> times(const Eigen::Matrix<double, R, C>& columns,
                                                      const Table& table) {
  Eigen::Matrix<double, R, C> result;
  for (int c = 0; c < C; ++c) {
    result.col(c) = table(0, c) * columns.col(0);
    for (int r = 1; r < C; ++r) result.col(c) += table(r, c) * columns.col(r);
  }
  return result;
}

/// The sum of the rows, in the same order everywhere.
template <int R>
EIGEN_ALWAYS_INLINE double total(const Eigen::Matrix<double, R, 1>& column) {
  double sum = column[0] + column[1];
  for (int r = 2; r < R; ++r) sum += column[r];
  return sum;
}

/// Derivatives by time become derivatives by normalised time; gradients by the latter become
/// gradients by the former.
template <int R, int S>
EIGEN_ALWAYS_INLINE Eigen::Matrix<double, R, S> scaled(Eigen::Matrix<double, R, S> derivatives,
                                                       double tau) {
  double power = tau;
  for (int k = 1; k < S; ++k, power *= tau) derivatives.col(k) *= power;
  return derivatives;
}

/// By how much the end misses the Taylor expansion about the start.
template <int R, int S>
EIGEN_ALWAYS_INLINE Eigen::Matrix<double, R, S> gap(const Eigen::Matrix<double, R, S>& start,
                                                    const Eigen::Matrix<double, R, S>& end) {
  Eigen::Matrix<double, R, S> gap = end - start;
  for (int k = 0; k < S; ++k) {
    for (int l = k + 1; l < S; ++l) gap.col(k) -= taylor_weight(k, l) * start.col(l);
  }
  return gap;
}

/// rate^(2S-1): the effort of a piece that lasts 1 / rate, by that of the same in normalised time.
template <int S>
double effort_scale(double rate) {
  double power = rate;
  for (int j = 1; j < S; ++j) power *= rate * rate;
  return power;
}

/// Half the effort's second derivatives by the free derivatives at the ends of a piece, and by its
/// displacement.
template <int S>
struct Stiffness {
  Eigen::Matrix<double, S - 1, S - 1> end;    ///< both at the end
  Eigen::Matrix<double, S - 1, S - 1> cross;  ///< row at the end, column at the start
  Eigen::Matrix<double, S - 1, 1> pull;       ///< end by displacement

  explicit Stiffness(double rate) {
    static constexpr auto kByGap = forces_by_gap<S>();
    static constexpr auto kByStart = forces_by_start<S>();
    std::array<double, 2 * S - 1> power;  // by the sum of the orders of two derivatives
    power[2 * S - 2] = rate;
    for (int order = 2 * S - 2; order > 0; --order) power[order - 1] = power[order] * rate;
    for (int k = 1; k < S; ++k) {
      pull[k - 1] = kByGap(k, 0) * power[k];
      for (int l = 1; l < S; ++l) {
        end(k - 1, l - 1) = kByGap(k, l) * power[k + l];
        cross(k - 1, l - 1) = kByStart(k, l) * power[k + l];
      }
    }
  }
};

}  // namespace

template <int D, int S>
void Minco<D, S>::resize(int pieces) {
  assert(pieces >= 1);
  states_.assign(pieces + 1, Derivatives::Zero());
  pieces_.resize(pieces);
  tau_.resize(pieces);
  rate_.resize(pieces);
  forces_.resize(pieces);
  efforts_.resize(pieces);
  inverse_.assign(pieces, Block::Zero());
  below_.assign(pieces, Block::Zero());
  adjoint_.assign(pieces, Free::Zero());
}

template <int D, int S>
void Minco<D, S>::solve(const State& start, const State& end, const Knots& knots,
                        const Eigen::VectorXd& durations_s) {
  const int m = pieces();
  assert(durations_s.size() == m && knots.cols() == m - 1);
  states_.front().template topRows<D>() = start;
  states_.back().template topRows<D>() = end;
  for (int i = 0; i < m; ++i) {
    tau_[i] = durations_s[i];
    rate_[i] = 1.0 / durations_s[i];
    if (i > 0) states_[i].col(0).template head<D>() = knots.col(i - 1);
  }
  eliminate();
  Free free = states_[m].template rightCols<kFree>();
  for (int i = m - 1; i > 0; --i) {
    const Free right = states_[i].template rightCols<kFree>();
    free = times(right, inverse_[i]) - times(free, below_[i]);
    states_[i].template rightCols<kFree>() = free;
    shape(i);
  }
  shape(0);
}

/// Factors the conditions on the free derivatives and leaves the eliminated right-hand side in
/// their place.
template <int D, int S>
void Minco<D, S>::eliminate() {
  Block block = Block::Zero();
  Free right = Free::Zero();
  for (int i = 0; i < pieces(); ++i) {
    const Stiffness<S> stiffness(rate_[i]);
    const Column displacement = states_[i + 1].col(0) - states_[i].col(0);
    if (i == 0) {
      const Free start = states_[0].template rightCols<kFree>();
      block = stiffness.end;
      right = -times(start, stiffness.cross.transpose());
    } else {
      // The start of a piece is its end in a mirror: odd derivatives change sign.
      for (int k = 0; k < kFree; ++k) {
        right.col(k) -= (k % 2 == 0 ? 1 : -1) * stiffness.pull[k] * displacement;
        for (int l = 0; l < kFree; ++l) {
          block(k, l) += ((k + l) % 2 == 0 ? 1 : -1) * stiffness.end(k, l);
        }
      }
      const Block inverse = block.inverse();
      const Block below = times(stiffness.cross, inverse);
      states_[i].template rightCols<kFree>() = right;
      inverse_[i] = inverse;
      below_[i] = below;
      block = stiffness.end - times(below, stiffness.cross.transpose());
      right = -times(right, below.transpose());
    }
    for (int k = 0; k < kFree; ++k) right.col(k) -= stiffness.pull[k] * displacement;
  }
}

/// Coefficients, forces and effort of a piece whose ends are known.
template <int D, int S>
void Minco<D, S>::shape(int i) {
  static constexpr auto kCoefficients = coefficients_by_gap<S>();
  static constexpr auto kForces = forces_by_gap<S>();
  const Derivatives start = scaled(states_[i], tau_[i]);
  const Derivatives missed = gap(start, scaled(states_[i + 1], tau_[i]));
  const Derivatives bend = times(missed, kCoefficients);
  const Derivatives forces = times(missed, kForces);
  for (int k = 0; k < S; ++k) {
    pieces_[i].col(k) = taylor_weight(0, k) * start.col(k).template head<D>();
    pieces_[i].col(S + k) = bend.col(k).template head<D>();
  }
  Column sum = missed.col(0).cwiseProduct(forces.col(0));
  for (int k = 1; k < S; ++k) sum += missed.col(k).cwiseProduct(forces.col(k));
  forces_[i] = forces;
  efforts_[i] = effort_scale<S>(rate_[i]) * total(sum);
}

template <int D, int S>
auto Minco<D, S>::curve() const -> Curve {
  return Curve(pieces_, tau_);
}

template <int D, int S>
double Minco<D, S>::effort() const {
  double sum = 0.0;
  for (const double effort : efforts_) sum += effort;
  return sum;
}

template <int D, int S>
void Minco<D, S>::add_effort_gradient(double weight, std::vector<Piece>& by_piece,
                                      Eigen::VectorXd& by_duration) const {
  for (int i = 0; i < pieces(); ++i) {
    const Derivatives by_gap = 2.0 * weight * effort_scale<S>(rate_[i]) * forces_[i];
    for (int j = S; j < 2 * S; ++j) {
      Column sum = by_gap.col(0);
      for (int k = 1; k < S; ++k) sum += falling_factorial(j, k) * by_gap.col(k);
      by_piece[i].col(j) += sum.template head<D>();
    }
    by_duration[i] += (1 - 2 * S) * weight * rate_[i] * efforts_[i];
  }
}

template <int D, int S>
void Minco<D, S>::propagate(const std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration,
                            Knots& by_knot) {
  static constexpr auto kForces = forces_by_gap<S>();
  pull_back(by_piece, by_duration, by_knot);
  // The adjoint: how J feels the conditions on the free derivatives.
  Free free = Free::Zero();
  Derivatives start = Derivatives::Zero();
  for (int i = pieces() - 1; i >= 0; --i) {
    const Derivatives end = scaled(start, tau_[i]);
    free = times(adjoint_[i], inverse_[i]) - times(free, below_[i]);
    start.template rightCols<kFree>() = free;
    const Derivatives reaction = times(gap(scaled(start, tau_[i]), end), kForces);
    const double scale = effort_scale<S>(rate_[i]);
    const Eigen::Matrix<double, D, 1> force = scale * reaction.col(0).template head<D>();
    if (i + 1 < pieces()) by_knot.col(i) -= force;
    if (i > 0) by_knot.col(i - 1) += force;
    // Let the piece last longer: its end moves on along it, and the forces there change.
    const Derivatives now = scaled(states_[i + 1], tau_[i]);
    Column sum = reaction.col(S - 1).cwiseProduct(forces_[i].col(S - 1));
    for (int k = 1; k < S; ++k) {
      sum += end.col(k).cwiseProduct(forces_[i].col(k - 1)) +
             reaction.col(k - 1).cwiseProduct(now.col(k));
    }
    by_duration[i] += scale * rate_[i] * total(sum);
  }
}

/// Gradients by pieces become gradients by states and durations. Those by positions are left in
/// `by_knot`; those by free derivatives in `adjoint_`, eliminated as a right-hand side.
template <int D, int S>
void Minco<D, S>::pull_back(const std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration,
                            Knots& by_knot) {
  static constexpr auto kCoefficients = coefficients_by_gap<S>();
  Derivatives by_state = Derivatives::Zero();
  for (int i = 0; i < pieces(); ++i) {
    Derivatives by_start;
    Derivatives by_end = Derivatives::Zero();
    for (int j = 0; j < S; ++j) {
      by_start.col(j) = taylor_weight(0, j) * padded<kRows>(by_piece[i].col(j));
      const Column by_bend = padded<kRows>(by_piece[i].col(S + j));
      for (int k = 0; k < S; ++k) by_end.col(k) += kCoefficients(k, j) * by_bend;
    }
    for (int l = 0; l < S; ++l) {
      for (int k = 0; k <= l; ++k) by_start.col(l) -= taylor_weight(k, l) * by_end.col(k);
    }
    by_start = scaled(by_start, tau_[i]);
    by_end = scaled(by_end, tau_[i]);
    Column sum = Column::Zero();
    for (int k = 1; k < S; ++k) {
      sum += k * (by_start.col(k).cwiseProduct(states_[i].col(k)) +
                  by_end.col(k).cwiseProduct(states_[i + 1].col(k)));
    }
    by_duration[i] += rate_[i] * total(sum);
    by_state += by_start;
    if (i > 0) by_knot.col(i - 1) = by_state.col(0).template head<D>();
    const Free free = by_state.template rightCols<kFree>();
    adjoint_[i] = free;
    by_state = by_end;
    by_state.template rightCols<kFree>() -= times(free, below_[i].transpose());
  }
}

template class Minco<2, 2>;
template class Minco<2, 3>;
template class Minco<2, 4>;
template class Minco<3, 2>;
template class Minco<3, 3>;
template class Minco<3, 4>;

}  // namespace mocha
