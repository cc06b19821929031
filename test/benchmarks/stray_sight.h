#pragma once

#include <memory>
#include <set>
#include <vector>

#include "benchmarks/fleet_robot.h"
#include "benchmarks/robot_nodes.h"

namespace mocha {

/// What the lidars of robots, which know all that stands, show them of team-mates that are not
/// where they promised to be, because their nodes ended. Stands for perception: such a robot is a
/// thing that moves and, once it has stood for a second, part of the map until a promise accounts
/// for it. Without noise.
class StraySight {
 public:
  explicit StraySight(OccupancyGrid walls, int robots, double radius_m);

  /// Where all robots really are, as often as lidars sweep.
  void look(double now_s, const std::vector<RobotState>& truth);
  /// What robot `observer` knows now.
  RobotSenses senses(int observer, double now_s, const RobotNodes& nodes);
  /// Drops the maps that are kept in case they are needed again.
  void forget_maps() { drawn_.clear(); }

 private:
  bool sees(const Vector2& from, const Vector2& to) const;
  std::shared_ptr<const FleetMap> map_with(const std::vector<Vector2>& standing);

  const OccupancyGrid walls_;
  const double radius_m_;
  const std::shared_ptr<const FleetMap> map_;
  std::vector<RobotState> truth_;
  std::vector<double> stands_since_s_;
  std::vector<std::set<int>> strays_;  // that each robot has seen
  struct Drawn {
    std::vector<Vector2> standing;
    std::shared_ptr<const FleetMap> map;
  };
  std::vector<Drawn> drawn_;  // the newest
};

}  // namespace mocha
