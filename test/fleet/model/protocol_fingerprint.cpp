#include "fleet/model/protocol_fingerprint.h"

#include <algorithm>
#include <cmath>

namespace mocha {

using test::Fingerprint;

Fingerprint ProtocolFingerprint::of(const test::ProtocolModel& model) {
  const auto& [scenario, robots, under_way, cut, left, step, turn, undisturbed, violation] = model;
  ProtocolFingerprint whole(0.0);
  test::StateHash& hash = whole.hash_;
  for (int i = 0; i < scenario->size(); ++i) {  // the scenario is the same in all states
    ProtocolFingerprint robot(model.now(i));
    robot.add(*robots[i]);
    hash.add(robot.hash_.print());
  }
  Fingerprint messages;  // in whatever order they were sent
  for (const test::MessageUnderWay& each : under_way) {
    ProtocolFingerprint message(0.0);
    message.add(each);
    messages.high += message.hash_.print().high;
    messages.low += message.hash_.print().low;
  }
  hash.add(messages);
  for (const auto& [i, j] : cut) hash.add(scenario->size() * i + j);
  hash.add(cut.size());
  const auto& [losses, delays, duplicates, restarts, cuts, brakes] = left;
  for (const int* each : {&losses, &delays, &duplicates, &restarts, &cuts, &brakes})
    hash.add(*each);
  hash.add(step);
  hash.add(turn);
  hash.add(undisturbed);
  hash.add(violation);
  return hash.print();
}

void ProtocolFingerprint::add(const test::RobotState& robot) {
  const auto& [protocol, driven, asleep, pending, fate, proposed, heard] = robot;
  add(protocol);
  add(driven);
  hash_.add(asleep);
  hash_.add(pending.has_value());
  if (pending) {
    const auto& [tag, since_s, start_s] = *pending;
    hash_.add(tag);
    hash_.add(since_s);
    hash_.add(start_s);
  }
  hash_.add(fate);
  hash_.add(proposed);
  for (const double each : heard) add_last(each, protocol.options().reach_timeout_s);
}

void ProtocolFingerprint::add(const test::MessageUnderWay& message) {
  const auto& [from, to, due_step, content] = message;
  hash_.add(from);
  hash_.add(to);
  hash_.add(due_step);
  add(*content);
}

void ProtocolFingerprint::add(const test::Message& message) {
  hash_.add(message.index());
  std::visit([this](const auto& each) { add(each); }, message);
}

void ProtocolFingerprint::add(const test::DrivenPromises& driven) {
  const auto& [chain, bindings] = driven;
  add(chain);
  for (const test::Binding& each : bindings) {
    const auto& [id, time_s, asked, emergency] = each;
    add(id);
    hash_.add(time_s);
    hash_.add(asked);
    hash_.add(emergency);
  }
}

void ProtocolFingerprint::add(const CommitmentProtocol& protocol) {
  const auto& [options, peers, binding, pending, last_sent, sequence, listen_until_s, listening,
               answers, next_answer_s, lines, next_heartbeat_s, next_resend_s, impostors] =
      protocol;
  hash_.add(options.epoch);  // the others are the scenario's
  add(peers);
  add(binding);
  hash_.add(pending.has_value());
  if (pending) add(*pending);
  add(last_sent);
  hash_.add(sequence);
  hash_.add(listen_until_s.has_value());
  if (listen_until_s) add_next(*listen_until_s);
  hash_.add(listening);
  add_each(answers);
  add_next(next_answer_s);
  add_next(next_heartbeat_s);
  add_next(next_resend_s);
  (void)impostors;  // only counts
  (void)lines;      // there is room for all peers of a model in each heartbeat
}

void ProtocolFingerprint::add(const CommitmentProtocol::Pending& pending) {
  const auto& [trajectory, proposal, since_s] = pending;
  add(trajectory);
  hash_.add(proposal.tag);  // the rest is in the trajectory
  hash_.add(since_s);
}

void ProtocolFingerprint::add(const PeerTable& table) {
  const auto& [own_name, own_epoch, reach_timeout_s, clocks, known_epoch, unlikely_epochs, peers,
               duplicates, old, crowded] = table;
  (void)own_name, (void)own_epoch, (void)clocks;                      // the protocol's own
  (void)unlikely_epochs, (void)duplicates, (void)old, (void)crowded;  // only count
  hash_.add(known_epoch);
  for (const auto& [name, peer] : peers) {
    hash_.add(name);
    add(peer, reach_timeout_s);
  }
}

void ProtocolFingerprint::add(const Peer& peer, double reach_timeout_s) {
  const auto& [epoch, binding, open, newest, endorsed, endorsed_state, of_us, last_heard_s,
               last_heartbeat_s, promise_reach_m, placed_s, last_old_s, stamp_s, stamp_heard_s,
               clock] = peer;
  hash_.add(epoch);
  add(binding);
  add_each(open);
  add(newest);
  add(endorsed);
  hash_.add(endorsed_state);
  hash_.add(of_us.has_value());
  if (of_us) add(*of_us);
  add_last(last_heard_s, reach_timeout_s);
  add_last(last_heartbeat_s, reach_timeout_s);
  hash_.add(promise_reach_m);
  add_last(placed_s, reach_timeout_s);
  add_last(last_old_s, reach_timeout_s);
  hash_.add(std::isfinite(stamp_s));  // models make stamps and echoes as they arrive
  (void)stamp_heard_s;
  add(clock);
}

/// All exchanges of a model tell the same, and it ends before any is forgotten.
void ProtocolFingerprint::add(const PeerClock& clock) {
  const auto& [estimate, ahead_s] = clock;
  hash_.add(estimate.reading(now_s_).has_value());
  hash_.add(ahead_s);
}

void ProtocolFingerprint::add(const ReservationChain& chain) {
  const auto& [reservations] = chain;
  hash_.add(reservations.size());
  for (const Reservation& each : reservations) {
    const auto& [trajectory, from_s, until_s] = each;
    add(trajectory);
    hash_.add(from_s);
    hash_.add(until_s);
  }
}

void ProtocolFingerprint::add(const CommittedTrajectory& trajectory) {
  const auto& [agent, id, state, priority, radius_m, braking, motion, mistimed_s] = trajectory;
  (void)mistimed_s;  // only planners hear of it
  hash_.add(agent);
  add(id);
  hash_.add(state);
  hash_.add(priority);
  hash_.add(radius_m);
  hash_.add(braking.has_value());  // all robots of a model brake alike
  hash_.add(motion != nullptr);
  if (motion != nullptr) add(*motion);
}

void ProtocolFingerprint::add(const Heartbeat& heartbeat) {
  const auto& [agent, epoch, stamp_s, acknowledgements, echoes, reach_m] = heartbeat;
  hash_.add(agent);
  hash_.add(epoch);
  hash_.add(stamp_s);
  hash_.add(reach_m);
  add_each(acknowledgements);
  for (const Echo& each : echoes) {
    const auto& [of, of_stamp_s, held_s] = each;
    hash_.add(of);
    hash_.add(of_stamp_s);
    hash_.add(held_s);
  }
}

void ProtocolFingerprint::add(const Acknowledgement& line) {
  const auto& [agent, id, state] = line;
  hash_.add(agent);
  add(id);
  hash_.add(state);
}

void ProtocolFingerprint::add(TrajectoryId id) {
  const auto& [epoch, sequence] = id;
  hash_.add(epoch);
  hash_.add(sequence);
}

void ProtocolFingerprint::add(const Motion& motion) {
  hash_.add(motion.start_time());
  add_each(motion.phases());
}

void ProtocolFingerprint::add(const Phase& phase) {
  hash_.add(phase.index());
  if (const auto* stand = std::get_if<StandPhase>(&phase)) {
    add(stand->pose);
    hash_.add(stand->duration_s);
  } else if (const auto* drive = std::get_if<DrivePhase>(&phase)) {
    hash_.add(drive->direction);
    for (int i = 0; i < drive->path.pieces(); ++i) {
      hash_.add(drive->path.piece_duration(i));
      for (const double each : drive->path.piece(i).reshaped()) hash_.add(each);
    }
  } else {
    const auto& [start, yaw_change_rad, duration_s, from, to] = std::get<TurnPhase>(phase);
    add(start);
    for (const double each : {yaw_change_rad, duration_s, from.yaw_rate, from.yaw_acceleration,
                              to.yaw_rate, to.yaw_acceleration})
      hash_.add(each);
  }
}

void ProtocolFingerprint::add(const Pose& pose) {
  const auto& [position, yaw_rad] = pose;
  hash_.add(position.x());
  hash_.add(position.y());
  hash_.add(yaw_rad);
}

void ProtocolFingerprint::add_next(double time_s) { hash_.add(std::max(time_s, now_s_)); }

void ProtocolFingerprint::add_last(double time_s, double lasts_s) {
  hash_.add(now_s_ - time_s > lasts_s ? -1.0 : time_s);
}

template <typename Range>
void ProtocolFingerprint::add_each(const Range& range) {
  hash_.add(range.size());
  for (const auto& each : range) add(each);
}

}  // namespace mocha
