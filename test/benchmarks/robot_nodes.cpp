#include "benchmarks/robot_nodes.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "stack/robot_stack.h"

namespace mocha {
namespace {

ParameterTable schema(const char* node) {
  return ParameterTable::from_schema(std::string("config/") + node + ".yaml");
}

}  // namespace

RobotNodes::Planner::Planner(const RobotNodes& robot)
    : planning(robot.robot_, robot.global_values_, robot.name_, 0, handover_s(robot.local_values_),
               runner) {}

RobotNodes::Replanner::Replanner(const RobotNodes& robot)
    : replanning(robot.robot_, robot.local_values_,
                 reach_of(robot.robot_, robot.options_).promise_m) {}

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
      broadcaster_ = std::make_unique<BroadcasterNode>(name_, robot_, epoch_,
                                                       local_values_.number("lease"), options_);
      if (driven_) broadcaster_->hear_driven(*driven_);
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
    for (Bytes& datagram : broadcaster_->relay(message)) sent.push_back(std::move(datagram));
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
  if (broadcaster_) broadcaster_->renew(lease);
  if (tracker_) tracker_->renew(lease.id, lease.end_s);
}

void RobotNodes::answer(const Answer& answer) {
  if (replanner_) replanner_->replanning.hear(answer);
}

// --- trajectory_broadcaster ---

void RobotNodes::propose(const ProposedMotion& proposal, double now_s, Datagrams& sent) {
  if (!broadcaster_) return;
  try {
    sent = apply(broadcaster_->propose(proposal, now_s), now_s);
  } catch (const std::invalid_argument& error) {
    answer({Answer::Kind::kRefused, proposal.sequence, error.what()});
  }
}

RobotNodes::Datagrams RobotNodes::settle(double now_s) {
  return broadcaster_ ? apply(broadcaster_->settle(now_s), now_s) : Datagrams();
}

RobotNodes::Datagrams RobotNodes::hear(const Bytes& datagram, double now_s) {
  return broadcaster_ ? apply(broadcaster_->hear(datagram, now_s), now_s) : Datagrams();
}

RobotNodes::Datagrams RobotNodes::apply(BroadcasterNode::Output output, double now_s) {
  if (output.passing && planner_) planner_->planning.executive().hear(*output.passing, now_s);
  for (const auto& [settled, gives_lease] : output.results) {
    if (settled.in_force) commit(*settled.in_force, gives_lease);
    answer(answer_of(settled));
  }
  if (output.fleet) publish_fleet(*output.fleet, now_s);
  return std::move(output.sent);
}

void RobotNodes::commit(const MotionInForce& in_force, bool gives_lease) {
  committed_ = OwnMotion{in_force.lease.id, *in_force.trajectory.motion};
  if (planner_) planner_->committed = committed_->motion;
  if (replanner_) replanner_->replanning.set_committed(committed_->id, committed_->motion);
  if (tracker_) tracker_->offer(committed_->id, committed_->motion, 0.0);
  if (gives_lease) renew(in_force.lease);
}

void RobotNodes::publish_fleet(const std::vector<CommittedTrajectory>& promises, double now_s) {
  auto fleet = std::make_shared<Fleet>();
  fleet->stamp_s = now_s;
  for (const CommittedTrajectory& each : promises) {
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

RobotNodes::Counts RobotNodes::counts() const {
  Counts counts = former_;
  if (!broadcaster_) return counts;
  const CommitmentKeeping::Counts& now = broadcaster_->counts();
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
  if (broadcaster_) broadcaster_->hear_driven(*driven_);
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
