#include "benchmarks/soak_run.h"

#include <malloc.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <random>
#include <utility>

#include "benchmarks/fleet_scene.h"
#include "benchmarks/patrols.h"
#include "benchmarks/progress_watch.h"
#include "benchmarks/stray_sight.h"

namespace mocha {
namespace {

constexpr double kBegin_s = 1.7e9;
constexpr int kStep_ms = 10;  // of the network
constexpr int kTick_ms = 20;  // as the nodes' periods
constexpr int kPursuit_ms = 50;
constexpr int kReplanning_ms = 100;
constexpr int kSweep_ms = 100;
constexpr int kMinute_ms = 60000;

std::size_t memory_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Without lidars to speak of: nobody looks at their scans.
World with_hardly_any_lidar(World world) {
  for (WorldRobot& robot : world.robots) {
    robot.model.lidar.beams = 3;
    robot.model.lidar.rate_hz = 1.0;
  }
  return world;
}

std::vector<std::vector<Vector2>> patrols_of(const World& world) {
  std::vector<std::vector<Vector2>> places;
  for (const WorldRobot& robot : world.robots)
    places.push_back({robot.start.position, robot.goal.value().position});
  return places;
}

class Soak {
 public:
  explicit Soak(const SoakScene& scene)
      : scene_(scene),
        simulator_(with_hardly_any_lidar(scene.world), kBegin_s, scene.seed),
        sight_(map_of(scene.world), robots(), radius_m()),
        network_(scene.seed, NetworkLink()),
        patrols_(patrols_of(scene.world)),
        clients_(robots()),
        next_fault_(scene.faults.faults.begin()),
        next_link_(scene.faults.links.begin()) {
    std::mt19937 random(scene.seed);
    for (const WorldRobot& robot : scene.world.robots) {
      nodes_.emplace_back(robot.name, scene.options);
      for (const RobotNode node : kRobotNodes) nodes_.back().start(node, now_s());
      // Robots do not all look at the same moment.
      late_ms_.push_back(static_cast<int>(random() % (kReplanning_ms / kStep_ms)) * kStep_ms);
    }
    for (int i = 0; i < robots(); ++i) clients_[i].watch.restart(0.0, state(i).pose.position);
    sight_.look(now_s(), states());
  }

  SoakRun run(const std::function<void(const SoakRun&)>& after_minute) {
    while (run_.time_s < scene_.duration_s) {
      ms_ += kStep_ms;
      run_.time_s = 1e-3 * ms_;
      if (ms_ % kTick_ms == 0) simulate();
      if (ms_ % kSweep_ms == 0) sight_.look(now_s(), states());
      begin_faults();
      end_faults();
      deliver();
      for (int i = 0; i < robots(); ++i) work(i);
      for (int i = 0; i < robots(); ++i) guide(i);
      if (ms_ % static_cast<int>(1e3 * scene_.swap_every_s) == 0) swap();
      if (ms_ % kMinute_ms == 0) {
        note_minute();
        after_minute(run_);
      }
    }
    for (const Client& client : clients_) note_arrival_gap(client);
    return std::move(run_);
  }

 private:
  /// The driver of a robot, which sends it from place to place.
  struct Client {
    double free_s = 0.0;  ///< until then it stays where it arrived
    bool has_goal = false;
    double arrived_s = 0.0;
    ProgressWatch watch;
    bool is_stuck = false;  ///< the last of its waits that were noted is under way
    std::size_t stuck = 0;  ///< that one
  };

  int robots() const { return static_cast<int>(scene_.world.robots.size()); }
  double now_s() const { return kBegin_s + 1e-3 * ms_; }
  double radius_m() const {
    return scene_.world.robots.front().model.footprint.circumscribed_radius_m();
  }

  RobotState state(int i) const {
    const Vehicle& vehicle = simulator_.robots()[i].vehicle;
    const Twist twist = vehicle.twist();
    return {now_s(), vehicle.pose(), {twist.speed, twist.yaw_rate}};
  }

  std::vector<RobotState> states() const {
    std::vector<RobotState> states;
    for (int i = 0; i < robots(); ++i) states.push_back(state(i));
    return states;
  }

  void simulate() {
    for (ContactEvent& event : simulator_.step_to(now_s()).contacts) {
      // Of two robots that touch, each has an event.
      if (event.other == "static" || event.robot < event.other)
        run_.contacts.push_back({run_.time_s, std::move(event)});
    }
    run_.min_separation_m = std::min(run_.min_separation_m, simulator_.min_separation_m());
  }

  // --- faults ---

  void begin_faults() {
    const auto& [faults, links] = scene_.faults;
    for (; next_link_ < links.end() && next_link_->begin_s <= run_.time_s; ++next_link_)
      network_.set_link(next_link_->link);
    for (; next_fault_ < faults.end() && next_fault_->begin_s <= run_.time_s; ++next_fault_) {
      begin(*next_fault_);
      under_way_.push_back(*next_fault_);
    }
  }

  void begin(const SoakFault& fault) {
    RobotNodes& robot = nodes_[fault.robot];
    switch (fault.kind) {
      case SoakFault::Kind::kNode:
        ++run_.node_restarts;
        return robot.end(fault.node);
      case SoakFault::Kind::kRobot:
        ++run_.robot_restarts;
        for (const RobotNode node : kRobotNodes) {
          if (node != RobotNode::kTracker) robot.end(node);
        }
        return;
      case SoakFault::Kind::kBlackout:
        ++run_.blackouts;
        return network_.cut_off(fault.robot, true);
    }
  }

