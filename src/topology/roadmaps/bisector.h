#pragma once

#include <vector>

#include "world/obstacle.h"

namespace mocha {

/// The line of all points that are equally far from two circles, of which neither may contain the
/// other: a branch of a hyperbola around the smaller one, straight if both are equally large.
///
/// The parameter t is 0 where it crosses the line of centres and grows to the left, seen from the
/// first circle; the clearance is least there and grows with |t|.
class Bisector {
 public:
  Bisector(const Circle& first, const Circle& second);

  Vector2 at(double t) const;
  double clearance_m(double t) const;        ///< to both circles, negative where they overlap
  double parameter(const Vector2& p) const;  ///< of a point on the line
  double reach(double clearance_m) const;    ///< the |t| of this clearance; 0 if all are larger

  /// The corners of a polyline from one parameter to the other, ends left out. Its clearance is
  /// smaller than the arc's by at most the share `loss` of it, or of 0.1 mm if that is more.
  std::vector<Vector2> corners(double from, double to, double loss) const;

 private:
  void refine(double from, double to, double loss, std::vector<Vector2>& corners) const;

  Vector2 centres_[2];
  Vector2 middle_;        // of the centres
  Vector2 along_;         // unit vector from the first to the second
  double mean_radius_m_;  // of the two
  double focal_m_;        // half the distance of the centres
  double real_m_;         // the semi-axis along: half the difference of the radii, signed
  double imaginary_m_;    // the other semi-axis
};

}  // namespace mocha
