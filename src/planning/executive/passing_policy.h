#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "control/robot_state.h"
#include "fleet/protocol/passing_messages.h"
#include "planning/executive/followed_order.h"
#include "planning/executive/heard_intents.h"
#include "planning/executive/impediment_watch.h"
#include "planning/executive/passing_leader.h"
#include "planning/executive/planner_interface.h"
#include "planning/global/planner_options.h"
#include "world/robot_model.h"

namespace mocha {

/// What a robot does, as far as it matters to those that it is to pass.
struct PassingSituation {
  double now_s;
  const RobotState& measured;
  const Motion& committed;      ///< not empty
  std::optional<Vector2> goal;  ///< none: it has reached all
};

/// How a robot and its team-mates get past each other. One that they keep from getting on calls for
/// an order, and all about it say where they are to get. The caller of the highest rank works out
/// in which order all pass, by which places (order_group()), and tells each its moves; who has been
/// told goes on move by move, each as soon as those before it are promised.
///
/// What follows. An order that was made leads all that it is for past each other, whatever their
/// timing, as long as they keep to it (PassingOrder) and the map holds; then the way to each goal
/// is free. Where not all can get to their goals, the highest ranks do. A robot that strays, gets
/// stuck for long, or takes another goal leaves the order, and calls anew if need be; one that has
/// obstacles on its way, by its own map, tells of them, for the next order to lead round. Orders
/// bind nobody: what may be driven is settled by promises alone.
class PassingPolicy {
 public:
  PassingPolicy(std::string name, int priority, RobotModel robot, const PlannerOptions& options);
  void set_options(const PlannerOptions& options);

  /// What a team-mate says.
  void hear(const PassingMessage& message, double now_s);
  /// The robot has another goal, or none: what was ordered is void.
  void begin_goal();

  /// To be called in each step of a robot that takes part; returns what is to be said.
  std::vector<PassingMessage> step(const PassingSituation& situation, const SceneSource& scene);
  /// The same for one that does not: it says nothing, and keeps to no order.
  void stay_out() { begin_goal(); }

  /// Whether it keeps to an order; then, what it may drive; nothing where it has to wait.
  bool follows() const { return followed_.has_value(); }
  /// Whether it had better drive no farther than it has promised: an order is being made.
  bool holds() const { return !follows() && holds_; }
  const std::optional<PassingStretch>& stretch() const { return stretch_; }
  /// Where it has to wait: which way it will go on [rad], if it knows.
  std::optional<double> next_heading_rad() const {
    return followed_ ? followed_->next_heading_rad() : std::nullopt;
  }

 private:
  void follow(const PassingInstruction& instruction);
  void leave_order();
  void take_up(const PassingSituation& situation, const SceneSource& scene);
  void progress(const PassingSituation& situation);
  void hold(double now_s);
  void watch(const PassingSituation& situation, const SceneSource& scene);
  bool is_let_down(double now_s) const;
  bool is_stuck(const PassingSituation& situation) const;
  void note_obstacles(const std::vector<PassingTurn>& turns, const PlanningScene& scene);
  bool leads(double now_s) const;
  void lead(const PassingSituation& situation, const SceneSource& scene);
  PassingIntent intent(const PassingSituation& situation) const;
  bool somebody_calls(double now_s) const;
  std::uint32_t promised_by(const std::string& name) const;
  void note_promised(double now_s);

  const std::string name_;
  const int priority_;
  const RobotModel robot_;
  TravelOptions travel_;
  HeardIntents heard_;
  PassingLeader leader_;
  ImpedimentWatch impediment_;
  bool calls_ = false;
  bool holds_ = false;
  double called_s_ = -std::numeric_limits<double>::infinity();  // the first call, after silence
  double calls_since_s_ = 0.0;
  double calls_until_s_ = 0.0;  // at least, after an order that it could not keep to
  std::optional<FollowedOrder> followed_;
  std::map<std::string, std::uint32_t> promised_;  // moves of it, by others
  PassingOrderId finished_;  // all its moves are made; others may wait for that
  std::uint32_t finished_moves_ = 0;
  PassingOrderId newest_;                      // heard of
  PassingOrderId void_;                        // was made for another goal
  std::optional<PassingInstruction> offered_;  // not taken up yet
  std::vector<Vector2> obstacles_;             // for which it has left, or not taken up, the newest
  std::optional<PassingStretch> stretch_;
  double news_s_ = 0.0;        // of anybody
  double progressed_s_ = 0.0;  // it, or who it waits for, got on last
  std::uint32_t seen_moves_ = 0;
  double said_s_ = -std::numeric_limits<double>::infinity();
  PassingIntent said_;
};

}  // namespace mocha