  void end_faults() {
    for (auto fault = under_way_.begin(); fault != under_way_.end();) {
      if (fault->end_s > run_.time_s) {
        ++fault;
        continue;
      }
      end(*fault);
      fault = under_way_.erase(fault);
    }
  }

  void end(const SoakFault& fault) {
    RobotNodes& robot = nodes_[fault.robot];
    switch (fault.kind) {
      case SoakFault::Kind::kNode:
        return robot.start(fault.node, now_s());
      case SoakFault::Kind::kRobot:
        robot.end(RobotNode::kTracker);
        for (const RobotNode node : kRobotNodes) robot.start(node, now_s());
        return;
      case SoakFault::Kind::kBlackout:
        return network_.cut_off(fault.robot, false);
    }
  }

  // --- the robots ---

  void deliver() {
    for (const auto& delivery : network_.receive(now_s()))
      send(delivery.to, nodes_[delivery.to].hear(*delivery.message, now_s()));
  }

  void send(int from, RobotNodes::Datagrams datagrams) {
    for (RobotNodes::Bytes& datagram : datagrams) {
      network_.broadcast(from, robots(),
                         std::make_shared<const RobotNodes::Bytes>(std::move(datagram)), now_s());
    }
  }

  void work(int i) {
    RobotNodes& robot = nodes_[i];
    const int ms = ms_ + late_ms_[i];
    if (ms % kTick_ms == 0) send(i, robot.settle(now_s()));
    const bool pursues = ms % kPursuit_ms == 0;
    const bool replans = ms % kReplanning_ms == 0 || robot.replanning_is_due();
    if (pursues || replans) {
      RobotSenses senses = sight_.senses(i, now_s(), robot);
      senses.measured = state(i);
      if (pursues) pursue(i, senses);
      if (replans) send(i, robot.replan(now_s(), senses));
    }
    if (ms % kTick_ms != 0) return;
    if (const auto command = robot.drive(now_s(), state(i)))
      simulator_.command(i, {command->speed, command->yaw_rate});
  }

  // --- where they go ---

  void pursue(int i, const RobotSenses& senses) {
    using Ending = GoalExecutive::Ending;
    Client& client = clients_[i];
    if (client.has_goal && nodes_[i].is_idle()) nodes_[i].go_to(patrols_.next(i), now_s());
    send(i, nodes_[i].pursue(now_s(), senses));
    const Ending ending = nodes_[i].ending();
    if (!client.has_goal || ending == Ending::kNone) return;
    if (ending != Ending::kReached) {
      ++run_.gave_up;
      return;
    }
    ++run_.arrivals;
    patrols_.arrive(i);
    note_arrival_gap(client);
    client.arrived_s = run_.time_s;
    client.has_goal = false;
    client.free_s = run_.time_s + scene_.stay_s;
  }

  void note_arrival_gap(const Client& client) {
    run_.longest_without_arrival_s =
        std::max(run_.longest_without_arrival_s, run_.time_s - client.arrived_s);
  }

  void guide(int i) {
    Client& client = clients_[i];
    const Vector2 place = state(i).pose.position;
    if (!client.has_goal && run_.time_s >= client.free_s) client.has_goal = true;
    if (!client.has_goal) client.watch.restart(run_.time_s, place);
    const double wait_s = client.watch.update(run_.time_s, place);
    run_.longest_wait_s = std::max(run_.longest_wait_s, wait_s);
    const bool was_stuck = std::exchange(client.is_stuck, wait_s > SoakRun::kStuck_s);
    if (!client.is_stuck) return;
    if (!was_stuck) {
      client.stuck = run_.stuck.size();
      run_.stuck.push_back(
          {i, run_.time_s - wait_s, wait_s, place, patrols_.next(i), nodes_[i].words()});
    }
    run_.stuck[client.stuck].lasts_s = wait_s;
  }

  void swap() {
    patrols_.swap();
    for (int i = 0; i < robots(); ++i) {
      if (clients_[i].has_goal && nodes_[i].runs(RobotNode::kGlobalPlanner))
        nodes_[i].go_to(patrols_.next(i), now_s());
    }
  }

  void note_minute() {
    run_.promises = {};
    double wait_s = 0.0;
    for (int i = 0; i < robots(); ++i) {
      const RobotNodes::Counts counts = nodes_[i].counts();
      run_.promises.breaches += counts.breaches;
      run_.promises.lease_stops += counts.lease_stops;
      run_.promises.refusals += counts.refusals;
      wait_s = std::max(wait_s, clients_[i].watch.update(run_.time_s, state(i).pose.position));
    }
    // The maps that the sight keeps belong to no robot, and come and go with what is seen.
    sight_.forget_maps();
    run_.minutes.push_back({memory_bytes(), run_.arrivals, wait_s});
  }

  const SoakScene& scene_;
  WorldSimulator simulator_;
  StraySight sight_;
  LossyNetwork<std::shared_ptr<const RobotNodes::Bytes>> network_;
  Patrols patrols_;
  std::deque<RobotNodes> nodes_;
  std::vector<int> late_ms_;
  std::vector<Client> clients_;
  std::vector<SoakFault>::const_iterator next_fault_;
  std::vector<LinkChange>::const_iterator next_link_;
  std::vector<SoakFault> under_way_;
  int ms_ = 0;
  SoakRun run_;
};

}  // namespace

SoakRun run_soak(const SoakScene& scene, const std::function<void(const SoakRun&)>& after_minute) {
  return Soak(scene).run(after_minute);
}

}  // namespace mocha
