#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fleet/protocol/passing_messages.h"
#include "ros_bridge/rviz/markers.h"

namespace mocha {

/// What one robot has been told about passing others, and how far all have come, for rviz.
class PassingDrawing {
 public:
  explicit PassingDrawing(std::string robot);

  /// What the robot says or hears.
  void note(const PassingIntent& intent);
  void note(const PassingInstruction& instruction);
  void note(const PassingMessage& message);

  /// Its turns, from the last one that it has promised on: the paths of those that it may make
  /// broad, those of the rest thin, and their ends as squares. Where it does not keep to the newest
  /// order: the obstacles that it tells of.
  void draw(Drawing& drawing) const;

 private:
  struct Order {
    PassingOrderId id;
    std::vector<std::string> robots;
    std::map<std::uint32_t, PassingTurn> turns;  ///< by number; as far as it has been told of them
  };

  bool may_make(const PassingTurn& turn) const;

  const std::string robot_;
  std::vector<Vector2> obstacles_;
  Order offered_;                                  // the newest that it does not keep to
  Order followed_;                                 // number 0: none
  std::map<std::string, std::uint32_t> promised_;  // turns of the order, by robot
};

}  // namespace mocha
