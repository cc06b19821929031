#pragma once

#include <Eigen/Core>
#include <array>

#include "optimization/piece_bounds.h"

namespace mocha {

/// phi(x) = max(0, x)^3, paper (31), and its derivative.
struct Cubic {
  double value;
  double slope;
};

inline Cubic cubic(double x) {
  if (x <= 0.0) return {0.0, 0.0};
  return {x * x * x, 3.0 * x * x};
}

/// A set of derivatives of a trajectory, as bits: 1 << order; and its time.
using Derivatives = unsigned;
constexpr int kOrders = 4;
constexpr Derivatives kNone = 0;
constexpr Derivatives kPosition = 1;
constexpr Derivatives kVelocity = 2;
constexpr Derivatives kAcceleration = 4;
constexpr Derivatives kJerk = 8;
constexpr Derivatives kTime = 16;

/// One piece of a trajectory at kappa + 1 uniform times, a row each: what penalties see. What no
/// penalty wants holds nothing of use.
template <int D>
struct PieceSamples {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, D>;

  explicit PieceSamples(int samples) : time_s(samples) {
    for (Rows& rows : derivative) rows.resize(samples, D);
  }

  int size() const { return static_cast<int>(time_s.size()); }
  const Rows& position() const { return derivative[0]; }      ///< [m]
  const Rows& velocity() const { return derivative[1]; }      ///< [m/s]
  const Rows& acceleration() const { return derivative[2]; }  ///< [m/s^2]
  const Rows& jerk() const { return derivative[3]; }          ///< [m/s^3]

  std::array<Rows, kOrders> derivative;
  Eigen::VectorXd time_s;  ///< from the start of the trajectory: tau_f of paper (22)
  PieceBounds<D> bounds;   ///< hold for the whole piece
};

/// Penalty of each sample of a piece, and its gradient by the sample's entries; penalties add to
/// them.
template <int D>
struct PenaltyRows {
  using Rows = typename PieceSamples<D>::Rows;

  explicit PenaltyRows(int samples) : value(samples), by_time(samples) {
    for (Rows& rows : by_derivative) rows.resize(samples, D);
  }

  Rows& by_position() { return by_derivative[0]; }
  Rows& by_velocity() { return by_derivative[1]; }
  Rows& by_acceleration() { return by_derivative[2]; }
  Rows& by_jerk() { return by_derivative[3]; }

  Eigen::VectorXd value;  ///< [1/s]
  std::array<Rows, kOrders> by_derivative;
  Eigen::VectorXd by_time;
};

/// One term of J_p, paper (14): what every instant of a trajectory costs, paper (21).
///
/// Penalties are dimensionless: what is to be avoided is measured against its limit before paper
/// (31) is applied, so that one set of weights serves robots of every size. The paper's form
/// follows with the weight times the limit to the sixth.
template <int D>
class Penalty {
 public:
  virtual ~Penalty() = default;
  /// A short name for reports, such as "obstacle".
  virtual const char* name() const = 0;
  /// The derivatives that add() looks at on a piece. kNone only where the penalty is certainly zero
  /// all along it, as most are on most pieces: such a piece is not even sampled.
  virtual Derivatives wanted(const PieceBounds<D>& piece) const = 0;
  /// Adds the weighted penalty [1/s] and its gradient at every sample.
  virtual void add(const PieceSamples<D>& samples, PenaltyRows<D>& rows) const = 0;
};

}  // namespace mocha
