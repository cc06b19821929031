#include "simulation/pose_history.h"

#include <algorithm>

namespace mocha {

void PoseHistory::add(double time_s, const Pose& pose) {
  entries_.push_back({time_s, pose});
  while (entries_.size() > 2 && entries_[1].time_s < time_s - span_s_) entries_.pop_front();
}

Pose PoseHistory::at(double time_s) const {
  const auto next = std::lower_bound(entries_.begin(), entries_.end(), time_s,
                                     [](const Entry& entry, double t) { return entry.time_s < t; });
  if (next == entries_.begin()) return entries_.front().pose;
  if (next == entries_.end()) return entries_.back().pose;
  const Entry& before = *(next - 1);
  const double share = (time_s - before.time_s) / (next->time_s - before.time_s);
  const double turn = wrap_angle(next->pose.yaw_rad - before.pose.yaw_rad);
  return {before.pose.position + share * (next->pose.position - before.pose.position),
          wrap_angle(before.pose.yaw_rad + share * turn)};
}

}  // namespace mocha
