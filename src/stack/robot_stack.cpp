#include "stack/robot_stack.h"

#include <stdexcept>
#include <utility>
#include <variant>

namespace mocha {
namespace {

CommittedTrajectory wish_of(const ProposedMotion& proposal, const std::string& agent,
                            double radius_m, const Braking& braking) {
  CommittedTrajectory wish;
  wish.agent = agent;
  wish.id.sequence = proposal.sequence;
  wish.state = proposal.emergency ? TrajectoryState::kEmergency : TrajectoryState::kProposed;
  wish.footprint_radius_m = radius_m;
  wish.braking = braking;
  wish.motion = std::make_shared<const Motion>(proposal.motion);
  return wish;
}

PassingIntent of_epoch(PassingIntent intent, std::uint32_t epoch) {
  intent.epoch = epoch;
  return intent;
}

PassingInstruction of_epoch(PassingInstruction instruction, std::uint32_t epoch) {
  instruction.id.epoch = epoch;
  return instruction;
}

}  // namespace

Answer answer_of(const Settled& settled) {
  using Kind = CommitmentEvent::Kind;
  const Kind kind = settled.event.kind;
  const auto said = kind == Kind::kSettled    ? Answer::Kind::kSettled
                    : kind == Kind::kBreached ? Answer::Kind::kBreached
                                              : Answer::Kind::kRefused;
  return {said, settled.sequence, name_of(settled.event.refusal)};
}

RobotStack::RobotStack(std::string name, const RobotModel& robot, const Parameters& parameters,
                       SettlingProtocol& protocol)
    : name_(std::move(name)),
      radius_m_(robot.footprint.circumscribed_radius_m()),
      braking_(robot.braking()),
      protocol_(protocol),
      planning_(robot, parameters.global_planner, name_, 0, handover_s(parameters.local_replanner),
                runner_),
      replanning_(robot, parameters.local_replanner, parameters.reach.promise_m),
      keeping_(robot, parameters.local_replanner.number("lease"), parameters.reach.radio_range_m,
               protocol) {}

void RobotStack::take(std::deque<Goal> goals, double now_s) {
  planning_.executive().take(std::move(goals), committed(), now_s);
}

void RobotStack::stop() {
  planning_.executive().drop();
  replanning_.set_plan(Motion());
}

void RobotStack::pause() {
  planning_.executive().pause();
  replanning_.set_plan(Motion());
}

RobotStack::Messages RobotStack::hear(const FleetMessage& message, double now_s) {
  if (const auto* intent = std::get_if<PassingIntent>(&message)) {
    planning_.executive().hear(*intent, now_s);
  } else if (const auto* instruction = std::get_if<PassingInstruction>(&message)) {
    planning_.executive().hear(*instruction, now_s);
  } else if (const auto* promise = std::get_if<CommittedTrajectory>(&message)) {
    return apply(keeping_.receive(*promise, now_s));
  } else if (const auto* heartbeat = std::get_if<Heartbeat>(&message)) {
    return apply(keeping_.receive(*heartbeat, now_s));
  }
  return {};
}

RobotStack::Messages RobotStack::tick(double now_s) { return apply(keeping_.tick(now_s)); }

RobotStack::Messages RobotStack::replan(double now_s, const RobotState& measured,
                                        LocalScene scene) {
  refresh_peers(now_s);
  scene.peers = peers_;
  LocalKnowledge known;
  known.measured = measured;
  known.map_age_s = known.fleet_age_s = known.prediction_age_s = 0.0;
  known.scene = [&scene](const Vector2&) { return scene; };
  replanned_ = replanning_.step(now_s, known);
  if (replanned_.swerves || replanned_.keeps_plan)
    planning_.executive().follow(replanning_.replanner().plan());
  if (replanned_.request_plan) planning_.executive().request();
  planning_.hear_replanner({replanned_.reason, replanned_.violation, replanned_.message}, now_s);
  if (replanned_.lease) keeping_.renew(*replanned_.lease);
  if (!replanned_.proposal) return {};
  return propose(*replanned_.proposal, now_s);
}

RobotStack::Messages RobotStack::propose(const ProposedMotion& proposal, double now_s) {
  try {
    return apply(
        keeping_.propose(proposal.sequence, wish_of(proposal, name_, radius_m_, braking_), now_s));
  } catch (const std::invalid_argument& error) {
    replanning_.hear({Answer::Kind::kRefused, proposal.sequence, error.what()});
    return {};
  }
}

RobotStack::Messages RobotStack::pursue(double now_s, const RobotState& measured,
                                        const PlanningScene& scene) {
  refresh_peers(now_s);
  pursued_ = planning_.step(now_s, measured, committed(), [&](const std::vector<Vector2>&) {
    return PlanningScene{scene.static_map, peers_, scene.unseen, scene.speed_zones};
  });
  if (pursued_.plan) replanning_.set_plan(*pursued_.plan, pursued_.kind);
  Messages messages;
  for (const PassingMessage& message : pursued_.messages) {
    std::visit([&](const auto& each) { messages.emplace_back(of_epoch(each, protocol_.epoch())); },
               message);
  }
  return messages;
}

RobotStack::Messages RobotStack::apply(CommitmentNews news) {
  for (const Settled& settled : news.settled) {
    if (settled.in_force) {
      replanning_.set_committed(settled.in_force->lease.id, *settled.in_force->trajectory.motion);
    }
    replanning_.hear(answer_of(settled));
  }
  return std::move(news.messages);
}

void RobotStack::refresh_peers(double now_s) {
  const auto news = keeping_.fleet_news(now_s);
  if (!news) return;
  peers_.clear();
  for (const CommittedTrajectory& promise : *news) {
    peers_.push_back(std::make_shared<PeerObstacle>(promise.agent, promise.motion,
                                                    promise.footprint_radius_m,
                                                    promise.braking.value(), promise.mistimed_s));
  }
}

}  // namespace mocha
