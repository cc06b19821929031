#include "benchmarks/robot_nodes.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

namespace mocha {
namespace {

constexpr double kTrackerWait_s = 1.0;  // as the node has it
constexpr double kStandstill_s = 0.1;

ParameterTable schema(const char* node) {
  return ParameterTable::from_schema(std::string("config/") + node + ".yaml");
}

Answer answer_of(const Settled& settled) {
  using Kind = CommitmentEvent::Kind;
  const Kind kind = settled.event.kind;
  const auto said = kind == Kind::kSettled    ? Answer::Kind::kSettled
                    : kind == Kind::kBreached ? Answer::Kind::kBreached
                                              : Answer::Kind::kRefused;
  return {said, settled.sequence, name_of(settled.event.refusal)};
}

}  // namespace

RobotNodes::Planner::Planner(const RobotNodes& robot)
    : planning(robot.robot_, robot.global_values_, robot.name_, 0, handover_s(robot.local_values_),
               runner) {}

RobotNodes::Replanner::Replanner(const RobotNodes& robot)
    : replanning(robot.robot_, robot.local_values_) {}

RobotNodes::Broadcaster::Broadcaster(const RobotNodes& robot)
    : protocol(commitment_options(robot.name_, robot.robot_, robot.epoch_, robot.options_)),
      keeping(robot.robot_, robot.local_values_.number("lease"), protocol),
      link(robot.name_, std::nullopt) {}

RobotNodes::RobotNodes(std::string name, const FleetOptions& options)
    : name_(std::move(name)),
      robot_(load_robot_model("config", "rover")),
      options_(options),
      global_values_(global_values(options)),
      local_values_(local_values(options)),
      peer_margin_m_(schema("perception").number("peer_margin")),
      peer_tracks_(peer_margin_m_, schema("perception").number("peer_timeout")) {}

bool RobotNodes::runs(RobotNode node) const {
  switch (node) {
    case RobotNode::kGlobalPlanner:
      return planner_ != nullptr;
    case RobotNode::kLocalReplanner:
      return replanner_ != nullptr;
    case RobotNode::kBroadcaster:
      return broadcaster_ != nullptr;
    case RobotNode::kTracker:
      return tracker_ != nullptr;
  }
  return false;
}

void RobotNodes::end(RobotNode node) {
  switch (node) {
    case RobotNode::kGlobalPlanner:
      planner_.reset();
      plan_.reset();
      break;
    case RobotNode::kLocalReplanner:
      replanner_.reset();
      report_.reset();
      break;
    case RobotNode::kBroadcaster:
      former_ = counts();
      broadcaster_.reset();
      committed_.reset();
      fleet_.reset();
      break;
    case RobotNode::kTracker:
      tracker_.reset();
      driven_.reset();
      break;
  }
}

void RobotNodes::start(RobotNode node, double now_s) {
  end(node);
  switch (node) {
    case RobotNode::kGlobalPlanner:
      planner_ = std::make_unique<Planner>(*this);
      planner_->fleet = fleet_;
      if (committed_) planner_->committed = committed_->motion;
      if (report_) planner_->planning.hear_replanner(*report_, now_s);
      break;
    case RobotNode::kLocalReplanner:
      replanner_ = std::make_unique<Replanner>(*this);
      replanner_->fleet = fleet_;
      if (plan_) replanner_->replanning.set_plan(plan_->motion, plan_->kind);
      if (committed_) replanner_->replanning.set_committed(committed_->id, committed_->motion);
      break;
    case RobotNode::kBroadcaster:
      ++epoch_;
      broadcaster_ = std::make_unique<Broadcaster>(*this);
      broadcaster_->driven = driven_;
      break;
    case RobotNode::kTracker:
      tracker_ = std::make_unique<TrajectoryTracker>(
          TrackerParameters::from(schema("trajectory_tracker")), robot_);
      tell_driven();
      // What was kept for late joiners gives no right to drive.
      if (committed_) tracker_->offer(committed_->id, committed_->motion, 0.0);
      break;
  }
}

// --- global_planner ---

void RobotNodes::go_to(const Vector2& goal, double now_s) {
  planner_->planning.executive().take({Goal{goal, std::nullopt}}, planner_->committed, now_s);
}

RobotNodes::Datagrams RobotNodes::pursue(double now_s, const RobotSenses& senses) {
  ending_ = GoalExecutive::Ending::kNone;
  if (!planner_) return {};
  const auto peers =
      planner_->fleet ? planner_->fleet->obstacles : decltype(planner_->fleet->obstacles)();
  const auto scene = [&](const std::vector<Vector2>&) {
    return PlanningScene{senses.map->static_map, peers, [&] { return senses.map->unseen; }};
  };
  const auto output = planner_->planning.step(now_s, senses.measured, planner_->committed, scene);
  ending_ = output.ending;
  if (output.report) words_ = output.report->message;
  Datagrams sent;
  for (const PassingMessage& message : output.messages) {
    if (!broadcaster_) break;
    std::visit(
        [&](auto each) {
          if constexpr (std::is_same_v<decltype(each), PassingIntent>)
            each.epoch = epoch_;
          else
            each.id.epoch = epoch_;
          send(each, sent);
        },
        message);
  }
  if (output.plan) {
    plan_ = Plan{*output.plan, output.kind};
    if (replanner_) replanner_->replanning.set_plan(plan_->motion, plan_->kind);
  }
  return sent;
}

// --- local_replanner ---

RobotNodes::Datagrams RobotNodes::replan(double now_s, const RobotSenses& senses) {
  if (!replanner_) return {};
  const auto scene = [&](const Vector2& here) {
    LocalScene scene = local_scene(senses.map->static_map, senses.map->unseen);
    scene.peers = replanner_->fleet->obstacles;
    const RiskOptions risk = RiskOptions::from(local_values_, robot_);
    scene.confident = confident_discs(senses.predictions,
                                      confidence_of_each(senses.predictions, here, risk), risk);
    scene.likely = likely_discs(senses.predictions);
    scene.predicted_until_s = now_s + local_values_.number("prediction_horizon");
    return scene;
  };
  LocalKnowledge known;
  known.measured = senses.measured;
  known.map_age_s = known.prediction_age_s = 0.0;
  if (replanner_->fleet) known.fleet_age_s = now_s - replanner_->fleet->stamp_s;
  known.scene = scene;
  const auto output = replanner_->replanning.step(now_s, known);
  if (planner_ && (output.swerves || output.keeps_plan))
    planner_->planning.executive().follow(replanner_->replanning.replanner().plan());
  Datagrams sent;
  if (output.proposal) propose(*output.proposal, now_s, sent);
  if (output.lease) renew(*output.lease);
  report(output, now_s);
  if (planner_ && output.request_plan) planner_->planning.executive().request();
  return sent;
}

void RobotNodes::report(const LocalReplanning::Output& output, double now_s) {
  report_ = GoalExecutive::Report{output.reason, output.violation, output.message};
  local_words_ = to_text(output.row) + (" (" + output.message + ")");
  if (planner_) planner_->planning.hear_replanner(*report_, now_s);
}

void RobotNodes::renew(const Lease& lease) {
  if (broadcaster_) broadcaster_->keeping.renew(lease);
  if (tracker_) tracker_->renew(lease.id, lease.end_s);
}

void RobotNodes::answer(const Answer& answer) {
  if (replanner_) replanner_->replanning.hear(answer);
}

// --- trajectory_broadcaster ---

CommittedTrajectory RobotNodes::wish_of(std::uint32_t sequence, const Motion& motion,
                                        bool emergency) const {
  CommittedTrajectory wish;
  wish.agent = name_;
  wish.id.sequence = sequence;
  wish.state = emergency ? TrajectoryState::kEmergency : TrajectoryState::kProposed;
  wish.footprint_radius_m = robot_.footprint.circumscribed_radius_m();
  wish.braking = robot_.braking();
  wish.motion = std::make_shared<const Motion>(motion);
  return wish;
}

void RobotNodes::propose(const ProposedMotion& proposal, double now_s, Datagrams& sent) {
  if (!broadcaster_) return;
  try {
    if (!broadcaster_->awake && !proposal.emergency)
      throw std::invalid_argument("just started, does not know yet what is driven");
    const CommitmentNews news = broadcaster_->keeping.propose(
        proposal.sequence, wish_of(proposal.sequence, proposal.motion, proposal.emergency), now_s);
    broadcaster_->awake = true;
    apply(news, sent);
  } catch (const std::invalid_argument& error) {
    answer({Answer::Kind::kRefused, proposal.sequence, error.what()});
  }
}

RobotNodes::Datagrams RobotNodes::settle(double now_s) {
  Datagrams sent;
  if (!broadcaster_) return sent;
  if (!broadcaster_->awake) wake_up(now_s, sent);
  if (!broadcaster_->awake) return sent;
  apply(broadcaster_->keeping.tick(now_s), sent);
  publish_fleet(now_s);
  return sent;
}

/// As soon as it is known what is driven, or there is no tracker that could tell.
void RobotNodes::wake_up(double now_s, Datagrams& sent) {
  Broadcaster& node = *broadcaster_;
  if (!node.wake_up_s) node.wake_up_s = now_s + kTrackerWait_s;
  if (!node.driven && now_s < *node.wake_up_s) return;
  if (node.driven && !node.driven->motion.empty()) {
    const OwnMotion& driven = *node.driven;
    try {
      apply(node.keeping.resume(wish_of(driven.id.sequence, driven.motion, true), now_s), sent);
    } catch (const std::invalid_argument&) {  // promises nothing until the replanner does
    }
  }
  node.awake = true;
}

RobotNodes::Datagrams RobotNodes::hear(const Bytes& datagram, double now_s) {
  Datagrams sent;
  if (!broadcaster_) return sent;
  const auto message = broadcaster_->link.unpack(datagram.data(), datagram.size());
  if (!message) return sent;
  if (const auto* intent = std::get_if<PassingIntent>(&*message)) {
    if (planner_) planner_->planning.executive().hear(*intent, now_s);
  } else if (const auto* instruction = std::get_if<PassingInstruction>(&*message)) {
    if (planner_) planner_->planning.executive().hear(*instruction, now_s);
  } else if (!broadcaster_->awake) {
    return sent;
  } else if (const auto* trajectory = std::get_if<CommittedTrajectory>(&*message)) {
    apply(broadcaster_->keeping.receive(*trajectory, now_s), sent);
  } else if (const auto* heartbeat = std::get_if<Heartbeat>(&*message)) {
    apply(broadcaster_->keeping.receive(*heartbeat, now_s), sent);
  }
  return sent;
}

void RobotNodes::apply(const CommitmentNews& news, Datagrams& sent) {
  for (const FleetMessage& message : news.messages) send(message, sent);
  for (const Settled& settled : news.settled) {
    if (settled.in_force) commit(*settled.in_force);
    answer(answer_of(settled));
  }
}

void RobotNodes::commit(const MotionInForce& in_force) {
  committed_ = OwnMotion{in_force.lease.id, *in_force.trajectory.motion};
  if (planner_) planner_->committed = committed_->motion;
  if (replanner_) replanner_->replanning.set_committed(committed_->id, committed_->motion);
  if (tracker_) tracker_->offer(committed_->id, committed_->motion, 0.0);
  // Whether what a former epoch promised is to be driven on is for the replanner to say.
  if (broadcaster_->awake) renew(in_force.lease);
}

void RobotNodes::publish_fleet(double now_s) {
  const auto news = broadcaster_->keeping.fleet_news(now_s);
  if (!news) return;
  auto fleet = std::make_shared<Fleet>();
  fleet->stamp_s = now_s;
  for (const CommittedTrajectory& each : *news) {
    fleet->obstacles.push_back(std::make_shared<PeerObstacle>(
        each.agent, each.motion, each.footprint_radius_m, each.braking.value()));
    fleet->motions.push_back({each.agent,
                              {each.id.epoch, each.id.sequence},
                              each.motion,
                              each.footprint_radius_m,
                              each.braking.value()});
  }
  peer_tracks_.update(now_s, fleet->motions);
  fleet_ = std::move(fleet);
  if (planner_) planner_->fleet = fleet_;
  if (replanner_) replanner_->fleet = fleet_;
}

void RobotNodes::send(const FleetMessage& message, Datagrams& sent) {
  for (Bytes& datagram : broadcaster_->link.pack(message)) sent.push_back(std::move(datagram));
}

RobotNodes::Counts RobotNodes::counts() const {
  Counts counts = former_;
  if (!broadcaster_) return counts;
  const CommitmentKeeping::Counts& now = broadcaster_->keeping.counts();
  counts.breaches += now.breaches;
  counts.lease_stops += now.lease_stops;
  for (const auto& [why, count] : now.refusals) counts.refusals += count;
  return counts;
}

// --- trajectory_tracker ---

std::optional<UnicycleState> RobotNodes::drive(double now_s, const RobotState& measured) {
  if (!tracker_) return std::nullopt;
  const UnicycleState command = tracker_->step(now_s, measured);
  if (tracker_->motions() != driven_motions_) tell_driven();
  return command;
}

void RobotNodes::tell_driven() {
  driven_motions_ = tracker_->motions();
  driven_ = OwnMotion{tracker_->id(), tracker_->motion()};
  if (broadcaster_) broadcaster_->driven = driven_;
}

// --- what others ask ---

bool RobotNodes::expects_at(const Vector2& place, double now_s) const {
  const auto discs = peer_tracks_.at(now_s);
  return std::any_of(discs.begin(), discs.end(), [&](const PeerTracks::Disc& disc) {
    return (disc.centre - place).norm() <= peer_margin_m_;
  });
}

std::string RobotNodes::words() const {
  std::string words;
  if (planner_)
    words += std::string(to_text(planner_->planning.executive().state())) + ": " + words_;
  if (replanner_) words += "; " + local_words_;
  if (tracker_) words += "; tracker " + std::string(to_text(tracker_->mode()));
  for (const RobotNode node : kRobotNodes) words += runs(node) ? "" : "; a node does not run";
  return words;
}

}  // namespace mocha
