// What may happen in a ProtocolModel, and how it reads.
#include "fleet/model/protocol_model.h"

namespace mocha::test {
namespace {

const char* name_of(TrajectoryState state) {
  switch (state) {
    case TrajectoryState::kProposed:
      return "proposed";
    case TrajectoryState::kCommitted:
      return "committed";
    case TrajectoryState::kEmergency:
      return "emergency";
    case TrajectoryState::kWithdrawn:
      return "withdrawn";
  }
  return "unknown";
}

std::string text_of(TrajectoryId id, TrajectoryState state) {
  return std::to_string(id.epoch) + "/" + std::to_string(id.sequence) + " " + name_of(state);
}

std::string text_of(const Message& message) {
  if (const auto* trajectory = std::get_if<CommittedTrajectory>(&message))
    return text_of(trajectory->id, trajectory->state);
  const auto& heartbeat = std::get<Heartbeat>(message);
  std::string text = "heartbeat of epoch " + std::to_string(heartbeat.epoch) + " (";
  for (const Acknowledgement& line : heartbeat.acknowledgements)
    text += line.agent + " " + text_of(line.id, line.state) + ", ";
  return text + std::to_string(heartbeat.echoes.size()) + " echoes)";
}

Action action(Action::Kind kind, int robot = 0, int which = 0) {
  return {kind, static_cast<std::uint8_t>(robot), static_cast<std::uint8_t>(which)};
}

}  // namespace

const ScriptedMotion* ProtocolModel::next_motion(int i) const {
  const std::vector<ScriptedMotion>& script = scenario_->robots[i].script;
  const auto next = static_cast<std::size_t>(robots_[i]->proposed);
  return next < script.size() ? &script[next] : nullptr;
}

bool ProtocolModel::over() const {
  if (step_ >= scenario_->steps) return true;
  for (int i = 0; i < scenario_->size(); ++i) {
    if (robots_[i]->pending || next_motion(i) != nullptr) return false;
  }
  return true;
}

std::vector<Action> ProtocolModel::actions() const {
  std::vector<Action> actions;
  if (over()) return actions;
  if (turn_ == 0) add_link_actions(actions);
  for (int i = turn_; i < scenario_->size(); ++i) {
    const std::size_t before = actions.size();
    add_message_actions(i, actions);
    const bool waits = actions.size() > before;
    add_own_actions(i, actions);
    if (waits) return actions;
  }
  actions.push_back(action(Action::Kind::kTimeGoesOn));
  return actions;
}

void ProtocolModel::add_message_actions(int i, std::vector<Action>& actions) const {
  using Kind = Action::Kind;
  for (std::size_t k = 0; k < under_way_.size(); ++k) {
    if (under_way_[k].to != i || !due(under_way_[k])) continue;
    actions.push_back(action(Kind::kDeliver, i, k));
    if (left_.duplicates > 0) actions.push_back(action(Kind::kDuplicate, i, k));
    if (left_.losses > 0) actions.push_back(action(Kind::kLose, i, k));
    if (left_.delays > 0) actions.push_back(action(Kind::kDelay, i, k));
  }
}

void ProtocolModel::add_own_actions(int i, std::vector<Action>& actions) const {
  using Kind = Action::Kind;
  if (robots_[i]->asleep) {
    actions.push_back(action(Kind::kWakeUp, i));
    return;
  }
  const ScriptedMotion* next = next_motion(i);
  if (next != nullptr && next->from_step <= step_) actions.push_back(action(Kind::kPropose, i));
  const ModelledRobot& robot = scenario_->robots[i];
  if (robot.may_brake && left_.brakes > 0) actions.push_back(action(Kind::kBrake, i));
  if (robot.may_restart && left_.restarts > 0) actions.push_back(action(Kind::kRestart, i));
}

void ProtocolModel::add_link_actions(std::vector<Action>& actions) const {
  using Kind = Action::Kind;
  for (int i = 0; i < scenario_->size(); ++i) {
    for (int j = i + 1; j < scenario_->size(); ++j) {
      if (cut(i, j)) actions.push_back(action(Kind::kRestore, i, j));
      if (!cut(i, j) && left_.cuts > 0) actions.push_back(action(Kind::kCut, i, j));
    }
  }
}

std::string ProtocolModel::describe(const Action& action) const {
  const std::string who = name_of_robot(action.robot);
  const auto message = [&] {
    const MessageUnderWay& each = under_way_[action.which];
    return name_of_robot(each.from) + " -> " + who + ": " + text_of(*each.message);
  };
  switch (action.kind) {
    case Action::Kind::kTimeGoesOn:
      return "time goes on to step " + std::to_string(step_ + 1);
    case Action::Kind::kDeliver:
      return "delivers " + message();
    case Action::Kind::kDuplicate:
      return "delivers, and will again, " + message();
    case Action::Kind::kLose:
      return "loses " + message();
    case Action::Kind::kDelay:
      return "delays " + message();
    case Action::Kind::kPropose:
      return who + " proposes";
    case Action::Kind::kBrake:
      return who + " brakes";
    case Action::Kind::kRestart:
      return who + " starts anew";
    case Action::Kind::kWakeUp:
      return who + " wakes up";
    case Action::Kind::kCut:
      return "cuts the link between " + who + " and " + name_of_robot(action.which);
    case Action::Kind::kRestore:
      return "restores the link between " + who + " and " + name_of_robot(action.which);
  }
  return "";
}

}  // namespace mocha::test
