#pragma once

#include <deque>

#include "trajectory/motion.h"

namespace mocha {

/// Where something was in the recent past.
class PoseHistory {
 public:
  /// Keeps at least the last `span_s` [s].
  explicit PoseHistory(double span_s) : span_s_(span_s) {}

  /// Times must increase.
  void add(double time_s, const Pose& pose);

  /// Linear between the poses added, the shorter way round in heading; clamped at both ends. Needs
  /// at least one pose.
  Pose at(double time_s) const;

 private:
  struct Entry {
    double time_s;
    Pose pose;
  };

  double span_s_;
  std::deque<Entry> entries_;
};

}  // namespace mocha
