#include "fleet/model/protocol_model.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "fleet/model/safety_property.h"
#include "fleet/protocol/motions.h"
#include "trajectory/rover_braking.h"

namespace mocha::test {
namespace {

constexpr double kBegin_s = 64.0;
constexpr double kRadius_m = 0.3;
constexpr int kSettlingIn = 8;  // steps until all have listened and know each other's clocks

/// As it is sent: stamps are made as it arrives.
Message unstamped(Message message) {
  if (auto* heartbeat = std::get_if<Heartbeat>(&message)) {
    heartbeat->stamp_s = 0.0;
    for (Echo& echo : heartbeat->echoes) echo.stamp_s = echo.held_s = 0.0;
  }
  return message;
}

/// Whether its sender has been started anew since, as the receiver knows.
bool is_former(const CommitmentProtocol& receiver, const Heartbeat& heartbeat) {
  const auto& peers = receiver.peers().peers();
  const auto peer = peers.find(heartbeat.agent);
  return peer != peers.end() && heartbeat.epoch < peer->second.epoch;
}

}  // namespace

ProtocolModel::ProtocolModel(std::shared_ptr<const Scenario> scenario)
    : scenario_(std::move(scenario)), step_(-kSettlingIn) {
  constexpr double kNever_s = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < scenario_->size(); ++i) {
    RobotState robot{CommitmentProtocol(options_of(*scenario_, i, 1)), {}, false, {}, {}, 0, {}};
    robot.heard_s.assign(scenario_->size(), kNever_s);
    robots_.push_back(std::make_shared<RobotState>(std::move(robot)));
  }
  for (int i = 0; i < scenario_->size(); ++i) {
    const Proposal home = proposal(i, stand(now(i), scenario_->robots[i].home));
    take(i, changed(i).protocol.brake(home, now(i)));
  }
  while (step_ < 0) calm_step();
  left_ = scenario_->harm;
  undisturbed_ = true;
}

double ProtocolModel::now(int i) const {
  return kBegin_s + step_ * kStep_s + scenario_->robots[i].clock_ahead_s;
}

void ProtocolModel::apply(const Action& action) {
  using Kind = Action::Kind;
  const bool of_turn = action.kind != Kind::kTimeGoesOn && action.kind != Kind::kCut &&
                       action.kind != Kind::kRestore;
  if (of_turn) turn_ = action.robot;
  switch (action.kind) {
    case Kind::kTimeGoesOn:
      return go_on();
    case Kind::kDeliver:
      return deliver(action.which, false);
    case Kind::kDuplicate:
      --left_.duplicates;
      return deliver(action.which, true);
    case Kind::kLose:
      --left_.losses;
      under_way_.erase(under_way_.begin() + action.which);
      return;
    case Kind::kDelay:
      --left_.delays;
      ++under_way_[action.which].due_step;
      return;
    case Kind::kPropose:
      return propose(action.robot);
    case Kind::kBrake:
      return brake(action.robot);
    case Kind::kRestart:
      return restart(action.robot);
    case Kind::kWakeUp:
      return wake_up(action.robot);
    case Kind::kCut:
      --left_.cuts;
      return set_link(action.robot, action.which, true);
    case Kind::kRestore:
      return set_link(action.robot, action.which, false);
  }
}

void ProtocolModel::go_on() {
  ++step_;
  turn_ = 0;
  for (int i = 0; i < scenario_->size(); ++i) {
    RobotState& robot = changed(i);
    robot.driven.prune(now(i));
    while (next_motion(i) != nullptr && next_motion(i)->until_step < step_) ++robot.proposed;
    if (!robot.asleep) take(i, robot.protocol.tick(now(i)));
  }
}

void ProtocolModel::deliver(int which, bool again) {
  const MessageUnderWay arrived = under_way_[which];
  if (again) {
    ++under_way_[which].due_step;
  } else {
    under_way_.erase(under_way_.begin() + which);
  }
  if (robots_[arrived.to]->asleep) return;
  RobotState& robot = changed(arrived.to);
  const double now_s = now(arrived.to);
  Message message = *arrived.message;
  if (auto* heartbeat = std::get_if<Heartbeat>(&message)) {
    if (!is_former(robot.protocol, *heartbeat)) robot.heard_s[arrived.from] = now_s;
    heartbeat->stamp_s = now(arrived.from);
    for (Echo& echo : heartbeat->echoes) echo.stamp_s = now_s;
  }
  if (scenario_->tamper && !scenario_->tamper(arrived.from, arrived.to, message)) return;
  take(arrived.to,
       std::visit([&](const auto& each) { return robot.protocol.receive(each, now_s); }, message));
}

void ProtocolModel::propose(int i) {
  RobotState& robot = changed(i);
  const ScriptedMotion& scripted = *next_motion(i);
  ++robot.proposed;
  const double start_s = now(i) + (scripted.start_step - step_) * kStep_s;
  std::vector<Vector2> places = {robot.driven.chain().position(start_s)};
  places.insert(places.end(), scripted.through.begin(), scripted.through.end());
  const Proposal wish = proposal(i, drive(start_s, places, scripted.speed));
  CommitmentActions actions;
  try {
    actions = robot.protocol.propose(wish, now(i));
  } catch (const std::invalid_argument&) {
    return;  // from where it has got to, that leads too far
  }
  if (robot.pending) undisturbed_ = false;
  robot.pending = PendingProposal{wish.tag, now(i), start_s};
  robot.fate = Fate::kPending;
  take(i, actions);
}

