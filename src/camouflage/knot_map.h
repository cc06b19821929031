#pragma once

#include <Eigen/Core>

namespace mocha {

/// By which variables knots are placed.
enum class Parameterisation { kNone, kCamouflage, kWaypoints };

/// How unconstrained optimisation variables place the interior knots of a trajectory.
template <int D>
class KnotMap {
 public:
  using Knots = Eigen::Matrix<double, D, Eigen::Dynamic>;

  virtual ~KnotMap() = default;

  virtual Parameterisation parameterisation() const = 0;

  /// Number of interior knots, and of variables; in all, and of one knot: at most D.
  virtual int knots() const = 0;
  virtual int variables() const = 0;
  virtual int variables_of(int knot) const = 0;

  /// The variables from which an optimisation starts: for knots on the prey path.
  virtual Eigen::VectorXd initial() const = 0;

  /// Knots [m] of `variables()` values starting at `x`; in `slopes`, of that size, it leaves what
  /// pull_back() needs. `knots` has the right size, too; nothing is allocated.
  virtual void place(const double* x, Knots& knots, Eigen::VectorXd& slopes) const = 0;

  /// Chain rule at the last place(): gradient by knots to gradient by variables, written from
  /// `by_x` on.
  virtual void pull_back(const Eigen::VectorXd& slopes, const Knots& by_knot,
                         double* by_x) const = 0;
};

/// The knots' coordinates themselves are the variables (plain MINCO).
template <int D>
class WaypointMap : public KnotMap<D> {
 public:
  using typename KnotMap<D>::Knots;
  explicit WaypointMap(const Knots& prey) : prey_(prey) {}

  Parameterisation parameterisation() const override { return Parameterisation::kWaypoints; }
  int knots() const override { return static_cast<int>(prey_.cols()); }
  int variables() const override { return static_cast<int>(prey_.size()); }
  int variables_of(int) const override { return D; }
  Eigen::VectorXd initial() const override {
    return Eigen::Map<const Eigen::VectorXd>(prey_.data(), prey_.size());
  }
  void place(const double* x, Knots& knots, Eigen::VectorXd&) const override {
    knots = Eigen::Map<const Knots>(x, D, prey_.cols());
  }
  void pull_back(const Eigen::VectorXd&, const Knots& by_knot, double* by_x) const override {
    Eigen::Map<Knots>(by_x, D, prey_.cols()) = by_knot;
  }

 private:
  Knots prey_;
};

}  // namespace mocha
