#pragma once

#include <cstdint>
#include <optional>

#include "trajectory/braking.h"
#include "trajectory/motion.h"

namespace mocha {

/// Names one committed motion of this robot.
struct MotionId {
  std::uint32_t epoch = 0;
  std::uint32_t sequence = 0;
};

inline bool operator==(const MotionId& a, const MotionId& b) {
  return a.epoch == b.epoch && a.sequence == b.sequence;
}

/// Until when (absolute) a motion may be driven.
struct Lease {
  MotionId id;
  double end_s = 0.0;
};

/// What a robot does on `motion` once its lease has ended: from `lease_end_s` on (absolute; at most
/// 0.1 s before `now_s`, where that was noticed late) it brakes along its path. A turn in place is
/// ended as well, and what has not begun does not begin.
Motion stop_at_lease_end(const Motion& motion, double lease_end_s, double now_s,
                         const Braking& braking);

/// Watches the lease of the committed motion, so that the peers can be told when it ends.
class LeaseWatch {
 public:
  /// A newly committed motion and the end of its first lease.
  void commit(const MotionId& id, Motion motion, double lease_end_s);
  /// Sets the end of the lease of the committed motion; those of other motions are ignored.
  void renew(const MotionId& id, double lease_end_s);
  /// The stop that the robot makes because its lease has ended: once, and not where the motion
  /// does the same, or moves no more.
  std::optional<Motion> expire(double now_s, const Braking& braking);

  /// The end of the lease (absolute); 0 without a motion.
  double end_s() const { return end_s_; }

 private:
  MotionId id_;
  std::optional<Motion> motion_;  // until it is replaced by its stop
  double end_s_ = 0.0;
};

}  // namespace mocha
