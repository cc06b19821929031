#pragma once

#include <limits>
#include <optional>

#include "planning/candidates/planning_scene.h"
#include "topology/static_map/travel_options.h"
#include "world/robot_model.h"

namespace mocha {

/// Whether a robot cannot get on because of its team-mates: it has stood for a while, though it
/// wants to go on, while one of them is to come to rest on its way. Where there is another way,
/// that while is longer; where there is none, it is impeded for as long as one rests there.
class ImpedimentWatch {
 public:
  /// A robot that stands, or does not, at `here` on its way to `goal`; on the newest look. Looks at
  /// the way twice a second at most.
  bool is_impeded(bool stands, const Vector2& here, const Vector2& goal, const PlanningScene& scene,
                  const RobotModel& robot, const TravelOptions& travel, double now_s);
  /// The robot is to go another way.
  void reset() { *this = ImpedimentWatch(); }

 private:
  std::optional<double> stands_since_s_;
  double looked_s_ = -std::numeric_limits<double>::infinity();
  bool is_impeded_ = false;
};

}  // namespace mocha