/// It stands at once: no robot can, but that is the worst for the others.
void ProtocolModel::brake(int i) {
  --left_.brakes;
  undisturbed_ = false;
  RobotState& robot = changed(i);
  const Vector2 here = robot.driven.chain().position(now(i));
  take(i, robot.protocol.brake(proposal(i, stand(now(i), here)), now(i)));
}

/// The broadcaster forgets all; the tracker drives on.
void ProtocolModel::restart(int i) {
  --left_.restarts;
  undisturbed_ = false;
  RobotState& robot = changed(i);
  robot.protocol = CommitmentProtocol(options_of(*scenario_, i, robot.protocol.epoch() + 1));
  robot.asleep = true;
  if (robot.pending) robot.fate = Fate::kInVain;
  robot.pending.reset();
  for (int j = 0; j < scenario_->size(); ++j) changed(j).driven.forgotten_by(i);
}

void ProtocolModel::wake_up(int i) {
  RobotState& robot = changed(i);
  robot.asleep = false;
  const ReservationChain& chain = robot.driven.chain();
  if (scenario_->restart == Restart::kNothing) return;
  const Motion says = scenario_->restart == Restart::kAsDriven
                          ? *chain.composed(now(i))
                          : stand(now(i), chain.position(now(i)));
  take(i, robot.protocol.brake(proposal(i, says), now(i)), true);
}

void ProtocolModel::set_link(int i, int j, bool cut_off) {
  if (cut_off) {
    cut_.insert(std::minmax(i, j));
  } else {
    cut_.erase(std::minmax(i, j));
  }
  for (auto each = under_way_.begin(); each != under_way_.end();) {
    each = cut(each->from, each->to) ? under_way_.erase(each) : each + 1;
  }
}

/// States share the robots that did not change.
RobotState& ProtocolModel::changed(int i) {
  if (robots_[i].use_count() > 1) robots_[i] = std::make_shared<RobotState>(*robots_[i]);
  return *robots_[i];
}

void ProtocolModel::take(int i, const CommitmentActions& actions, bool resumes) {
  for (const CommittedTrajectory& trajectory : actions.trajectories) send(i, trajectory);
  if (actions.heartbeat) send(i, *actions.heartbeat);
  if (resumes) return;  // the tracker drives that already
  for (const CommitmentEvent& event : actions.events) note(i, event);
}

void ProtocolModel::send(int i, Message message) {
  const auto sent = std::make_shared<const Message>(unstamped(std::move(message)));
  for (int j = 0; j < scenario_->size(); ++j) {
    if (j != i && !cut(i, j)) under_way_.push_back({i, j, step_ + 1, sent});
  }
}

void ProtocolModel::note(int i, const CommitmentEvent& event) {
  using Kind = CommitmentEvent::Kind;
  if (event.kind == Kind::kBreached) return;
  RobotState& robot = changed(i);
  const bool of_pending = robot.pending && robot.pending->tag == event.proposal.tag;
  if (event.kind == Kind::kSettled) {
    const double since_s = of_pending ? robot.pending->since_s : now(i);
    const bool emergency = event.trajectory.state == TrajectoryState::kEmergency;
    if (!emergency && violation_.empty())
      violation_ = safety_violation(*this, i, event.trajectory, since_s);
    robot.driven.bind(event.trajectory, now(i), asked(i));
  }
  if (!of_pending) return;
  const bool outdone =
      event.refusal == Refusal::kPeerPromise || event.refusal == Refusal::kPeerProposal;
  robot.fate = event.kind == Kind::kSettled ? Fate::kSettled
               : outdone                    ? Fate::kLost
                                            : Fate::kInVain;
  undisturbed_ = undisturbed_ && robot.fate != Fate::kInVain;
  robot.pending.reset();
}

bool ProtocolModel::any_settled() const {
  return std::any_of(robots_.begin(), robots_.end(),
                     [](const auto& robot) { return robot->fate == Fate::kSettled; });
}

unsigned ProtocolModel::reach(int i) const {
  unsigned members = 0;
  const double timeout_s = robots_[i]->protocol.options().reach_timeout_s;
  for (int j = 0; j < scenario_->size(); ++j)
    members |= (j != i && now(i) - robots_[i]->heard_s[j] <= timeout_s) << j;
  return members;
}

/// Of the robots in its reach, those that are still as robot i knows them.
unsigned ProtocolModel::asked(int i) const {
  unsigned members = reach(i);
  const auto& peers = robots_[i]->protocol.peers().peers();
  for (int j = 0; j < scenario_->size(); ++j) {
    const auto peer = peers.find(name_of_robot(j));
    const bool same = peer != peers.end() && peer->second.epoch == robots_[j]->protocol.epoch();
    if (!same) members &= ~(1u << j);
  }
  return members;
}

Proposal ProtocolModel::proposal(int i, Motion motion) const {
  const std::uint32_t tag = 100 * robots_[i]->protocol.epoch() + robots_[i]->proposed;
  return {tag, kRadius_m, kRoverBraking, shared(std::move(motion))};
}

void ProtocolModel::calm_down() {
  left_ = {};
  cut_.clear();
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    RobotState& robot = changed(i);
    robot.proposed = static_cast<int>(scenario_->robots[i].script.size());
  }
}

void ProtocolModel::calm_step() {
  for (std::size_t i = 0; i < under_way_.size();) {
    if (due(under_way_[i])) {
      deliver(static_cast<int>(i), false);
    } else {
      ++i;
    }
  }
  for (int i = 0; i < scenario_->size(); ++i) {
    if (robots_[i]->asleep) wake_up(i);
  }
  go_on();
}

}  // namespace mocha::test
