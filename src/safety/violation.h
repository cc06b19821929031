#pragma once

#include <Eigen/Core>
#include <string>

namespace mocha {

/// What a motion violates.
enum class ViolatedTerm {
  kNothing,
  kClearance,      ///< [m] body to static obstacle
  kSpeed,          ///< [m/s]
  kAcceleration,   ///< [m/s^2] of the base, or [rad/s^2] of a turn in place
  kYawRate,        ///< [rad/s]
  kSeparation,     ///< [m] own disc to a moving obstacle's disc
  kUnseenSpace,    ///< cannot stop inside space that was seen free
  kWheelSpeed,     ///< [m/s] of the faster wheel
  kSpeedBackward,  ///< [m/s] of a base that cannot drive backward
  kZoneSpeed,      ///< [m/s] in a speed zone
};

/// The first moment at which something that moves in D dimensions breaks a limit; false if there is
/// none.
template <int D>
struct BasicViolation {
  using Vector = Eigen::Matrix<double, D, 1>;

  ViolatedTerm term = ViolatedTerm::kNothing;
  double time_s = 0.0;            ///< absolute for a motion, from its start for a bare curve
  Vector place = Vector::Zero();  ///< [m] of the base, map frame
  /// The worst of the stretch that begins at time_s, in the unit of the term; infinite where place,
  /// velocity or heading jump.
  double value = 0.0;
  double limit = 0.0;  ///< in the unit of the term; a minimum for distances, a maximum otherwise
  std::string peer;    ///< kSeparation: name of the moving obstacle; kZoneSpeed: of the zone

  explicit operator bool() const { return term != ViolatedTerm::kNothing; }
};

using Violation = BasicViolation<2>;

/// In words: what is violated, by how much and where. "no violation" if there is none.
std::string describe(const BasicViolation<2>& violation);
std::string describe(const BasicViolation<3>& violation);

}  // namespace mocha
