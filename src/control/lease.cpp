#include "control/lease.h"

#include <algorithm>
#include <utility>

#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kNoticedAfter_s = 0.1;
constexpr double kStand_s = 0.1;
constexpr double kSameTime_s = 0.1;
constexpr double kSamePlace_m = 0.02;

/// A motion that brakes at least as hard has no need of another stop.
bool stops_alike(const Motion& motion, const Motion& stop) {
  return motion.end_time() <= stop.end_time() + kSameTime_s &&
         (motion.end_pose().position - stop.end_pose().position).norm() <= kSamePlace_m;
}

}  // namespace

Motion stop_at_lease_end(const Motion& motion, double lease_end_s, double now_s,
                         const Braking& braking) {
  const double t = motion.clean_cut(std::max(lease_end_s, now_s - kNoticedAfter_s));
  if (t >= motion.start_time()) {
    if (MotionOrFault stop = try_brake(motion, t, t, braking)) return std::move(stop.motion);
  }
  return Motion(t, {StandPhase{motion.at(t).pose, kStand_s}});
}

void LeaseWatch::commit(const MotionId& id, Motion motion, double lease_end_s) {
  id_ = id;
  motion_ = std::move(motion);
  end_s_ = lease_end_s;
}

void LeaseWatch::renew(const MotionId& id, double lease_end_s) {
  if (id == id_) end_s_ = lease_end_s;
}

std::optional<Motion> LeaseWatch::expire(double now_s, const Braking& braking) {
  if (!motion_ || now_s <= end_s_) return std::nullopt;
  Motion stop = stop_at_lease_end(*motion_, end_s_, now_s, braking);
  if (stops_alike(*motion_, stop)) return std::nullopt;
  motion_.reset();
  return stop;
}

}  // namespace mocha
