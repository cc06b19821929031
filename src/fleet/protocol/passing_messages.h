#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// Which order of passing: the robot that made it, and a number that it counts up, also over its
/// starts.
struct PassingOrderId {
  std::string leader;
  std::uint32_t epoch = 0;   ///< of the leader where it sends the order; does not tell orders apart
  std::uint32_t number = 0;  ///< from 1; 0: none

  bool operator==(const PassingOrderId& other) const {
    return std::tie(leader, number) == std::tie(other.leader, other.number);
  }
  bool operator!=(const PassingOrderId& other) const { return !(*this == other); }
};

/// "This is where I am to get, and so far I have come": said again and again by robots that stand
/// in each other's way, and by those about them, as long as one of them calls for an order.
struct PassingIntent {
  std::string agent;
  std::uint32_t epoch = 0;
  int priority = 0;
  bool calls = false;           ///< it cannot get on by itself
  double radius_m = 0.0;        ///< circumscribed
  std::optional<Vector2> goal;  ///< map frame; none: it is parked, and makes room as it likes
  PassingOrderId follows;       ///< the order that it keeps to
  std::uint32_t moves = 0;      ///< of that order, which it has promised to make
  /// Why it does not keep to the newest order that it was told of: what stands on its way there, by
  /// its own map; map frame [m].
  std::vector<Vector2> obstacles = {};
};

/// So many of its moves a robot has to have promised.
struct PassingProgress {
  std::uint32_t robot = 0;  ///< index into the robots of the order
  std::uint32_t moves = 0;
};

/// One move of a robot.
struct PassingTurn {
  std::vector<Vector2> path;           ///< of the centre, straight between; map frame [m]
  std::vector<PassingProgress> after;  ///< of others, at most one each: before it must not begin
};

/// What an order asks of one robot. Where it does not fit into a datagram, a part: the turns from
/// `first` on.
struct PassingInstruction {
  PassingOrderId id;
  std::string robot;                ///< whom it is for
  std::vector<std::string> robots;  ///< all that the order is for
  std::uint32_t turns = 0;          ///< so many there are altogether
  std::uint32_t alone_from = 0;     ///< no turn from this number on has to do with others
  std::uint32_t first = 0;          ///< number of part.front(), from 0
  std::vector<PassingTurn> part;
};

using PassingMessage = std::variant<PassingIntent, PassingInstruction>;

/// Whether a goes first: the higher priority, then the smaller name. A total order over the fleet.
inline bool outranks(const PassingIntent& a, const PassingIntent& b) {
  return a.priority != b.priority ? a.priority > b.priority : a.agent < b.agent;
}

constexpr std::size_t kMostPassing = 32;    // robots of an order
constexpr std::size_t kMostTurns = 400;     // of one robot
constexpr std::size_t kMostTurnPlaces = 8;  // of the path of one turn
constexpr std::size_t kMostObstacles = 16;  // that a robot tells of

/// Throws std::invalid_argument, saying what is wrong, for what no robot can have meant: no name, a
/// radius outside (0, 10] m, places that are not finite, too many of anything.
void validate(const PassingIntent& intent);
/// Likewise: no name, no number, a robot that the order is not for, too many of anything, a path of
/// less than two places, a part that goes beyond the end, progress of a robot that is not there or
/// of the robot itself.
void validate(const PassingInstruction& instruction);

}  // namespace mocha
