#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fleet/protocol/passing_messages.h"
#include "planning/candidates/planning_scene.h"
#include "planning/executive/heard_intents.h"
#include "planning/executive/told_obstacles.h"
#include "planning/global/planner_options.h"
#include "planning/passing/group_order.h"
#include "world/robot_model.h"

namespace mocha {

/// Whether an order was made within the last seconds.
bool is_recent(const PassingOrderId& order, double now_s);

/// The orders that a robot makes for its group, and has others told.
class PassingLeader {
 public:
  PassingLeader(std::string name, RobotModel robot, const PlannerOptions& options);
  void set_options(const PlannerOptions& options);

  /// Forgets the order that it has made.
  void retire() { order_.reset(); }
  /// Likewise where the robot keeps to another one by now.
  void retire_for(const PassingOrderId& other);

  /// Whether another robot, which keeps to the other order, has a part in the one that was made.
  bool competes(const PassingOrderId& other, const std::string& robot) const;
  /// What a team-mate says of the order that was made, and of obstacles.
  void hear(const PassingIntent& intent, double now_s);
  /// Whether one of those that were heard has a part in the order, and does not keep to it.
  bool is_not_kept(const std::vector<PassingIntent>& heard) const;
  /// Whether the newest order was made so long ago that it is not just unheard yet, or leads by
  /// obstacles that were not known.
  bool may_make_another(double now_s) const;

  /// Makes an order for those that say where they are to get, highest rank first, the robot itself
  /// among them, which comes to rest at `rest` and is at `here`. Returns what the robot itself is
  /// to do; nothing where there is no order.
  std::optional<PassingInstruction> make(const std::vector<PassingIntent>& intents,
                                         const Vector2& here, const Vector2& rest,
                                         const PlanningScene& scene, double now_s);

  /// Adds the instructions that are to be said now: to each robot that does not keep to the order
  /// yet, or has not been told all of it; and to its own robot, for people to see. An order that no
  /// datagram holds is void.
  void say(const HeardIntents& heard, double now_s, std::vector<PassingMessage>& messages);

 private:
  struct Order {
    PassingOrderId id;
    std::map<std::string, PassingInstruction> instructions;  ///< of each robot
    std::map<std::string, std::uint32_t> promised;           ///< moves of it, as far as was heard
    double made_s;
    bool is_obstructed = false;
  };

  std::vector<PassingMember> members_of(const std::vector<PassingIntent>& intents,
                                        const Vector2& rest, const PlanningScene& scene) const;
  std::optional<GroupOrder> order_for(const std::vector<PassingMember>& members, double radius_m,
                                      const PlanningScene& scene, double now_s) const;

  const std::string name_;
  const RobotModel robot_;
  TravelOptions travel_;
  ToldObstacles obstacles_;
  std::optional<Order> order_;
  std::uint32_t number_ = 0;  // of the orders that it has made
};

}  // namespace mocha
