#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fleet/model/action.h"
#include "fleet/model/driven_promises.h"
#include "fleet/model/scenario.h"
#include "fleet/protocol/commitment_protocol.h"

namespace mocha {
class ProtocolFingerprint;
}

namespace mocha::test {

/// What became of the motion that a robot proposed last.
enum class Fate { kNone, kPending, kSettled, kLost, kInVain };

/// A robot's proposal that is not settled yet, by its own clock.
struct PendingProposal {
  std::uint32_t tag;
  double since_s;
  double start_s;
};

/// One robot: the real protocol, and the truth about it.
struct RobotState {
  CommitmentProtocol protocol;
  DrivenPromises driven;
  bool asleep = false;  ///< says and hears nothing
  std::optional<PendingProposal> pending;
  Fate fate = Fate::kNone;
  int proposed = 0;             ///< motions of its script, or passed over
  std::vector<double> heard_s;  ///< the last heartbeat of each, by its own clock
};

struct MessageUnderWay {
  int from;
  int to;
  int due_step;  ///< it is delivered, delayed or lost then
  std::shared_ptr<const Message> message;
};

/// Two or three robots that run the real CommitmentProtocol in discrete time, and all that may
/// happen to them: a value, so that every choice can be tried from every state.
///
/// In each step time goes on for all robots, then one after the other has its turn: each message
/// that is due to it is delivered, delayed or lost, in any order, and it may propose, brake or
/// start anew between any two. What is sent is due in the next step, so turns commute, and one
/// order of them is enough. A heartbeat's stamp and echoes are made as it arrives: an exchange
/// tells the other's clock exactly (how well it does in truth is ClockEstimate's business).
class ProtocolModel {
 public:
  /// All robots stand at home, have promised so, and know each other.
  explicit ProtocolModel(std::shared_ptr<const Scenario> scenario);

  /// What may happen now; nothing where the model has ended, or no motion can be settled any more.
  std::vector<Action> actions() const;
  void apply(const Action& action);
  /// The action in words, before it is applied.
  std::string describe(const Action& action) const;

  /// Restores all links; from now on nothing new is proposed and no harm done.
  void calm_down();
  /// The rest of the step without harm, and the beginning of the next.
  void calm_step();

  /// Of the safety property; empty: none.
  const std::string& violation() const { return violation_; }
  /// Whether the motion that a robot proposed last has been settled.
  bool any_settled() const;
  /// Nobody has restarted, braked, or been refused in vain.
  bool undisturbed() const { return undisturbed_; }
  const Scenario& scenario() const { return *scenario_; }
  const RobotState& robot(int i) const { return *robots_[i]; }
  int step() const { return step_; }
  /// By the clock of robot i.
  double now(int i) const;
  /// The robots of which robot i has heard a heartbeat within the reach timeout: bit j for robot j.
  unsigned reach(int i) const;

 private:
  friend class mocha::ProtocolFingerprint;

  bool over() const;
  void add_message_actions(int robot, std::vector<Action>& actions) const;
  void add_own_actions(int robot, std::vector<Action>& actions) const;
  void add_link_actions(std::vector<Action>& actions) const;
  bool due(const MessageUnderWay& message) const { return message.due_step <= step_; }
  const ScriptedMotion* next_motion(int robot) const;
  bool cut(int i, int j) const { return cut_.count(std::minmax(i, j)) > 0; }

  void go_on();
  void deliver(int which, bool again);
  void propose(int robot);
  void brake(int robot);
  void restart(int robot);
  void wake_up(int robot);
  void set_link(int i, int j, bool cut_off);

  RobotState& changed(int robot);
  void take(int robot, const CommitmentActions& actions, bool resumes = false);
  void send(int robot, Message message);
  void note(int robot, const CommitmentEvent& event);
  unsigned asked(int robot) const;
  Proposal proposal(int robot, Motion motion) const;

  std::shared_ptr<const Scenario> scenario_;
  std::vector<std::shared_ptr<RobotState>> robots_;  // shared until one changes
  std::vector<MessageUnderWay> under_way_;
  std::set<std::pair<int, int>> cut_;  // the smaller number first
  Harm left_;
  int step_ = 0;
  int turn_ = 0;  // robots before this one have had theirs
  bool undisturbed_ = true;
  std::string violation_;
};

}  // namespace mocha::test
