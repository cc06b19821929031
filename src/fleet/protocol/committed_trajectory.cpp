#include "fleet/protocol/committed_trajectory.h"

#include <cmath>
#include <stdexcept>

#include "trajectory/separation.h"

namespace mocha {
namespace {

constexpr double kLargestFootprint_m = 10.0;
constexpr double kMaxDuration_s = 300.0;
constexpr double kLongestStop_s = 120.0;    // also bounds the work that a proof of stops takes
constexpr double kMaxSpeed = 50.0;          // [m/s]
constexpr double kMaxAcceleration = 500.0;  // [m/s^2]
constexpr double kGentlest = 0.02;          // [m/s^2] below what any robot model may have
constexpr double kHardest = 50.0;           // [m/s^2]

void require_of_promise(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument("promise: " + what);
}

void require_of_braking(double value, const char* name) {
  require_of_promise(
      value >= kGentlest && value <= kHardest,
      std::string(name) + " = " + std::to_string(value) + " m/s^2, allowed is 0.02 up to 50 m/s^2");
}

}  // namespace

void validate(const Braking& braking) {
  require_of_braking(braking.deceleration(), "deceleration");
  if (std::isfinite(braking.max_acceleration()))
    require_of_braking(braking.max_acceleration(), "max_acceleration");
}

void validate(const CommittedTrajectory& trajectory) {
  require_of_promise(!trajectory.agent.empty(), "has no name of a robot");
  require_of_promise(trajectory.id.sequence > 0, "sequence is 0");
  if (trajectory.state == TrajectoryState::kWithdrawn) return;
  const double radius = trajectory.footprint_radius_m;
  require_of_promise(
      radius > 0.0 && radius <= kLargestFootprint_m,
      "footprint_radius = " + std::to_string(radius) + " m, allowed is above 0 up to 10 m");
  require_of_promise(trajectory.braking.has_value(), "does not say how its robot brakes");
  validate(*trajectory.braking);
  require_of_promise(trajectory.motion != nullptr && !trajectory.motion->empty(), "has no motion");
  require_of_promise(
      trajectory.motion->end_time() - trajectory.motion->start_time() <= kMaxDuration_s,
      "takes more than five minutes");
  const MotionBounds bound = bounds(*trajectory.motion);
  require_of_promise(bound.speed <= kMaxSpeed, "may be faster than 50 m/s");
  require_of_promise(bound.speed <= kLongestStop_s * trajectory.braking->deceleration(),
                     "may take more than two minutes to stop");
  require_of_promise(bound.acceleration <= kMaxAcceleration,
                     "may accelerate by more than 500 m/s^2");
}

CommittedTrajectory reclocked(CommittedTrajectory trajectory, double later_s) {
  if (trajectory.motion == nullptr) return trajectory;
  const Motion& motion = *trajectory.motion;
  trajectory.motion =
      std::make_shared<const Motion>(motion.start_time() + later_s, motion.phases());
  return trajectory;
}

}  // namespace mocha
