#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fleet/protocol/passing_messages.h"
#include "trajectory/motion.h"

namespace mocha {

/// Moves of a robot that it may make without a stop.
struct PassingStretch {
  PassingOrderId order;
  std::uint32_t from = 0;     ///< number of its first move, from 0 ...
  std::uint32_t until = 0;    ///< ... and of the one after its last
  std::vector<Vector2> path;  ///< of the centre, straight between; map frame

  const Vector2& end() const { return path.back(); }
  /// Whether it leads to the end of the same move, wherever it begins.
  bool ends_with(const PassingStretch& other) const {
    return order == other.order && until == other.until;
  }
};

/// The order that a robot keeps to: what it has been told of it, how far it has come, and what it
/// may do next.
class FollowedOrder {
 public:
  /// How many moves of this order a robot has promised, by name.
  using PromisedBy = std::function<std::uint32_t(const std::string&)>;

  /// The beginning of an order.
  explicit FollowedOrder(const PassingInstruction& beginning);
  /// Another part of the same; what does not fit to its beginning is not heeded.
  void add(const PassingInstruction& part);

  const PassingOrderId& id() const { return id_; }
  const std::vector<std::string>& robots() const { return robots_; }
  /// Where its first move begins; nothing where it has none, or not been told of it.
  std::optional<Vector2> start() const;
  /// What is left of it has nothing to do with others: the robot had better drive on as it likes.
  bool is_over() const { return made_ >= alone_from_; }
  /// How many there are.
  std::uint32_t moves() const { return static_cast<std::uint32_t>(turns_.size()); }
  std::uint32_t promised() const { return promised_; }

  /// Takes note of what is in force, of a robot that stands at a place, or is about to, and of one
  /// that drives by there.
  void note_promise(const Motion& committed);
  void note_stand(const Vector2& place, double tolerance_m);
  void note_drive(const Vector2& place);

  /// Grants the moves from the last stop on that may be made by now: none has to wait for another
  /// robot, they do not turn back, and do not come again to where they have led, so that each place
  /// tells how far the robot is. Where they end for one of the latter, as promised, and the next
  /// may be made, that is the last stop, though the robot still drives there. Nothing where it has
  /// to wait.
  std::optional<PassingStretch> grant(const PromisedBy& promised_by);
  /// The robots that have to promise moves before the one after the last stop may begin.
  std::vector<std::string> waits_for(const PromisedBy& promised_by) const;
  /// Which way the move after the last stop begins [rad]: a robot that waits can turn there.
  /// Nothing where there is none, or the robot was not told of it.
  std::optional<double> next_heading_rad() const;

 private:
  bool may_begin(std::size_t move, const PromisedBy& promised_by) const;
  /// Whether the moves from the last stop on are a stretch of their own before this one: it turns
  /// back, or comes to where they have led. All of them must be known.
  bool ends_stretch_before(std::uint32_t move) const;
  PassingStretch stretch_until(std::uint32_t until) const;

  PassingOrderId id_;
  std::vector<std::string> robots_;
  std::vector<std::optional<PassingTurn>> turns_;
  std::uint32_t alone_from_;
  std::uint32_t made_ = 0;      // before the last stop
  std::uint32_t promised_ = 0;  // made ones among them
  std::uint32_t granted_ = 0;   // the same
};

}  // namespace mocha
