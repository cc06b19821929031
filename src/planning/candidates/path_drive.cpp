#include "planning/candidates/path_drive.h"

#include "safety/certificate.h"
#include "trajectory/minco.h"
#include "trajectory/time_scaling.h"

namespace mocha {
namespace {

constexpr double kLongestStretch = 10.0;  // of the time that the profile asks for
constexpr double kSlower = 1.2;

}  // namespace

std::optional<DrivePhase> drive_along(const std::vector<Vector2>& path, const PathDrive& how,
                                      const MotionLimits& limits) {
  const InitialKnots<2> knots =
      spread_knots<2>(path, 0.0, how.wanted, how.spacing_m, how.fastest_at);
  const int last = static_cast<int>(knots.path.cols()) - 1;
  const double acceleration = 0.5 * how.wanted.max_acceleration;
  PlanarMinco::State from;
  PlanarMinco::State to;
  from << knots.path.col(0), Vector2::Zero(), acceleration * how.first_course;
  to << knots.path.col(last), Vector2::Zero(), -acceleration * how.last_course;
  PlanarMinco minco;
  minco.resize(last);
  minco.solve(from, to, knots.path.middleCols(1, last - 1), knots.durations_s);
  const PlanarPath curve = minco.curve();
  const auto stretch =
      smallest_stretch(curve, {how.wanted.max_speed, how.wanted.max_acceleration, kLongestStretch});
  if (!stretch) return std::nullopt;
  for (double slower = *stretch; slower <= kLongestStretch; slower *= kSlower) {
    const DrivePhase drive{how.direction, curve.stretched(slower)};
    if (!check_limits(Motion(0.0, {drive}), limits, 0.0)) return drive;
  }
  return std::nullopt;
}

}  // namespace mocha
