#pragma once

#include <vector>

#include "safety/curve_piece.h"
#include "safety/violation.h"
#include "world/moving/tube.h"
#include "world/obstacle_field.h"

namespace mocha {

/// What is proved of a bare curve, such as a benchmark's trajectory in space: a ball instead of a
/// footprint, no heading, no phases. Its times run from its own start.
///
/// As for motions, each check proves its property in continuous time and returns the first
/// violation: what is accepted holds; what is refused is violated or within 1 mm or a share of 1e-6
/// of it.
template <int D, int S>
class CurveCertificate {
 public:
  using Curve = PiecewisePolynomial<D, S>;
  using Violation = BasicViolation<D>;

  /// Throws std::invalid_argument for a curve without pieces.
  explicit CurveCertificate(const Curve& curve);

  /// Speed [m/s] and acceleration [m/s^2] by their norms.
  Violation check_limits(double max_speed, double max_acceleration) const;

  /// A ball of `radius_m` >= 0 about the curve keeps `margin_m` >= 0 to all obstacles of the field.
  Violation check_clearance(double radius_m, const ObstacleField<D>& field, double margin_m) const;

  /// A ball of `radius_m` >= 0 about the curve keeps `margin_m` >= 0 to what moves in the tube, at
  /// all times of the curve. What grows counts as large as it gets within one of its pieces.
  Violation check_separation(double radius_m, const Tube<D>& tube, double margin_m) const;

 private:
  double gap_m(const TubePiece<D>& piece, double t) const;

  Curve curve_;
  std::vector<CurvePiece<D, 2 * S - 1>> pieces_;
};

extern template class CurveCertificate<2, 3>;
extern template class CurveCertificate<3, 3>;

}  // namespace mocha
