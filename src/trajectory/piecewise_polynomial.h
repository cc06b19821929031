#pragma once

#include <Eigen/Core>
#include <vector>

namespace mocha {

using Vector2 = Eigen::Vector2d;

/// A D-dimensional curve p(t) [m] over t in [0, duration()] [s], made of polynomial pieces of
/// degree 2S - 1, paper (11).
///
/// Coefficients are kept in normalised time u = t / tau in [0, 1] of each piece: p_i(u) = sum_k
/// c_i[k] u^k. They relate to the paper's by c_paper[k] = c[k] / tau^k, and stay well scaled
/// whatever the durations are.
template <int D, int S>
class PiecewisePolynomial {
 public:
  static constexpr int kCoefficients = 2 * S;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Piece = Eigen::Matrix<double, D, kCoefficients>;  ///< column k: coefficient of u^k
  using State = Eigen::Matrix<double, D, S>;              ///< columns: derivatives 0 .. S-1

  struct Location {
    int piece;
    double u;  ///< normalised time within the piece, in [0, 1]
  };

  PiecewisePolynomial() = default;
  /// Throws std::invalid_argument if the sizes differ, are zero, or a duration is not positive and
  /// finite.
  PiecewisePolynomial(std::vector<Piece> pieces, std::vector<double> durations_s);

  int pieces() const { return static_cast<int>(pieces_.size()); }
  double duration() const { return knots_.empty() ? 0.0 : knots_.back(); }
  const Piece& piece(int i) const { return pieces_[i]; }
  double piece_duration(int i) const { return durations_[i]; }
  const std::vector<double>& durations() const { return durations_; }
  double piece_start(int i) const { return i == 0 ? 0.0 : knots_[i - 1]; }

  /// The piece that holds time t [s]; t is clamped into [0, duration()].
  Location locate(double t) const;

  /// The derivative of the given order (0: position) at time t [s], clamped into [0, duration()].
  Vector derivative(double t, int order) const;
  Vector derivative(const Location& at, int order) const;
  Vector position(double t) const { return derivative(t, 0); }

  /// Derivatives 0 .. S-1 at time t.
  State state(double t) const;

  /// The part from t0 to t1 [s]; the same curve, exactly up to rounding. What is left of a piece
  /// that is cut, if shorter than 2 ms, becomes part of its neighbour. Requires 0 <= t0 < t1 <=
  /// duration(), and a smooth curve (one of MINCO).
  PiecewisePolynomial slice(double t0, double t1) const;

  /// The same path driven in `factor` times the time.
  PiecewisePolynomial stretched(double factor) const;

 private:
  std::vector<Piece> pieces_;
  std::vector<double> durations_;
  std::vector<double> knots_;  // end time of each piece
};

extern template class PiecewisePolynomial<2, 2>;
extern template class PiecewisePolynomial<2, 3>;
extern template class PiecewisePolynomial<2, 4>;
extern template class PiecewisePolynomial<3, 2>;
extern template class PiecewisePolynomial<3, 3>;
extern template class PiecewisePolynomial<3, 4>;

using PlanarPath = PiecewisePolynomial<2, 3>;

}  // namespace mocha
