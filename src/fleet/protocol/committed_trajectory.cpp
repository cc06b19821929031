#include "fleet/protocol/committed_trajectory.h"

#include <stdexcept>

#include "trajectory/separation.h"

namespace mocha {
namespace {

constexpr double kMaxRadius_m = 10.0;
constexpr double kMaxDuration_s = 3600.0;
constexpr double kMaxSpeed = 50.0;          // [m/s]
constexpr double kMaxAcceleration = 500.0;  // [m/s^2]

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument("promise: " + what);
}

}  // namespace

void validate(const CommittedTrajectory& trajectory) {
  require(!trajectory.agent.empty(), "has no name of a robot");
  require(trajectory.id.sequence > 0, "sequence is 0");
  if (trajectory.state == TrajectoryState::kWithdrawn) return;
  const double radius = trajectory.footprint_radius_m;
  require(radius > 0.0 && radius <= kMaxRadius_m,
          "footprint_radius = " + std::to_string(radius) + " m, allowed is above 0 up to 10 m");
  require(trajectory.motion != nullptr && !trajectory.motion->empty(), "has no motion");
  require(trajectory.motion->end_time() - trajectory.motion->start_time() <= kMaxDuration_s,
          "takes more than an hour");
  const MotionBounds bound = bounds(*trajectory.motion);
  require(bound.speed <= kMaxSpeed, "may be faster than 50 m/s");
  require(bound.acceleration <= kMaxAcceleration, "may accelerate by more than 500 m/s^2");
}

CommittedTrajectory reclocked(CommittedTrajectory trajectory, double later_s, double less_sure_s) {
  if (trajectory.motion == nullptr) return trajectory;
  const Motion& motion = *trajectory.motion;
  trajectory.footprint_radius_m += less_sure_s * bounds(motion).speed;
  trajectory.motion =
      std::make_shared<const Motion>(motion.start_time() + later_s, motion.phases());
  return trajectory;
}

}  // namespace mocha
