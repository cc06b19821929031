#pragma once

#include <Eigen/Core>
#include <optional>

#include "topology/signatures/h_signature.h"

namespace mocha {

/// A space as a sampler sees it: the plane, space, or the plane with time as a third axis. Lengths
/// and distances between points are Euclidean unless stated, so a time is to be scaled to metres.
template <int D>
class SampledSpace {
 public:
  using Point = Eigen::Matrix<double, D, 1>;

  virtual ~SampledSpace() = default;

  /// The point for D shares in [0, 1): evenly spread shares give evenly spread points.
  virtual Point at(const Point& shares) const = 0;

  /// The clearance of a point [m], proved; nothing where one must not be.
  virtual std::optional<double> clearance_m(const Point& p) const = 0;

  /// Whether a path may come to q after p at all, whatever lies between.
  virtual bool in_order(const Point& /*p*/, const Point& /*q*/) const { return true; }

  /// A proved lower bound on the clearance along the straight line from p to q, which are in order
  /// [m]; nothing where one must not go.
  virtual std::optional<double> clearance_m(const Point& p, const Point& q) const = 0;

  virtual double length_m(const Point& p, const Point& q) const { return (q - p).norm(); }

  /// What the straight line from p to q adds to the class of a path.
  virtual SignatureKey key(const Point& p, const Point& q) const = 0;
};

}  // namespace mocha
