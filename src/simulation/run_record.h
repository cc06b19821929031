#pragma once

#include <optional>

#include "simulation/vehicle.h"
#include "world/world_file.h"

namespace mocha {

/// When a goal counts as reached.
enum class Arrival {
  kStanding,  ///< standing within 0.15 m of it, and within 0.2 rad of its heading if it has one
  kNear       ///< within 1 m of it: BARN worlds
};

/// What one robot has achieved so far, by the truth.
class RunRecord {
 public:
  RunRecord(const Pose& start, const std::optional<Goal>& goal, Arrival arrival);

  /// After a step that ended at `time_s` [s] and drove `arc`.
  void update(double time_s, const Pose& pose, const Twist& twist, const Arc& arc);

  double path_length_m() const { return path_length_m_; }
  /// When it was first more than 0.1 m from its start [s].
  const std::optional<double>& moved_at_s() const { return moved_at_s_; }
  /// When it first was at its goal [s]; stays, whatever it does later.
  const std::optional<double>& reached_at_s() const { return reached_at_s_; }

 private:
  bool at_goal(const Pose& pose, const Twist& twist) const;

  Pose start_;
  std::optional<Goal> goal_;
  Arrival arrival_;
  double path_length_m_ = 0.0;
  std::optional<double> moved_at_s_;
  std::optional<double> reached_at_s_;
};

}  // namespace mocha
